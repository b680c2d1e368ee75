//! The tree finds what a scan of all primitives finds.

use super::dice::Dice;
use super::scan::{Scan, Shape, Verdict};
use super::world::{Line, Triangle, World, closest_and_free_by_all_ways};
use chainlight::geometry::Geometry;
use glam::Vec3;

/// Instances in turn: a mesh of some triangles, or one other shape.
pub fn world(instances: &[Vec<Shape>]) -> World {
    let mut world = World::default();
    for shapes in instances {
        let triangle = |shape: &Shape| match *shape {
            Shape::Triangle(corners) => Some(corners),
            _ => None,
        };
        world = match shapes.as_slice() {
            [Shape::Sphere(center, radius)] => world.sphere(*center, *radius),
            [Shape::Disk(center, normal, radius)] => world.disk(*center, *normal, *radius),
            [Shape::Cylinder(from, to, radius)] => world.cylinder(*from, *to, *radius),
            _ => world.mesh(&shapes.iter().filter_map(triangle).collect::<Vec<Triangle>>()),
        };
    }
    world
}

/// `count` primitives: every eighth instance is a sphere, the others are meshes of a few triangles.
fn group(count: usize, dice: &mut Dice, mut next: impl FnMut(&mut Dice, bool) -> Shape) -> Vec<Vec<Shape>> {
    let mut instances = Vec::new();
    let mut left = count;
    while left > 0 {
        let sphere = instances.len() % 8 == 7;
        let size = if sphere { 1 } else { (1 + dice.below(20)).min(left) };
        instances.push((0..size).map(|_| next(dice, sphere)).collect());
        left -= size;
    }
    instances
}

/// Compares geometry and scan; returns how many rays and segments were judged.
pub fn compare(instances: Vec<Vec<Shape>>, margin: f64, rays: &[Line], segments: &[Line]) -> usize {
    let geometry = world(&instances).compile().geometry;
    let scan = Scan {
        shapes: instances,
        margin,
    };
    compare_with(&geometry, &scan, rays, segments)
}

/// Compares a geometry and a scan; returns how many rays and segments were judged.
pub fn compare_with(geometry: &Geometry, scan: &Scan, rays: &[Line], segments: &[Line]) -> usize {
    let mut judged = 0;
    let (found, passed) = closest_and_free_by_all_ways(geometry, rays, segments);
    for (&ray, found) in rays.iter().zip(found) {
        match scan.closest(ray) {
            Verdict::Unsure => continue,
            Verdict::Nothing => assert_eq!(found.hit(), None, "{ray:?}"),
            Verdict::Hit(t, name, tied) => {
                assert!(found.hit().is_some(), "{ray:?} missed {name:?} at {t}");
                let difference = (f64::from(found.distance) - t).abs();
                assert!(difference <= 1.2e-7 * t, "{ray:?}: {} for {t}", found.distance);
                // Distances are compared in f64: those that differ in their last bits may be told apart differently.
                assert!(tied || found.name() == name, "{ray:?}: {found:?} for {name:?}");
            }
        }
        judged += 1;
    }
    for (&segment, free) in segments.iter().zip(passed) {
        if let Some(expected) = scan.free(segment) {
            assert_eq!(free, expected, "{segment:?}");
            judged += 1;
        }
    }
    judged
}

const SIZES: [(usize, usize); 12] = [
    (0, 100),
    (1, 4000),
    (2, 4000),
    (3, 4000),
    (5, 4000),
    (9, 4000),
    (17, 4000),
    (60, 4000),
    (250, 4000),
    (1000, 2000),
    (2500, 1000),
    (5000, 800),
];

#[test]
fn the_tree_finds_what_a_scan_finds() {
    let mut dice = Dice::new(1);
    let (mut judged, mut all) = (0, 0);
    for (count, lines) in SIZES {
        for scale in [1.0, 1e-3, 1e5] {
            let spread = dice.pick(&[0.02, 0.2, 1.0]);
            let instances = group(count, &mut dice, |dice, sphere| {
                let center = dice.point(1.0);
                if sphere {
                    return Shape::Sphere(center * scale, dice.magnitude(0.01, 0.3) * scale);
                }
                Shape::Triangle([0; 3].map(|_| (center + dice.point(spread)) * scale))
            });
            let ray = |dice: &mut Dice| {
                let origin = dice.point(1.5) * scale;
                let direction = match dice.below(4) {
                    // Along an axis, from the plane of some primitive's box or from anywhere.
                    0 => {
                        let mut axis = [0.0, -0.0, 0.0];
                        axis[dice.below(3)] = dice.pick(&[1.0, -1.0]);
                        Vec3::from_array(axis)
                    }
                    // In a plane that two axes span.
                    1 => {
                        let mut direction = dice.direction();
                        direction[dice.below(3)] = dice.pick(&[0.0, -0.0]);
                        direction.normalize()
                    }
                    _ => dice.direction(),
                };
                (origin, direction)
            };
            let rays: Vec<Line> = (0..lines).map(|_| ray(&mut dice)).collect();
            let segments: Vec<Line> = (0..lines)
                .map(|_| (dice.point(1.2) * scale, dice.point(1.2) * scale))
                .collect();
            judged += compare(instances, 1e-11, &rays, &segments);
            all += 2 * lines;
        }
    }
    assert!(judged * 100 > all * 95, "{judged} of {all} judged");
}

/// Corners, origins and directions on a lattice, where every volume is exact: rays through edges and corners, inside
/// the planes of triangles and boxes, from box faces, and ties between many primitives, all judged.
#[test]
fn the_tree_finds_what_a_scan_finds_on_a_lattice() {
    let mut dice = Dice::new(2);
    let (mut judged, mut all) = (0, 0);
    for (count, lines) in SIZES {
        for flat in [false, true] {
            let instances = group(count, &mut dice, |dice, _| {
                let corner =
                    |dice: &mut Dice, reach: usize| [0; 3].map(|_| (dice.below(2 * reach + 1) as f32) - reach as f32);
                let center = Vec3::from_array(corner(dice, 8));
                let axis = dice.below(3);
                let mut corners = [0; 3].map(|_| center + Vec3::from_array(corner(dice, 3)));
                if flat {
                    corners.iter_mut().for_each(|corner| corner[axis] = center[axis]);
                }
                Shape::Triangle(corners)
            });
            let ray = |dice: &mut Dice| {
                let origin = [0; 3].map(|_| dice.below(45) as f32 * 0.5 - 11.0);
                let along = dice.below(3);
                let simple = dice.below(2) == 0;
                let direction = [0, 1, 2].map(|axis| match (axis == along, simple) {
                    (true, _) => dice.pick(&[1.0, -1.0]),
                    (false, true) => dice.pick(&[0.0, -0.0]),
                    (false, false) => dice.pick(&[0.0, -0.0, 0.25, -0.25, 0.5, -0.5, 1.0, -1.0]),
                });
                (Vec3::from_array(origin), Vec3::from_array(direction))
            };
            let rays: Vec<Line> = (0..lines).map(|_| ray(&mut dice)).collect();
            let segments: Vec<Line> = (0..lines)
                .map(|_| {
                    let (origin, direction) = ray(&mut dice);
                    (origin, origin + direction * dice.pick(&[1.0, 2.0, 8.0, 16.0]))
                })
                .collect();
            judged += compare(instances, 0.0, &rays, &segments);
            all += 2 * lines;
        }
    }
    assert_eq!(judged, all);
}

/// Primitives nested in one another, each a fixed factor smaller than the last, around a point and along a spiral:
/// trees over them are as deep as trees get.
#[test]
fn nested_and_spiralling_primitives_are_all_found() {
    let mut dice = Dice::new(3);
    let mut judged = 0;
    for (ratio, count) in [(0.5, 60), (0.8, 150), (0.97, 1200)] {
        for turn in [0.0, 0.4] {
            let mut size = 1e4_f64;
            let instances: Vec<Vec<Shape>> = (0..count)
                .map(|i| {
                    let angle = turn * f64::from(i);
                    let (x, y) = (libm::cos(angle) * size, libm::sin(angle) * size);
                    let corners = [(x, y, 0.0), (-y, x, 0.1 * size), (-x * 0.7, -y * 0.9, -0.2 * size)];
                    size *= ratio;
                    vec![Shape::Triangle(
                        corners.map(|(x, y, z)| Vec3::new(x as f32, y as f32, z as f32)),
                    )]
                })
                .collect();
            let ray = |dice: &mut Dice| {
                let size = dice.magnitude(1e-4, 1e4);
                let (from, to) = (dice.point(2.0) * size, dice.point(0.5) * size);
                (from, to)
            };
            let segments: Vec<Line> = (0..3000).map(|_| ray(&mut dice)).collect();
            let rays: Vec<Line> = segments
                .iter()
                .map(|&(from, to)| (from, (to - from).normalize()))
                .collect();
            judged += compare(instances, 1e-13, &rays, &segments);
        }
    }
    assert!(judged > 30_000, "{judged} of 36000 judged");
}
