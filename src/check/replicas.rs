//! Replicas: independent chains, each at a bootstrap's sample of its own.

use super::CheckError;
use super::family::{Cells, Family, Side, families};
use crate::chain::{
    Acceptance, BootstrapWeight, ChosenMutation, CommonDensity, ForwardDensity, ProposedTarget, Rejections,
    SupportDensity, Target,
};
use crate::film::{BlockGrid, GroupFilm};
use crate::path::ChainTable;
use crate::plan::{Base, ChainPlan, ChainSettings, Plan, PlanOptions, Registry, Technique};
use crate::render::TileWorld;
use crate::scene::Scene;
use crate::systems::Run;
use crate::systems::chains::{ChainStatistics, GroupPlace, MutationLists, Mutations};
use crate::systems::tile::{FilmBlocks, GroupFilmRef, SceneRef, StrategiesRef};
use std::sync::{Arc, Mutex};

/// Replicas that run side by side.
pub(super) const BATCH: u32 = 512;
/// Blocks along a side of the film.
const BLOCKS_PER_SIDE: u32 = 4;

/// What is tried: a plan of chains, and the families that their states have.
pub(super) struct Subject {
    plan: Plan,
    chains: ChainPlan,
    scene: Arc<Scene>,
    seed: u64,
    blocks: Arc<BlockGrid>,
    pub(super) families: Vec<Family>,
    /// Number of the mutation that is checked.
    pub(super) number: usize,
}

impl Subject {
    /// Plans chains that run the mutations of `registry`, of which `name` is checked.
    pub(super) fn new(
        registry: Registry,
        name: &'static str,
        (technique, base): (Technique, Base),
        scene: &Arc<Scene>,
        seed: u64,
    ) -> Result<Self, CheckError> {
        let options = PlanOptions {
            tile_size: Some(BATCH),
            chains: ChainSettings {
                groups: 1,
                chains: Some(BATCH),
                bootstrap: Some(BATCH),
                densities: true,
            },
            mutations: registry,
            base,
            ..PlanOptions::default()
        };
        let plan = Plan::with(scene, technique, &options)?;
        let chains = plan.chains.clone().ok_or(CheckError::NoTechnique {
            name,
            space: technique.name(),
        })?;
        let blocks = Arc::new(BlockGrid::new(scene.width, scene.height, BLOCKS_PER_SIDE));
        let number = chains.mutations.iter().position(|m| m.mutation.name() == name);
        Ok(Self {
            families: families(&plan.tile, &blocks),
            number: number.unwrap_or(0),
            plan,
            chains,
            scene: Arc::clone(scene),
            seed,
            blocks,
        })
    }

    /// A world in which replicas run.
    pub(super) fn replicas(&self) -> Result<Replicas<'_>, CheckError> {
        let film = GroupFilm::new(self.scene.width, self.scene.height)?;
        let mutations = &self.chains.mutations;
        let world = TileWorld::new(&self.plan.tile, self.seed, |world| {
            world.insert_resource(Mutations::new(mutations));
            world.insert_resource(MutationLists::default());
            world.insert_resource(ChainStatistics::new(mutations.len()));
            world.insert_resource(GroupPlace::default());
            world.insert_resource(SceneRef(Arc::clone(&self.scene)));
            world.insert_resource(GroupFilmRef(Arc::new(Mutex::new(film))));
            world.insert_resource(FilmBlocks(Arc::clone(&self.blocks)));
            if let Some(strategies) = self.plan.strategies {
                world.insert_resource(StrategiesRef(strategies));
            }
            for (number, planned) in mutations.iter().enumerate() {
                planned.mutation.register(number, world);
            }
        });
        Ok(Replicas {
            subject: self,
            world,
            first: 0,
            chains: 0,
        })
    }
}

/// Replicas under way.
pub(super) struct Replicas<'a> {
    pub(super) subject: &'a Subject,
    pub(super) world: TileWorld,
    /// Global number of the first replica.
    pub(super) first: u32,
    chains: u32,
}

impl Replicas<'_> {
    /// Draws a sample for each of `chains` replicas from `first` on, and returns their weights f/p. They are proposals still.
    pub(super) fn draw(&mut self, first: u32, chains: u32) -> Vec<f64> {
        (self.first, self.chains) = (first, chains.min(BATCH));
        self.world.run_once(Run::Bootstrap, self.first, self.chains, 0);
        self.column::<f64>(|world, values| world.read::<BootstrapWeight, ChainTable>(values))
    }

    /// Makes the samples the replicas' states, but for those without light, whose replicas weigh nothing.
    pub(super) fn take(&mut self) {
        self.world.clear::<Target, ChainTable>();
        // The keys are still those of the samples.
        self.world.run_once(Run::Seed, self.first, self.chains, 0);
    }

    /// Takes step number `step` of every replica.
    pub(super) fn step(&mut self, step: u64) {
        self.world.run_once(Run::Step, self.first, self.chains, step);
    }

    /// The cells of all replicas' states.
    pub(super) fn look(&mut self, cells: &mut Cells, side: Side) {
        cells.look(&self.subject.families, &mut self.world, side, self.chains as usize);
    }

    /// The acceptances of the last step.
    pub(super) fn acceptances(&mut self) -> Vec<f64> {
        self.column(|world, values| world.read::<Acceptance, ChainTable>(values))
    }

    /// Whether the last step's proposals were taken.
    pub(super) fn accepted(&mut self) -> Vec<bool> {
        let rejections = self.column::<u32>(|world, values| world.read::<Rejections, ChainTable>(values));
        rejections.into_iter().map(|run| run == 0).collect()
    }

    /// The mutations that the last step tried.
    pub(super) fn chosen(&mut self) -> Vec<u32> {
        self.column(|world, values| world.read::<ChosenMutation, ChainTable>(values))
    }

    /// The targets of the current states, or of proposals.
    pub(super) fn targets(&mut self, side: Side) -> Vec<f32> {
        self.column(|world, values| match side {
            Side::Current => world.read::<Target, ChainTable>(values),
            Side::Proposed => world.read::<ProposedTarget, ChainTable>(values),
        })
    }

    /// ln T of the last step's proposals, whole.
    pub(super) fn log_densities(&mut self) -> Vec<f64> {
        let mut forward = self.column::<f64>(|world, values| world.read::<ForwardDensity, ChainTable>(values));
        let common = self.column::<f64>(|world, values| world.read::<CommonDensity, ChainTable>(values));
        forward.iter_mut().zip(common).for_each(|(sum, more)| *sum += more);
        forward
    }

    /// ln q of the last step's proposals.
    pub(super) fn support_log_densities(&mut self) -> Vec<f64> {
        self.column(|world, values| world.read::<SupportDensity, ChainTable>(values))
    }

    fn column<V: Clone + Default>(&mut self, read: impl FnOnce(&mut TileWorld, &mut [V])) -> Vec<V> {
        let mut values = vec![V::default(); self.chains as usize];
        read(&mut self.world, &mut values);
        values
    }
}
