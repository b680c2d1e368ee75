//! A mutation with other systems: what the density test needs beside the mutation itself.

use crate::chain::{StateClass, SupportDensity};
use crate::plan::{AnyMutation, EffectPlan, MovesVertices, Region, StateSpace, Support, SystemPlan, TablePlan};
use crate::systems::propose::MovesPaths;
use bevy_ecs::world::World;
use std::sync::Arc;

/// The mutation `inner`, with `systems` in place of its own.
#[derive(Clone, Debug)]
pub(super) struct Instrumented {
    inner: Arc<dyn AnyMutation>,
    systems: Vec<SystemPlan>,
}

impl Instrumented {
    /// The mutation, whose proposals are also weighed.
    pub(super) fn weighed(inner: &Arc<dyn AnyMutation>, region: &Region) -> Self {
        let mut systems = inner.systems();
        systems.extend_from_slice(&region.weigh);
        Self {
            inner: Arc::clone(inner),
            systems,
        }
    }

    /// Draws from the region in place of the mutation's proposals.
    pub(super) fn drawn(inner: &Arc<dyn AnyMutation>, region: &Region) -> Self {
        Self {
            inner: Arc::clone(inner),
            systems: region.draw.clone(),
        }
    }
}

impl AnyMutation for Instrumented {
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
        self.systems.clone()
    }
    fn columns(&self, tables: &mut [TablePlan]) {
        self.inner.columns(tables);
        if let Some(chains) = tables.first_mut() {
            chains.column::<SupportDensity>("densities are tested");
        }
    }
    fn depth_first(&self) -> Option<Box<dyn MovesVertices>> {
        // It would leave out the systems that were added.
        None
    }
    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        // As before.
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
