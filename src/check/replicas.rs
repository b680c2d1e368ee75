//! Replicas: independent chains, each at a bootstrap's sample of its own.

use super::family::{Cells, Family, Side, families};
use super::{CheckError, Options};
use crate::chain::{
    Acceptance, BootstrapWeight, ChosenMutation, CommonDensity, ForwardDensity, ProposedTarget, Rejections,
    SupportDensity, Target,
};
use crate::film::{BlockGrid, GroupFilm};
use crate::path::{ChainKey, ChainTable};
use crate::plan::{ChainPlan, ChainSettings, Plan, PlanOptions, Registry, StateSpace, Technique};
use crate::render::TileWorld;
use crate::sampling::{Purpose, Stream, StreamKey};
use crate::scene::Scene;
use crate::systems::Run;
use crate::systems::chains::{ChainStatistics, GroupPlace, MutationLists, Mutations, bootstrap_step};
use crate::systems::tile::{FilmBlocks, GroupFilmRef, SceneRef, StrategiesRef};
use std::sync::{Arc, Mutex};

/// Replicas that run side by side.
pub(super) const BATCH: u32 = 512;
/// Chooses among them.
const CHOICE: Purpose = Purpose::named("start of a replica");
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
    /// Samples among which a replica's start is chosen.
    candidates: u64,
}

impl Subject {
    /// Plans chains that run the mutations of `registry`, of which `name` is checked.
    pub(super) fn new(
        registry: Registry,
        name: &'static str,
        technique: Technique,
        checked: &Options,
        scene: &Arc<Scene>,
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
            base: checked.base,
            direct: Some(checked.direct),
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
            families: families(&plan.tile, &blocks, scene),
            number: number.unwrap_or(0),
            candidates: if technique.space() == Some(StateSpace::PATH) {
                u64::from(checked.candidates.max(1))
            } else {
                1
            },
            plan,
            chains,
            scene: Arc::clone(scene),
            seed: checked.seed,
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
    ///
    /// Of states whose weights differ much, each replica draws some candidates and starts at one of them, chosen in proportion to
    /// their weights; it then weighs as much as they do on average. E[w h(x₀)] is the same, and replicas stay independent; but
    /// without it, a few of them would be most of every sum (Talbot, Cline and Egbert 2005, on resampled importance sampling).
    pub(super) fn draw(&mut self, first: u32, chains: u32) -> Vec<f64> {
        (self.first, self.chains) = (first, chains.min(BATCH));
        let candidates = self.subject.candidates;
        let mut chosen = vec![0; self.chains as usize];
        let mut sums = vec![0.0; self.chains as usize];
        let mut streams: Vec<Stream> = (0..self.chains)
            .map(|chain| StreamKey::new(self.subject.seed, first + chain, 0).stream(CHOICE, 0))
            .collect();
        for round in 0..candidates {
            self.world.run_once(Run::Bootstrap, self.first, self.chains, round);
            let weights = self.column::<f64>(|world, values| world.read::<BootstrapWeight, ChainTable>(values));
            for (((sum, chosen), stream), weight) in sums.iter_mut().zip(&mut chosen).zip(&mut streams).zip(weights) {
                *sum += weight;
                if stream.next_f64() * *sum < weight {
                    *chosen = round;
                }
            }
        }
        if candidates > 1 {
            let key = |(chain, &round): (u32, &u64)| {
                StreamKey::new(self.subject.seed, first + chain, bootstrap_step(round)).bits()
            };
            let keys: Vec<u64> = (0..).zip(&chosen).map(key).collect();
            self.world.write::<ChainKey, ChainTable>(&keys);
        }
        sums.iter_mut().for_each(|sum| *sum /= candidates as f64);
        sums
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
