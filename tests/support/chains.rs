//! Small renders with chains.

use chainlight::film::GroupFilm;
use chainlight::path::ChainTable;
use chainlight::plan::{ChainSettings, Plan, PlanOptions, Technique};
use chainlight::render::{ChainRender, Rendering, TileWorld};
use chainlight::scene::Scene;
use chainlight::table::{Column, Rows};
use std::sync::{Arc, PoisonError};

/// How chains of a test are run.
#[derive(Clone, Debug)]
pub struct Chains {
    /// The technique.
    pub technique: Technique,
    /// The plan's options.
    pub options: PlanOptions,
    /// Seed of the render.
    pub seed: u64,
    /// Threads. One as a rule: tests themselves run side by side.
    pub threads: usize,
}

impl Chains {
    /// Chains of `pssmlt`: `groups` groups of `chains`, each group with a bootstrap of `bootstrap` samples.
    pub fn new(groups: u32, chains: u32, bootstrap: u32) -> Self {
        let settings = ChainSettings {
            groups,
            chains: Some(chains),
            bootstrap: Some(bootstrap),
            ..ChainSettings::default()
        };
        Self {
            technique: Technique::Pssmlt,
            options: PlanOptions {
                chains: settings,
                ..PlanOptions::default()
            },
            seed: 1,
            threads: 1,
        }
    }

    /// The same with another seed.
    pub fn seeded(&self, seed: u64) -> Self {
        Self { seed, ..self.clone() }
    }

    /// The same with a mutation's settings changed, in the words of the command line.
    #[track_caller]
    pub fn set(&self, setting: &str) -> Self {
        let mut changed = self.clone();
        let outcome = changed.options.mutations.set(setting);
        assert_eq!(outcome, Ok(()), "a setting of a test");
        changed
    }

    /// The plan.
    #[track_caller]
    pub fn plan(&self, scene: &Scene) -> Plan {
        Plan::with(scene, self.technique, &self.options).expect("the mutations of a test make a plan")
    }

    /// Chains at their first states.
    #[track_caller]
    pub fn start(&self, scene: &Arc<Scene>) -> ChainRender {
        self.start_as(scene, self.plan(scene))
    }

    /// Chains at their first states, run by a plan that the test has changed.
    #[track_caller]
    pub fn start_as(&self, scene: &Arc<Scene>, plan: Plan) -> ChainRender {
        ChainRender::new(Arc::clone(scene), plan, self.seed, self.threads).expect("small films and few threads")
    }

    /// Chains that have taken `steps` steps.
    #[track_caller]
    pub fn run(&self, scene: &Arc<Scene>, steps: u64) -> ChainRender {
        let mut render = self.start(scene);
        render.burst(steps, &|_| {});
        render
    }
}

/// The groups' films.
pub fn films(render: &ChainRender) -> Vec<GroupFilm> {
    let film = |film: &Arc<std::sync::Mutex<GroupFilm>>| film.lock().unwrap_or_else(PoisonError::into_inner).clone();
    render.films.iter().map(film).collect()
}

/// A column of the chain table over all chains, in the order of their global numbers.
pub fn column<C: Column>(render: &ChainRender) -> Vec<C::Value> {
    let mut values = vec![[C::zeroed()].at(0); render.run.counts().total() as usize];
    render.run.for_each_tile(&mut |chains, world: &mut TileWorld| {
        world.read::<C, ChainTable>(&mut values[chains.start as usize..chains.end as usize]);
    });
    values
}
