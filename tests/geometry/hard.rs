//! Scenes of up to two hundred primitives that are hard to trace, against a scan: triangles that almost or exactly coincide, that share
//! corners and edges, that are slivers, tiny beside large ones or without area, other shapes among them, at scales that f32 has and far
//! from the origin; with lines at corners and edges, from planes, along them, and from far away. So few that all are looked at without
//! a tree as well.

use super::dice::Dice;
use super::scan::{Scan, Shape};
use super::tree::{compare_with, world};
use super::world::{Line, Triangle};
use glam::{DVec3, Vec3};

/// What is looked at, before it is scaled and moved.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Soup,
    Fan,
    Slivers,
    Mixed,
    Sheets,
    Flat,
}

const KINDS: [Kind; 6] = [
    Kind::Soup,
    Kind::Fan,
    Kind::Slivers,
    Kind::Mixed,
    Kind::Sheets,
    Kind::Flat,
];

/// Where a scene is, and how large.
#[derive(Clone, Copy)]
struct Place {
    scale: f64,
    center: DVec3,
}

impl Place {
    fn put(self, point: Vec3) -> Vec3 {
        (point.as_dvec3() * self.scale + self.center).as_vec3()
    }
}

fn triangle(dice: &mut Dice, kind: Kind, common: Triangle) -> Triangle {
    let around = |dice: &mut Dice, size: f32| {
        let center = dice.point(1.0);
        [0; 3].map(|_| center + dice.point(size))
    };
    match kind {
        Kind::Soup => around(dice, 0.4),
        Kind::Fan => [
            dice.pick(&common),
            dice.point(1.0),
            dice.pick(&common).lerp(dice.point(1.0), 0.5),
        ],
        Kind::Slivers => {
            let [a, b, _] = around(dice, 0.6);
            let along = dice.pick(&[0.0, 0.5, 1.0, 1.5]);
            let size = dice.magnitude(1e-8, 1e-2);
            [a, b, a.lerp(b, along) + dice.point(size)]
        }
        Kind::Mixed => {
            let size = dice.magnitude(1e-6, 1.0);
            around(dice, size)
        }
        Kind::Sheets => {
            let apart = dice.pick(&[0.0, 1e-7, 1e-5, 1e-3]);
            common.map(|corner| corner + dice.point(apart))
        }
        Kind::Flat => {
            let (axis, at) = (dice.below(3), dice.pick(&[-1.0, -0.5, 0.0, 0.5, 1.0]));
            around(dice, 0.5).map(|corner| {
                let mut corner = corner.to_array();
                corner[axis] = at;
                Vec3::from_array(corner)
            })
        }
    }
}

/// Meshes of so many triangles in all, and a round shape after each.
fn instances(dice: &mut Dice, kind: Kind, mut triangles: usize, round: bool, place: Place) -> Vec<Vec<Shape>> {
    let common = [0; 3].map(|_| dice.point(1.0));
    let mut instances = Vec::new();
    while triangles > 0 {
        let count = (1 + dice.below(40)).min(triangles);
        triangles -= count;
        let mesh = (0..count).map(|_| Shape::Triangle(triangle(dice, kind, common).map(|corner| place.put(corner))));
        instances.push(mesh.collect());
        if round {
            let (at, other) = (place.put(dice.point(1.0)), place.put(dice.point(1.0)));
            let radius = dice.magnitude(0.01, 0.4) * place.scale as f32;
            instances.push(vec![match dice.below(3) {
                0 => Shape::Sphere(at, radius),
                1 => Shape::Disk(at, dice.direction(), radius),
                _ => Shape::Cylinder(at, other, radius * 0.3),
            }]);
        }
    }
    instances
}

/// A point of a triangle, or just beside it.
fn aim(dice: &mut Dice, corners: Triangle) -> DVec3 {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (u, v) = match dice.below(5) {
        0 => dice.pick(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]),
        1 => (dice.fine_unit(), 0.0),
        2 => (1.2 * dice.fine_unit() - 0.1, 1e-3 * dice.fine_unit() - 5e-4),
        _ => {
            let u = dice.fine_unit();
            (u, (1.0 - u) * dice.fine_unit())
        }
    };
    a + (b - a) * u + (c - a) * v
}

/// Two points: where a line starts, and where it is aimed at.
fn line(dice: &mut Dice, triangles: &[Triangle], place: Place) -> Line {
    let anywhere = |dice: &mut Dice| place.put(dice.point(1.3));
    let target = match dice.below(8) {
        0 => anywhere(dice),
        _ => {
            let corners = dice.pick(triangles);
            aim(dice, corners).as_vec3()
        }
    };
    let origin = match dice.below(8) {
        // In the plane of a triangle, or off it by some roundings.
        0 | 1 => {
            let corners = dice.pick(triangles);
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            let off = dice.magnitude(1e-13, 1e-4) * dice.pick(&[0.0, 1.0, -1.0]);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            (aim(dice, corners) + normal * (f64::from(off) * place.scale)).as_vec3()
        }
        2 => dice.pick(triangles)[0],
        3 => place.put(dice.direction() * dice.magnitude(1.0, 1e6)),
        _ => anywhere(dice),
    };
    (origin, target)
}

/// A ray towards a point, of a length near one or far from it, now and then along an axis.
fn ray(dice: &mut Dice, (origin, target): Line) -> Line {
    let way = target.as_dvec3() - origin.as_dvec3();
    let direction = match dice.below(6) {
        0 => (way * f64::from(dice.magnitude(1e-4, 1e4))).as_vec3(),
        1 => {
            let mut axis = [0.0, -0.0, 0.0];
            axis[dice.below(3)] = dice.pick(&[1.0, -1.0]);
            Vec3::from_array(axis)
        }
        _ => way.normalize_or_zero().as_vec3(),
    };
    (origin, if direction == Vec3::ZERO { Vec3::X } else { direction })
}

/// Corners on one line, or in one point.
fn without_area(dice: &mut Dice, place: Place) -> Vec<Triangle> {
    let (a, b) = (place.put(dice.point(1.0)), place.put(dice.point(1.0)));
    vec![[a, a, a], [a, b, b], [a, b, a], [Vec3::ZERO, a, a * 2.0]]
}

const LINES: usize = 2200;

/// Half a million rays and as many segments, each by all ways to trace. Returns the share of them that was judged.
fn hold_against_a_scan(seed: u64, counts: &[usize], round: bool) -> f64 {
    let mut dice = Dice::new(seed);
    let (mut judged, mut all) = (0, 0);
    for kind in KINDS {
        for (scale, distance) in [
            (1.0, 0.0),
            (1.0, 1e4),
            (1e-2, 1e4),
            (1e-20, 0.0),
            (1e15, 0.0),
            (1e-4, 1.0),
        ] {
            if round && distance > 0.0 {
                // Where roundings are a part of their size, rims reach as much farther, of which the scan knows nothing.
                continue;
            }
            for &count in counts {
                let center = dice.direction().as_dvec3() * distance;
                let place = Place { scale, center };
                let shapes = instances(&mut dice, kind, count, round, place);
                let flaws = without_area(&mut dice, place);
                let geometry = world(&shapes).mesh(&flaws).compile().geometry;
                let scan = Scan { shapes, margin: 3e-8 };
                let corners = |shape: &Shape| match *shape {
                    Shape::Triangle(corners) => Some(corners),
                    _ => None,
                };
                let triangles: Vec<Triangle> = scan.shapes.iter().flatten().filter_map(corners).collect();
                let aimed: Vec<Line> = (0..LINES).map(|_| line(&mut dice, &triangles, place)).collect();
                let rays: Vec<Line> = aimed.iter().map(|&aimed| ray(&mut dice, aimed)).collect();
                let segments: Vec<Line> = aimed
                    .iter()
                    .map(|&(from, to)| (from, from + (to - from) * dice.pick(&[0.5, 0.99, 1.0, 1.01, 2.0])))
                    .collect();
                judged += compare_with(&geometry, &scan, &rays, &segments);
                all += 2 * LINES;
            }
        }
    }
    judged as f64 / all as f64
}

#[test]
fn few_triangles_are_found_as_by_a_scan() {
    let share = hold_against_a_scan(41, &[1, 3, 16, 40, 64, 66], false);
    assert!(share > 0.5, "{share} judged");
}

#[test]
fn hundreds_of_triangles_are_found_as_by_a_scan() {
    let share = hold_against_a_scan(42, &[100, 128, 200], false);
    assert!(share > 0.4, "{share} judged");
}

#[test]
fn triangles_among_round_shapes_are_found_as_by_a_scan() {
    let share = hold_against_a_scan(43, &[1, 12, 50, 130], true);
    assert!(share > 0.4, "{share} judged");
}
