//! How a group of chains starts: its own normalization, and seeds from the same samples.

use crate::chain::{Normalization, StateClass, distinct, resample};
use crate::sampling::{Purpose, StreamKey};
use crate::systems::chains::{VISIT_CLASSES, bootstrap_step, visit_classes};

/// What a group's bootstrap came to.
#[derive(Clone, Debug)]
pub struct Start {
    /// b, with its standard error.
    pub normalization: Normalization,
    /// How many different samples the group's chains start from; none if no sample has any light.
    pub distinct_seeds: usize,
    /// The samples' weights by class, numbered as visits are: sums over samples.
    pub class_weights: Vec<f64>,
}

impl Default for Start {
    fn default() -> Self {
        Self {
            normalization: Normalization::of(&[]),
            distinct_seeds: 0,
            class_weights: vec![0.0; VISIT_CLASSES],
        }
    }
}

/// The samples of a group's bootstrap: sample number round · chains + chain, chains counted inside the group.
#[derive(Clone, Debug, Default)]
pub(super) struct BootstrapSamples {
    pub(super) weights: Vec<f64>,
    pub(super) classes: Vec<u32>,
}

impl BootstrapSamples {
    pub(super) fn new(count: usize) -> Self {
        Self {
            weights: vec![0.0; count],
            classes: vec![0; count],
        }
    }
}

/// A seed: which chain of the group drew it, in which round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Seed {
    pub(super) chain: u32,
    pub(super) round: u64,
}

impl Seed {
    /// The key under which the sample was drawn. `first_chain` is the global number of the group's first chain.
    pub(super) const fn key(self, seed: u64, first_chain: u32) -> StreamKey {
        StreamKey::new(seed, first_chain + self.chain, bootstrap_step(self.round))
    }
}

impl Start {
    /// The normalization, and a seed for each of `chains` chains, resampled in proportion to the samples' weights. No seeds
    /// if no sample has any.
    pub(super) fn from_samples(
        samples: &BootstrapSamples,
        seed: u64,
        first_chain: u32,
        chains: u32,
    ) -> (Self, Vec<Seed>) {
        let mut class_weights = vec![0.0; VISIT_CLASSES];
        for (&weight, &class) in samples.weights.iter().zip(&samples.classes) {
            if weight > 0.0 {
                for entry in visit_classes(StateClass(class)) {
                    class_weights[entry] += weight;
                }
            }
        }
        let mut stream = StreamKey::new(seed, first_chain, bootstrap_step(0)).stream(Purpose::RESAMPLE, 0);
        let chosen = resample(&samples.weights, chains as usize, || stream.next_f64()).unwrap_or_default();
        let seed_of = |&sample: &u32| Seed {
            chain: sample % chains,
            round: u64::from(sample / chains),
        };
        let start = Self {
            normalization: Normalization::of(&samples.weights),
            distinct_seeds: distinct(&chosen),
            class_weights,
        };
        (start, chosen.iter().map(seed_of).collect())
    }
}
