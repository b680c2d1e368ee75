//! Broken twins of mutations of whole paths, each with one mistake in its density, the kinds of mistake that are made: they propose
//! what the mutation they are a twin of proposes, under its name.

use bevy_ecs::system::Res;
use chainlight::chain::{ChosenMutation, Class, ForwardDensity, ProposedClass, ReverseDensity, StateClass};
use chainlight::path::{ChainTable, DrawList};
use chainlight::plan::{Mutation, Place, Stage, StateSpace, SystemPlan, TablePlan};
use chainlight::sampling::StreamKey;
use chainlight::systems::chains::Mutations;
use chainlight::systems::propose::{
    Bidirectional, CausticPerturbation, LensPerturbation, LensSubpath, MovesPaths, MultiChainPerturbation,
    PathProposal, PathView, Way,
};
use chainlight::systems::tile::TilePlace;
use chainlight::table::{Read, Rows, Write};
use chainlight::{path_systems, system};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A twin of a mutation whose density is another.
macro_rules! twin {
    ($(#[$doc:meta])* $name:ident, $inner:ty, $called:literal, |$twin:ident, $way:ident| $density:expr $(; $more:expr)?) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub $inner);

        impl Mutation for $name {
            const NAME: &'static str = <$inner as Mutation>::NAME;
            const ABOUT: &'static str = "a twin";
            const SPACE: StateSpace = StateSpace::PATH;
            const SELECTIVE: bool = <$inner as Mutation>::SELECTIVE;

            fn weight(&self) -> f32 {
                self.0.weight()
            }

            fn suitability(&self, state: StateClass) -> f32 {
                self.0.suitability(state)
            }

            fn systems(&self) -> Vec<SystemPlan> {
                let systems =
                    path_systems!($name, $called: propose "as it should", steer "as it should", weigh "not as it should");
                $(let systems = systems.into_iter().chain([SystemPlan::new($more, "a twin")]).collect();)?
                systems
            }

            fn columns(&self, tables: &mut [TablePlan]) {
                self.0.columns(tables);
                if let Some(chains) = tables.first_mut() {
                    chains.column::<DrawList>("perturbed subpaths wait for a direction");
                }
            }
        }

        impl MovesPaths for $name {
            fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal> {
                self.0.propose(path, key)
            }

            fn near(&self, direction: Vec3, key: StreamKey, depth: u32) -> Vec3 {
                self.0.near(direction, key, depth)
            }

            fn density(&self, $way: &Way<'_>) -> f64 {
                let $twin = self;
                $density
            }
        }
    };
}

twin! {
    /// T as if only the strategy that has drawn the proposal could have done so, and one for the way back.
    OneStrategy, Bidirectional, "twin of one strategy", |twin, way| {
        let first = way.kept[0].max(1);
        let last = way.to.edges + 1 - way.kept[1];
        let all: f64 = (first..=last).map(|t| way.to.share(t)).sum();
        twin.0.density(way) * way.to.share(way.made.clamp(first, last)) / all
    }
}
twin! {
    /// T that is 5 % too large where the path grows.
    TooMuchGrowth, Bidirectional, "twin of growth", |twin, way| {
        twin.0.density(way) * if way.to.edges > way.from.edges { 1.05 } else { 1.0 }
    }
}
twin! {
    /// T with the geometry term of the edge that it joins, which it does not draw.
    WithGeometry, LensPerturbation, "twin with geometry", |twin, way| twin.0.density(way) * geometry_of_joint(way)
}
twin! {
    /// T of a place on the film as if all places were within as many filters.
    WithoutFilter, LensPerturbation, "twin without filter", |twin, way| twin.0.density(way) * f64::from(way.to.filter)
}
twin! {
    /// T as if directions that are drawn about others had the density of those that materials draw.
    WithMaterials, MultiChainPerturbation, "twin with materials", |twin, way| {
        let drawn = (1..way.made - 1).filter(|&i| !way.to.is_discrete(i));
        twin.0.density(way) * drawn.map(|i| way.to.onward(i)).product::<f64>()
    }
}
twin! {
    /// T without the density of the kept light: as if the strategy had chosen it.
    WithoutKeptLight, LensSubpath, "twin without kept light", |twin, way| {
        let kept_light = if way.kept[1] == 1 { way.to.kept_light } else { 1.0 };
        twin.0.density(way) / kept_light
    }
}
twin! {
    /// T without the probability of stopping on surfaces that are matt and mirror at once.
    WithoutStopping, LensSubpath, "twin without stopping", |twin, way| {
        let (s, edges) = (way.kept[1], way.to.edges);
        let stopping = if edges == way.to.longest() {
            1.0
        } else {
            way.to.vertex(edges - s).stopping(way.to.scene)
        };
        twin.0.density(way) / stopping
    }
}
twin! {
    /// T without the densities of the directions that it does not draw.
    WithoutDirections, CausticPerturbation, "twin without directions", |twin, way| {
        let start = way.from.edges + 1 - way.kept[1];
        let lobes: f64 = (2..start).map(|i| way.to.onward(i)).product();
        twin.0.density(way) * lobes * way.to.back(start)
    }
}
twin! {
    /// T as if the ratio of solid angles where light is refracted were a part of the lobe's probability.
    WithSolidAngles, CausticPerturbation, "twin with solid angles", |twin, way| {
        let start = way.from.edges + 1 - way.kept[1];
        let angles: f64 = (2..start).map(|i| way.to.back(i) / way.to.onward(i)).product();
        twin.0.density(way) / angles
    }
}
twin! {
    /// T that forgets that a step must be one of those that lead back.
    WithoutWayBack, CausticPerturbation, "twin without a way back", |_twin, way| {
        let start = way.from.edges + 1 - way.kept[1];
        let lobes: f64 = (2..start).map(|i| way.to.onward(i)).product();
        way.to.share(1) / (lobes * way.to.back(start))
    }
}
twin! {
    /// T that leaves out how likely mutations are to be chosen, of all of them: it has to be the last one.
    WithoutChoices, MultiChainPerturbation, "twin without choices", |twin, way| twin.0.density(way);
    system!(Place::Stage(Stage::Evaluate), forget_choices)
}

/// cos cos / d² of the edge by which a proposal's subpaths are joined; 1 where they are not.
fn geometry_of_joint(way: &Way<'_>) -> f64 {
    if way.made > way.to.edges {
        return 1.0;
    }
    let [x, y] = [way.made - 1, way.made].map(|i| way.to.vertex(i).surface);
    let span = y.position.as_dvec3() - x.position.as_dvec3();
    let cosines = span.dot(x.normal.as_dvec3()) * span.dot(y.normal.as_dvec3());
    cosines.abs() / (span.length_squared() * span.length_squared())
}

/// Takes away what the core adds to the densities of all chains.
fn forget_choices(
    place: Res<TilePlace>,
    mutations: Res<Mutations>,
    chosen: Read<ChosenMutation, ChainTable>,
    classes: Read<Class, ChainTable>,
    proposed: Read<ProposedClass, ChainTable>,
    mut forward: Write<ForwardDensity, ChainTable>,
    mut reverse: Write<ReverseDensity, ChainTable>,
) {
    let (chosen, classes, proposed) = (chosen.rows(), classes.rows(), proposed.rows());
    let (forward, reverse) = (forward.rows(), reverse.rows());
    for chain in 0..place.chains as usize {
        let number = chosen.at(chain) as usize;
        forward.put(
            chain,
            forward.at(chain) - log_choice(&mutations, number, classes.at(chain)),
        );
        reverse.put(
            chain,
            reverse.at(chain) - log_choice(&mutations, number, proposed.at(chain)),
        );
    }
}

/// The logarithm of the probability of choosing a mutation; 0 where it cannot be chosen.
fn log_choice(mutations: &Mutations, number: usize, class: u32) -> f64 {
    let probability = mutations.probability(number, StateClass(class));
    if probability > 0.0 { libm::log(probability) } else { 0.0 }
}
