//! `caustic`: light that leaves the last matt or rough point, or the lamp, near to where it leaves on the current path, follows the
//! same kinds of mirrors and clear surfaces, and is seen by the lens where it comes to the first matt or rough point (Veach and
//! Guibas 1997, section 4.2; Veach 1997, §11.3.3).
//!
//! | setting | meaning | unit | default | others use |
//! |---|---|---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations, where it is suitable | | 1 | 1 |
//! | `smallest` | the smallest step that is seen on the film, about | pixels | 0.1 | 0.1 |
//! | `covered` | share of the film that a disc of the largest step covers, about | | 0.05 | 0.05 |
//!
//! Suitable for paths E D S* (D|L): caustics. Light that comes from infinity keeps its direction, and comes from a place beside.
//!
//! The angle is so large that the light is moved by about as many pixels: that of a pixel, times the length of the edge at the lens
//! over that of the path behind it; light from infinity moves by the width of a pixel where the lens sees it. T(x→y): one strategy;
//! steps are as likely one way as the other, except that those which are too small or too large for y cannot lead back.

use super::super::super::chains::{Keys, MutationLists};
use super::super::super::list::{PROPOSE_CAUSTICS, STEER_CAUSTICS, WEIGH_CAUSTICS};
use super::super::super::paths::Vertices;
use super::super::super::tile::{SceneRef, TilePlace};
use super::film_jump::{check_film_sizes, film_sizes};
use super::range::{PathRange, Ranges};
use super::steering::Steering;
use super::weighing::{PathDensities, Weighing};
use crate::chain::{MutationList, StateClass};
use crate::columns;
use crate::path::whole::*;
use crate::path::{ChainTable, Direction, DrawList, VERTEX_DISCRETE, VERTEX_INFINITE};
use crate::plan::{Mutation, Registered, StateSpace, SystemPlan, TablePlan};
use crate::sampling::Purpose;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::Res;
use serde::{Deserialize, Serialize};

columns! {
    /// The angle by which a caustic perturbation has changed a direction, in radians; of light from infinity, how far it has moved
    /// it, in scene units.
    pub CausticStep: f64;
}

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
            weight: 1.0,
            smallest: 0.1,
            covered: 0.05,
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

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(PROPOSE_CAUSTICS, "light leaves in a direction nearby"),
            SystemPlan::new(STEER_CAUSTICS, "and comes by way of the same kinds of surfaces"),
            SystemPlan::new(WEIGH_CAUSTICS, "each way is as likely as its strategy"),
        ]
    }

    fn columns(&self, tables: &mut [TablePlan]) {
        if let Some(chains) = tables.first_mut() {
            chains
                .column::<DrawList>("perturbed subpaths wait for a direction")
                .column::<SteeredOrigin>("light from infinity comes from a place beside")
                .column::<CausticStep>("a step must be one of those that lead back");
        }
    }
}

/// The angle at vertex `start` of a path that stands for a pixel; the width of a pixel where the lens sees the path, if light comes
/// from infinity there.
fn pixel_step(scene: &Scene, vertex: impl Fn(usize) -> WholeVertex, start: usize) -> f64 {
    let positions = |i: usize| vertex(i).surface.position.as_dvec3();
    let edge = |i: usize| positions(i).distance(positions(i + 1));
    let pixels = f64::from(scene.width) * f64::from(scene.height);
    // Of a camera of parallel rays its width.
    let angle = libm::sqrt(1.0 / (pixels * f64::from(scene.camera.density(vertex(1).surface.direction))));
    let seen = if scene.camera.is_directional() { 1.0 } else { edge(0) };
    if vertex(start).kind == VERTEX_INFINITE {
        return angle * seen;
    }
    angle * seen / (1..start).map(edge).sum::<f64>()
}

/// Tilts the direction in which light leaves, or moves light from infinity, for every chain that tries it.
pub fn propose_caustics(
    mutation: Res<Registered<CausticPerturbation>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    edges: Read<PathEdges, ChainTable>,
    current: Vertices<PathTable>,
    mut ranges: Ranges,
    mut directions: Write<Direction, ChainTable>,
    mut origins: Write<SteeredOrigin, ChainTable>,
    mut steps: Write<CausticStep, ChainTable>,
) {
    let sizes = film_sizes(&scene.0, mutation.settings.smallest, mutation.settings.covered);
    let (list, keys, edges, current) = (list.rows(), keys.columns(), edges.rows(), current.columns());
    let (directions, origins, steps) = (directions.rows(), origins.rows(), steps.rows());
    for chain in lists.entries(mutation.number).map(|entry| list.at(entry) as usize) {
        let k = edges.at(chain) as usize;
        let vertex = |i: usize| current.at(place.path_vertex(chain, i));
        let Some((s, kept)) = light_vertices(k, |i| vertex(i).kind == VERTEX_DISCRETE) else {
            ranges.none(chain);
            continue;
        };
        let start = k + 1 - kept;
        let left = vertex(start);
        let mut stream = keys.at(chain).stream(Purpose::PERTURB, 0);
        let step = sizes
            .scaled(pixel_step(&scene.0, vertex, start))
            .sample(stream.next_f64());
        let u = stream.next_f64();
        let path = place.lights_from as usize + chain;
        let leaving = -left.surface.direction;
        if left.kind == VERTEX_INFINITE {
            let beside = aside(leaving, step, u) + vertex(start - 1).surface.position.as_dvec3();
            origins.put(chain, scene.0.lights.beyond(beside.as_vec3(), -leaving));
            directions.put(path, leaving);
        } else {
            // Beyond half a turn there is no angle.
            if !(step > 0.0 && step < std::f64::consts::PI) {
                ranges.none(chain);
                continue;
            }
            directions.put(path, tilt(leaving, step, u));
        }
        steps.put(chain, step);
        let range = PathRange {
            kept: [1, kept as u32],
            made: [1, s as u32],
            steered: [false, true],
        };
        ranges.put(&place, chain, range);
    }
}

/// Follows the discrete lobes of the current path.
pub fn steer_caustics(mutation: Res<Registered<CausticPerturbation>>, mut steering: Steering) {
    steering.steer(mutation.number, |direction, _, _| direction);
}

/// Writes the densities.
pub fn weigh_caustics(
    mutation: Res<Registered<CausticPerturbation>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    steps: Read<CausticStep, ChainTable>,
    current: Vertices<PathTable>,
    proposed: Vertices<ProposedPathTable>,
    mut weighing: Weighing,
) {
    let sizes = film_sizes(&scene.0, mutation.settings.smallest, mutation.settings.covered);
    let (list, steps) = (list.rows(), steps.rows());
    let (current, proposed) = (current.columns(), proposed.columns());
    let chains = lists.entries(mutation.number).map(|entry| list.at(entry) as usize);
    weighing.weigh(&place, chains, |chain, way| {
        let vertices = if way.is_back { &proposed } else { &current };
        let start = way.from.edges + 1 - way.kept[1];
        let unit = pixel_step(&scene.0, |i| vertices.at(place.path_vertex(chain, i)), start as usize);
        if sizes.scaled(unit).contains(steps.at(chain)) {
            caustic_density(&way.to, start)
        } else {
            0.0
        }
    });
}

/// T / r of a path whose light leaves vertex `start` in a direction drawn about another, as likely one way as the other, which
/// stands in for the density of bidirectional path tracing, as does the certainty of discrete lobes.
fn caustic_density(to: &PathDensities<'_>, start: u32) -> f64 {
    let steered: f64 = (2..=start).map(|i| to.back(i)).product();
    to.share(1) / steered
}
