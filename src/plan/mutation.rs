//! Mutations: how a chain proposes its next state. Each is one file of its own; this is what it has to say of itself.

use super::effect::EffectPlan;
use super::support::Support;
use super::system::SystemPlan;
use super::table::TablePlan;
use crate::chain::StateClass;
use crate::path::{FilmCoordinates, VertexCoordinates};
use crate::sampling::StreamKey;
use crate::scene::nearest_name;
use crate::systems::propose::MovesPaths;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt;
use std::sync::Arc;

/// The largest weight that a mutation may have.
pub const MAX_WEIGHT: f32 = 1e6;

/// The most mutations that a plan may have.
pub const MAX_MUTATIONS: usize = 16;

/// A mutation: the struct that implements this holds its settings. Their defaults are the struct's
/// [`Default`]; what serde reads is what the command line can set. One of the settings has to be called `weight`: it is what
/// [`weight`](Self::weight) says, and how a mutation is tried alone or not at all.
pub trait Mutation: Clone + Default + fmt::Debug + Serialize + DeserializeOwned + Send + Sync + 'static {
    /// Its name on the command line, in profiles and in tables.
    const NAME: &'static str;
    /// What it does, in a line.
    const ABOUT: &'static str;
    /// The states that it moves between: a mutation goes with the techniques whose chains have such states.
    const SPACE: StateSpace;
    /// Whether its proposals do not depend on the current state. Then bootstraps can draw seeds with it.
    const INDEPENDENT: bool = false;

    /// How often it is tried, relative to the others, where it is suitable. 0 switches it off.
    fn weight(&self) -> f32;

    /// Says what is wrong with the settings.
    ///
    /// # Errors
    /// The setting, what was expected, and what it is.
    fn check(&self) -> Result<(), String> {
        Ok(())
    }

    /// Whether a scene with these effects can use it, and if not, why.
    ///
    /// # Errors
    /// The reason.
    fn applies(&self, effects: &[EffectPlan]) -> Result<(), &'static str> {
        let _ = effects;
        Ok(())
    }

    /// Whether [`suitability`](Self::suitability) is not 1 everywhere.
    const SELECTIVE: bool = false;

    /// How suitable it is in a state, as a factor of its weight, not negative.
    fn suitability(&self, state: StateClass) -> f32 {
        let _ = state;
        1.0
    }

    /// The systems that propose and trace with it. They find its chains in
    /// [`MutationLists`](crate::systems::tile::MutationLists), and its settings and number in [`Registered`].
    fn systems(&self) -> Vec<SystemPlan>;

    /// Adds the columns that it needs beside those of its state space.
    fn columns(&self, tables: &mut [TablePlan]) {
        let _ = tables;
    }

    /// How it moves one path after another, if it can: techniques that run chains depth first ask for it.
    fn depth_first(&self) -> Option<Box<dyn MovesVertices>> {
        None
    }

    /// How it moves whole paths, if it does so path by path: techniques that run chains depth first ask for it.
    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        None
    }

    /// Where its proposals can be: what [`check`](crate::check) tests its density against. Without it, the density goes
    /// untested, and reports say so.
    fn support(&self) -> Option<Support> {
        None
    }
}

/// A mutation of primary sample space that moves a path's coordinates as the path reaches them, is as likely one way as the
/// other, and draws coordinates beyond the end of the current path afresh. Its systems do the same for many chains at once.
pub trait MovesVertices: fmt::Debug + Send + Sync {
    /// Where the proposal of a path that starts at `current` starts; draws come from `key`.
    fn film(&self, current: FilmCoordinates, key: StreamKey) -> FilmCoordinates;

    /// The proposal's coordinates of the vertex at `depth`, which has the coordinates `current`.
    fn vertex(&self, current: VertexCoordinates, key: StreamKey, depth: u32) -> VertexCoordinates;
}

/// The kind of states that chains move between, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StateSpace(pub &'static str);

impl StateSpace {
    /// Primary sample space: the uniform numbers that a path tracer turns into a path.
    pub const PRIMARY: Self = Self("primary");
    /// Path space: whole paths from the camera to a light (Veach and Guibas 1997).
    pub const PATH: Self = Self("path");
}

/// A planned mutation's settings and number, as its systems read them.
#[derive(Resource, Clone, Debug)]
pub struct Registered<M: Mutation> {
    /// Its settings.
    pub settings: M,
    /// Its number in the plan.
    pub number: usize,
}

/// A mutation of any type.
pub trait AnyMutation: fmt::Debug + Send + Sync {
    /// [`Mutation::NAME`].
    fn name(&self) -> &'static str;
    /// [`Mutation::ABOUT`].
    fn about(&self) -> &'static str;
    /// [`Mutation::SPACE`].
    fn space(&self) -> StateSpace;
    /// [`Mutation::INDEPENDENT`].
    fn is_independent(&self) -> bool;
    /// [`Mutation::SELECTIVE`].
    fn is_selective(&self) -> bool;
    /// [`Mutation::weight`].
    fn weight(&self) -> f32;
    /// [`Mutation::applies`].
    ///
    /// # Errors
    /// The reason why not.
    fn applies(&self, effects: &[EffectPlan]) -> Result<(), &'static str>;
    /// [`Mutation::suitability`].
    fn suitability(&self, state: StateClass) -> f32;
    /// [`Mutation::systems`].
    fn systems(&self) -> Vec<SystemPlan>;
    /// [`Mutation::columns`].
    fn columns(&self, tables: &mut [TablePlan]);
    /// [`Mutation::depth_first`].
    fn depth_first(&self) -> Option<Box<dyn MovesVertices>>;
    /// [`Mutation::moves_paths`].
    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>>;
    /// [`Mutation::support`].
    fn support(&self) -> Option<Support>;
    /// Its settings, as JSON.
    fn settings(&self) -> serde_json::Value;
    /// The same mutation with these settings, by key and value.
    ///
    /// # Errors
    /// A setting that it does not have, or a value that does not fit.
    fn with(&self, settings: &[(&str, &str)]) -> Result<Arc<dyn AnyMutation>, String>;
    /// Inserts [`Registered`].
    fn register(&self, number: usize, world: &mut World);
}

impl<M: Mutation> AnyMutation for M {
    fn name(&self) -> &'static str {
        M::NAME
    }
    fn about(&self) -> &'static str {
        M::ABOUT
    }
    fn space(&self) -> StateSpace {
        M::SPACE
    }
    fn is_independent(&self) -> bool {
        M::INDEPENDENT
    }
    fn is_selective(&self) -> bool {
        M::SELECTIVE
    }
    fn weight(&self) -> f32 {
        Mutation::weight(self)
    }
    fn applies(&self, effects: &[EffectPlan]) -> Result<(), &'static str> {
        Mutation::applies(self, effects)
    }
    fn suitability(&self, state: StateClass) -> f32 {
        Mutation::suitability(self, state)
    }
    fn systems(&self) -> Vec<SystemPlan> {
        Mutation::systems(self)
    }
    fn columns(&self, tables: &mut [TablePlan]) {
        Mutation::columns(self, tables);
    }
    fn depth_first(&self) -> Option<Box<dyn MovesVertices>> {
        Mutation::depth_first(self)
    }
    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        Mutation::moves_paths(self)
    }
    fn support(&self) -> Option<Support> {
        Mutation::support(self)
    }
    fn settings(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }
    fn with(&self, settings: &[(&str, &str)]) -> Result<Arc<dyn AnyMutation>, String> {
        let mut all = AnyMutation::settings(self);
        for (key, value) in settings {
            let known: Vec<String> = all
                .as_object()
                .map(|map| map.keys().cloned().collect())
                .unwrap_or_default();
            let Some(entry) = all.get_mut(*key) else {
                let hint = nearest_name(key, known.iter().map(String::as_str));
                return Err(format!("`{}` has no setting `{key}`: {hint}", M::NAME));
            };
            *entry = serde_json::from_str(value).unwrap_or_else(|_| (*value).into());
            // So that a value that does not fit is told with its key.
            serde_json::from_value::<M>(all.clone())
                .map_err(|error| format!("`{}`, setting `{key}`: {error}", M::NAME))?;
        }
        let changed: M = serde_json::from_value(all).map_err(|error| format!("`{}`: {error}", M::NAME))?;
        let weight = Mutation::weight(&changed);
        if !(0.0..=MAX_WEIGHT).contains(&weight) {
            return Err(format!(
                "`{}`: its weight is a number from 0 up to {MAX_WEIGHT}, not {weight}",
                M::NAME
            ));
        }
        changed.check().map_err(|error| format!("`{}`: {error}", M::NAME))?;
        Ok(Arc::new(changed))
    }
    fn register(&self, number: usize, world: &mut World) {
        world.insert_resource(Registered {
            settings: self.clone(),
            number,
        });
    }
}

/// The mutations there are. A program that has mutations of its own adds them here, one line each.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    mutations: Vec<Arc<dyn AnyMutation>>,
}

impl Registry {
    /// A registry without mutations.
    #[must_use]
    pub fn empty() -> Self {
        Self::default()
    }

    /// The same registry with one mutation more, in place of one of its name.
    #[must_use]
    pub fn with(mut self, mutation: impl Mutation) -> Self {
        self.put(Arc::new(mutation));
        self
    }

    /// Adds a mutation of any type, in place of one of its name.
    pub fn put(&mut self, mutation: Arc<dyn AnyMutation>) {
        match self.mutations.iter_mut().find(|known| known.name() == mutation.name()) {
            Some(known) => *known = mutation,
            None => self.mutations.push(mutation),
        }
    }

    /// All of them, in the order in which they were registered.
    pub fn iter(&self) -> impl Iterator<Item = &Arc<dyn AnyMutation>> {
        self.mutations.iter()
    }

    /// The mutation of this name.
    ///
    /// # Errors
    /// There is none: the names there are, and the nearest.
    pub fn get(&self, name: &str) -> Result<&Arc<dyn AnyMutation>, String> {
        self.mutations.iter().find(|known| known.name() == name).ok_or_else(|| {
            let names: Vec<&str> = self.mutations.iter().map(|m| m.name()).collect();
            format!("there is no mutation `{name}`: {}", nearest_name(name, names))
        })
    }

    /// Changes settings as `NAME:KEY=VALUE,KEY=VALUE` says.
    ///
    /// # Errors
    /// A name, a key or a value that does not fit.
    pub fn set(&mut self, text: &str) -> Result<(), String> {
        let form = || format!("expected NAME:SETTING=VALUE,..., such as small_step:weight=0.5, not `{text}`");
        let (name, settings) = text.split_once(':').ok_or_else(form)?;
        let pairs: Option<Vec<(&str, &str)>> = settings.split(',').map(|setting| setting.split_once('=')).collect();
        let pairs: Vec<(&str, &str)> = pairs.ok_or_else(form)?;
        let trimmed: Vec<(&str, &str)> = pairs.iter().map(|(key, value)| (key.trim(), value.trim())).collect();
        let mutation = self.get(name.trim())?.with(&trimmed)?;
        self.put(mutation);
        Ok(())
    }

    /// The same registry where `name` alone is tried: every other mutation has its weight set to 0.
    ///
    /// # Errors
    /// No such mutation.
    pub fn only(&self, name: &str) -> Result<Self, String> {
        self.get(name)?;
        let mut only = Self::empty();
        for mutation in &self.mutations {
            only.put(mutation.with(&[("weight", if mutation.name() == name { "1" } else { "0" })])?);
        }
        Ok(only)
    }
}

/// A mutation as a plan lists it.
#[derive(Clone, Debug)]
pub struct MutationPlan {
    /// Which, with its settings.
    pub mutation: Arc<dyn AnyMutation>,
    /// Why it is there, or why its weight is 0.
    pub reason: &'static str,
}
