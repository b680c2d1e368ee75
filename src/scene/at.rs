//! A value's place in a scene, and the checks that many values share.

use super::error::{SceneError, SceneWarning};
use super::mesh::MAX_COORDINATE;
use super::read::{SceneSource, Step};
use glam::DVec3;

/// The way to a value of a scene, and the scene itself.
#[derive(Clone)]
pub(super) struct At<'a> {
    pub(super) source: &'a SceneSource,
    steps: Vec<Step<'a>>,
}

impl<'a> At<'a> {
    /// The scene as a whole.
    pub(super) fn root(source: &'a SceneSource) -> Self {
        Self {
            source,
            steps: Vec::new(),
        }
    }

    fn step(&self, step: Step<'a>) -> Self {
        let mut steps = self.steps.clone();
        steps.push(step);
        Self {
            source: self.source,
            steps,
        }
    }

    pub(super) fn key(&self, name: &'a str) -> Self {
        self.step(Step::Key(name))
    }

    /// The name of an entry rather than its value.
    pub(super) fn name(&self, name: &'a str) -> Self {
        self.step(Step::Name(name))
    }

    pub(super) fn index(&self, index: usize) -> Self {
        self.step(Step::Index(index))
    }

    pub(super) fn variant(&self, name: &'a str) -> Self {
        self.step(Step::Variant(name))
    }

    /// The one unnamed value in an enum variant.
    pub(super) fn content(&self) -> Self {
        self.step(Step::Content)
    }

    pub(super) fn error(&self, message: impl Into<String>, help: impl Into<String>) -> SceneError {
        self.source.error(&self.steps, message, help)
    }

    pub(super) fn warning(&self, message: impl Into<String>, help: impl Into<String>) -> SceneWarning {
        self.source.warning(&self.steps, message, help)
    }

    /// The name of the innermost field, to begin a message with: `fov: `.
    fn field(&self) -> String {
        let keys = self.steps.iter().rev();
        let mut names = keys.filter_map(|step| if let Step::Key(name) = step { Some(name) } else { None });
        names.next().map_or_else(String::new, |name| format!("{name}: "))
    }

    /// Refuses infinities and values that are not numbers.
    pub(super) fn finite(&self, value: f32) -> Result<(), SceneError> {
        if value.is_finite() {
            return Ok(());
        }
        let help = if value.is_nan() {
            ""
        } else {
            "the largest number is about 3.4e38"
        };
        Err(self.error(format!("{}expected a finite number, found {value}", self.field()), help))
    }

    /// Refuses values outside `least..=most`; `help` says what is usual.
    pub(super) fn within(&self, value: f32, least: f32, most: f32, help: &str) -> Result<(), SceneError> {
        self.finite(value)?;
        if (least..=most).contains(&value) {
            return Ok(());
        }
        let [least, most, value] = [least, most, value].map(short);
        Err(self.error(
            format!(
                "{}expected a number from {least} to {most}, found {value}",
                self.field()
            ),
            help,
        ))
    }

    /// [`At::within`], for every element.
    pub(super) fn each_within(&self, values: [f32; 3], least: f32, most: f32, help: &str) -> Result<(), SceneError> {
        values
            .iter()
            .enumerate()
            .try_for_each(|(index, value)| self.index(index).within(*value, least, most, help))
    }

    /// A position or an extent: finite, and not so large that computing with it overflows.
    pub(super) fn lengths(&self, values: [f32; 3]) -> Result<DVec3, SceneError> {
        self.each_within(
            values,
            -MAX_COORDINATE,
            MAX_COORDINATE,
            "choose a larger unit of length",
        )?;
        Ok(wide(values))
    }

    /// A direction of any length that can be computed with.
    pub(super) fn direction(&self, values: [f32; 3]) -> Result<DVec3, SceneError> {
        let direction = self.lengths(values)?;
        if direction == DVec3::ZERO {
            return Err(self.error("expected a direction, found the zero vector", "such as (0, 1, 0)"));
        }
        if direction.length() < 1.0e-9 {
            return Err(self.error("this direction is too short to compute with", "such as (0, 1, 0)"));
        }
        Ok(direction)
    }
}

/// A number as messages show it: without rows of zeros.
fn short(value: f32) -> String {
    if value == 0.0 || (1.0e-4..1.0e6).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// Three numbers as a vector of doubles.
pub(super) fn wide(values: [f32; 3]) -> DVec3 {
    DVec3::from_array(values.map(f64::from))
}
