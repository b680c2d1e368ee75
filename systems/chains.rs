//! What the systems of chains share beside a tile's own: mutations, which chains try which, and what came of it.

use crate::chain::{KeyChain, StateClass};
use crate::path::{ChainKey, ChainTable};
use crate::plan::{AnyMutation, MAX_MUTATIONS, MovesVertices, MutationPlan};
use crate::sampling::StreamKey;
use crate::table::{Read, Rows};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::SystemParam;
use std::ops::Range;
use std::sync::Arc;

use super::propose::MovesPaths;
use super::tile::TilePlace;

/// The mutations of the plan, shared by all tiles.
#[derive(Resource, Clone, Debug)]
pub struct Mutations {
    list: Arc<[Arc<dyn AnyMutation>]>,
    weights: [f32; MAX_MUTATIONS],
    independent: usize,
    selective: bool,
    depth_first: Arc<[Option<Box<dyn MovesVertices>>]>,
    moves_paths: Arc<[Option<Box<dyn MovesPaths>>]>,
}

impl Mutations {
    /// The mutations of a plan, of which one must be independent.
    ///
    /// # Panics
    /// Where a plan has too many of them or no independent one, which no plan has.
    #[must_use]
    pub fn new(plan: &[MutationPlan]) -> Self {
        let list: Arc<[Arc<dyn AnyMutation>]> = plan.iter().map(|planned| Arc::clone(&planned.mutation)).collect();
        let mut weights = [0.0; MAX_MUTATIONS];
        for (weight, mutation) in weights.iter_mut().zip(list.iter()) {
            *weight = mutation.weight();
        }
        Self {
            weights,
            independent: list.iter().position(|m| m.is_independent()).unwrap_or(0),
            selective: list.iter().any(|m| m.is_selective() && m.weight() > 0.0),
            depth_first: list.iter().map(|m| m.depth_first()).collect(),
            moves_paths: list.iter().map(|m| m.moves_paths()).collect(),
            list,
        }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Mutation number `number`.
    #[must_use]
    pub fn get(&self, number: usize) -> Option<&Arc<dyn AnyMutation>> {
        self.list.get(number)
    }

    /// How mutation number `number` moves one path after another, if it can.
    #[inline]
    #[must_use]
    pub fn depth_first(&self, number: usize) -> Option<&dyn MovesVertices> {
        self.depth_first.get(number)?.as_deref()
    }

    /// How mutation number `number` moves whole paths, if it does.
    #[inline]
    #[must_use]
    pub fn moves_paths(&self, number: usize) -> Option<&dyn MovesPaths> {
        self.moves_paths.get(number)?.as_deref()
    }

    /// The number of the independent mutation, which bootstraps draw with.
    #[must_use]
    pub const fn independent(&self) -> usize {
        self.independent
    }

    /// Whether the choice of a mutation depends on the state.
    #[must_use]
    pub const fn is_selective(&self) -> bool {
        self.selective
    }

    /// How likely each mutation is to be chosen in a state of `class`, up to a common factor.
    #[inline]
    fn suitabilities(&self, class: StateClass) -> [f32; MAX_MUTATIONS] {
        let mut weights = self.weights;
        if self.selective {
            for (weight, mutation) in weights.iter_mut().zip(self.list.iter()) {
                if *weight > 0.0 {
                    let suitability = mutation.suitability(class);
                    // What is no number suits nothing, here as in the probability.
                    *weight *= if suitability.is_finite() {
                        suitability.max(0.0)
                    } else {
                        0.0
                    };
                }
            }
        }
        weights
    }

    /// The probability of choosing mutation `number` in a state of `class`; 0 where none is suitable.
    #[must_use]
    pub fn probability(&self, number: usize, class: StateClass) -> f64 {
        let weights = self.suitabilities(class);
        let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
        match weights.get(number) {
            Some(&weight) if total > 0.0 => f64::from(weight) / total,
            _ => 0.0,
        }
    }

    /// The mutation that `u` in [0, 1) chooses in a state of `class`; the independent one where none is suitable, whose
    /// probability there is 0, so that the proposal will be turned down.
    #[inline]
    #[must_use]
    pub fn choose(&self, class: StateClass, u: f64) -> usize {
        let weights = self.suitabilities(class).map(f64::from);
        let total: f64 = weights.iter().sum();
        let mut left = u * total;
        let mut chosen = self.independent;
        for (number, &weight) in weights.iter().enumerate() {
            if weight > 0.0 {
                chosen = number;
                if left < weight {
                    break;
                }
                left -= weight;
            }
        }
        chosen
    }
}

/// Which part of [`MutationList`](crate::chain::MutationList) belongs to which mutation.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct MutationLists {
    starts: [u32; MAX_MUTATIONS + 1],
}

impl MutationLists {
    /// The entries of mutation `number`.
    #[inline]
    #[must_use]
    pub const fn entries(&self, number: usize) -> Range<usize> {
        self.starts[number] as usize..self.starts[number + 1] as usize
    }

    /// The lists of mutations that were chosen so many times each.
    #[must_use]
    pub fn of_counts(counts: &[u32; MAX_MUTATIONS]) -> Self {
        let mut starts = [0; MAX_MUTATIONS + 1];
        for (number, count) in counts.iter().enumerate() {
            starts[number + 1] = starts[number] + count;
        }
        Self { starts }
    }
}

/// The random streams of chains: their own in steps, those that drew a seed before.
#[derive(SystemParam)]
pub struct Keys<'w, 's> {
    keys: Read<'w, 's, ChainKey, ChainTable>,
    chains: Read<'w, 's, KeyChain, ChainTable>,
}

impl Keys<'_, '_> {
    /// The columns as slices.
    #[must_use]
    pub fn columns(&self) -> KeyColumns<'_> {
        KeyColumns {
            keys: self.keys.rows(),
            chains: self.chains.rows(),
        }
    }
}

/// [`Keys`] as slices.
#[derive(Clone, Copy)]
pub struct KeyColumns<'a> {
    keys: &'a [ChainKey],
    chains: &'a [KeyChain],
}

impl KeyColumns<'_> {
    /// The key of a chain.
    #[inline]
    #[must_use]
    pub fn at(&self, chain: usize) -> StreamKey {
        StreamKey::from_bits(self.keys.at(chain), self.chains.at(chain))
    }
}

/// The step in a random stream's key that stands for round `round` of a bootstrap: apart from any step of a chain.
#[must_use]
pub const fn bootstrap_step(round: u64) -> u64 {
    round | 1 << 63
}

/// What came of the proposals of one mutation in states of one length, or one signature.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct ProposalCount {
    /// Proposals made.
    pub proposed: u64,
    /// Proposals taken.
    pub accepted: u64,
    /// Proposals that could not be taken: their target is 0 or not finite, or there is no way back.
    pub impossible: u64,
}

impl ProposalCount {
    /// The sum of two counts.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self {
            proposed: self.proposed + other.proposed,
            accepted: self.accepted + other.accepted,
            impossible: self.impossible + other.impossible,
        }
    }
}

/// Chains in a batch share a remainder by this: what a group's chains visited is kept apart for so many batches, so that
/// the spread inside a group is known.
pub const BATCHES: usize = 16;

/// Classes that visits are counted by: blocks, then lengths, then signatures.
pub const VISIT_CLASSES: usize = StateClass::BLOCKS + StateClass::LENGTHS + StateClass::SIGNATURES;

/// Classes that proposals are counted by: lengths, then signatures of the states that were left.
const PROPOSAL_CLASSES: usize = StateClass::LENGTHS + StateClass::SIGNATURES;

/// The classes of a state, numbered as [`ChainStatistics::visits`] counts them.
#[inline]
#[must_use]
pub fn visit_classes(class: StateClass) -> [usize; 3] {
    [
        class.block() as usize,
        StateClass::BLOCKS + class.length_class(),
        StateClass::BLOCKS + StateClass::LENGTHS + class.signature().number() % StateClass::SIGNATURES,
    ]
}

/// Which group a tile belongs to.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct GroupPlace {
    /// Number of the group.
    pub group: u32,
    /// Global number of the group's first chain.
    pub first_chain: u32,
    /// The power of two that weights of independent proposals are added up in units of: near the group's b.
    pub unit: f64,
}

/// The sum of weights f(y)/T(y) of independent proposals, in fixed point, so that it does not depend on any order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WeightTally {
    /// In steps of 2⁻⁶⁰ units.
    pub sum: i128,
    /// How many were added, those of no weight included.
    pub count: u64,
}

/// Steps of a [`WeightTally`] in a unit.
const WEIGHT_STEPS: f64 = (1_u64 << 60) as f64;

impl WeightTally {
    /// Adds one weight. One that is not finite counts as none.
    #[inline]
    pub fn add(&mut self, weight: f64, unit: f64) {
        self.count += 1;
        let steps = weight / unit * WEIGHT_STEPS;
        if steps.is_finite() && steps > 0.0 {
            self.sum = self.sum.saturating_add(steps as i128);
        }
    }

    /// The mean of these weights and of `count` others whose mean is `mean`.
    #[must_use]
    pub fn mean_with(&self, mean: f64, count: u64, unit: f64) -> f64 {
        let all = (self.count + count) as f64;
        if all > 0.0 {
            (self.sum as f64 / WEIGHT_STEPS * unit + mean * count as f64) / all
        } else {
            0.0
        }
    }
}

/// The power of two at or above `b`; 1 if there is none.
#[must_use]
pub fn weight_unit(b: f64) -> f64 {
    if b.is_normal() && b > 0.0 {
        libm::exp2(libm::ceil(libm::log2(b)))
    } else {
        1.0
    }
}

impl GroupPlace {
    /// The batch of the chain with this global number.
    #[inline]
    #[must_use]
    pub const fn batch(&self, chain: u32) -> usize {
        (chain - self.first_chain) as usize % BATCHES
    }
}

/// What a tile's chains have tried and where they have been. Counts only: they add up in any order.
#[derive(Resource, Clone, Debug, PartialEq, Eq)]
pub struct ChainStatistics {
    /// By mutation, then by class of the state that was left: its length, and its signature.
    pub proposals: Vec<ProposalCount>,
    /// By batch, then by class: steps after which a chain was there.
    pub visits: Vec<u64>,
    /// What independent proposals weighed.
    pub independent: WeightTally,
}

impl ChainStatistics {
    /// Nothing tried with any of `mutations` mutations.
    #[must_use]
    pub fn new(mutations: usize) -> Self {
        Self {
            proposals: vec![ProposalCount::default(); mutations * PROPOSAL_CLASSES],
            visits: vec![0; BATCHES * VISIT_CLASSES],
            independent: WeightTally::default(),
        }
    }

    /// Counts what mutation `number` came to in a state of class `left`.
    #[inline]
    pub fn book(&mut self, number: usize, left: StateClass, accepted: bool, impossible: bool) {
        let signature = StateClass::LENGTHS + left.signature().number() % StateClass::SIGNATURES;
        for class in [left.length_class(), signature] {
            if let Some(count) = self.proposals.get_mut(number * PROPOSAL_CLASSES + class) {
                count.proposed += 1;
                count.accepted += u64::from(accepted);
                count.impossible += u64::from(impossible);
            }
        }
    }

    /// Counts one step of a chain of `batch` after which its state is of `class`.
    #[inline]
    pub fn visit(&mut self, batch: usize, class: StateClass) {
        for entry in visit_classes(class) {
            self.visits[batch * VISIT_CLASSES + entry] += 1;
        }
    }

    /// Adds what another tile counted.
    pub fn add(&mut self, other: &Self) {
        for (sum, more) in self.proposals.iter_mut().zip(&other.proposals) {
            *sum = sum.plus(*more);
        }
        for (sum, more) in self.visits.iter_mut().zip(&other.visits) {
            *sum += more;
        }
        self.independent.sum = self.independent.sum.saturating_add(other.independent.sum);
        self.independent.count += other.independent.count;
    }

    /// What came of mutation `number` in states of a length.
    #[must_use]
    pub fn of_length(&self, number: usize, length: usize) -> ProposalCount {
        self.of_class(number, length)
    }

    /// What came of mutation `number` in states of the signature of this number.
    #[must_use]
    pub fn of_signature(&self, number: usize, signature: usize) -> ProposalCount {
        self.of_class(number, StateClass::LENGTHS + signature)
    }

    fn of_class(&self, number: usize, class: usize) -> ProposalCount {
        let entry = self.proposals.get(number * PROPOSAL_CLASSES + class);
        entry.copied().unwrap_or_default()
    }

    /// What came of all mutations together.
    #[must_use]
    pub fn of_all(&self) -> ProposalCount {
        let mutations = 0..self.proposals.len() / PROPOSAL_CLASSES;
        mutations
            .flat_map(|number| (0..StateClass::LENGTHS).map(move |length| self.of_length(number, length)))
            .fold(ProposalCount::default(), ProposalCount::plus)
    }
}

/// The place of a chain's random streams and of its tile, for systems that need no more.
#[inline]
#[must_use]
pub const fn global_chain(place: &TilePlace, chain: usize) -> u32 {
    place.first_chain + chain as u32
}
