//! Renders with Markov chains of light paths.

use super::chain_run::ChainRun;
use super::layers::{LayerFinding, LayerSums, insert_layers};
use super::rendering::{Rendering, error_blocks};
use super::tile_world::{TileWorld, lock};
use super::{Combination, DirectLight, Findings, RenderError};
use crate::chain::StateClass;
use crate::color::Rgb;
use crate::film::{BlockGrid, FilmError, GroupFilm, LayerChannels, Picture, Tally, block_means, develop_combined};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::stats::error::PictureError;
use crate::stats::group_means::GroupMeans;
use crate::systems::SystemCost;
use crate::systems::chains::GroupPlace;
use crate::systems::layers::LayerFilmsRef;
use crate::systems::tile::{Counters, FilmBlocks, GroupFilmRef, SceneRef, StrategiesRef};
use bevy_ecs::world::World;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Blocks along a side of the film that states are classed by.
const BLOCKS_PER_SIDE: u32 = 8;

/// A render with chains under way: every group has a film of its own.
pub struct ChainRender {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The plan that the worlds were built from.
    pub plan: Plan,
    /// The groups' films.
    pub films: Vec<Arc<Mutex<GroupFilm>>>,
    /// The blocks that states are classed by.
    pub blocks: Arc<BlockGrid>,
    /// The chains.
    pub run: ChainRun,
    /// Direct light, where the chains leave it out.
    pub(super) direct: Option<DirectLight>,
    pub(super) layers: Option<LayerSums>,
}

impl ChainRender {
    /// Builds films, threads and worlds, and bootstraps every group: its chains then stand at their first states.
    ///
    /// # Errors
    /// Films that do not fit, threads that cannot be started, or a plan without chains.
    pub fn new(scene: Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Result<Self, RenderError> {
        Self::start(scene, plan, seed, threads, &AtomicBool::new(false), &|_| {})
    }

    /// [`new`](Self::new), telling `progress` the share that is done of what comes before the first step, the bootstrap and samples
    /// of direct light that is rendered apart, and giving up when `interrupt` is set.
    ///
    /// # Errors
    /// As [`new`](Self::new), and if it was interrupted.
    pub fn start(
        scene: Arc<Scene>,
        plan: Plan,
        seed: u64,
        threads: usize,
        interrupt: &AtomicBool,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, RenderError> {
        let mut render = Self::unstarted(scene, plan, seed, threads)?;
        // Of what comes before the first step, if direct light does too.
        let bootstrap = if render.direct.is_some() { 0.5 } else { 1.0 };
        render.run.bootstrap(interrupt, &|share| progress(bootstrap * share))?;
        render.weigh_layers();
        if let Some(direct) = &mut render.direct {
            direct.begin(interrupt, &|share| progress(bootstrap + (1.0 - bootstrap) * share))?;
        }
        Ok(render)
    }

    /// Builds films, threads and worlds, whose chains have no states yet.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn unstarted(scene: Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Result<Self, RenderError> {
        let Some(chains) = plan.chains.clone() else {
            return Err(RenderError::NoChains {
                technique: plan.technique.name(),
            });
        };
        let film = |_| GroupFilm::new(scene.width, scene.height).map(|film| Arc::new(Mutex::new(film)));
        let films = (0..chains.counts.groups)
            .map(film)
            .collect::<Result<Vec<_>, FilmError>>()?;
        let blocks = Arc::new(state_blocks(&scene));
        // States are divided by their targets, so splats are of order one.
        let layers = LayerSums::of_groups(&plan, &scene, chains.counts.groups)?;
        let run = ChainRun::new(plan.tile.clone(), chains, seed, threads, |world, group| {
            insert_light(world, &scene, &blocks, &plan);
            insert_layers(world, layers.as_ref());
            world.insert_resource(GroupFilmRef(Arc::clone(&films[group])));
        })?;
        let direct = plan.direct.clone();
        let direct = direct.map(|direct| DirectLight::new(&scene, direct, plan.layers.as_ref(), seed, threads));
        Ok(Self {
            direct: direct.transpose()?,
            scene,
            plan,
            films,
            blocks,
            run,
            layers,
        })
    }

    /// [`burst`](Rendering::burst) with the tiles of chains dealt in the given order, which must name every tile once; others are
    /// passed over.
    pub fn burst_in_order(&mut self, steps: u64, order: &[usize], done: &(dyn Fn(u64) + Sync)) {
        self.run.burst_in_order(steps, order, done);
        self.follow(done);
    }

    /// Takes the samples of direct light that belong to the steps of the chains; they are no mutations.
    fn follow(&mut self, done: &(dyn Fn(u64) + Sync)) {
        let mutations = self.mutations();
        if let Some(direct) = &mut self.direct {
            direct.follow(mutations, &|| done(0));
        }
    }

    /// Tells every tile how much its group counts: as much as b of its bootstrap, see [`Combination`].
    pub(super) fn weigh_layers(&mut self) {
        if self.layers.is_none() {
            return;
        }
        let weights = self.group_weights();
        self.run.for_each_tile(&mut |_, world| {
            let group = world.world().resource::<GroupPlace>().group;
            world.world_mut().resource_mut::<LayerFilmsRef>().weight = weights[group as usize];
        });
    }

    /// b of the groups' bootstraps over the largest.
    fn group_weights(&self) -> Vec<f32> {
        let b = || self.run.starts().iter().map(|start| start.normalization.b);
        let most = b().fold(f64::MIN_POSITIVE, f64::max);
        b().map(|b| (b / most) as f32).collect()
    }

    /// Wall time of what came before the first step.
    #[must_use]
    pub fn start_time(&self) -> Duration {
        let direct = self.direct.as_ref().map_or(Duration::ZERO, DirectLight::start_time);
        self.run.bootstrap_time() + direct
    }

    /// Mutations of all chains so far.
    pub(super) fn mutations(&self) -> u64 {
        self.run.steps().saturating_mul(u64::from(self.run.counts().total()))
    }

    /// The factor that turns a group's sums into means over its states, for each pixel.
    fn per_state(&self) -> f64 {
        let states = self.run.steps() as f64 * f64::from(self.run.counts().chains);
        let pixels = f64::from(self.scene.pixel_count());
        if states > 0.0 { pixels / states } else { 0.0 }
    }

    /// How the groups make one picture.
    #[must_use]
    pub fn combination(&self) -> Combination {
        let bootstraps: Vec<f64> = self.run.starts().iter().map(|start| start.normalization.b).collect();
        Combination::new(&bootstraps, &self.run.normalizations())
    }

    /// The steps that come nearest to so many mutations per pixel, at least one.
    #[must_use]
    pub fn steps_for(&self, mutations_per_pixel: f64) -> u64 {
        self.run
            .counts()
            .steps_for(mutations_per_pixel, self.scene.pixel_count())
    }

    /// What every group's chains stand for in the mean radiance of every block and channel (number block · 3 + channel), see
    /// [`Combination`]: of all light but that which is rendered apart.
    #[must_use]
    pub fn group_block_means(&self, grid: &BlockGrid) -> Option<GroupMeans> {
        let (per_state, combination) = (self.per_state(), self.combination());
        let row = |film: &Arc<Mutex<GroupFilm>>| block_means(&lock(film), grid, per_state);
        let rows = self.films.iter().map(row).collect::<Result<Vec<_>, _>>().ok()?;
        Some(
            GroupMeans::from_rows(&rows)
                .ok()?
                .combined(|values| combination.apply(values)),
        )
    }

    /// The standard error of the picture's mean in every block and channel. `None` while it is not known.
    fn block_errors(&self, grid: &BlockGrid) -> Option<Vec<f64>> {
        let estimates = self.group_block_means(grid)?.estimates();
        let mut errors: Vec<f64> = estimates.iter().map(|estimate| estimate.error).collect();
        if let Some(direct) = &self.direct {
            let (_, blocks) = direct.block_means(grid)?;
            for (error, variance) in errors.iter_mut().zip(blocks.variances) {
                *error = (*error * *error + variance).sqrt();
            }
        }
        Some(errors)
    }

    /// Mutations per pixel so far.
    #[must_use]
    pub fn mutations_per_pixel(&self) -> f64 {
        self.run
            .counts()
            .mutations_per_pixel(self.run.steps(), self.scene.pixel_count())
    }

    /// `picture` with what the groups tell of it, as layers: `block_error`, the standard error of the mean of the pixel's
    /// block among [`error_blocks`], and `agreement`, how far groups lie apart in the pixel's block among those that states
    /// are classed by: the ratio of the variance between groups to the one that chains inside them explain, about 1 where
    /// nothing is wrong, 0 where too little was seen.
    #[must_use]
    pub fn with_layers(&self, picture: Picture, findings: &Findings) -> Picture {
        let pixels = 0..self.scene.pixel_count();
        let grid = error_blocks(&self.scene);
        let errors = self.block_errors(&grid).unwrap_or_default();
        let error = |pixel: u32| {
            let first = 3 * grid.block_of(pixel)?;
            let [r, g, b] = errors.get(first..first + 3)? else {
                return None;
            };
            Some(Rgb::new(*r as f32, *g as f32, *b as f32))
        };
        let ratio = |pixel: u32| {
            findings
                .block_ratios
                .get(self.blocks.block_of(pixel)?)
                .map(|&ratio| ratio as f32)
        };
        let errors = pixels.clone().map(|pixel| error(pixel).unwrap_or_default()).collect();
        let ratios = pixels.map(|pixel| ratio(pixel).unwrap_or_default()).collect();
        picture
            .with_layer("block_error", LayerChannels::Rgb(errors))
            .with_layer("agreement", LayerChannels::Y(ratios))
    }

    /// What a class of states is called in reports.
    #[must_use]
    pub fn class_name(&self, class: usize) -> String {
        if class < StateClass::BLOCKS {
            return self.blocks.name(class);
        }
        let length = class - StateClass::BLOCKS;
        if length < StateClass::LENGTHS {
            let more = if length + 1 == StateClass::LENGTHS {
                " or more"
            } else {
                ""
            };
            return format!("length {length}{more}");
        }
        let signature = crate::chain::Signature::of_number(length - StateClass::LENGTHS);
        format!("signature {}", signature.name())
    }
}

/// The blocks of the film that states are classed by.
pub(super) fn state_blocks(scene: &Scene) -> BlockGrid {
    BlockGrid::new(scene.width, scene.height, BLOCKS_PER_SIDE)
}

/// Inserts what chains of light read beside the core and the film.
pub(super) fn insert_light(world: &mut World, scene: &Arc<Scene>, blocks: &Arc<BlockGrid>, plan: &Plan) {
    world.insert_resource(SceneRef(Arc::clone(scene)));
    if let Some(strategies) = plan.strategies {
        world.insert_resource(StrategiesRef(strategies));
    }
    world.insert_resource(FilmBlocks(Arc::clone(blocks)));
}

impl Rendering for ChainRender {
    fn plan(&self) -> &Plan {
        &self.plan
    }

    fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    fn steps(&self) -> u64 {
        self.run.steps()
    }

    fn chains(&self) -> u32 {
        self.run.counts().total()
    }

    fn threads(&self) -> usize {
        self.run.threads()
    }

    fn tile_count(&self) -> usize {
        self.run.tile_count()
    }

    fn burst(&mut self, steps: u64, done: &(dyn Fn(u64) + Sync)) {
        self.run.burst(steps, done);
        self.follow(done);
    }

    fn counters(&self) -> Counters {
        self.run.counters()
    }

    fn costs(&self) -> Vec<SystemCost> {
        self.run.costs()
    }

    fn busy_time(&self) -> Duration {
        self.run.busy_time()
    }

    fn picture(&self) -> Picture {
        let films: Vec<_> = self.films.iter().map(|film| lock(film)).collect();
        let films: Vec<_> = films.iter().map(|film| &**film).collect();
        let (scales, combination) = (vec![self.per_state(); films.len()], self.combination());
        let weight = self.mutations_per_pixel() as f32;
        // All films are of the scene's size, and there is a finite scale for each.
        let mut picture =
            develop_combined(&films, &scales, weight, |values| combination.apply(values)).unwrap_or_default();
        if let Some(direct) = &self.direct {
            direct.add_to(&mut picture);
        }
        picture
    }

    fn error(&self) -> Option<PictureError> {
        let grid = error_blocks(&self.scene);
        let means = self.group_block_means(&grid)?;
        let Some(direct) = &self.direct else {
            return PictureError::of(&means)?.relative_to(means.grand_mean());
        };
        let (of_direct, blocks) = direct.block_means(&grid)?;
        let mean = of_direct.iter().sum::<f64>() / of_direct.len() as f64;
        PictureError::of_parts(&means, &blocks)?.relative_to(mean + means.grand_mean())
    }

    fn layers(&self) -> Vec<LayerFinding> {
        let Some(layers) = &self.layers else {
            return Vec::new();
        };
        let (weights, normalizations) = (self.group_weights(), self.run.normalizations());
        let b = normalizations.iter().sum::<f64>() / normalizations.len() as f64;
        let of_groups: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
        let scale = if of_groups > 0.0 {
            b * self.per_state() / of_groups
        } else {
            0.0
        };
        let combination = self.combination();
        let parts = layers.of_states(scale, self.per_state(), self.run.busy_time(), &|values| {
            combination.apply(values)
        });
        let of_direct = self.direct.as_ref().map(DirectLight::layer_parts);
        LayerFinding::all(&layers.layers, parts, of_direct)
    }

    fn acceptance(&self) -> Option<f64> {
        let all = self.run.statistics().of_all();
        (all.proposed > 0).then(|| all.accepted as f64 / all.proposed as f64)
    }

    fn save(&self) -> Vec<u8> {
        ChainRender::save(self)
    }

    fn tally(&self) -> Tally {
        let mut sum = Tally::default();
        self.films.iter().for_each(|film| sum.add(&lock(film).tally()));
        if let Some(direct) = &self.direct {
            sum.add(&direct.tally());
        }
        sum
    }

    fn direct(&self) -> Option<&DirectLight> {
        self.direct.as_ref()
    }

    fn as_chains(&self) -> Option<&ChainRender> {
        Some(self)
    }

    fn for_each_world(&self, look: &mut dyn FnMut(usize, &mut TileWorld)) {
        let mut number = 0;
        self.run.for_each_tile(&mut |_, world| {
            look(number, world);
            number += 1;
        });
    }
}
