//! Direct light under way, beside chains that leave it out: samples of path tracing, in proportion to mutations.
//!
//! Sample number i is the i / pixels-th of pixel i mod pixels: each pixel has as many as any other, or one more. So a step of
//! chains brings a part of a sample for every pixel, and bursts, interrupts and time limits are as fine as those of chains alone.

use super::RenderError;
use super::layers::{LayerParts, LayerSums, insert_layers, unit};
use super::samples::Samples;
use super::tile_world::TileWorld;
use crate::film::{BlockGrid, Film, Picture, Tally, block_means_of, block_variances};
use crate::layer::Layers;
use crate::plan::{DirectPlan, SPLAT_FILMS, TilePlan};
use crate::sampling::StreamKey;
use crate::scene::Scene;
use crate::stats::error::IndependentBlocks;
use crate::systems::SystemCost;
use crate::systems::tile::{Counters, FilmRef, SceneRef};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The step of chain 0 whose key is the seed of direct light's samples: it is no chain's, so they share no numbers.
const SEED_STEP: u64 = 1 << 61;

/// Samples of direct light under way, and their film.
pub struct DirectLight {
    /// How it is rendered.
    pub plan: DirectPlan,
    /// What its samples brought.
    pub film: Arc<Film>,
    samples: Samples,
    pixels: u32,
    /// Samples taken, of all pixels together.
    pub(super) taken: u64,
    start_time: Duration,
    pub(super) layers: Option<LayerSums>,
}

impl DirectLight {
    pub(super) fn new(
        scene: &Arc<Scene>,
        plan: DirectPlan,
        layers: Option<&Arc<Layers>>,
        seed: u64,
        threads: usize,
    ) -> Result<Self, RenderError> {
        let film = Arc::new(Film::new(scene.width, scene.height, scene.lights.max_radiance())?);
        let layers = layers.map(|layers| LayerSums::new(layers, scene, SPLAT_FILMS, unit(scene)));
        let layers = layers.transpose()?;
        let seed = StreamKey::new(seed, 0, SEED_STEP).bits();
        let samples = Samples::new(&plan.tile, scene.pixel_count(), seed, threads, |world| {
            world.insert_resource(SceneRef(Arc::clone(scene)));
            world.insert_resource(FilmRef(Arc::clone(&film)));
            insert_layers(world, layers.as_ref());
        })?;
        Ok(Self {
            plan,
            film,
            samples,
            pixels: scene.pixel_count(),
            taken: 0,
            start_time: Duration::ZERO,
            layers,
        })
    }

    /// Takes the samples that come before the first step. `progress` hears the share that is done.
    pub(super) fn begin(&mut self, interrupt: &AtomicBool, progress: &dyn Fn(f64)) -> Result<(), RenderError> {
        let start = Instant::now();
        let due = self.due(0);
        while self.taken < due {
            if interrupt.load(Ordering::Relaxed) {
                return Err(RenderError::Interrupted);
            }
            progress(self.taken as f64 / due as f64);
            let next = self.taken + u64::from(self.pixels);
            self.samples.take(self.taken, next, &|| {});
            self.taken = next;
        }
        progress(1.0);
        self.start_time = start.elapsed();
        Ok(())
    }

    /// Wall time of the samples before the first step.
    #[must_use]
    pub const fn start_time(&self) -> Duration {
        self.start_time
    }

    /// Takes the samples that belong to so many mutations, but for those that were taken before. `done` hears whenever some are.
    pub(super) fn follow(&mut self, mutations: u64, done: &(dyn Fn() + Sync)) {
        let due = self.due(mutations).max(self.taken);
        self.samples.take(self.taken, due, done);
        self.taken = due;
    }

    /// Samples that belong to so many mutations, of all pixels together.
    pub(super) fn due(&self, mutations: u64) -> u64 {
        self.plan.samples_after(mutations, self.pixels)
    }

    /// Samples per pixel so far.
    #[must_use]
    pub fn samples_per_pixel(&self) -> f64 {
        self.taken as f64 / f64::from(self.pixels)
    }

    /// The plan of its worlds.
    #[must_use]
    pub const fn tile(&self) -> &TilePlan {
        &self.plan.tile
    }

    /// What its worlds have counted.
    #[must_use]
    pub fn counters(&self) -> Counters {
        self.samples.counters()
    }

    /// What every system has cost, summed over threads, in the order in which systems run.
    #[must_use]
    pub fn costs(&self) -> Vec<SystemCost> {
        self.samples.costs()
    }

    /// Wall time that threads have spent in samples, summed over them.
    #[must_use]
    pub fn busy_time(&self) -> Duration {
        self.samples.busy_time()
    }

    /// What its film could not take as it was.
    #[must_use]
    pub fn tally(&self) -> Tally {
        self.film.tally()
    }

    /// Lets `look` see every world.
    pub fn for_each_world(&self, look: &mut dyn FnMut(usize, &mut TileWorld)) {
        self.samples.for_each_world(look);
    }

    /// The picture of direct light alone, with the errors of pixels.
    #[must_use]
    pub fn picture(&self) -> Picture {
        self.film.develop()
    }

    /// Whether any sample found light.
    #[must_use]
    pub fn is_lit(&self) -> bool {
        self.picture().rgb.iter().any(|rgb| !rgb.is_black())
    }

    /// The mean of every block and channel (number block · 3 + channel), and its variances. `None` while those are not known.
    #[must_use]
    pub fn block_means(&self, grid: &BlockGrid) -> Option<(Vec<f64>, IndependentBlocks)> {
        let picture = self.picture();
        let means = block_means_of(picture.view(), grid).ok()?;
        let variances = block_variances(&picture, grid).ok()?;
        let samples = self.taken / u64::from(self.pixels);
        let known = samples > 1 && variances.iter().all(|variance| variance.is_finite());
        known.then(|| {
            let blocks = IndependentBlocks {
                variances,
                channels: 3,
                // At worst a single pixel has all of a block's.
                degrees_of_freedom: (samples - 1) as f64,
            };
            (means, blocks)
        })
    }

    /// What layers have of it.
    pub(super) fn layer_parts(&self) -> LayerParts {
        let pixels = u64::from(self.pixels);
        let layers = self.layers.as_ref();
        layers.map_or_else(LayerParts::default, |layers| {
            layers.of_samples(&self.samples, self.taken / pixels, (self.taken % pixels) as u32)
        })
    }

    /// Adds its light and variance to the pixels of `picture`, which is of the same size.
    pub(super) fn add_to(&self, picture: &mut Picture) {
        let direct = self.picture();
        for (sum, light) in picture.rgb.iter_mut().zip(direct.rgb) {
            *sum += light;
        }
        for (sum, error) in picture.error.iter_mut().zip(direct.error) {
            sum.r = libm::hypotf(sum.r, error.r);
            sum.g = libm::hypotf(sum.g, error.g);
            sum.b = libm::hypotf(sum.b, error.b);
        }
    }
}
