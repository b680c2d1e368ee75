//! Renders whose samples are independent and bring light to many pixels: light tracing, bidirectional path tracing.
//!
//! Light that one path brings to several pixels is correlated, so that single pixels tell too little about the error of a
//! block. Steps therefore [take turns](super::turns) among some films, and their spread is the error.

use super::RenderError;
use super::layers::{LayerFinding, LayerSums, insert_layers};
use super::pilot;
use super::rendering::{Rendering, error_blocks};
use super::samples::Samples;
use super::tile_world::{TileWorld, lock};
use super::turns::Turns;
use crate::film::{FilmError, GroupFilm, Picture, Tally, block_means, develop_combined};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::stats::error::PictureError;
use crate::stats::group_means::GroupMeans;
use crate::systems::SystemCost;
use crate::systems::tile::{Counters, SceneRef, SplatFilms, StrategiesRef};
use bevy_ecs::world::World;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// A render of independent samples that bring light to many pixels.
pub struct SplatRender {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The plan that the worlds were built from.
    pub plan: Plan,
    /// The films that steps take turns among.
    pub films: Arc<[Mutex<GroupFilm>]>,
    pub(super) seed: u64,
    pub(super) samples: Samples,
    /// The radiance that one unit of a film stands for: a power of two.
    unit: f64,
    pub(super) layers: Option<LayerSums>,
}

impl SplatRender {
    /// Builds films, threads and their worlds; no more threads than there are tiles.
    ///
    /// # Errors
    /// Films that do not fit, threads that cannot be started, or a plan without both ends.
    pub fn new(scene: Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Result<Self, RenderError> {
        let Some(strategies) = plan.strategies.filter(|_| plan.splat_films > 0) else {
            return Err(RenderError::NoSplats {
                technique: plan.technique.name(),
            });
        };
        let film = |_| GroupFilm::new(scene.width, scene.height).map(Mutex::new);
        let films: Arc<[Mutex<GroupFilm>]> = (0..plan.splat_films)
            .map(film)
            .collect::<Result<Vec<_>, FilmError>>()?
            .into();
        let insert = |world: &mut World| {
            world.insert_resource(SceneRef(Arc::clone(&scene)));
            world.insert_resource(StrategiesRef(strategies));
        };
        let unit = pilot::unit(
            &plan.tile,
            scene.pixel_count(),
            seed,
            scene.lights.max_radiance(),
            insert,
        )?;
        let layers = LayerSums::planned(&plan, &scene, unit)?;
        let samples = Samples::new(&plan.tile, scene.pixel_count(), seed, threads, |world| {
            insert(world);
            insert_layers(world, layers.as_ref());
            world.insert_resource(SplatFilms {
                films: Arc::clone(&films),
                scale: (1.0 / unit) as f32,
            });
        })?;
        Ok(Self {
            scene,
            plan,
            films,
            seed,
            samples,
            unit,
            layers,
        })
    }

    /// [`burst`](Rendering::burst) with the tiles dealt in the given order, which must name every tile once; others are
    /// passed over.
    pub fn burst_in_order(&mut self, steps: u64, order: &[usize], done: &(dyn Fn(u64) + Sync)) {
        self.samples.burst(steps, order, done);
    }

    fn turns(&self) -> Turns {
        Turns::new(self.films.len(), self.samples.steps, 0.0)
    }

    /// The radiance that one unit of each film's sums stands for, of those that have any.
    fn scales(&self) -> Vec<f64> {
        self.turns().counts().iter().map(|count| self.unit / count).collect()
    }

    /// What every film stands for in the mean radiance of every block and channel (number block · 3 + channel).
    #[must_use]
    pub fn film_block_means(&self) -> Option<GroupMeans> {
        let grid = error_blocks(&self.scene);
        let films = self.films.iter().zip(self.scales());
        let rows = films.map(|(film, scale)| block_means(&lock(film), &grid, scale));
        let rows = rows.collect::<Result<Vec<_>, _>>().ok()?;
        let turns = self.turns();
        Some(
            GroupMeans::from_rows(&rows)
                .ok()?
                .combined(|values| turns.combine(values)),
        )
    }
}

impl Rendering for SplatRender {
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
        let scales = self.scales();
        let films: Vec<_> = self.films.iter().take(scales.len()).map(|film| lock(film)).collect();
        let films: Vec<_> = films.iter().map(|film| &**film).collect();
        let turns = self.turns();
        // All films are of the scene's size, and there is a finite scale for each.
        develop_combined(&films, &scales, self.samples.steps as f32, |values| {
            turns.combine(values)
        })
        .unwrap_or_default()
    }

    fn error(&self) -> Option<PictureError> {
        let means = self.film_block_means()?;
        PictureError::of(&means)?.relative_to(means.grand_mean())
    }

    fn layers(&self) -> Vec<LayerFinding> {
        let steps = self.samples.steps;
        let parts = self
            .layers
            .as_ref()
            .map(|layers| (layers, layers.of_samples(&self.samples, steps, 0)));
        parts.map_or_else(Vec::new, |(layers, parts)| {
            LayerFinding::all(&layers.layers, parts, None)
        })
    }

    fn save(&self) -> Vec<u8> {
        SplatRender::save(self)
    }

    fn tally(&self) -> Tally {
        let mut sum = Tally::default();
        self.films.iter().for_each(|film| sum.add(&lock(film).tally()));
        sum
    }

    fn for_each_world(&self, look: &mut dyn FnMut(usize, &mut TileWorld)) {
        self.samples.for_each_world(look);
    }
}
