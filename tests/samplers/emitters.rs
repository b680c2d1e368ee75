//! Emitters that the tests of light sampling share, and the points they are seen from: ahead, aside, near enough to touch,
//! far, grazing, tiny, and far from the world's origin.

use chainlight::color::Rgb;
use chainlight::light::{Emitter, EmitterShape};
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// Where a triangle is seen from: its corners, the reference point.
pub const TRIANGLES: [(&str, [Vec3; 3], Vec3); 7] = [
    ("triangle ahead", UNIT, Vec3::new(0.3, 0.2, 1.0)),
    ("triangle aside", UNIT, Vec3::new(-2.0, 1.5, 0.7)),
    ("triangle near", UNIT, Vec3::new(0.4, 0.3, 0.01)),
    ("triangle far", UNIT, Vec3::new(3e3, -2e3, 5e3)),
    ("triangle grazing", UNIT, Vec3::new(-1.0, 0.4, 2e-3)),
    (
        "tiny triangle",
        [
            Vec3::new(1e-4, 0.0, 0.0),
            Vec3::new(0.0, 1e-4, 0.0),
            Vec3::new(0.0, 0.0, 1e-4),
        ],
        Vec3::new(2e-4, 3e-4, 1e-4),
    ),
    (
        "triangle far from the origin",
        [
            Vec3::new(1e4, -1e4, 2e4),
            Vec3::new(1.01e4, -1e4, 2e4),
            Vec3::new(1e4, -0.99e4, 2.002e4),
        ],
        Vec3::new(1.002e4, -0.998e4, 2.008e4),
    ),
];
const UNIT: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

/// Centre, radius, reference point.
pub const SPHERES: [(&str, Vec3, f32, Vec3); 7] = [
    ("sphere", Vec3::new(1.0, 2.0, 3.0), 1.0, Vec3::new(-1.0, 1.0, 2.0)),
    ("sphere near", Vec3::ZERO, 1.0, Vec3::new(0.0, 0.0, 1.01)),
    ("sphere touching", Vec3::ZERO, 1.0, Vec3::new(0.0, 0.0, 1.000_01)),
    ("sphere touching aslant", Vec3::ZERO, 1.0, Vec3::new(0.6, 0.0, 0.800_1)),
    ("sphere far", Vec3::ZERO, 1.0, Vec3::new(500.0, 700.0, -300.0)),
    ("tiny sphere", Vec3::new(0.0, 0.0, 100.0), 1e-3, Vec3::ZERO),
    (
        "sphere far from the origin",
        Vec3::new(1e4, 2e4, -1e4),
        2.0,
        Vec3::new(1.0004e4, 2.0002e4, -1.0003e4),
    ),
];

/// A light of a triangle.
pub fn triangle_light(corners: [Vec3; 3], radiance: Rgb) -> Emitter {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    Emitter {
        shape: EmitterShape::Triangle(corners),
        radiance,
        area: (0.5 * (b - a).cross(c - a).length()) as f32,
    }
}

/// A light of a sphere.
pub fn sphere_light(center: Vec3, radius: f32, radiance: Rgb) -> Emitter {
    Emitter {
        shape: EmitterShape::Sphere { center, radius },
        radiance,
        area: (2.0 * TAU * f64::from(radius) * f64::from(radius)) as f32,
    }
}

/// A light of a disk.
pub fn disk_light(center: Vec3, normal: Vec3, radius: f32, radiance: Rgb) -> Emitter {
    Emitter {
        shape: EmitterShape::Disk { center, normal, radius },
        radiance,
        area: (0.5 * TAU * f64::from(radius) * f64::from(radius)) as f32,
    }
}

/// A light of a tube.
pub fn cylinder_light(from: Vec3, to: Vec3, radius: f32, radiance: Rgb) -> Emitter {
    let length = (to.as_dvec3() - from.as_dvec3()).length();
    Emitter {
        shape: EmitterShape::Cylinder { from, to, radius },
        radiance,
        area: (TAU * f64::from(radius) * length) as f32,
    }
}

/// A triangle as it is seen from a point, with coordinates on it: (b₁ + b₂)² and the share of b₂, in which area is area.
pub struct SeenTriangle {
    /// The first corner.
    pub corner: DVec3,
    edges: [DVec3; 2],
    /// The normal, twice the area long.
    pub normal: DVec3,
    from: DVec3,
}

impl SeenTriangle {
    /// A triangle seen from a point.
    pub fn new(corners: [Vec3; 3], from: Vec3) -> Self {
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let edges = [b - a, c - a];
        Self {
            corner: a,
            edges,
            normal: edges[0].cross(edges[1]),
            from: from.as_dvec3(),
        }
    }

    /// Coordinates of the point where a direction meets the triangle.
    pub fn coordinates(&self, direction: Vec3) -> [f64; 2] {
        let d = direction.as_dvec3();
        let t = self.normal.dot(self.corner - self.from) / self.normal.dot(d);
        let p = self.from + d * t - self.corner;
        let n2 = self.normal.length_squared();
        // Rounding of the direction moves the point by a little, more so aslant: at the edges that is forgiven.
        let forgive = |b: f64| if b > -1e-3 { b.max(0.0) } else { b };
        let b1 = forgive(p.cross(self.edges[1]).dot(self.normal) / n2);
        let b2 = forgive(self.edges[0].cross(p).dot(self.normal) / n2);
        let sum = b1 + b2;
        let x = if sum < 1.0 + 1e-3 { sum.min(1.0) } else { sum };
        [x * x, if sum > 0.0 { b2 / sum } else { 0.0 }]
    }

    /// Point, and solid angle per unit of the coordinates there.
    pub fn point(&self, x: f64, y: f64) -> (Vec3, f64) {
        let sum = x.sqrt();
        let p = self.corner + self.edges[0] * (sum * (1.0 - y)) + self.edges[1] * (sum * y);
        let to = p - self.from;
        // The triangle's area is half the normal's length; cos θ = |n·to| / |n||to|.
        (
            p.as_vec3(),
            0.5 * self.normal.dot(to).abs() / (to.length_squared() * to.length()),
        )
    }
}
