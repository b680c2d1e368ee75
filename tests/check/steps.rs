//! Mutations of primary sample space by functions over values: what every twin is made of, so that each is only its mistake.

use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::Res;
use chainlight::chain::{Kernel, KnownDraws, MutationList};
use chainlight::path::{ChainTable, CoordinateSet, FilmCoordinates, PrimaryFilm, VertexCoordinates};
use chainlight::plan::{InPlan, Mutation, Place, Region, Registered, Stage, SystemPlan, SystemSpec, TraceStep};
use chainlight::sampling::StreamKey;
use chainlight::systems::chains::{Keys, MutationLists};
use chainlight::systems::propose::drawing::{Drawing, Drawn};
use chainlight::systems::propose::known::KnownDensities;
use chainlight::systems::propose::proposal::Proposals;
use chainlight::table::{Read, Rows};

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
        fourth_moment: KnownDraws::FOURTH_MOMENT,
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

fn draw_steps<M: Steps>(mutation: Res<Registered<M>>, mut drawing: Drawing) {
    let steps = &mutation.settings;
    drawing.draw(mutation.number, |current, waiting| {
        let at = Reached {
            depth: waiting.depth,
            grows: waiting.grows,
            set: waiting.set,
        };
        let moved = match current {
            Some(current) => steps.shared(current, at, waiting.key),
            None => steps.beyond(at, waiting.key),
        };
        Drawn {
            coordinates: moved.to,
            common: moved.density,
            forward: moved.forward,
        }
    });
}

fn propose_supports<M: Steps>(
    mutation: Res<Registered<M>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let known = KnownDraws::about(mutation.settings.kernel());
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let drawn = FilmCoordinates(film.at(chain)).known(&known, keys.at(chain));
        proposals.start(chain, drawn, 0.0);
    }
}

fn draw_supports<M: Steps>(mutation: Res<Registered<M>>, mut drawing: Drawing) {
    let known = KnownDraws::about(mutation.settings.kernel());
    drawing.draw(mutation.number, |current, waiting| {
        current.map_or_else(
            || Drawn::afresh(waiting),
            |from| Drawn::uniform(from.known(&known, waiting.key, waiting.depth)),
        )
    });
}

fn weigh_supports<M: Steps>(mutation: Res<Registered<M>>, mut densities: KnownDensities) {
    densities.weigh(mutation.number, &KnownDraws::about(mutation.settings.kernel()));
}
