//! What every technique that runs chains needs, whatever their states are: the core that chooses, decides and counts.

use super::effect::EffectPlan;
use super::mutation::{MAX_MUTATIONS, MutationPlan, Registry, StateSpace};
use super::system::SystemPlan;
use super::table::{Extent, TableId, TablePlan};
use super::tile::{Subpaths, TilePlan};
use crate::chain::{
    Acceptance, AcceptedList, BootstrapWeight, ChosenMutation, Class, CommonDensity, ForwardDensity, KeyChain,
    LongestRejections, MutationList, ProposedClass, ProposedTarget, Rejections, ReverseDensity, Target,
};
use crate::path::{BookedWeight, ChainKey, Decisions};
use crate::systems::list::*;
use crate::table::LANES;
use std::sync::Arc;

/// How chains are run. None of it depends on threads or tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainSettings {
    /// Groups of chains, each independent of all others: the picture's error is the spread over them. 16 or more where an
    /// interval is to be trusted.
    pub groups: u32,
    /// Chains of a group; if not given, one for every eight pixels of the whole film, from 64 to 1024.
    pub chains: Option<u32>,
    /// Samples of a group's bootstrap; if not given, 64 for each of its chains, and at least 4096. They are rounded up to
    /// whole samples per chain.
    pub bootstrap: Option<u32>,
    /// Whether the parts of transition densities that acceptances do not need are kept too: for tests and replays.
    pub densities: bool,
}

impl Default for ChainSettings {
    fn default() -> Self {
        Self {
            groups: 16,
            chains: None,
            bootstrap: None,
            densities: false,
        }
    }
}

/// Chains of a group where the settings do not say.
const CHAINS: (u32, u32) = (64, 1024);
/// Pixels for each chain where the settings do not say.
const PIXELS_PER_CHAIN: u32 = 8;
/// Samples of a bootstrap for each chain, and at least for each group, where the settings do not say.
const BOOTSTRAP: (u32, u32) = (64, 4096);

impl ChainSettings {
    /// The settings in numbers, for a film of `pixels` pixels.
    #[must_use]
    pub fn counts(&self, pixels: u32) -> ChainCounts {
        let groups = self.groups.max(1);
        let usual = (pixels / PIXELS_PER_CHAIN / groups)
            .clamp(CHAINS.0, CHAINS.1)
            .next_multiple_of(LANES as u32);
        let chains = self.chains.unwrap_or(usual).max(1);
        let samples = self.bootstrap.unwrap_or((BOOTSTRAP.0 * chains).max(BOOTSTRAP.1));
        ChainCounts {
            groups,
            chains,
            rounds: samples.div_ceil(chains).max(1),
        }
    }
}

/// How many chains a plan runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainCounts {
    /// Groups.
    pub groups: u32,
    /// Chains of each group.
    pub chains: u32,
    /// Samples that each chain adds to its group's bootstrap.
    pub rounds: u32,
}

impl ChainCounts {
    /// Chains of all groups.
    #[must_use]
    pub const fn total(&self) -> u32 {
        self.groups * self.chains
    }

    /// Mutations per pixel of a film of `pixels` pixels after `steps` steps.
    #[must_use]
    pub fn mutations_per_pixel(&self, steps: u64, pixels: u32) -> f64 {
        steps as f64 * f64::from(self.total()) / f64::from(pixels)
    }

    /// The steps that come nearest to so many mutations per pixel, at least one. What [`Self::mutations_per_pixel`] says
    /// of some steps comes back as those.
    #[must_use]
    pub fn steps_for(&self, mutations_per_pixel: f64, pixels: u32) -> u64 {
        let mutations = mutations_per_pixel * f64::from(pixels);
        (mutations / f64::from(self.total())).round().max(1.0) as u64
    }
}

/// Why chains cannot be planned.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum ChainPlanError {
    /// Nothing is ever proposed.
    #[error("no mutation of {space} states has a weight above 0")]
    #[diagnostic(help("give one of them a weight: {names}"))]
    NoMutation {
        /// The state space.
        space: &'static str,
        /// The mutations there are.
        names: String,
    },
    /// Nothing can draw seeds.
    #[error("no mutation of {space} states is independent of the current one: none can draw the chains' seeds")]
    #[diagnostic(help("register one whose INDEPENDENT is true"))]
    NoIndependent {
        /// The state space.
        space: &'static str,
    },
    /// Chains over bidirectional path tracing are staged only.
    #[error("pssmlt-reference runs over pt alone")]
    #[diagnostic(help("leave --base out, or use pssmlt"))]
    Base,
    /// A mutation that only systems of the staged trace loop can run.
    #[error("`{mutation}` cannot run one chain after another")]
    #[diagnostic(help("switch it off with {mutation}:weight=0, or use pssmlt"))]
    NotDepthFirst {
        /// The mutation.
        mutation: &'static str,
    },
    /// A baseline traces depth first, and knows of no layers.
    #[error("{technique} does not split light into layers")]
    #[diagnostic(help("use {staged}, which brings the same light"))]
    Layers {
        /// The technique.
        technique: &'static str,
        /// The one that does.
        staged: &'static str,
    },
    /// Too many mutations.
    #[error("{count} mutations are planned, and {MAX_MUTATIONS} can be")]
    #[diagnostic(help("give those that are not needed a weight of 0"))]
    TooMany {
        /// How many.
        count: usize,
    },
}

/// What a technique brings beside the core: how its states are traced, evaluated and taken over.
#[derive(Clone, Debug, Default)]
pub struct StateSystems {
    /// Systems that run before those of mutations at the same place, in their order.
    pub before: Vec<SystemPlan>,
    /// Systems that run after them.
    pub systems: Vec<SystemPlan>,
    /// Tables. The first is the chain table, to which the core adds its columns.
    pub tables: Vec<TablePlan>,
    /// The subpaths of each chain, where states are paths of light.
    pub subpaths: Subpaths,
}

/// The mutations that a plan takes from `registry`: those of `space` that are ever tried, and the one that draws seeds.
///
/// # Errors
/// None is tried, or none can draw seeds.
pub fn choose_mutations(
    registry: &Registry,
    space: StateSpace,
    effects: &[EffectPlan],
) -> Result<Vec<MutationPlan>, ChainPlanError> {
    let here = || registry.iter().filter(|m| m.space() == space);
    let mut planned = Vec::new();
    let mut has_seeds = false;
    for mutation in here() {
        let tried = mutation.weight() > 0.0 && mutation.applies(effects).is_ok();
        let draws_seeds = mutation.is_independent() && !has_seeds;
        has_seeds |= draws_seeds;
        let reason = match (draws_seeds, tried) {
            (true, true) => "its weight is above 0, and it draws the seeds",
            (true, false) => "it draws the seeds",
            (false, true) => "its weight is above 0",
            (false, false) => continue,
        };
        planned.push(MutationPlan {
            mutation: Arc::clone(mutation),
            reason,
        });
    }
    if !has_seeds {
        return Err(ChainPlanError::NoIndependent { space: space.0 });
    }
    if planned.iter().all(|m| m.mutation.weight() <= 0.0) {
        let names: Vec<&str> = here().map(|m| m.name()).collect();
        return Err(ChainPlanError::NoMutation {
            space: space.0,
            names: names.join(", "),
        });
    }
    if planned.len() > MAX_MUTATIONS {
        return Err(ChainPlanError::TooMany { count: planned.len() });
    }
    Ok(planned)
}

/// A tile of chains: the core around `states`, with `mutations`.
#[must_use]
pub fn chain_tile(
    states: StateSystems,
    mutations: &[MutationPlan],
    counts: ChainCounts,
    densities: bool,
    size: Option<u32>,
) -> TilePlan {
    let StateSystems {
        before,
        systems,
        mut tables,
        subpaths,
    } = states;
    if tables.is_empty() {
        tables.push(TablePlan::new(TableId::CHAINS, Extent::PerChain(1)));
    }
    let chains = &mut tables[0];
    chains.is_state = true;
    core_columns(chains, densities);
    let selective = mutations
        .iter()
        .any(|m| m.mutation.is_selective() && m.mutation.weight() > 0.0);
    let mut all = core_before();
    all.extend(before);
    for planned in mutations {
        all.extend(planned.mutation.systems());
        planned.mutation.columns(&mut tables);
    }
    all.extend(systems);
    all.extend(core_after(selective || densities));
    // No tile has chains of two groups.
    let whole_group = counts.chains.next_multiple_of(LANES as u32);
    let mut tile = TilePlan::with_subpaths(subpaths, all, tables, size);
    if tile.size > whole_group {
        tile.resize(whole_group, "a whole group".to_owned());
    }
    tile
}

/// What the core runs before anything else at the same place.
fn core_before() -> Vec<SystemPlan> {
    vec![
        SystemPlan::new(KEY_SAMPLES, "a bootstrap's samples have streams of their own"),
        SystemPlan::new(START_INDEPENDENT, "a bootstrap's samples are independent proposals"),
        SystemPlan::new(KEY_CHAINS, "every step has streams of its own"),
        SystemPlan::new(CHOOSE_MUTATION, "a chain tries one mutation a step"),
        SystemPlan::new(DECIDE, "every chain decides exactly once a step"),
    ]
}

/// What the core runs after everything else at the same place.
fn core_after(weighs_choices: bool) -> Vec<SystemPlan> {
    let mut systems = vec![
        SystemPlan::new(WEIGH_SAMPLES, "the normalization is their mean weight"),
        SystemPlan::new(TALLY_INDEPENDENT, "the normalization gets surer while chains run"),
        SystemPlan::new(COUNT_VISITS, "groups are compared by where their chains are"),
    ];
    if weighs_choices {
        systems.push(SystemPlan::new(
            WEIGH_CHOICES,
            "which mutation is chosen depends on the state",
        ));
    }
    systems
}

fn core_columns(chains: &mut TablePlan, densities: bool) {
    chains
        .column::<ChainKey>("draws are keyed by it")
        .column::<KeyChain>("seeds are drawn again from the streams of the chain that found them")
        .column::<Target>("f of the current state")
        .column::<ProposedTarget>("f of the proposal")
        .column::<Class>("statistics are kept by it")
        .column::<ProposedClass>("statistics are kept by it")
        .column::<ChosenMutation>("one mutation a step")
        .column::<MutationList>("each mutation walks its own chains")
        .column::<ForwardDensity>("T of the way there")
        .column::<ReverseDensity>("T of the way back")
        .column::<Acceptance>("splats are weighted by it")
        .column::<BookedWeight>("what the decision booked: one in all")
        .column::<Decisions>("every chain decides exactly once a step")
        .column::<Rejections>("the longest run of rejections is reported")
        .column::<LongestRejections>("the longest run of rejections is reported")
        .column::<AcceptedList>("accepted proposals become states")
        .column::<BootstrapWeight>("seeds are resampled by it");
    if densities {
        chains.column::<CommonDensity>("densities are looked at whole");
    }
}
