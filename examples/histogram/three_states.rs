//! A chain of three states simulated from its transition matrix. The target is constant and every proposal is drawn from
//! the current state's row, so all are taken: the core then runs that very chain, whatever its stationary distribution.

use super::{CHAINS, GROUPS, Sampled};
use chainlight::chain::{
    AcceptedList, ForwardDensity, MutationList, ProposedClass, ProposedTarget, ReverseDensity, Signature, StateClass,
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

use bevy_ecs::system::Res;
use glam::{DMat3, DVec3};
use miette::Result;
use serde::{Deserialize, Serialize};
use std::sync::atomic::AtomicBool;

columns! {
    /// The state: 0, 1 or 2.
    pub Current: u32;
    /// The state that is drawn next.
    pub Next: u32;
}

/// The probability of going from each state to each: a row for each state that is left. It has a sense of rotation: no
/// rule of acceptance with a symmetric proposal would make it.
pub const MATRIX: [[f64; 3]; 3] = [[0.5, 0.4, 0.1], [0.1, 0.6, 0.3], [0.45, 0.05, 0.5]];

const SPACE: StateSpace = StateSpace("three states");
const DRAW: Purpose = Purpose::named("three states: draw");
const PROPOSE: Place = Place::Stage(Stage::Propose);

/// The stationary distribution π = π P, Σ π = 1: two of the equations of balance, and the sum.
pub fn stationary() -> [f64; 3] {
    let balance =
        |state: usize| DVec3::from_array(std::array::from_fn(|from| MATRIX[from][state])) - DVec3::AXES[state];
    let equations = DMat3::from_cols(balance(0), balance(1), DVec3::ONE).transpose();
    (equations.inverse() * DVec3::Z).to_array()
}

/// Any state: draws where chains begin, and nothing else.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Begin {
    /// How often it is tried.
    pub weight: f32,
}

/// The next state, from the current one's row.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Follow {
    /// How often it is tried.
    pub weight: f32,
}

impl Default for Follow {
    fn default() -> Self {
        Self { weight: 1.0 }
    }
}

impl Mutation for Begin {
    const NAME: &'static str = "begin";
    const ABOUT: &'static str = "any state";
    const SPACE: StateSpace = SPACE;
    const INDEPENDENT: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn systems(&self) -> Vec<SystemPlan> {
        let spec = system!(PROPOSE, draw_beginnings).in_phases(Phases::ALL);
        vec![SystemPlan::new(spec, "chains begin anywhere")]
    }
}

impl Mutation for Follow {
    const NAME: &'static str = "follow";
    const ABOUT: &'static str = "the next state by the matrix";
    const SPACE: StateSpace = SPACE;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![SystemPlan::new(system!(PROPOSE, draw_next), "the matrix says where to")]
    }
}

/// Draws any state for the chains that begin.
pub fn draw_beginnings(
    mutation: Res<Registered<Begin>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    mut next: Write<Next, ChainTable>,
) {
    let (list, keys, next) = (list.rows(), keys.columns(), next.rows());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let u = keys.at(chain).stream(DRAW, 0).next_f64();
        next.put(chain, (3.0 * u) as u32);
    }
}

/// Draws the next state of the chains from the row of the current one.
pub fn draw_next(
    mutation: Res<Registered<Follow>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    current: Read<Current, ChainTable>,
    mut next: Write<Next, ChainTable>,
) {
    let (list, keys, current, next) = (list.rows(), keys.columns(), current.rows(), next.rows());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let [first, second, _] = MATRIX[current.at(chain) as usize % 3];
        let u = keys.at(chain).stream(DRAW, 0).next_f64();
        next.put(chain, u32::from(u >= first) + u32::from(u >= first + second));
    }
}

/// Every state is as good as any other, and every proposal as likely one way as the other, as far as decisions know.
pub fn evaluate_constant(
    place: Res<TilePlace>,
    next: Read<Next, ChainTable>,
    mut targets: Write<ProposedTarget, ChainTable>,
    mut classes: Write<ProposedClass, ChainTable>,
    mut forward: Write<ForwardDensity, ChainTable>,
    mut reverse: Write<ReverseDensity, ChainTable>,
) {
    let (next, targets, classes) = (next.rows(), targets.rows(), classes.rows());
    let (forward, reverse) = (forward.rows(), reverse.rows());
    for chain in 0..place.chains as usize {
        targets.put(chain, 1.0);
        classes.put(chain, StateClass::new(next.at(chain), 0, Signature::NONE).0);
        forward.put(chain, 0.0);
        reverse.put(chain, 0.0);
    }
}

/// Makes the drawn state the current one of every chain that accepted.
pub fn take_states(
    queues: Res<Queues>,
    accepted: Read<AcceptedList, ChainTable>,
    next: Read<Next, ChainTable>,
    mut current: Write<Current, ChainTable>,
) {
    let (accepted, next, current) = (accepted.rows(), next.rows(), current.rows());
    for entry in 0..queues.accepted {
        let chain = accepted.at(entry) as usize;
        current.put(chain, next.at(chain));
    }
}

/// Chains that begin in any state.
///
/// # Errors
/// No threads.
pub fn start(seed: u64) -> Result<ChainRun> {
    let registry = Registry::empty().with(Begin::default()).with(Follow::default());
    let mutations = choose_mutations(&registry, SPACE, &[])?;
    let mut chains = TablePlan::new(TableId::CHAINS, Extent::PerChain(1));
    chains
        .column::<Current>("where the chain is")
        .column::<Next>("where it goes");
    let states = StateSystems {
        systems: vec![
            SystemPlan::new(
                system!(Place::Stage(Stage::Evaluate), evaluate_constant),
                "the target is constant",
            ),
            SystemPlan::new(
                system!(Place::Stage(Stage::Accept), take_states),
                "accepted proposals become states",
            ),
        ],
        tables: vec![chains],
        ..StateSystems::default()
    };
    let counts = ChainCounts {
        groups: GROUPS,
        chains: CHAINS,
        rounds: 1,
    };
    let tile = chain_tile(states, &mutations, counts, false, None);
    let mut run = ChainRun::new(tile, ChainPlan { counts, mutations }, seed, 2, |_, _| ())?;
    run.bootstrap(&AtomicBool::new(false), &|_| ())?;
    Ok(run)
}

/// Occupancies after so many steps of every chain, the first steps from any state included.
///
/// # Errors
/// As [`start`].
pub fn simulate(seed: u64, steps: [u64; 2]) -> Result<Vec<Sampled>> {
    let mut run = start(seed)?;
    let after = |until: u64| {
        run.burst(until.saturating_sub(run.steps()), &|_| ());
        Sampled::of(&run, stationary().into())
    };
    Ok(steps.map(after).into())
}
