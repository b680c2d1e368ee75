//! Mutations of primary sample space by functions over values: what every twin is made of, so that each is only its mistake.

use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::Res;
use chainlight::chain::{ChosenMutation, CommonDensity, ForwardDensity, Kernel, MutationList, SupportDensity};
use chainlight::path::{
    ChainTable, CoordinateSet, DrawList, FilmCoordinates, PathLength, PrimaryDepth, PrimaryFilm, ProposedDepth,
    ProposedPrimaryTable, VertexCoordinates,
};
use chainlight::plan::{InPlan, Mutation, Place, Region, Registered, Stage, SystemPlan, SystemSpec, TraceStep};
use chainlight::sampling::StreamKey;
use chainlight::systems::chains::{Keys, MutationLists};
use chainlight::systems::propose::proposal::Proposals;
use chainlight::systems::tile::{Queues, TilePlace};
use chainlight::systems::trace::draws::{CoordinatesMut, CurrentCoordinates};
use chainlight::table::{Read, Rows, Write};

/// A proposal of some coordinates.
pub struct Move<T> {
    pub to: T,
    /// What the mutation says is ln of the density.
    pub density: f64,
    /// What it says beyond that of the way there alone.
    pub forward: f64,
}

impl<T> Move<T> {
    pub fn new(to: T, density: f64) -> Self {
        Self {
            to,
            density,
            forward: 0.0,
        }
    }
}

/// A vertex that a proposal has reached.
#[derive(Clone, Copy)]
pub struct Reached {
    pub depth: u32,
    /// Whether it is the first one that the current path does not have.
    pub grows: bool,
    /// Which coordinates vertices have.
    pub set: CoordinateSet,
}

/// How coordinates are proposed: a small step, but for what a twin does otherwise.
pub trait Steps: Mutation {
    fn kernel(&self) -> Kernel {
        Kernel::new(1.0 / 128.0, 1.0 / 16.0).expect("sizes of a kernel")
    }

    fn film(&self, from: FilmCoordinates, key: StreamKey) -> Move<FilmCoordinates> {
        let to = from.perturbed(&self.kernel(), key);
        Move::new(to, from.log_density(&self.kernel(), to))
    }

    fn shared(&self, from: VertexCoordinates, at: Reached, key: StreamKey) -> Move<VertexCoordinates> {
        let to = from.perturbed(&self.kernel(), key, at.depth);
        Move::new(to, from.log_density(&self.kernel(), to, at.depth, at.set))
    }

    fn beyond(&self, at: Reached, key: StreamKey) -> Move<VertexCoordinates> {
        Move::new(VertexCoordinates::independent(key, at.depth), 0.0)
    }
}

macro_rules! spec {
    ($function:ident :: <$mutation:ident>, $place:expr) => {
        SystemSpec::new(stringify!($function), $place, |schedule, spec| {
            schedule.add_systems(
                $function::<$mutation>
                    .in_set(InPlan::At(spec.place()))
                    .in_set(InPlan::System(spec)),
            );
        })
    };
}
pub(crate) use spec;

/// The systems that propose as `M` says.
pub fn systems<M: Steps>() -> Vec<SystemPlan> {
    vec![
        SystemPlan::new(spec!(propose_steps::<M>, Place::Stage(Stage::Propose)), "a twin"),
        SystemPlan::new(spec!(draw_steps::<M>, Place::Loop(TraceStep::Draw)), "a twin"),
    ]
}

/// Where small steps with the kernel of `M` lead.
pub fn region<M: Steps>() -> Region {
    Region {
        draw: vec![
            SystemPlan::new(spec!(propose_supports::<M>, Place::Stage(Stage::Propose)), "a twin"),
            SystemPlan::new(spec!(draw_supports::<M>, Place::Loop(TraceStep::Draw)), "a twin"),
        ],
        weigh: vec![SystemPlan::new(
            spec!(weigh_supports::<M>, Place::Stage(Stage::Evaluate)),
            "a twin",
        )],
    }
}

fn propose_steps<M: Steps>(
    mutation: Res<Registered<M>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let moved = mutation.settings.film(FilmCoordinates(film.at(chain)), keys.at(chain));
        proposals.start(chain, moved.to, moved.density);
    }
}

fn draw_steps<M: Steps>(
    mutation: Res<Registered<M>>,
    place: Res<TilePlace>,
    queues: Res<Queues>,
    list: Read<DrawList, ChainTable>,
    chosen: Read<ChosenMutation, ChainTable>,
    lengths: Read<PathLength, ChainTable>,
    current_depths: Read<PrimaryDepth, ChainTable>,
    keys: Keys,
    current: CurrentCoordinates,
    mut proposed: CoordinatesMut<ProposedPrimaryTable>,
    mut depths: Write<ProposedDepth, ChainTable>,
    (mut common, mut forward): (Write<CommonDensity, ChainTable>, Write<ForwardDensity, ChainTable>),
) {
    let (list, chosen, lengths, keys) = (list.rows(), chosen.rows(), lengths.rows(), keys.columns());
    let (current_depths, current) = (current_depths.rows(), current.columns());
    let (mut proposed, depths) = (proposed.columns(), depths.rows());
    let (common, forward) = (common.rows(), forward.rows());
    for entry in 0..queues.draw {
        let chain = list.at(entry) as usize;
        if chosen.at(chain) as usize != mutation.number {
            continue;
        }
        let depth = lengths.at(chain);
        let vertex = place.vertex(chain, depth - 1);
        let at = Reached {
            depth,
            grows: depth == current_depths.at(chain) + 1,
            set: current.set(),
        };
        let moved = if depth <= current_depths.at(chain) {
            mutation.settings.shared(current.at(vertex), at, keys.at(chain))
        } else {
            mutation.settings.beyond(at, keys.at(chain))
        };
        proposed.put(vertex, moved.to);
        depths.put(chain, depth);
        forward.put(chain, forward.at(chain) + moved.forward);
        if !common.is_empty() {
            common.put(chain, common.at(chain) + moved.density);
        }
    }
}

fn propose_supports<M: Steps>(
    mutation: Res<Registered<M>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let kernel = mutation.settings.kernel();
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let drawn = FilmCoordinates(film.at(chain)).uniform_in_support(&kernel, keys.at(chain));
        proposals.start(chain, drawn, 0.0);
    }
}

fn draw_supports<M: Steps>(
    mutation: Res<Registered<M>>,
    place: Res<TilePlace>,
    queues: Res<Queues>,
    list: Read<DrawList, ChainTable>,
    lengths: Read<PathLength, ChainTable>,
    current_depths: Read<PrimaryDepth, ChainTable>,
    keys: Keys,
    current: CurrentCoordinates,
    mut proposed: CoordinatesMut<ProposedPrimaryTable>,
    mut depths: Write<ProposedDepth, ChainTable>,
    chosen: Read<ChosenMutation, ChainTable>,
) {
    let kernel = mutation.settings.kernel();
    let (list, chosen, lengths, keys) = (list.rows(), chosen.rows(), lengths.rows(), keys.columns());
    let (current_depths, current) = (current_depths.rows(), current.columns());
    let (mut proposed, depths) = (proposed.columns(), depths.rows());
    for entry in 0..queues.draw {
        let chain = list.at(entry) as usize;
        if chosen.at(chain) as usize != mutation.number {
            continue;
        }
        let (depth, key) = (lengths.at(chain), keys.at(chain));
        let vertex = place.vertex(chain, depth - 1);
        let drawn = if depth <= current_depths.at(chain) {
            current.at(vertex).uniform_in_support(&kernel, key, depth)
        } else {
            VertexCoordinates::independent(key, depth)
        };
        proposed.put(vertex, drawn);
        depths.put(chain, depth);
    }
}

fn weigh_supports<M: Steps>(
    mutation: Res<Registered<M>>,
    place: Res<TilePlace>,
    current_depths: Read<PrimaryDepth, ChainTable>,
    depths: Read<ProposedDepth, ChainTable>,
    current: CurrentCoordinates,
    mut densities: Write<SupportDensity, ChainTable>,
) {
    let log_length = libm::log(mutation.settings.kernel().support_length());
    let set = current.columns().set();
    let (current_depths, depths, densities) = (current_depths.rows(), depths.rows(), densities.rows());
    for chain in 0..place.chains as usize {
        let shared = current_depths.at(chain).min(depths.at(chain));
        let vertices = (1..=shared).map(|depth| VertexCoordinates::count(depth, set));
        let count = FilmCoordinates::COUNT + vertices.sum::<u32>();
        densities.put(chain, -log_length * f64::from(count));
    }
}
