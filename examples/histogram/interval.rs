//! States on the interval [0, 1), whose ends are joined: columns, systems and mutations of this example's own.

use super::{CHAINS, GROUPS, Sampled, target};
use chainlight::chain::{
    AcceptedList, ForwardDensity, MutationList, ProposedClass, ProposedTarget, ReverseDensity, Signature, StateClass,
    to_f64,
};
use chainlight::path::ChainTable;
use chainlight::plan::{
    ChainCounts, ChainPlan, Extent, Mutation, Phases, Place, Registered, Registry, Stage, StateSpace, StateSystems,
    SystemPlan, TableId, TablePlan, chain_tile, choose_mutations,
};
use chainlight::render::ChainRun;
use chainlight::sampling::Purpose;
use chainlight::systems::chains::{Keys, MutationLists};
use chainlight::systems::tile::{Queues, TilePlace};
use chainlight::table::{Read, Rows, Write};
use chainlight::{columns, system};

use bevy_ecs::system::{Res, SystemParam};
use miette::Result;
use serde::{Deserialize, Serialize};
use std::sync::atomic::AtomicBool;

columns! {
    /// Where the chain is, in units of 2⁻⁶⁴: adding a step wraps around by itself, and is undone exactly by its opposite.
    pub Position: u64;
    /// Where it might go.
    pub ProposedPosition: u64;
}

/// Bins of histograms.
pub const BINS: usize = 100;
/// Samples that each chain adds to its group's bootstrap.
const ROUNDS: u32 = 200;

const SPACE: StateSpace = StateSpace("interval");
const MOVE: Purpose = Purpose::named("histogram: move");
const PROPOSE: Place = Place::Stage(Stage::Propose);

/// `uniform`: anywhere, whatever the state. T(x→y) = 1.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Uniform {
    /// How often it is tried.
    pub weight: f32,
}

/// `near`: anywhere within 0.05 of the state, on either side and around the ends. T(x→y) = 10 both ways.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Near {
    /// How often it is tried.
    pub weight: f32,
}

/// How far `near` goes, in units of 2⁻⁶⁴: 0.05.
const REACH: u64 = u64::MAX / 20;

impl Default for Uniform {
    fn default() -> Self {
        Self { weight: 1.0 }
    }
}

impl Default for Near {
    fn default() -> Self {
        Self { weight: 1.0 }
    }
}

impl Mutation for Uniform {
    const NAME: &'static str = "uniform";
    const ABOUT: &'static str = "anywhere";
    const SPACE: StateSpace = SPACE;
    const INDEPENDENT: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn systems(&self) -> Vec<SystemPlan> {
        // Bootstraps draw with it, so it takes part in them too.
        let spec = system!(PROPOSE, propose_uniform).in_phases(Phases::ALL);
        vec![SystemPlan::new(spec, "anywhere on the interval")]
    }
}

impl Mutation for Near {
    const NAME: &'static str = "near";
    const ABOUT: &'static str = "within 0.05";
    const SPACE: StateSpace = SPACE;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![SystemPlan::new(
            system!(PROPOSE, propose_near),
            "near the current place",
        )]
    }
}

/// What a proposal is written to.
#[derive(SystemParam)]
pub struct Proposals<'w, 's> {
    positions: Write<'w, 's, ProposedPosition, ChainTable>,
    forward: Write<'w, 's, ForwardDensity, ChainTable>,
    reverse: Write<'w, 's, ReverseDensity, ChainTable>,
}

/// Draws where the chains that go anywhere might go.
pub fn propose_uniform(
    mutation: Res<Registered<Uniform>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    mut proposals: Proposals,
) {
    let (list, keys) = (list.rows(), keys.columns());
    let (positions, forward, reverse) = (
        proposals.positions.rows(),
        proposals.forward.rows(),
        proposals.reverse.rows(),
    );
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        positions.put(chain, keys.at(chain).stream(MOVE, 0).next_u64());
        // ln T = ln 1.
        forward.put(chain, 0.0);
        reverse.put(chain, 0.0);
    }
}

/// Draws where the chains that stay near might go.
pub fn propose_near(
    mutation: Res<Registered<Near>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    current: Read<Position, ChainTable>,
    mut proposals: Proposals,
) {
    let (list, keys, current) = (list.rows(), keys.columns(), current.rows());
    let (positions, forward, reverse) = (
        proposals.positions.rows(),
        proposals.forward.rows(),
        proposals.reverse.rows(),
    );
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let random = u128::from(keys.at(chain).stream(MOVE, 0).next_u64());
        // One of 2 REACH + 1 steps from −REACH to REACH.
        let step = ((random * (2 * u128::from(REACH) + 1)) >> 64) as u64;
        positions.put(chain, current.at(chain).wrapping_add(step).wrapping_sub(REACH));
        // T is the same both ways, so both may leave it out.
        forward.put(chain, 0.0);
        reverse.put(chain, 0.0);
    }
}

/// Writes the target of every proposal, and its bin as the block that statistics are kept by.
pub fn evaluate(
    place: Res<TilePlace>,
    positions: Read<ProposedPosition, ChainTable>,
    mut targets: Write<ProposedTarget, ChainTable>,
    mut classes: Write<ProposedClass, ChainTable>,
) {
    let (positions, targets, classes) = (positions.rows(), targets.rows(), classes.rows());
    for chain in 0..place.chains as usize {
        let x = to_f64(positions.at(chain));
        targets.put(chain, target::value(x) as f32);
        let bin = (x * BINS as f64) as u32;
        classes.put(chain, StateClass::new(bin, 0, Signature::NONE).0);
    }
}

/// Makes the position of every accepted proposal that of the current state.
pub fn take_positions(
    queues: Res<Queues>,
    accepted: Read<AcceptedList, ChainTable>,
    proposed: Read<ProposedPosition, ChainTable>,
    mut positions: Write<Position, ChainTable>,
) {
    let (accepted, proposed, positions) = (accepted.rows(), proposed.rows(), positions.rows());
    for entry in 0..queues.accepted {
        let chain = accepted.at(entry) as usize;
        positions.put(chain, proposed.at(chain));
    }
}

/// What these states bring to the core of chains.
fn states() -> StateSystems {
    let mut chains = TablePlan::new(TableId::CHAINS, Extent::PerChain(1));
    chains
        .column::<Position>("where the chain is")
        .column::<ProposedPosition>("where it might go");
    StateSystems {
        systems: vec![
            SystemPlan::new(system!(Place::Stage(Stage::Evaluate), evaluate), "the target decides"),
            SystemPlan::new(
                system!(Place::Stage(Stage::Accept), take_positions),
                "accepted proposals become states",
            ),
        ],
        tables: vec![chains],
        ..StateSystems::default()
    }
}

/// The three ways to sample: each mutation alone, and a random choice of both.
pub fn runs() -> [(&'static str, Registry); 3] {
    let of = |uniform, near| {
        Registry::empty()
            .with(Uniform { weight: uniform })
            .with(Near { weight: near })
    };
    [
        ("uniform", of(1.0, 0.0)),
        ("near", of(0.0, 1.0)),
        ("mixture", of(0.5, 0.5)),
    ]
}

/// Chains at their first states, drawn from the target by a bootstrap.
///
/// # Errors
/// No mutation, or no threads.
pub fn start(mutations: &Registry, seed: u64) -> Result<ChainRun> {
    let mutations = choose_mutations(mutations, SPACE, &[])?;
    let counts = ChainCounts {
        groups: GROUPS,
        chains: CHAINS,
        rounds: ROUNDS,
    };
    let tile = chain_tile(states(), &mutations, counts, false, None);
    let mut run = ChainRun::new(tile, ChainPlan { counts, mutations }, seed, 2, |_, _| ())?;
    run.bootstrap(&AtomicBool::new(false), &|_| ())?;
    Ok(run)
}

/// Histograms after so many steps of every chain.
///
/// # Errors
/// As [`start`].
pub fn sample(mutations: Registry, seed: u64, steps: [u64; 2]) -> Result<Vec<Sampled>> {
    let mut run = start(&mutations, seed)?;
    let after = |until: u64| {
        run.burst(until.saturating_sub(run.steps()), &|_| ());
        Sampled::of(&run, target::bins(BINS))
    };
    Ok(steps.map(after).into())
}
