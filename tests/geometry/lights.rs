//! Segments to sampled lights: free where nothing is in between, blocked where something is.

use super::dice::Dice;
use super::shapes::{quad, room};
use super::world::{Line, World, closest, free};
use chainlight::geometry::offset_origin;
use chainlight::scene::Scene;
use glam::{DVec3, Vec3};

/// Sizes and distances from the world's origin at which a gap of 1e-3 of the size is still 16 roundings wide.
const PLACES: [(f64, f64); 12] = [
    (1e-4, 0.0),
    (1e-4, 1e-2),
    (1e-2, 0.0),
    (1e-2, 1.0),
    (1.0, 0.0),
    (1.0, 1e2),
    (1e2, 1.0),
    (1e2, 1e4),
    (1e3, 1e5),
    (1e4, 0.0),
    (1e4, 1e2),
    (1e4, 1e5),
];

/// A convex room, -1..1 along every axis, with a light a thousandth of its height below the ceiling, at some place.
struct Room {
    scale: f64,
    center: DVec3,
}

impl Room {
    fn at(&self, x: f64, y: f64, z: f64) -> Vec3 {
        (self.center + DVec3::new(x, y, z) * self.scale).as_vec3()
    }

    fn walls(&self) -> World {
        World::default().mesh(&room(self.at(-1.0, -1.0, -1.0), self.at(1.0, 1.0, 1.0)))
    }

    /// A quad under the ceiling that shines down.
    fn quad_light(&self, world: World) -> World {
        let [a, b, c, d] = [(-0.3, -0.4), (0.3, -0.4), (0.3, 0.4), (-0.3, 0.4)].map(|(x, z)| self.at(x, 0.998, z));
        world.light_mesh(&[[a, b, c], [a, c, d]])
    }

    fn sphere_light(&self, world: World) -> World {
        world.light_sphere(self.at(0.1, 0.898, 0.2), (0.1 * self.scale) as f32)
    }

    /// Segments to light samples from random points of the walls, `count` of them, with what the light sent.
    fn segments(&self, scene: &Scene, count: usize, below: f64, dice: &mut Dice) -> Vec<Line> {
        let mut segments = Vec::new();
        for _ in 0..100 {
            if segments.len() >= count {
                return segments;
            }
            let rays: Vec<Line> = (0..count)
                .map(|_| {
                    let from = dice.point(0.5).as_dvec3();
                    (self.at(from.x, from.y - 0.3, from.z), dice.direction())
                })
                .collect();
            for found in closest(&scene.geometry, &rays) {
                let Some(hit) = found.hit().filter(|hit| hit.instance == 0) else {
                    continue;
                };
                let point = scene.geometry.surface_point(hit);
                if f64::from(point.position.y) > self.center.y + below * self.scale {
                    continue;
                }
                let Some(light) = scene.lights.sample(point.position, dice.fine_unit(), dice.pair()) else {
                    continue;
                };
                if point.geometric_normal.dot(light.direction) > 1e-5 {
                    let origin = offset_origin(point.position, point.geometric_normal, point.offset, light.direction);
                    segments.push((origin, light.target));
                }
            }
        }
        panic!("the light is hardly ever seen: {} of {count} segments", segments.len());
    }
}

/// 1.2 million segments to a quad and as many to a sphere: none is blocked, which bounds the rate by 2.5e-6 each.
#[test]
fn nothing_blocks_a_light_in_an_empty_convex_room() {
    let mut dice = Dice::new(61);
    for (scale, distance) in PLACES {
        let center = dice.direction().as_dvec3() * distance;
        let place = Room { scale, center };
        for light in [Room::quad_light, Room::sphere_light] {
            let scene = light(&place, place.walls()).compile();
            let segments = place.segments(&scene, 100_000, 2.0, &mut dice);
            for (segment, free) in segments.iter().zip(free(&scene.geometry, &segments)) {
                assert!(free, "scale {scale} at {distance}: {segment:?} {:?}", scene.lights);
            }
        }
    }
}

/// The same room with a ceiling hung between: 0.6 million segments from below, none is free.
#[test]
fn a_sheet_in_between_always_blocks_a_light() {
    let mut dice = Dice::new(62);
    for (scale, distance) in PLACES {
        let center = dice.direction().as_dvec3() * distance;
        let place = Room { scale, center };
        for light in [Room::quad_light, Room::sphere_light] {
            let [corner, along, across] = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)].map(|(x, z)| place.at(x, 0.7, z));
            let sheet = quad(corner, along - corner, across - corner);
            let scene = light(&place, place.walls()).mesh(&sheet).compile();
            let segments = place.segments(&scene, 25_000, 0.69, &mut dice);
            let passed = free(&scene.geometry, &segments).iter().filter(|&&free| free).count();
            assert_eq!(passed, 0, "scale {scale} at {distance}");
        }
    }
}

/// Lights of all sizes, near and far, with nothing else in the world, seen from free points: 1.2 million samples, none
/// blocked by the light that it lies on.
#[test]
fn a_light_never_blocks_its_own_sample() {
    let mut dice = Dice::new(63);
    let mut judged = 0;
    for round in 0..12_000 {
        let size = dice.magnitude(1e-4, 1e4);
        let center = dice.direction() * dice.pick(&[0.0, 1.0, 1e3]) * size;
        let world = World::default();
        let world = match round % 3 {
            0 => world.light_mesh(&[[0; 3].map(|_| center + dice.point(1.0) * size)]),
            1 => {
                // Along two axes: a tilted one would be folded by the rounding of its corners.
                let (x, y) = (Vec3::X * size, Vec3::Z * size * dice.magnitude(1e-3, 1.0));
                world.light_mesh(&quad(center, x, y * dice.pick(&[1.0, -1.0])))
            }
            _ => world.light_sphere(center, size),
        };
        let scene = world.compile();
        let segments: Vec<Line> = (0..160)
            .filter_map(|_| {
                let from = center + dice.direction() * size * dice.magnitude(1e-2, 1e6);
                let light = scene.lights.sample(from, dice.fine_unit(), dice.pair())?;
                Some((from, light.target))
            })
            .collect();
        judged += segments.len();
        for (segment, free) in segments.iter().zip(free(&scene.geometry, &segments)) {
            assert!(free, "{round}: {segment:?} {:?}", scene.lights);
        }
    }
    assert!(judged > 1_100_000, "{judged}");
}
