//! What the example is made of: two state spaces, a measure of distance, and charts.

pub mod chart;
pub mod distance;
pub mod interval;
pub mod target;
pub mod three_states;

use chainlight::chain::StateClass;
use chainlight::render::ChainRun;
use chainlight::stats::effective_samples::{EffectiveSamples, effective_sample_size};
use chainlight::stats::group_means::GroupMeans;
use chainlight::systems::chains::{BATCHES, ChainStatistics, VISIT_CLASSES};

/// Groups of chains, each independent of all others.
pub const GROUPS: u32 = 20;
/// Chains of each group: at most [`BATCHES`], so that visits are counted for each chain apart.
pub const CHAINS: u32 = 5;
/// Steps of each chain after which histograms are taken: 1,000 and 1,000,000 steps of all chains.
pub const STEPS: [u64; 2] = [10, 10_000];

/// Parts of the classes that are about as large as what chains get stuck in.
const COARSE: usize = 5;

/// Where chains have been, class by class, and where they should have been.
pub struct Sampled {
    /// Steps after which a chain was in each class, by chain.
    pub visits: Vec<Vec<u64>>,
    /// The probability of each class.
    pub expected: Vec<f64>,
}

impl Sampled {
    /// Where the chains of `run` have been since it started.
    pub fn of(run: &ChainRun, expected: Vec<f64>) -> Self {
        let classes = expected.len();
        let groups = run.statistics_by_group();
        let visits = groups.iter().flat_map(|group| by_chain(group, classes)).collect();
        Self { visits, expected }
    }

    /// Steps of all chains.
    pub fn total(&self) -> u64 {
        self.visits.iter().flatten().sum()
    }

    /// The share of all steps after which a chain was in each class.
    pub fn shares(&self) -> Vec<f64> {
        let total = self.total().max(1) as f64;
        let visits = |class: usize| self.visits.iter().map(|chain| chain[class]).sum::<u64>();
        (0..self.expected.len())
            .map(|class| visits(class) as f64 / total)
            .collect()
    }

    /// The total variation between shares and probabilities.
    pub fn distance(&self) -> f64 {
        distance::total_variation(&self.shares(), &self.expected)
    }

    /// What that is expected to be for as many independent samples.
    pub fn expected_distance(&self) -> f64 {
        distance::expected(&self.expected, self.total())
    }

    /// How many independent samples the chains are worth for the shares of single classes, by the spread over groups; unknown
    /// where nothing varies.
    pub fn worth(&self) -> Option<EffectiveSamples> {
        self.worth_for(1)
    }

    /// The same for the shares of so many neighbouring classes together.
    fn worth_for(&self, together: usize) -> Option<EffectiveSamples> {
        let rows: Vec<Vec<f64>> = self
            .visits
            .chunks(CHAINS as usize)
            .map(|chains| group_shares(chains, together))
            .collect();
        effective_sample_size(&GroupMeans::from_rows(&rows).ok()?)
    }

    /// What the distance exceeds with a probability of at most about `alpha` if nothing is wrong: that of as many
    /// independent samples as the chains are worth at least. Chains that seldom cross a gap are worth far less for what lies
    /// on either side of it together than for single classes, so the least of both counts.
    pub fn bound(&self, alpha: f64) -> Option<f64> {
        let least = |together| self.worth_for(together).map(|worth| worth.interval[0]);
        let few = least(1)?.min(least(self.expected.len().div_ceil(COARSE))?);
        Some(distance::bound(&self.expected, few.max(1.0), alpha))
    }
}

/// The shares of a group's chains in `together` neighbouring classes each.
fn group_shares(chains: &[Vec<u64>], together: usize) -> Vec<f64> {
    let total = chains.iter().flatten().sum::<u64>().max(1) as f64;
    let classes = chains.first().map_or(0, Vec::len);
    let visits = |class: usize| chains.iter().map(|chain| chain[class]).sum::<u64>();
    let first = (0..classes).step_by(together);
    let sum = |first: usize| (first..classes.min(first + together)).map(visits).sum::<u64>() as f64;
    first.map(|first| sum(first) / total).collect()
}

/// The visits of a group's chains: the core counts them by batch, of which each has one chain here, and block, which is what
/// states are classed by here.
fn by_chain(group: &ChainStatistics, classes: usize) -> Vec<Vec<u64>> {
    const { assert!(CHAINS as usize <= BATCHES) };
    debug_assert!(classes <= StateClass::BLOCKS);
    let of_batch = |batch: usize| group.visits[batch * VISIT_CLASSES..][..classes].to_vec();
    (0..CHAINS as usize).map(of_batch).collect()
}
