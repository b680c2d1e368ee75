//! A group of chains: what it owns alone, so that groups are independent of each other.

use crate::chain::{Normalization, distinct, resample};
use crate::film::{FilmError, GroupFilm};
use crate::sampling::{Purpose, StreamKey};
use crate::systems::chains::{VISIT_CLASSES, bootstrap_step, visit_classes};
use std::sync::{Arc, Mutex};

/// A group's film and normalization.
#[derive(Debug)]
pub struct Group {
    /// Where its chains splat.
    pub film: Arc<Mutex<GroupFilm>>,
    /// b, from its own bootstrap.
    pub normalization: Normalization,
    /// How many different samples its chains start from.
    pub distinct_seeds: usize,
    /// The bootstrap's weight by class, numbered as visits are: sums over samples.
    pub class_weights: Vec<f64>,
}

/// The samples of a group's bootstrap: sample number round · chains + chain, chains counted inside the group.
#[derive(Clone, Debug, Default)]
pub(super) struct BootstrapSamples {
    pub(super) weights: Vec<f64>,
    pub(super) classes: Vec<u32>,
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

impl Group {
    pub(super) fn new(width: u32, height: u32) -> Result<Self, FilmError> {
        Ok(Self {
            film: Arc::new(Mutex::new(GroupFilm::new(width, height)?)),
            normalization: Normalization::of(&[]),
            distinct_seeds: 0,
            class_weights: vec![0.0; VISIT_CLASSES],
        })
    }

    /// Takes the bootstrap's outcome: the normalization, and a seed for each of `chains` chains, resampled in proportion to
    /// the samples' weights. No seeds if no sample has any.
    pub(super) fn settle(&mut self, samples: &BootstrapSamples, seed: u64, first_chain: u32, chains: u32) -> Vec<Seed> {
        self.normalization = Normalization::of(&samples.weights);
        for (&weight, &class) in samples.weights.iter().zip(&samples.classes) {
            if weight > 0.0 {
                for entry in visit_classes(crate::chain::StateClass(class)) {
                    self.class_weights[entry] += weight;
                }
            }
        }
        let mut stream = StreamKey::new(seed, first_chain, bootstrap_step(0)).stream(Purpose::RESAMPLE, 0);
        let chosen = resample(&samples.weights, chains as usize, || stream.next_f64()).unwrap_or_default();
        self.distinct_seeds = distinct(&chosen);
        let seed_of = |&sample: &u32| Seed {
            chain: sample % chains,
            round: u64::from(sample / chains),
        };
        chosen.iter().map(seed_of).collect()
    }
}
