//! The weights that strategies get are those of their densities: held exactly, path by path, against products in f64.
//!
//! Subpaths are those of the renderer's own systems, with the densities and odds that these keep. Every strategy (s, t) of every
//! pair of them gives a path; the densities of all strategies for that path ([`super::densities`]) give the weight that it must
//! have: p^β / Σ p^β. So the weights of all strategies that can find a path sum to one. The scenes have every kind of end and
//! surface: diffuse, rough metal, a mirror, smooth glass with a matt ball in it, rough glass, a coat over matt ground, a mesh with
//! smooth normals; lights of triangles,
//! round, at a point, in one direction, all around; pinhole, lens and parallel rays. Paths have up to six edges.

use super::densities::{Mistake, Node, WholePath};
use super::subpath;
use crate::support::draws::stream;
use crate::support::scenes::inline;
use crate::support::verdict::say;
use chainlight::color::Rgb;
use chainlight::light::Endpoint;
use chainlight::path::bidirectional::{EndVertex, Join, Strategies, Weights};
use chainlight::path::mis::Heuristic;
use chainlight::path::*;
use chainlight::plan::{Plan, PlanOptions, Technique};
use chainlight::render::{Rendering, SplatRender};
use chainlight::sampling::Stream;
use chainlight::scene::Scene;
use chainlight::systems::tile::TilePlace;
use glam::{DVec3, Vec2, Vec3};
use std::collections::BTreeMap;
use std::sync::Arc;

const SIZE: u32 = 12;
pub(super) const MAX_DEPTH: u32 = 6;
const STEPS: u64 = 20;
/// How far weights may be off, relatively, for roundings of densities, ratios and throughputs to f32. What rounding does to the
/// directions of edges comes on top, path by path: the sum of what the weight changes by when each edge is turned by as much
/// ([`WholePath::turned`]). Most edges are long, and it is little.
const TOLERANCE: f64 = 1e-4;

pub(super) const CAMERAS: [(&str, &str); 3] = [
    (
        "a pinhole",
        "Perspective(origin: (0, 1.2, 4), target: (0, 0.9, 0), fov: 55)",
    ),
    (
        "a lens",
        "ThinLens(origin: (0, 1.2, 4), target: (0, 0.9, 0), fov: 55, aperture_radius: 0.1)",
    ),
    (
        "parallel rays",
        "Orthographic(origin: (0, 1.2, 4), target: (0, 0.9, 0), height: 4.6)",
    ),
];

const TRIANGLES: &str = r#"(shape: Quad(corner: (-1, 3, -1), edge_u: (2, 0, 0.3), edge_v: (0, 0.2, 2)), material: "white",
    emission: (6, 6, 6)),"#;
const BALL: &str = r#"(shape: Sphere(center: (0.4, 2.4, 0.3), radius: 0.6), material: "white", emission: (9, 9, 9)),"#;

/// A light by its name, shape and words.
pub(super) const LIGHTS: [(&str, &str, &str); 5] = [
    ("triangles", TRIANGLES, ""),
    ("a round light", BALL, ""),
    ("a point", "", "Point(position: (0.5, 2.6, 1), intensity: (5, 5, 5))"),
    (
        "one direction",
        "",
        "Directional(direction: (-0.3, -1, -0.5), irradiance: (3, 3, 3))",
    ),
    ("all directions", "", "Environment(radiance: (1, 1, 1))"),
];

const GLASS: (DVec3, f64, f64) = (DVec3::new(0.1, 0.65, 1.0), 0.6, 1.5);

/// Open, so that lights at infinity are met.
pub(super) fn scene(camera: &str, light: &str, lights: &str) -> Arc<Scene> {
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: {MAX_DEPTH}), camera: {camera}, film: (width: {SIZE}, height: {SIZE}),
            materials: {{
                "white": Diffuse(reflectance: (0.8, 0.8, 0.8)),
                "gold": RoughConductor(metal: "Au", alpha: 0.35),
                "mirror": Conductor(metal: "Ag"),
                "glass": Dielectric(interior_ior: 1.5),
                "frosted": RoughDielectric(interior_ior: 1.5, alpha: 0.4),
                "coated": Plastic(diffuse_reflectance: (0.6, 0.6, 0.6)),
            }},
            shapes: [
                (shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -5)), material: "white"),
                (shape: Quad(corner: (-3, 0, -2), edge_u: (6, 0, 0), edge_v: (0, 3, 0)), material: "gold"),
                (shape: Quad(corner: (-2, 0, 2), edge_u: (0, 0, -4), edge_v: (-0.3, 3, 0)), material: "mirror"),
                (shape: Sphere(center: (0.1, 0.65, 1.0), radius: 0.6), material: "glass"),
                (shape: Sphere(center: (0.1, 0.55, 1.0), radius: 0.3), material: "white"),
                (shape: Sphere(center: (1.5, 0.4, 1.6), radius: 0.4), material: "frosted"),
                (shape: Box(min: (-1.6, 0, 0.6), max: (-0.9, 0.6, 1.3)), material: "coated"),
                (shape: Torus(center: (1.4, 0.5, 0), axis: (0.2, 1, 0.3), major_radius: 0.6, minor_radius: 0.25,
                    segments: (12, 8)), material: "white"),
                {light}
            ],
            lights: [{lights}])"#
        ),
        SIZE,
    )
}

/// A light sampled by strategy s = 1, as a vertex.
pub(super) fn light_end(scene: &Scene, from: Vec3, draw: LightDraw) -> Option<(Node, u32)> {
    let sample = scene.lights.sample(from, draw.choice, draw.point)?;
    let surface = Scatterer {
        position: sample.position,
        normal: sample.normal,
        shading_normal: sample.normal,
        offset: 0.0,
        material: 0,
        uv: Vec2::ZERO,
        tangent: Vec3::ZERO,
        direction: Vec3::ZERO,
    };
    let infinite = scene.lights.endpoint(sample.light) == Endpoint::Infinite;
    let node = Node {
        surface,
        infinite,
        discrete: false,
    };
    Some((node, sample.light))
}

/// A strategy's weight for a path.
#[derive(Clone, Copy, Debug)]
struct Weighed {
    given: f64,
    expected: f64,
    tolerance: f64,
}

/// Errors of smaller weights are beside this.
const LEAST_WEIGHT: f64 = 1e-6;

impl Weighed {
    /// The relative error.
    fn error(&self) -> f64 {
        let error = (self.given - self.expected).abs() / self.expected.max(LEAST_WEIGHT);
        if error.is_nan() { f64::INFINITY } else { error }
    }
}

/// A pair of subpaths.
pub(super) struct Pair<'a> {
    pub(super) scene: &'a Scene,
    pub(super) heuristic: Heuristic,
    pub(super) camera: &'a [EndVertex],
    pub(super) light: &'a [EndVertex],
}

impl Pair<'_> {
    /// What strategy (s, t) brings.
    pub(super) fn value(&self, s: usize, t: usize, draw: LightDraw, weights: Weights) -> Rgb {
        let join = Join {
            scene: self.scene,
            strategies: Strategies {
                weights,
                heuristic: self.heuristic,
            },
            camera: self.camera,
            light: self.light,
        };
        let offer = match (s, t) {
            (0, _) => return join.met(t),
            (_, 1) => join.seen(s, 0.5).map(|seen| seen.offer),
            (1, _) => join.sampled(t, draw),
            _ => join.joined(s, t),
        };
        offer.map_or(Rgb::BLACK, |offer| offer.value)
    }

    /// Whether strategy (s, t) joins vertices that can be joined.
    pub(super) fn connects(&self, s: usize, t: usize) -> bool {
        let connects = |vertex: &EndVertex| {
            vertex.kind != VERTEX_INFINITE && !self.scene.materials.kind(vertex.surface.material).is_discrete()
        };
        (s == 0 || t == 1 || connects(&self.camera[t - 1])) && (s < 2 || connects(&self.light[s - 1]))
    }

    /// The weight that strategy (s, t) gets, against what the densities say of it; `None` where it brings nothing.
    fn weigh(&self, s: usize, t: usize, draw: LightDraw, mistake: Mistake) -> Option<Weighed> {
        if !self.connects(s, t) {
            return None;
        }
        let alone = self.value(s, t, draw, Weights::Only(s as u32, t as u32)).max_channel();
        if alone <= 0.0 {
            return None;
        }
        let weighted = self.value(s, t, draw, Weights::All).max_channel();
        let mut nodes: Vec<Node> = self.camera[..t - 1].iter().map(Node::inner).collect();
        nodes.push(Node::joined(&self.camera[t - 1]));
        let light = match s {
            0 if self.camera[t - 1].kind == VERTEX_INFINITE => self.scene.lights.infinite().next()?,
            0 => self.camera[t - 1].light,
            1 if t > 1 => {
                let (node, light) = light_end(self.scene, self.camera[t - 1].surface.position, draw)?;
                nodes.push(node);
                light
            }
            _ => {
                nodes.push(Node::joined(&self.light[s - 1]));
                nodes.extend(self.light[..s - 1].iter().rev().map(Node::inner));
                self.light[0].light
            }
        };
        let path = WholePath {
            scene: self.scene,
            nodes: &nodes,
            light,
            ball: GLASS,
            mistake,
            turned: None,
        };
        let expected = self.expected(&path, s)?;
        let mut weighed = Weighed {
            given: f64::from(weighted) / f64::from(alone),
            expected,
            tolerance: TOLERANCE,
        };
        // What turned edges change is only asked for where it may matter.
        if weighed.error() > 0.25 * TOLERANCE {
            let turned = path.turned().filter_map(|turned| self.expected(&turned, s));
            weighed.tolerance += turned
                .map(|turned| (turned - expected).abs() / expected.max(LEAST_WEIGHT))
                .sum::<f64>();
        }
        Some(weighed)
    }

    /// The weight of strategy number `s` by the densities of all; `None` where it cannot find the path.
    fn expected(&self, path: &WholePath<'_>, s: usize) -> Option<f64> {
        let densities = path.densities();
        // Powers of ratios: products of densities are too large or small for their squares.
        let odds = |p: &f64| self.heuristic.odds(p / densities[s]);
        let sum: f64 = densities.iter().map(odds).sum();
        (path.mistake == Mistake::None || densities[s] > 0.0).then_some(1.0 / sum)
    }
}

pub(super) fn light_draw(stream: &mut Stream) -> LightDraw {
    LightDraw {
        choice: stream.next_f64(),
        point: stream.next_pair(),
    }
}

/// What was found of a strategy.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    paths: u32,
    /// Those with a weight that is neither nothing nor all.
    shared: u32,
    /// The largest relative error.
    error: f64,
    /// The largest relative error over what is tolerated.
    excess: f64,
}

impl Found {
    fn add(&mut self, weighed: &Weighed) {
        let error = weighed.error();
        self.paths += 1;
        self.shared += u32::from((0.001..0.999).contains(&weighed.expected));
        self.error = self.error.max(error);
        self.excess = self.excess.max(error / weighed.tolerance);
    }
}

type Strategy = (usize, usize);

/// Visits the pairs of subpaths of some steps of a scene.
pub(super) fn for_each_pair(scene: &Arc<Scene>, heuristic: Heuristic, mut visit: impl FnMut(&Pair<'_>)) {
    let options = PlanOptions {
        tile_size: Some(SIZE * SIZE),
        heuristic,
        ..PlanOptions::default()
    };
    let plan = Plan::with(scene, Technique::Bdpt, &options).expect("a plan without chains");
    let mut render = SplatRender::new(Arc::clone(scene), plan, 1, 1).expect("a small film");
    for _ in 0..STEPS {
        render.burst(1, &|_| {});
        render.for_each_world(&mut |_, world| {
            let place = *world.world().resource::<TilePlace>();
            for chain in 0..place.chains as usize {
                let camera = subpath(world, chain);
                let light = subpath(world, place.lights_from as usize + chain);
                visit(&Pair {
                    scene,
                    heuristic,
                    camera: &camera,
                    light: &light,
                });
            }
        });
    }
}

impl Pair<'_> {
    /// The strategies that can join these subpaths.
    pub(super) fn strategies(&self) -> impl Iterator<Item = Strategy> {
        let light = self.light.len();
        (1..=self.camera.len()).flat_map(move |t| {
            let longest = (MAX_DEPTH as usize + 1 - t).min(light);
            (0..=longest).map(move |s| (s, t)).filter(|(s, t)| s + t > 1)
        })
    }
}

/// The paths of some steps of a scene, strategy by strategy.
fn look(scene: &Arc<Scene>, heuristic: Heuristic, mistake: Mistake) -> BTreeMap<Strategy, Found> {
    let mut found: BTreeMap<Strategy, Found> = BTreeMap::new();
    let mut stream = stream(1);
    for_each_pair(scene, heuristic, |pair| {
        for (s, t) in pair.strategies() {
            if let Some(weighed) = pair.weigh(s, t, light_draw(&mut stream), mistake) {
                found.entry((s, t)).or_default().add(&weighed);
            }
        }
    });
    found
}

/// The strategies that find paths from a light of some kind: those of 1 to 6 edges, but that what is in one place or direction
/// is not met, and that the lens sees none of it, nor of what is at infinity, where light subpaths start.
fn strategies(light: &str) -> usize {
    let all = (1..=MAX_DEPTH as usize).map(|edges| edges + 1).sum();
    match light {
        "a point" | "one direction" => all - MAX_DEPTH as usize - 1,
        "all directions" => all - 1,
        _ => all,
    }
}

#[test]
fn weights_are_those_of_the_densities_of_all_strategies() {
    for (camera_name, camera) in CAMERAS {
        for (light_name, shape, light) in LIGHTS {
            let scene = scene(camera, shape, light);
            for heuristic in [Heuristic::Power, Heuristic::Balance] {
                let found = look(&scene, heuristic, Mistake::None);
                let case = format!("{camera_name}, {light_name}, {heuristic}");
                let sum = |number: fn(&Found) -> u32| found.values().map(number).sum::<u32>();
                say(&format!(
                    "{case}: {} strategies, {} paths, {} of them shared, off by {:.1e} at most, {:.2} of what is tolerated",
                    found.len(),
                    sum(|found| found.paths),
                    sum(|found| found.shared),
                    found.values().map(|found| found.error).fold(0.0, f64::max),
                    found.values().map(|found| found.excess).fold(0.0, f64::max)
                ));
                assert_eq!(found.len(), strategies(light_name), "{case}");
                for (strategy, found) in &found {
                    assert!(found.excess < 1.0, "{case}, {strategy:?}: {found:?}");
                }
            }
        }
    }
}

#[test]
fn mistakes_in_densities_show() {
    let cases = [
        (0, Mistake::Refraction),
        (0, Mistake::Unseen),
        (1, Mistake::SampledByArea),
        (2, Mistake::Refraction),
        (3, Mistake::Unseen),
        (4, Mistake::Unseen),
    ];
    for (light, mistake) in cases {
        let (name, shape, light) = LIGHTS[light];
        let found = look(&scene(CAMERAS[0].1, shape, light), Heuristic::Power, mistake);
        let excess = found.values().map(|found| found.excess).fold(0.0, f64::max);
        say(&format!(
            "{name}, {mistake:?}: off by {excess:.0} times what is tolerated"
        ));
        assert!(excess > 100.0, "{name}, {mistake:?}");
    }
}
