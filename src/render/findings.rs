//! What a render with chains tells of itself, beyond its picture: whether to believe it.

use super::{ChainRender, DirectLight, Rendering};
use crate::chain::{LongestRejections, Signature, StateClass};
use crate::path::ChainTable;
use crate::plan::{Effect, MutationPlan};
use crate::stats::agreement::{Agreement, judge};
use crate::stats::comparison::compare;
use crate::stats::effective_samples::{EffectiveSamples, effective_sample_size};
use crate::stats::error::PictureError;
use crate::stats::group_means::GroupMeans;
use crate::stats::student::t_interval;
use crate::stats::z_test::Estimate;
use crate::systems::chains::{BATCHES, ChainStatistics, ProposalCount, VISIT_CLASSES};
use serde::Serialize;

/// Of a hundred renders in which nothing is wrong, one may say that its groups disagree.
const ALPHA: f64 = 0.01;
/// Standard errors that a share has to be from nothing to be compared.
const RESOLVED: f64 = 5.0;
/// Visits of a batch in the mean below which a class is too rare for a ratio of variances to mean anything.
const LEAST_VISITS: f64 = 64.0;
/// Visits of a group below which it may have missed a class by chance, since a chain stays where it is for a while.
const MISSED_VISITS: f64 = 2048.0;
/// A class that has this share of the light and is missed by a group is named.
const NOTABLE_SHARE: f64 = 1e-4;

/// What a render with chains tells of itself.
#[derive(Clone, Debug, Serialize)]
pub struct Findings {
    /// Groups, each independent of all others.
    pub groups: u32,
    /// Chains of all groups.
    pub chains: u32,
    /// b, the mean of the groups' own, from bootstraps and from independent proposals since.
    pub normalization: f64,
    /// The interval that covers the true b with 95 % probability, by Student's t over groups. `None` with a single group.
    pub normalization_interval: Option<[f64; 2]>,
    /// Samples of all bootstraps.
    pub bootstrap_samples: u64,
    /// Different samples that chains start from.
    pub distinct_seeds: usize,
    /// The picture's relative error over block means, see [`Rendering::error`].
    pub error: Option<PictureError>,
    /// What came of each mutation.
    pub mutations: Vec<MutationFindings>,
    /// The most steps in a row that a chain took nothing, among all chains.
    pub longest_rejections: u32,
    /// The global number of that chain.
    pub longest_rejections_chain: u32,
    /// How many independent draws of where a state lies on the film would tell as much as all chains do.
    pub effective_samples: Option<EffectiveSamples>,
    /// How groups agree in every class that was visited often enough to be judged.
    pub agreement: Vec<ClassAgreement>,
    /// Classes in which groups disagree more than their own spread explains.
    pub disagreements: Vec<ClassFinding>,
    /// Notable classes that some groups have never been in.
    pub missed: Vec<ClassFinding>,
    /// Classes whose share of the light differs from what the bootstraps found.
    pub against_bootstrap: Vec<ClassFinding>,
    /// Whether direct light is rendered apart, and was found.
    #[serde(skip)]
    pub has_direct: bool,
    /// Whether anything in the scene emits: if not, black is what there is to find, and the scene's reader says so.
    #[serde(skip)]
    pub is_lit: bool,
    /// Ratio of the spread between groups to that expected from inside them, for every block that was visited often enough;
    /// 0 for others.
    #[serde(skip)]
    pub block_ratios: Vec<f64>,
}

/// What came of a mutation.
#[derive(Clone, Debug, Serialize)]
pub struct MutationFindings {
    /// Its name.
    pub name: &'static str,
    /// Its settings.
    pub settings: serde_json::Value,
    /// All of its proposals.
    #[serde(flatten)]
    pub count: ProposalCount,
    /// The same by length of the state that was left; lengths without proposals are left out.
    pub by_length: Vec<LengthFindings>,
    /// The same by signature of the state that was left; signatures without proposals are left out.
    pub by_signature: Vec<SignatureFindings>,
}

/// What came of a mutation in states of one length.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct LengthFindings {
    /// The length; the last stands for all longer ones.
    pub length: usize,
    /// Its proposals.
    #[serde(flatten)]
    pub count: ProposalCount,
}

/// What came of a mutation in states of one signature.
#[derive(Clone, Debug, Serialize)]
pub struct SignatureFindings {
    /// The signature's [name](Signature::name).
    pub signature: String,
    /// Its proposals.
    #[serde(flatten)]
    pub count: ProposalCount,
}

/// How groups agree in a class of states.
#[derive(Clone, Debug, Serialize)]
pub struct ClassAgreement {
    /// Its name.
    pub class: String,
    /// Its share of the light, by the chains.
    pub share: f64,
    /// The spread between groups against that inside them.
    #[serde(flatten)]
    pub agreement: Agreement,
}

/// Something about a class of states.
#[derive(Clone, Debug, Serialize)]
pub struct ClassFinding {
    /// Its name.
    pub class: String,
    /// Its share of the light, by the chains.
    pub share: f64,
    /// What it is compared with: for groups, the ratio of variances; for bootstraps, their share; for missed classes, the
    /// share of the groups that missed it.
    pub against: f64,
    /// The probability of as much when nothing is wrong.
    pub p: f64,
}

impl Findings {
    /// What there is to tell of `render`.
    #[must_use]
    pub fn of(render: &ChainRender) -> Self {
        let counts = render.run.counts();
        let by_group = render.run.statistics_by_group();
        let mut all = ChainStatistics::new(render.run.chains().mutations.len());
        by_group.iter().for_each(|group| all.add(group));
        let starts = render.run.starts();
        let b = render.run.normalizations();
        let (normalization, normalization_interval) = normalization(&b);
        let shares = Shares::new(&by_group);
        let agreements = shares.agreements(counts.chains);
        let mut block_ratios = vec![0.0; StateClass::BLOCKS];
        for (class, agreement) in &agreements {
            if *class < StateClass::BLOCKS {
                block_ratios[*class] = agreement.ratio;
            }
        }
        let (longest_rejections, longest_rejections_chain) = longest_rejections(render);
        let mutations = render.run.chains().mutations.iter().enumerate();
        Self {
            groups: counts.groups,
            chains: counts.total(),
            normalization,
            normalization_interval,
            bootstrap_samples: starts.iter().map(|start| start.normalization.samples).sum(),
            distinct_seeds: starts.iter().map(|start| start.distinct_seeds).sum(),
            error: render.error(),
            mutations: mutations
                .map(|(number, planned)| of_mutation(&all, number, planned))
                .collect(),
            longest_rejections,
            longest_rejections_chain,
            effective_samples: shares.of_blocks().and_then(|shares| effective_sample_size(&shares)),
            agreement: agreements
                .iter()
                .map(|(class, agreement)| ClassAgreement {
                    class: render.class_name(*class),
                    share: shares.mean(*class),
                    agreement: *agreement,
                })
                .collect(),
            disagreements: disagreements(render, &shares, &agreements),
            missed: missed(render, &shares),
            against_bootstrap: against_bootstrap(render, &shares),
            has_direct: render.direct().is_some_and(DirectLight::is_lit),
            is_lit: render.plan().has(Effect::Emission),
            block_ratios,
        }
    }

    /// What somebody who looks at the picture has to know, in words.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if !self.is_lit {
            return warnings;
        }
        if self.normalization == 0.0 {
            let samples = self.bootstrap_samples;
            warnings.push(if self.has_direct {
                format!(
                    "none of {samples} bootstrap samples found light that is not direct: the picture has direct light alone, which may \
                     not be all there is; raise --bootstrap"
                )
            } else {
                format!(
                    "none of {samples} bootstrap samples found light: the picture is black, which it may not be; raise --bootstrap"
                )
            });
            return warnings;
        }
        if self.distinct_seeds < self.chains as usize / 2 {
            warnings.push(format!(
                "{} chains start from only {} different samples: light is hard to find here; raise --bootstrap",
                self.chains, self.distinct_seeds
            ));
        }
        if self.groups < 16 {
            warnings.push(format!(
                "errors from {} groups are themselves uncertain; 16 are enough",
                self.groups
            ));
        }
        if let Some(worst) = worst(&self.disagreements) {
            warnings.push(format!(
                "groups disagree in {} of their statistics, most in {}: {:.1} times the variance that chains inside a \
                 group explain; the chains have not mixed, and the error may be larger than it says",
                self.disagreements.len(),
                worst.class,
                worst.against
            ));
        }
        if let Some(worst) = self.missed.iter().max_by(|a, b| a.share.total_cmp(&b.share)) {
            warnings.push(format!(
                "{:.0} % of the groups have never been in {}, where the others find {:.2} % of the light: it is hard to \
                 get there",
                100.0 * worst.against,
                worst.class,
                100.0 * worst.share
            ));
        }
        if let Some(worst) = worst(&self.against_bootstrap) {
            warnings.push(format!(
                "chains and bootstraps disagree in {} of their statistics, most in {}: {:.3} % of the light by the \
                 chains, {:.3} % by independent samples; chains may have missed something",
                self.against_bootstrap.len(),
                worst.class,
                100.0 * worst.share,
                100.0 * worst.against
            ));
        }
        warnings
    }
}

fn worst(findings: &[ClassFinding]) -> Option<&ClassFinding> {
    findings.iter().min_by(|a, b| a.p.total_cmp(&b.p))
}

/// The mean of the groups' b, and its interval.
fn normalization(b: &[f64]) -> (f64, Option<[f64; 2]>) {
    let Estimate { mean, error } = Estimate::of(b);
    let interval = (b.len() > 1).then(|| {
        let [low, high] = t_interval(mean, error, (b.len() - 1) as f64, 0.95);
        [low.max(0.0), high]
    });
    (mean, interval)
}

fn longest_rejections(render: &ChainRender) -> (u32, u32) {
    let mut longest = (0, 0);
    render.run.for_each_tile(&mut |chains, world| {
        let mut runs = vec![0; chains.len()];
        world.read::<LongestRejections, ChainTable>(&mut runs);
        for (chain, run) in chains.zip(runs) {
            if run > longest.0 {
                longest = (run, chain);
            }
        }
    });
    longest
}

fn of_mutation(all: &ChainStatistics, number: usize, planned: &MutationPlan) -> MutationFindings {
    let lengths = 0..StateClass::LENGTHS;
    let by_length: Vec<LengthFindings> = lengths
        .map(|length| LengthFindings {
            length,
            count: all.of_length(number, length),
        })
        .filter(|findings| findings.count.proposed > 0)
        .collect();
    let by_signature = (0..StateClass::SIGNATURES).map(|signature| SignatureFindings {
        signature: Signature::of_number(signature).name(),
        count: all.of_signature(number, signature),
    });
    MutationFindings {
        name: planned.mutation.name(),
        settings: planned.mutation.settings(),
        count: by_length
            .iter()
            .fold(ProposalCount::default(), |sum, f| sum.plus(f.count)),
        by_length,
        by_signature: by_signature.filter(|findings| findings.count.proposed > 0).collect(),
    }
}

/// Shares of the steps that chains spent in each class, by group and by batch.
struct Shares {
    groups: usize,
    /// Group-major.
    by_group: Vec<f64>,
    /// Group-major, then by batch.
    by_batch: Vec<f64>,
    /// Visits of a batch to any block, in the mean.
    batch_visits: f64,
}

impl Shares {
    fn new(statistics: &[ChainStatistics]) -> Self {
        let mut shares = Self {
            groups: statistics.len(),
            by_group: Vec::new(),
            by_batch: Vec::new(),
            batch_visits: 0.0,
        };
        for group in statistics {
            let mut sum = vec![0_u64; VISIT_CLASSES];
            for batch in group.visits.chunks_exact(VISIT_CLASSES) {
                shares.batch_visits += shares.push(batch, true) / (BATCHES * statistics.len()) as f64;
                sum.iter_mut().zip(batch).for_each(|(sum, visits)| *sum += visits);
            }
            shares.push(&sum, false);
        }
        shares
    }

    /// Appends the shares of one batch or group; how many visits it made.
    fn push(&mut self, visits: &[u64], batch: bool) -> f64 {
        // Every visit counts for one block.
        let total = visits[..StateClass::BLOCKS].iter().sum::<u64>() as f64;
        let shares = visits.iter().map(|&visits| visits as f64 / total.max(1.0));
        if batch {
            self.by_batch.extend(shares);
        } else {
            self.by_group.extend(shares);
        }
        total
    }

    fn of_group(&self, class: usize) -> Vec<f64> {
        self.by_group
            .chunks_exact(VISIT_CLASSES)
            .map(|group| group[class])
            .collect()
    }

    fn mean(&self, class: usize) -> f64 {
        self.of_group(class).iter().sum::<f64>() / self.groups as f64
    }

    fn of_blocks(&self) -> Option<GroupMeans> {
        let blocks = |group: &[f64]| group[..StateClass::BLOCKS].to_vec();
        let rows: Vec<Vec<f64>> = self.by_group.chunks_exact(VISIT_CLASSES).map(blocks).collect();
        GroupMeans::from_rows(&rows).ok()
    }

    /// How groups agree in the classes that were visited often enough.
    fn agreements(&self, chains: u32) -> Vec<(usize, Agreement)> {
        // Batches have to be equally large, or nearly so.
        if (chains as usize) < BATCHES || (!(chains as usize).is_multiple_of(BATCHES) && chains < 256) {
            return Vec::new();
        }
        let often = (0..VISIT_CLASSES).filter(|&class| self.mean(class) * self.batch_visits >= LEAST_VISITS);
        let agreement = |class: usize| {
            let batches: Vec<f64> = self
                .by_batch
                .chunks_exact(VISIT_CLASSES)
                .map(|batch| batch[class])
                .collect();
            Some((class, Agreement::of(&self.of_group(class), &batches)?))
        };
        often.filter_map(agreement).collect()
    }
}

/// Classes in which groups disagree more than chance lets them.
fn disagreements(render: &ChainRender, shares: &Shares, agreements: &[(usize, Agreement)]) -> Vec<ClassFinding> {
    let judged: Vec<Agreement> = agreements.iter().map(|(_, agreement)| *agreement).collect();
    judge(&judged, ALPHA)
        .into_iter()
        .map(|d| {
            let class = agreements[d.statistic].0;
            ClassFinding {
                class: render.class_name(class),
                share: shares.mean(class),
                against: d.ratio,
                p: d.p,
            }
        })
        .collect()
}

/// Notable classes that some groups have never been in, though all others often were.
fn missed(render: &ChainRender, shares: &Shares) -> Vec<ClassFinding> {
    let mut findings = Vec::new();
    for class in 0..VISIT_CLASSES {
        let share = shares.mean(class);
        let expected = share * shares.batch_visits * BATCHES as f64;
        let missed = shares.of_group(class).iter().filter(|&&share| share == 0.0).count();
        if missed > 0 && share >= NOTABLE_SHARE && expected >= MISSED_VISITS {
            findings.push(ClassFinding {
                class: render.class_name(class),
                share,
                against: missed as f64 / shares.groups as f64,
                p: 0.0,
            });
        }
    }
    findings
}

/// Classes whose share by the chains is not that by the bootstraps.
fn against_bootstrap(render: &ChainRender, shares: &Shares) -> Vec<ClassFinding> {
    let starts = render.run.starts();
    let share = |class: usize| {
        let of_group = |start: &super::Start| {
            let total: f64 = start.class_weights[..StateClass::BLOCKS].iter().sum();
            start.class_weights[class] / total.max(f64::MIN_POSITIVE)
        };
        Estimate::of(&starts.iter().map(of_group).collect::<Vec<_>>())
    };
    let freedom = [(shares.groups.max(2) - 1) as f64; 2];
    let compared: Vec<_> = (0..VISIT_CLASSES)
        .map(|class| (class, Estimate::of(&shares.of_group(class)), share(class)))
        // Rare classes are far from normal: those that groups seldom visit, and those that bootstraps do not tell from none.
        .filter(|(_, chains, bootstrap)| {
            let share = chains.mean.max(bootstrap.mean);
            share >= NOTABLE_SHARE
                && share * shares.batch_visits * BATCHES as f64 >= MISSED_VISITS
                && bootstrap.mean >= RESOLVED * bootstrap.error
        })
        .map(|(class, chains, bootstrap)| (class, chains, bootstrap, compare(chains, bootstrap, freedom)))
        .collect();
    let tests = compared.len();
    compared
        .into_iter()
        .filter(|(_, _, _, comparison)| comparison.error.is_finite() && !comparison.passes(ALPHA, tests))
        .map(|(class, chains, bootstrap, comparison)| ClassFinding {
            class: render.class_name(class),
            share: chains.mean,
            against: bootstrap.mean,
            p: comparison.p,
        })
        .collect()
}
