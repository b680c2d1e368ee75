//! The plan: from a scene and settings to the effects that exist, and the systems and columns that they bring.
//!
//! Schedule and tables are built from the plan and nothing else ([`crate::render::TileWorld`]), so an effect that a
//! scene does not call for has no system that runs and no column that takes memory. Every entry carries its reason.

mod bidirectional;
mod chains;
mod direct;
mod effect;
mod layers;
mod missing;
mod mlt;
mod mlt_reference;
mod mutation;
mod path_tracing;
mod pssmlt;
mod pssmlt_reference;
mod reference;
mod support;
mod system;
mod table;
mod technique;
mod tile;

pub use chains::{ChainCounts, ChainPlanError, ChainSettings, StateSystems, chain_tile, choose_mutations};
pub use direct::{Direct, DirectPlan, PER_MUTATIONS};
pub use effect::{Effect, EffectPlan};
pub use missing::Missing;
pub use mutation::{
    AnyMutation, MAX_MUTATIONS, MovesVertices, Mutation, MutationPlan, Registered, Registry, StateSpace,
};
pub use support::{Region, Support};
pub use system::{InPlan, JoinStep, Phases, Place, Repeated, Stage, SystemPlan, SystemSpec, TraceStep, Traces};
pub use table::{ColumnPlan, Extent, TableId, TablePlan};
pub use technique::{Base, Technique, UnknownTechnique};
pub use tile::{Subpaths, TilePlan};

use crate::film::{Film, GroupFilm};
use crate::geometry::Tracing;
use crate::layer::{LayerFilms, Layers};
use crate::path::bidirectional::{Strategies, Weights};
use crate::path::mis::Heuristic;
use crate::scene::Scene;
use bidirectional::BothEnds;
use std::sync::Arc;

/// What is asked of a plan beyond the technique.
#[derive(Clone, Debug)]
pub struct PlanOptions {
    /// Chains of a tile, instead of as many as fit the cache; rounded up to whole lane groups.
    pub tile_size: Option<u32>,
    /// How chains are run.
    pub chains: ChainSettings,
    /// The mutations there are, with their settings.
    pub mutations: Registry,
    /// What primary-sample-space chains run over.
    pub base: Base,
    /// The only strategy (s, t) of bidirectional path tracing to use, with weight one, instead of all: for tests.
    pub strategy: Option<(u32, u32)>,
    /// How weights are made of densities, where strategies share paths.
    pub heuristic: Heuristic,
    /// Who renders direct light beside chains in path space; the scene says, where this does not ([`Direct::in_scene`]).
    pub direct: Option<Direct>,
    /// The layers that light is split into, beside the picture of all of it.
    pub layers: Option<Arc<Layers>>,
}

impl Default for PlanOptions {
    fn default() -> Self {
        Self {
            tile_size: None,
            chains: ChainSettings::default(),
            mutations: crate::systems::propose::mutations(),
            base: Base::default(),
            strategy: None,
            heuristic: Heuristic::default(),
            direct: None,
            layers: None,
        }
    }
}

/// The chains of a plan.
#[derive(Clone, Debug)]
pub struct ChainPlan {
    /// How many.
    pub counts: ChainCounts,
    /// Their mutations, by number.
    pub mutations: Vec<MutationPlan>,
}

/// What a render will do, and why.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The technique that was asked for.
    pub technique: Technique,
    /// Every effect, on or off.
    pub effects: Vec<EffectPlan>,
    /// Light that the technique cannot find in this scene.
    pub missing: Vec<Missing>,
    /// What every tile's world is built from.
    pub tile: TilePlan,
    /// The chains, for techniques that run some.
    pub chains: Option<ChainPlan>,
    /// How direct light is rendered, where chains leave it out.
    pub direct: Option<DirectPlan>,
    /// How subpaths are joined, for techniques with both ends.
    pub strategies: Option<Strategies>,
    /// The layers that light is split into.
    pub layers: Option<Arc<Layers>>,
    /// Films that steps take turns among, where independent samples bring light to many pixels; otherwise 0.
    pub splat_films: u32,
    /// How rays are traced.
    pub tracer: String,
    /// Why they are traced so.
    pub tracer_reason: String,
    /// Memory of the tree and its primitives, in bytes.
    pub tree_bytes: u64,
    /// Memory of the film, in bytes.
    pub film_bytes: u64,
}

/// Films that the steps of independent samples take turns among: as many as groups of chains, for the same reason.
pub(crate) const SPLAT_FILMS: u32 = 16;

/// What `technique` asks of paths from both ends.
fn both_ends<'a>(
    scene: &'a Scene,
    effects: &'a [EffectPlan],
    technique: Technique,
    options: &PlanOptions,
) -> BothEnds<'a> {
    let (subpaths, weights) = match (technique, options.strategy) {
        (Technique::Lt, _) => (Subpaths::Light, Weights::Lens),
        (_, Some((s, t))) => (Subpaths::Both, Weights::Only(s, t)),
        _ => (Subpaths::Both, Weights::All),
    };
    BothEnds {
        scene,
        effects,
        subpaths,
        strategies: Strategies {
            weights,
            heuristic: options.heuristic,
        },
    }
}

impl Plan {
    /// Plans `technique` for `scene`, with the mutations of this crate at their defaults. `tile_size` overrides the chains
    /// of a tile.
    ///
    /// # Panics
    /// Never: the defaults make a plan.
    #[must_use]
    pub fn new(scene: &Scene, technique: Technique, tile_size: Option<u32>) -> Self {
        let options = PlanOptions {
            tile_size,
            ..PlanOptions::default()
        };
        match Self::with(scene, technique, &options) {
            Ok(plan) => plan,
            Err(error) => panic!("the defaults make a plan: {error}"),
        }
    }

    /// Plans `technique` for `scene` as `options` say.
    ///
    /// # Errors
    /// Mutations that chains cannot run with.
    pub fn with(scene: &Scene, technique: Technique, options: &PlanOptions) -> Result<Self, ChainPlanError> {
        if let (true, Some(staged)) = (options.layers.is_some(), technique.staged()) {
            return Err(ChainPlanError::Layers {
                technique: technique.name(),
                staged: staged.name(),
            });
        }
        let split = |systems: &mut Vec<SystemPlan>, tables: &mut Vec<TablePlan>| {
            if let Some(layers) = &options.layers {
                layers::split(layers, systems, tables);
            }
        };
        let split_states = |states: &mut StateSystems| {
            // What evaluates whole paths is listed apart.
            let mut all = std::mem::take(&mut states.before);
            let before = all.len();
            all.append(&mut states.systems);
            split(&mut all, &mut states.tables);
            states.systems = all.split_off(before);
            states.before = all;
        };
        let effects = effect::effects(scene);
        let mut chains = None;
        let mut direct = None;
        let mut strategies = None;
        let mut tile = match technique {
            Technique::Pt => {
                let mut systems = path_tracing::systems(scene, &effects, scene.max_depth);
                let mut tables = path_tracing::tables(scene, &effects, scene.max_depth);
                split(&mut systems, &mut tables);
                TilePlan::new(systems, tables, options.tile_size)
            }
            Technique::PtReference => TilePlan::new(
                reference::systems(&effects),
                reference::tables(&effects),
                options.tile_size,
            ),
            Technique::Lt | Technique::Bdpt => {
                let both = both_ends(scene, &effects, technique, options);
                strategies = Some(both.strategies);
                let (mut systems, mut tables) = (both.systems(), both.tables());
                split(&mut systems, &mut tables);
                TilePlan::with_subpaths(both.subpaths, systems, tables, options.tile_size)
            }
            Technique::Pssmlt | Technique::PssmltReference if options.base == Base::Bdpt => {
                if technique == Technique::PssmltReference {
                    return Err(ChainPlanError::Base);
                }
                let mutations = choose_mutations(&options.mutations, StateSpace::PRIMARY, &effects)?;
                let counts = options.chains.counts(scene.pixel_count());
                let both = both_ends(scene, &effects, technique, options);
                strategies = Some(both.strategies);
                let mut states = pssmlt::over_bidirectional(&both);
                split_states(&mut states);
                let tile = chain_tile(states, &mutations, counts, options.chains.densities, options.tile_size);
                chains = Some(ChainPlan { counts, mutations });
                tile
            }
            Technique::Mlt | Technique::MltReference => {
                let mutations = choose_mutations(&options.mutations, StateSpace::PATH, &effects)?;
                let counts = options.chains.counts(scene.pixel_count());
                strategies = Some(Strategies::default());
                let mut states = mlt::states(scene, &effects);
                split_states(&mut states);
                let mut tile = if technique == Technique::Mlt {
                    chain_tile(states, &mutations, counts, options.chains.densities, options.tile_size)
                } else {
                    mlt_reference::tile(states, &mutations, counts, &effects, options.tile_size)?
                };
                let by = Direct::in_scene(options.direct, scene);
                tile.sought = by.sought_by_chains();
                tile.shortest = tile.sought.shortest();
                if let Direct::Apart(samples) = by {
                    direct = Some(DirectPlan::new(scene, &effects, samples, options));
                }
                chains = Some(ChainPlan { counts, mutations });
                tile
            }
            Technique::Pssmlt | Technique::PssmltReference => {
                let mutations = choose_mutations(&options.mutations, StateSpace::PRIMARY, &effects)?;
                let counts = options.chains.counts(scene.pixel_count());
                let mut states = pssmlt::over_path_tracing(scene, &effects);
                split_states(&mut states);
                let tile = if technique == Technique::Pssmlt {
                    chain_tile(states, &mutations, counts, options.chains.densities, options.tile_size)
                } else {
                    pssmlt_reference::tile(states, &mutations, counts, &effects, options.tile_size)?
                };
                chains = Some(ChainPlan { counts, mutations });
                tile
            }
        };
        tile.heuristic = options.heuristic;
        let (width, height) = (scene.width, scene.height);
        let splat_films = if chains.is_none() && strategies.is_some() {
            SPLAT_FILMS
        } else {
            0
        };
        let films = chains.as_ref().map_or(splat_films, |plan| plan.counts.groups);
        let mut film_bytes = u64::from(films) * GroupFilm::bytes(width, height);
        if films == 0 || direct.is_some() {
            film_bytes += Film::bytes(width, height);
        }
        if let Some(layers) = &options.layers {
            let films = 1 + u64::from(direct.is_some());
            film_bytes += films * LayerFilms::bytes(layers.len(), (width, height));
        }
        Ok(Self {
            technique,
            missing: missing::missing(scene, technique, options.base),
            effects,
            tile,
            chains,
            direct,
            strategies,
            layers: options.layers.clone(),
            splat_films,
            tracer: {
                let Tracing {
                    tracer, instructions, ..
                } = scene.geometry.tracing();
                format!("{tracer} by {instructions}")
            },
            tracer_reason: {
                let why = if scene.geometry.tracing().asked_for {
                    "as asked for"
                } else {
                    "the fastest for this scene and machine"
                };
                format!("{why}; {} primitives", scene.geometry.primitive_count())
            },
            tree_bytes: scene.geometry.tree_bytes() as u64,
            film_bytes,
        })
    }

    /// Tiles of a render of `pixels` pixels: no tile has chains of two groups.
    #[must_use]
    pub fn tiles(&self, pixels: u32) -> u32 {
        match &self.chains {
            Some(plan) => plan.counts.groups * plan.counts.chains.div_ceil(self.tile.size),
            None => pixels.div_ceil(self.tile.size),
        }
    }

    /// Who renders direct light: where it is not rendered apart, the technique's samples or chains do.
    #[must_use]
    pub fn direct_by(&self) -> Direct {
        let apart = self.direct.as_ref().map(|direct| Direct::Apart(direct.samples));
        apart.unwrap_or(Direct::Chains)
    }

    /// Whether `effect` is on.
    #[must_use]
    pub fn has(&self, effect: Effect) -> bool {
        effect::is_on(&self.effects, effect)
    }
}
