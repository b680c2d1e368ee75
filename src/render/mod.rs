//! Rendering: tiles built from a plan, dealt to threads, burst by burst.

mod blank;
mod built;
mod bytes;
mod chain_run;
mod chains;
mod combination;
mod deal;
mod direct;
mod driver;
mod findings;
mod group;
mod layers;
mod lone_chain;
mod pilot;
mod remaining;
mod rendering;
mod samples;
mod saved;
mod saved_states;
mod saved_tile;
mod splats;
mod tile_world;
mod turns;

pub use blank::blank;
pub use built::{Built, BuiltColumn, BuiltTable, short};
pub use chain_run::ChainRun;
pub use chains::ChainRender;
pub use combination::Combination;
pub use direct::DirectLight;
pub use driver::{Budget, Goal, Outcome, Progress, Stop, drive};
pub use findings::{ClassAgreement, ClassFinding, Findings, LengthFindings, MutationFindings};
pub use group::Start;
pub use layers::{LayerFinding, LayerRecord};
pub use lone_chain::{LoneChain, LoneStart};
pub use remaining::{LastLook, steps_to_target};
pub use rendering::{Rendering, error_blocks};
pub use saved::SavedRenderError;
pub use splats::SplatRender;
pub use tile_world::TileWorld;

use crate::film::{Film, FilmError, Picture, Tally, block_means_of, block_variances};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::stats::error::PictureError;
use crate::systems::SystemCost;
use crate::systems::tile::{Counters, FilmRef, SceneRef};
use layers::{LayerSums, insert_layers};
use samples::Samples;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Why a render cannot start.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum RenderError {
    /// The film cannot be made.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Film(#[from] FilmError),
    /// The operating system refused threads.
    #[error("cannot start {threads} threads")]
    #[diagnostic(help("ask for fewer with --threads"))]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the operating system said.
        source: rayon::ThreadPoolBuildError,
    },
    /// The plan has no chains.
    #[error("{technique} has no chains")]
    #[diagnostic(help("plan a technique with chains, such as pssmlt"))]
    NoChains {
        /// The technique.
        technique: &'static str,
    },
    /// The plan has no samples of one pixel each.
    #[error("{technique} does not sample one pixel at a time")]
    #[diagnostic(help("start it with `chainlight::render::start`, which knows every technique"))]
    NoSamples {
        /// The technique.
        technique: &'static str,
    },
    /// The plan has no samples that bring light to many pixels.
    #[error("{technique} brings light to one pixel at a time")]
    #[diagnostic(help("plan a technique with both ends, such as bdpt"))]
    NoSplats {
        /// The technique.
        technique: &'static str,
    },
    /// There is no such chain.
    #[error("there is no chain {chain}: the chains of {technique} are 0 to {last}")]
    #[diagnostic(help("{}", if *.samples_pixels {
        "each pixel is a chain, row by row from the top left: y * width + x"
    } else {
        "groups follow each other: chain = group * chains of a group + number in the group"
    }))]
    NoSuchChain {
        /// The number that was asked for.
        chain: u32,
        /// The technique.
        technique: &'static str,
        /// The last chain there is.
        last: u32,
        /// Whether each pixel is a chain.
        samples_pixels: bool,
    },
    /// What was saved cannot be taken up.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Saved(#[from] SavedRenderError),
    /// Somebody stopped it before the first step.
    #[error("interrupted before the first step")]
    Interrupted,
}

/// A render under way: the film, and one tile world per thread through which the tiles pass.
///
/// Independent samples leave nothing behind in a tile, so a few worlds serve any number of tiles. What a tile adds to
/// the film depends on its chains and steps alone, and the film's sums on no order: so the picture is a function of
/// scene, settings, seed and steps.
pub struct Render {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The plan that the worlds were built from.
    pub plan: Plan,
    /// The film.
    pub film: Arc<Film>,
    seed: u64,
    samples: Samples,
    layers: Option<LayerSums>,
}

impl Render {
    /// Builds the film, the threads and their worlds; no more threads than there are tiles.
    ///
    /// # Errors
    /// A film that does not fit, or threads that cannot be started.
    pub fn new(scene: Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Result<Self, RenderError> {
        if plan.splat_films > 0 || plan.chains.is_some() {
            return Err(RenderError::NoSamples {
                technique: plan.technique.name(),
            });
        }
        let film = Arc::new(Film::new(scene.width, scene.height, scene.lights.max_radiance())?);
        let layers = LayerSums::planned(&plan, &scene, layers::unit(&scene))?;
        let samples = Samples::new(&plan.tile, scene.pixel_count(), seed, threads, |world| {
            world.insert_resource(SceneRef(Arc::clone(&scene)));
            world.insert_resource(FilmRef(Arc::clone(&film)));
            insert_layers(world, layers.as_ref());
        })?;
        Ok(Self {
            layers,
            scene,
            plan,
            film,
            seed,
            samples,
        })
    }

    /// [`burst`](Rendering::burst) with the tiles dealt in the given order, which must name every tile once; others are
    /// passed over.
    pub fn burst_in_order(&mut self, steps: u64, order: &[usize], done: &(dyn Fn(u64) + Sync)) {
        self.samples.burst(steps, order, done);
    }
}

impl Rendering for Render {
    fn plan(&self) -> &Plan {
        &self.plan
    }

    fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    fn steps(&self) -> u64 {
        self.samples.steps
    }

    /// One per pixel.
    fn chains(&self) -> u32 {
        self.scene.pixel_count()
    }

    fn threads(&self) -> usize {
        self.samples.threads()
    }

    fn tile_count(&self) -> usize {
        self.samples.tile_count()
    }

    fn burst(&mut self, steps: u64, done: &(dyn Fn(u64) + Sync)) {
        self.samples.burst_all(steps, done);
    }

    fn counters(&self) -> Counters {
        self.samples.counters()
    }

    fn costs(&self) -> Vec<SystemCost> {
        self.samples.costs()
    }

    fn busy_time(&self) -> Duration {
        self.samples.busy_time()
    }

    fn picture(&self) -> Picture {
        self.film.develop()
    }

    fn error(&self) -> Option<PictureError> {
        let (picture, grid) = (self.picture(), error_blocks(&self.scene));
        let variances = block_variances(&picture, &grid).ok()?;
        let means = block_means_of(picture.view(), &grid).ok()?;
        if !variances.iter().all(|variance| variance.is_finite()) {
            return None;
        }
        let mean = means.iter().sum::<f64>() / means.len() as f64;
        PictureError::of_independent(&variances).relative_to(mean)
    }

    fn layers(&self) -> Vec<LayerFinding> {
        let parts = self
            .layers
            .as_ref()
            .map(|layers| (layers, layers.of_samples(&self.samples, self.samples.steps, 0)));
        parts.map_or_else(Vec::new, |(layers, parts)| {
            LayerFinding::all(&layers.layers, parts, None)
        })
    }

    fn save(&self) -> Vec<u8> {
        Render::save(self)
    }

    fn tally(&self) -> Tally {
        self.film.tally()
    }

    fn for_each_world(&self, look: &mut dyn FnMut(usize, &mut TileWorld)) {
        self.samples.for_each_world(look);
    }
}

/// Starts a render of whatever the plan says: for chains, bootstrap included, of which `progress` hears the share that is
/// done.
///
/// # Errors
/// As [`Render::new`] and [`ChainRender::start`].
pub fn start(
    scene: Arc<Scene>,
    plan: Plan,
    seed: u64,
    threads: usize,
    interrupt: &AtomicBool,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Box<dyn Rendering>, RenderError> {
    Ok(if plan.chains.is_some() {
        Box::new(ChainRender::start(scene, plan, seed, threads, interrupt, progress)?)
    } else if plan.splat_films > 0 {
        Box::new(SplatRender::new(scene, plan, seed, threads)?)
    } else {
        Box::new(Render::new(scene, plan, seed, threads)?)
    })
}

/// Takes up a render that [`Rendering::save`] saved: it goes on as if it had never stopped.
///
/// # Errors
/// As [`start`], and for bytes that are no saved render, or one of something else.
pub fn resume(
    scene: Arc<Scene>,
    plan: Plan,
    seed: u64,
    threads: usize,
    saved: &[u8],
) -> Result<Box<dyn Rendering>, RenderError> {
    Ok(if plan.chains.is_some() {
        let mut render = ChainRender::unstarted(scene, plan, seed, threads)?;
        render.restore(saved)?;
        Box::new(render)
    } else if plan.splat_films > 0 {
        let mut render = SplatRender::new(scene, plan, seed, threads)?;
        render.restore(saved)?;
        Box::new(render)
    } else {
        let mut render = Render::new(scene, plan, seed, threads)?;
        render.restore(saved)?;
        Box::new(render)
    })
}

/// A pool of `threads` threads.
fn thread_pool(threads: usize) -> Result<rayon::ThreadPool, RenderError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|source| RenderError::Threads { threads, source })
}
