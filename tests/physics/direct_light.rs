//! Direct light on a matt floor against closed forms: a ball, a disk, and a rectangle by Lambert's formula for
//! polygons; a tube against an integral over its surface; near and far, overhead and aslant, small and large and far from the world's origin.

use crate::support::render::{picture, scene, whole};
use crate::support::verdict::Family;
use chainlight::plan::Technique;
use glam::DVec3;
use std::f64::consts::PI;

const REFLECTANCE: f64 = 0.5;
const RADIANCE: f64 = 4.0;
/// Units of length, and how far the world's origin is away, in units.
const PLACES: [(f64, f64); 4] = [(1.0, 0.0), (1e-4, 0.0), (1e4, 0.0), (1.0, 1e4)];
const LIGHTS: [Light; 10] = [
    ball("ball overhead", [0.0, 2.0, 0.0], 0.5, 4.0),
    ball("ball aslant", [3.0, 2.0, 1.0], 1.5, 4.0),
    ball("ball far", [40.0, 80.0, 10.0], 1.0, 4.0),
    ball("ball near", [0.0, 1.0625, 0.0], 1.0, 0.0625),
    quad(
        "quad overhead",
        [-1.0, 1.5, -0.5],
        [2.0, 0.0, 0.0],
        [0.0, 0.0, 1.0],
        4.0,
    ),
    quad("quad aslant", [2.0, 0.5, -1.0], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0], 4.0),
    quad(
        "quad near",
        [-2.0, 0.0625, -1.0],
        [4.0, 0.0, 0.0],
        [0.0, 0.0, 2.0],
        0.0625,
    ),
    Light {
        name: "disk overhead",
        shape: Shape::Disk {
            center: [0.5, 1.5, -0.25],
            radius: 1.0,
        },
        headroom: 4.0,
    },
    Light {
        name: "disk far",
        shape: Shape::Disk {
            center: [30.0, 60.0, 0.0],
            radius: 2.0,
        },
        headroom: 4.0,
    },
    Light {
        name: "tube",
        shape: Shape::Tube {
            from: [-1.0, 1.0, 1.0],
            to: [1.5, 2.0, 0.5],
            radius: 0.25,
        },
        headroom: 4.0,
    },
];
const FAMILY: Family = Family {
    tests: LIGHTS.len() * PLACES.len() * 2,
};
/// A bias of 2 % is seen.
const SEES: f64 = 0.02;

/// A light over the floor point at the origin, whose normal is +y. Lengths in units.
struct Light {
    name: &'static str,
    shape: Shape,
    /// How much room there is above the floor point for the camera.
    headroom: f64,
}

enum Shape {
    Ball {
        center: [f64; 3],
        radius: f64,
    },
    /// Faces the floor point: `u` x `v` points to its side.
    Quad {
        corner: [f64; 3],
        u: [f64; 3],
        v: [f64; 3],
    },
    /// Faces down.
    Disk {
        center: [f64; 3],
        radius: f64,
    },
    Tube {
        from: [f64; 3],
        to: [f64; 3],
        radius: f64,
    },
}

const fn ball(name: &'static str, center: [f64; 3], radius: f64, headroom: f64) -> Light {
    Light {
        name,
        shape: Shape::Ball { center, radius },
        headroom,
    }
}

const fn quad(name: &'static str, corner: [f64; 3], u: [f64; 3], v: [f64; 3], headroom: f64) -> Light {
    Light {
        name,
        shape: Shape::Quad { corner, u, v },
        headroom,
    }
}

impl Light {
    /// Irradiance of the floor point per radiance.
    fn irradiance(&self) -> f64 {
        match self.shape {
            // A ball all above the horizon: π sin² of its half angle, times the cosine to its centre.
            Shape::Ball { center, radius } => {
                let to = DVec3::from_array(center);
                assert!(to.y >= radius);
                PI * radius * radius / to.length_squared() * (to.y / to.length())
            }
            Shape::Quad { corner, u, v } => {
                let [corner, u, v] = [corner, u, v].map(DVec3::from_array);
                lambert(&[corner, corner + u, corner + u + v, corner + v])
            }
            Shape::Disk {
                center: [x, y, z],
                radius,
            } => {
                // Howell, *A Catalog of Radiation Heat Transfer Configuration Factors*, B-13: in offsets aside.
                let aside = (x * x + z * z).sqrt();
                let (h, r) = (y / aside, radius / aside);
                let sum = 1.0 + h * h + r * r;
                PI * 0.5 * (1.0 - (1.0 + h * h - r * r) / (sum * sum - 4.0 * r * r).sqrt())
            }
            Shape::Tube { from, to, radius } => around_tube(from.into(), to.into(), radius),
        }
    }

    fn describe(&self, place: Place) -> String {
        let shape = match self.shape {
            Shape::Ball { center, radius } => format!(
                "Sphere(center: {}, radius: {})",
                place.point(center),
                radius * place.unit
            ),
            Shape::Quad { corner, u, v } => format!(
                "Quad(corner: {}, edge_u: {}, edge_v: {})",
                place.point(corner),
                place.edge(u),
                place.edge(v)
            ),
            Shape::Disk { center, radius } => format!(
                "Disk(center: {}, normal: (0, -1, 0), radius: {})",
                place.point(center),
                radius * place.unit
            ),
            Shape::Tube { from, to, radius } => format!(
                "Cylinder(from: {}, to: {}, radius: {})",
                place.point(from),
                place.point(to),
                radius * place.unit
            ),
        };
        format!("(shape: {shape}, material: \"black\", emission: ({RADIANCE}, {RADIANCE}, {RADIANCE}))")
    }
}

/// Irradiance of the origin, whose normal is +y, per radiance of the outside of a tube above the horizon: the product of
/// both cosines over the squared distance, by the midpoint rule over the tube.
fn around_tube(from: DVec3, to: DVec3, radius: f64) -> f64 {
    const STEPS: u32 = 1000;
    let axis = to - from;
    let (x, y) = axis.normalize().any_orthonormal_pair();
    let area = 2.0 * PI * radius * axis.length() / f64::from(STEPS * STEPS);
    let mut sum = 0.0;
    for i in 0..STEPS {
        let angle = 2.0 * PI * (f64::from(i) + 0.5) / f64::from(STEPS);
        let normal = x * libm::cos(angle) + y * libm::sin(angle);
        for j in 0..STEPS {
            let point = from + axis * ((f64::from(j) + 0.5) / f64::from(STEPS)) + normal * radius;
            let d2 = point.length_squared();
            sum += point.y.max(0.0) * (-point.dot(normal)).max(0.0) / (d2 * d2) * area;
        }
    }
    sum
}

/// Lambert's formula (1760): the irradiance per radiance that a polygon above the horizon sends to the origin, whose
/// normal is +y: half the sum over its edges of the angle they span times the height of the normal of their plane.
fn lambert(corners: &[DVec3]) -> f64 {
    let sum: f64 = (0..corners.len())
        .map(|i| {
            let (a, b) = (corners[i].normalize(), corners[(i + 1) % corners.len()].normalize());
            let cross = a.cross(b);
            libm::atan2(cross.length(), a.dot(b)) * cross.normalize().y
        })
        .sum();
    0.5 * sum.abs()
}

#[derive(Clone, Copy)]
struct Place {
    unit: f64,
    offset: f64,
}

impl Place {
    fn point(self, p: [f64; 3]) -> String {
        self.edge(p.map(|c| c + self.offset))
    }

    fn edge(self, p: [f64; 3]) -> String {
        let [x, y, z] = p.map(|c| c * self.unit);
        format!("({x}, {y}, {z})")
    }
}

/// The floor point, seen so narrowly that its irradiance is one number.
fn floor_under(light: &Light, place: Place) -> std::sync::Arc<chainlight::scene::Scene> {
    // Near lights leave little room: the camera looks in from the side, below them.
    let up = 0.5 * light.headroom.min(1.0);
    let camera = format!(
        "origin: {}, target: {}, fov: 0.1",
        place.point([0.5, up, 0.25]),
        place.point([0.0; 3])
    );
    let floor = format!(
        "(shape: Quad(corner: {}, edge_u: {}, edge_v: {}), material: \"floor\"),",
        place.point([-1.0, 0.0, -1.0]),
        place.edge([0.0, 0.0, 2.0]),
        place.edge([2.0, 0.0, 0.0])
    );
    let materials = format!(
        "\"black\": Diffuse(reflectance: (0, 0, 0)),
        \"floor\": Diffuse(reflectance: ({REFLECTANCE}, {REFLECTANCE}, {REFLECTANCE}))"
    );
    scene(2, &camera, &materials, &(floor + &light.describe(place)))
}

#[test]
fn direct_light_agrees_with_closed_forms() {
    for light in &LIGHTS {
        let expected = RADIANCE * light.irradiance() * REFLECTANCE / PI;
        for (unit, offset) in PLACES {
            for technique in Technique::INDEPENDENT {
                let name = format!("{technique}, {}, unit {unit}, offset {offset}", light.name);
                let mean = whole(
                    &picture(&floor_under(light, Place { unit, offset }), technique, 13, 1024),
                    1,
                );
                // The spot is not quite a point, and ten thousand units away coordinates are rounded to 2⁻¹⁰ units.
                let slack = expected * if offset == 0.0 { 1e-4 } else { 3e-3 };
                FAMILY.is(&name, mean, expected, slack, SEES);
                FAMILY.is_not(&name, mean, 1.02 * expected, slack);
            }
        }
    }
}

/// The form factor of a parallel rectangle over one of its corners (Howell, *A Catalog of Radiation Heat Transfer
/// Configuration Factors*, B-3), four of them put together: another closed form for the first quad.
#[test]
fn lamberts_formula_agrees_with_the_form_factor_of_a_rectangle() {
    let (a, b, c) = (1.0_f64, 0.5_f64, 1.5_f64);
    let (x, y) = (a / c, b / c);
    let (p, q) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    let corner = (x / p * libm::atan(y / p) + y / q * libm::atan(x / q)) / (2.0 * PI);
    let overhead = LIGHTS[4].irradiance();
    assert!((overhead - 4.0 * PI * corner).abs() < 1e-12, "{overhead}");
}
