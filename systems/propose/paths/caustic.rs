//! `caustic`: light that leaves the last matt or rough point, or the lamp, near to where it leaves on the current path, follows the
//! same kinds of mirrors and clear surfaces, and is seen by the lens where it comes to the first matt or rough point (Veach and
//! Guibas 1997, section 4.2; Veach 1997, §11.3.3).
//!
//! | setting | meaning | unit | default | others use |
//! |---|---|---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations, where it is suitable | | 2 | 1 |
//! | `smallest` | the smallest step that is seen on the film, about | pixels | 0.1 | 0.1 |
//! | `covered` | share of the film that a disc of the largest step covers, about | | 0.05 | 0.05 |
//!
//! Suitable for paths E D S* (D|L): caustics. Light that comes from infinity keeps its direction, and comes from a place beside.
//!
//! The angle is so large that the light is moved by about as many pixels: that of a pixel, times the length of the edge at the lens
//! over that of the path behind it; light from infinity moves by the width of a pixel where the lens sees it. T(x→y): one strategy;
//! steps are as likely one way as the other, except that those which are too small or too large for y cannot lead back.

use super::film_jump::{COVERED, SMALLEST, check_film_sizes, film_sizes};
use super::moves_paths::{MovesPaths, PathProposal, SteeredLight, Way};
use super::view::PathView;
use crate::chain::StateClass;
use crate::path::whole::{CAUSTIC_TRAIT, Sizes, SteeredOrigin, aside, tilt};
use crate::path::{DrawList, VERTEX_INFINITE};
use crate::path_systems;
use crate::plan::{Mutation, StateSpace, SystemPlan, TablePlan};
use crate::sampling::{Purpose, StreamKey};
use serde::{Deserialize, Serialize};

/// Settings of `caustic`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CausticPerturbation {
    /// How often it is tried, relative to the other mutations, where it is suitable.
    pub weight: f32,
    /// The smallest step that is seen on the film, in pixels, about.
    pub smallest: f32,
    /// Share of the film that a disc of the largest step covers, about.
    pub covered: f32,
}

impl Default for CausticPerturbation {
    fn default() -> Self {
        Self {
            weight: 2.0,
            smallest: SMALLEST,
            covered: COVERED,
        }
    }
}

impl Mutation for CausticPerturbation {
    const NAME: &'static str = "caustic";
    const ABOUT: &'static str = "the part of the path that light takes to the point that the lens sees";
    const SPACE: StateSpace = StateSpace::PATH;
    const SELECTIVE: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn check(&self) -> Result<(), String> {
        check_film_sizes(self.smallest, self.covered)
    }

    fn suitability(&self, state: StateClass) -> f32 {
        if state.traits() & CAUSTIC_TRAIT != 0 { 1.0 } else { 0.0 }
    }

    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        Some(Box::new(self.clone()))
    }

    fn systems(&self) -> Vec<SystemPlan> {
        path_systems!(Self, "caustic":
            propose "light leaves in a direction nearby",
            steer "and comes by way of the same kinds of surfaces",
            weigh "each way is as likely as its strategy")
    }

    fn columns(&self, tables: &mut [TablePlan]) {
        if let Some(chains) = tables.first_mut() {
            chains
                .column::<DrawList>("perturbed subpaths wait for a direction")
                .column::<SteeredOrigin>("light from infinity comes from a place beside");
        }
    }
}

/// The angle at vertex `start` of a path that stands for a pixel; the width of a pixel where the lens sees the path, if light comes
/// from infinity there.
fn pixel_step(path: &PathView<'_>, start: u32) -> f64 {
    let camera = &path.scene.camera;
    let edge = |i: u32| path.position(i).as_dvec3().distance(path.position(i + 1).as_dvec3());
    let pixels = f64::from(path.scene.width) * f64::from(path.scene.height);
    // Of a camera of parallel rays its width.
    let density = camera.density(path.vertex(1).surface.direction);
    let angle = libm::sqrt(1.0 / (pixels * f64::from(density)));
    let seen = if camera.is_directional() { 1.0 } else { edge(0) };
    if path.vertex(start).kind == VERTEX_INFINITE {
        return angle * seen;
    }
    angle * seen / (1..start).map(edge).sum::<f64>()
}

impl CausticPerturbation {
    /// The sizes of steps at vertex `start` of a path: angles in radians; distances in scene units of light from infinity.
    fn sizes(&self, path: &PathView<'_>, start: u32) -> Sizes {
        film_sizes(path.scene, self.smallest, self.covered).scaled(pixel_step(path, start))
    }

    /// The step that `key` draws there, and in which direction it is taken, as a number in [0, 1).
    fn step(&self, path: &PathView<'_>, start: u32, key: StreamKey) -> (f64, f64) {
        let mut stream = key.stream(Purpose::PERTURB, 0);
        let step = self.sizes(path, start).sample(stream.next_f64());
        (step, stream.next_f64())
    }
}

impl MovesPaths for CausticPerturbation {
    fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal> {
        let (s, kept) = path.light_vertices()?;
        let start = path.edges + 1 - kept;
        let left = path.vertex(start);
        let (step, u) = self.step(path, start, key);
        let leaving = -left.surface.direction;
        let light = if left.kind == VERTEX_INFINITE {
            let beside = aside(leaving, step, u) + path.position(start - 1).as_dvec3();
            SteeredLight {
                direction: leaving,
                origin: path.scene.lights.beyond(beside.as_vec3(), -leaving),
            }
        } else {
            // Beyond half a turn there is no angle.
            if !(step > 0.0 && step < std::f64::consts::PI) {
                return None;
            }
            SteeredLight {
                direction: tilt(leaving, step, u),
                origin: left.surface.position,
            }
        };
        Some(PathProposal {
            light: Some(light),
            ..PathProposal::new([1, kept], [1, s])
        })
    }

    fn density(&self, way: &Way<'_>) -> f64 {
        let start = way.from.edges + 1 - way.kept[1];
        let (step, _) = self.step(way.current(), start, way.key);
        if !self.sizes(&way.from, start).contains(step) {
            return 0.0;
        }
        // The direction in which light leaves, drawn about another and as likely one way as the other, stands in for the density of
        // bidirectional path tracing, as does the certainty of discrete lobes: theirs are probabilities, the same both ways. What
        // `back` has beside them where light is refracted, a ratio of solid angles, is part of all strategies' measure.
        let lobes: f64 = (2..start).map(|i| way.to.onward(i)).product();
        way.to.share(1) / (lobes * way.to.back(start))
    }
}
