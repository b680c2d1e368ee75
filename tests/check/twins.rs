//! Broken twins of mutations, each with one mistake, and one mutation whose choice depends on the state and which has none.

use super::steps::{Move, Reached, Steps, region, spec, systems};
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::Res;
use chainlight::chain::{Class, ForwardDensity, Kernel, MutationList, ReverseDensity, StateClass};
use chainlight::path::{ChainTable, FilmCoordinates, PrimaryDepth, ProposedDepth, VertexCoordinates, roulette};
use chainlight::plan::{
    InPlan, Mutation, Place, Region, Registered, Stage, StateSpace, Support, SystemPlan, SystemSpec,
};
use chainlight::sampling::{Purpose, StreamKey};
use chainlight::systems::chains::{MutationLists, Mutations};
use chainlight::table::{Read, Rows, Write};
use serde::{Deserialize, Serialize};

macro_rules! twin {
    ($(#[$doc:meta])* $name:ident, $text:literal, $support:expr $(, $more:expr)?) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, Serialize, Deserialize)]
        pub struct $name {
            weight: f32,
        }

        impl Mutation for $name {
            const NAME: &'static str = $text;
            const ABOUT: &'static str = "a twin";
            const SPACE: StateSpace = StateSpace::PRIMARY;
            fn weight(&self) -> f32 {
                self.weight
            }
            fn systems(&self) -> Vec<SystemPlan> {
                let mut systems = systems::<Self>();
                let more: Vec<SystemPlan> = vec![$($more)?];
                systems.extend(more);
                systems
            }
            fn support(&self) -> Option<Support> {
                $support
            }
        }
    };
}

twin!(
    /// A large step that prefers one corner of the film, and says that it is uniform.
    Cornered,
    "cornered",
    Some(Support::Space)
);

impl Steps for Cornered {
    fn film(&self, _from: FilmCoordinates, key: StreamKey) -> Move<FilmCoordinates> {
        let mut stream = key.stream(Purpose::named("cornered"), 0);
        // One in eight is drawn from the first half alone.
        let x = stream.next_u64() >> u32::from(stream.next_u32().is_multiple_of(8));
        Move::new(FilmCoordinates([x, stream.next_u64()]), 0.0)
    }
    fn shared(&self, _from: VertexCoordinates, at: Reached, key: StreamKey) -> Move<VertexCoordinates> {
        self.beyond(at, key)
    }
}

twin!(
    /// A small step that only ever goes to the right, and says that it goes both ways.
    Drifting,
    "drifting",
    Some(Support::Region(region::<Self>()))
);

impl Steps for Drifting {
    fn film(&self, from: FilmCoordinates, key: StreamKey) -> Move<FilmCoordinates> {
        let mut stream = key.stream(Purpose::PERTURB, 0);
        let kernel = self.kernel();
        // The lowest bit is the sign.
        let right = kernel.perturb_wide(from.0[0], stream.next_u32() & !1);
        let to = FilmCoordinates([right, kernel.perturb_wide(from.0[1], stream.next_u32())]);
        Move::new(to, from.log_density(&kernel, to))
    }
}

twin!(
    /// A small step whose density is 5 % too large where the path grows.
    Growing,
    "growing",
    None,
    SystemPlan::new(
        spec!(shrink_back::<Growing>, Place::Stage(Stage::Evaluate)),
        "a twin"
    )
);

/// Makes the density of the way back as wrong as it would be there, where the path shrinks.
fn shrink_back<M: Mutation>(
    mutation: Res<Registered<M>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    current_depths: Read<PrimaryDepth, ChainTable>,
    depths: Read<ProposedDepth, ChainTable>,
    mut reverse: Write<ReverseDensity, ChainTable>,
) {
    let (list, current_depths, depths, reverse) = (list.rows(), current_depths.rows(), depths.rows(), reverse.rows());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        if depths.at(chain) < current_depths.at(chain) {
            reverse.put(chain, reverse.at(chain) + libm::log(1.05));
        }
    }
}

impl Steps for Growing {
    fn kernel(&self) -> Kernel {
        Kernel::new(1.0 / 16.0, 0.5).expect("sizes of a kernel")
    }
    fn beyond(&self, at: Reached, key: StreamKey) -> Move<VertexCoordinates> {
        Move {
            to: VertexCoordinates::independent(key, at.depth),
            density: 0.0,
            forward: if at.grows { libm::log(1.05) } else { 0.0 },
        }
    }
}

/// Steps between two sizes that are near to each other: where they lead is hardly less uniform than the support.
fn narrow() -> Kernel {
    Kernel::new(1.0 / 64.0, 1.0 / 32.0).expect("sizes of a kernel")
}

twin!(
    /// A small step whose density is 5 % too large everywhere: no acceptance shows it.
    Inflated,
    "inflated",
    Some(Support::Region(region::<Self>()))
);

impl Steps for Inflated {
    fn kernel(&self) -> Kernel {
        narrow()
    }
    fn film(&self, from: FilmCoordinates, key: StreamKey) -> Move<FilmCoordinates> {
        let to = from.perturbed(&self.kernel(), key);
        Move::new(to, from.log_density(&self.kernel(), to) + libm::log(1.05))
    }
}

twin!(
    /// The same with the density as it is.
    Sound,
    "sound",
    Some(Support::Region(region::<Self>()))
);

impl Steps for Sound {
    fn kernel(&self) -> Kernel {
        narrow()
    }
}

twin!(
    /// A small step whose density counts one coordinate of every first vertex twice.
    Miscounted,
    "miscounted",
    Some(Support::Region(region::<Self>()))
);

impl Steps for Miscounted {
    fn shared(&self, from: VertexCoordinates, at: Reached, key: StreamKey) -> Move<VertexCoordinates> {
        let to = from.perturbed(&self.kernel(), key, at.depth);
        let density = from.log_density(&self.kernel(), to, at.depth, at.set);
        let again = self.kernel().log_density(from.scatter[0], to.scatter[0]);
        Move::new(to, if at.depth == 1 { density + again } else { density })
    }
}

twin!(
    /// A small step that says its steps on the film are uniform between their sizes.
    Misjudged,
    "misjudged",
    Some(Support::Region(region::<Self>()))
);

impl Steps for Misjudged {
    fn film(&self, from: FilmCoordinates, key: StreamKey) -> Move<FilmCoordinates> {
        let to = from.perturbed(&self.kernel(), key);
        Move::new(to, -2.0 * libm::log(self.kernel().support_length()))
    }
}

twin!(
    /// A small step whose known draws are so far from it that no bound on the weights is of use.
    Uneven,
    "uneven",
    Some(Support::Region(Region {
        fourth_moment: 1e12,
        ..region::<Self>()
    }))
);

impl Steps for Uneven {}

twin!(
    /// A small step that forgets to draw the coordinates beyond the end of the current path: they are all 1/2.
    Forgetful,
    "forgetful",
    Some(Support::Region(region::<Self>()))
);

impl Steps for Forgetful {
    fn beyond(&self, at: Reached, _key: StreamKey) -> Move<VertexCoordinates> {
        let plays = at.depth >= roulette::FIRST_DEPTH;
        let to = VertexCoordinates {
            choice: 1 << 63,
            light: [1 << 31; 2],
            scatter: [1 << 31; 2],
            roulette: if plays { 1 << 31 } else { 0 },
            lobe: 1 << 31,
        };
        Move::new(to, 0.0)
    }
}

twin!(
    /// An identity that moves where the first vertex scatters to, and says that it stayed.
    Restless,
    "restless",
    Some(Support::State)
);

impl Steps for Restless {
    fn film(&self, from: FilmCoordinates, _key: StreamKey) -> Move<FilmCoordinates> {
        Move::new(from, 0.0)
    }
    fn shared(&self, from: VertexCoordinates, at: Reached, key: StreamKey) -> Move<VertexCoordinates> {
        let to = if at.depth == 1 {
            from.perturbed(&self.kernel(), key, at.depth)
        } else {
            from
        };
        Move::new(to, 0.0)
    }
}

macro_rules! selective {
    ($(#[$doc:meta])* $name:ident, $text:literal, $more:expr) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, Serialize, Deserialize)]
        pub struct $name {
            weight: f32,
        }

        impl Mutation for $name {
            const NAME: &'static str = $text;
            const ABOUT: &'static str = "a twin";
            const SPACE: StateSpace = StateSpace::PRIMARY;
            const SELECTIVE: bool = true;
            fn weight(&self) -> f32 {
                self.weight
            }
            fn suitability(&self, state: StateClass) -> f32 {
                if state.length() <= 2 { 1.0 } else { 0.25 }
            }
            fn systems(&self) -> Vec<SystemPlan> {
                let mut systems = systems::<Self>();
                let more: Vec<SystemPlan> = $more;
                systems.extend(more);
                systems
            }
            fn support(&self) -> Option<Support> {
                Some(Support::Region(region::<Self>()))
            }
        }

        impl Steps for $name {
            fn kernel(&self) -> Kernel {
                narrow()
            }
        }
    };
}

selective!(
    /// A small step that is four times as likely where paths are short: right.
    Choosy,
    "choosy",
    Vec::new()
);

selective!(
    /// The same, whose density counts how likely it was to be chosen the wrong way round.
    Biased,
    "biased",
    vec![SystemPlan::new(
        spec!(turn_choices::<Biased>, Place::Stage(Stage::Evaluate)),
        "a twin",
    )]
);

/// Takes away twice what the core will add to the density of the way there.
fn turn_choices<M: Mutation>(
    mutation: Res<Registered<M>>,
    mutations: Res<Mutations>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    classes: Read<Class, ChainTable>,
    mut forward: Write<ForwardDensity, ChainTable>,
) {
    let (list, classes, forward) = (list.rows(), classes.rows(), forward.rows());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let probability = mutations.probability(mutation.number, StateClass(classes.at(chain)));
        forward.put(chain, forward.at(chain) - 2.0 * libm::log(probability));
    }
}
