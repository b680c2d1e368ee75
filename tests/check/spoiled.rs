//! Mutations with something added that spoils them: broken twins of mutations that stay as they are.

use bevy_ecs::world::World;
use chainlight::chain::StateClass;
use chainlight::plan::{AnyMutation, EffectPlan, MovesVertices, StateSpace, Support, SystemPlan, TablePlan};
use std::sync::Arc;

/// The mutation `inner`, behind whose systems others run.
#[derive(Clone, Debug)]
pub struct Spoiled {
    pub inner: Arc<dyn AnyMutation>,
    pub systems: Vec<SystemPlan>,
}

impl AnyMutation for Spoiled {
    fn name(&self) -> &'static str {
        self.inner.name()
    }
    fn about(&self) -> &'static str {
        self.inner.about()
    }
    fn space(&self) -> StateSpace {
        self.inner.space()
    }
    fn is_independent(&self) -> bool {
        self.inner.is_independent()
    }
    fn is_selective(&self) -> bool {
        self.inner.is_selective()
    }
    fn weight(&self) -> f32 {
        self.inner.weight()
    }
    fn applies(&self, effects: &[EffectPlan]) -> Result<(), &'static str> {
        self.inner.applies(effects)
    }
    fn suitability(&self, state: StateClass) -> f32 {
        self.inner.suitability(state)
    }
    fn systems(&self) -> Vec<SystemPlan> {
        let mut systems = self.inner.systems();
        systems.extend_from_slice(&self.systems);
        systems
    }
    fn columns(&self, tables: &mut [TablePlan]) {
        self.inner.columns(tables);
    }
    fn depth_first(&self) -> Option<Box<dyn MovesVertices>> {
        None
    }
    fn support(&self) -> Option<Support> {
        self.inner.support()
    }
    fn settings(&self) -> serde_json::Value {
        self.inner.settings()
    }
    fn with(&self, settings: &[(&str, &str)]) -> Result<Arc<dyn AnyMutation>, String> {
        Ok(Arc::new(Self {
            inner: self.inner.with(settings)?,
            systems: self.systems.clone(),
        }))
    }
    fn register(&self, number: usize, world: &mut World) {
        self.inner.register(number, world);
    }
}
