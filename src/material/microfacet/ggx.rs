//! Facets of Trowbridge and Reitz (GGX), of the roughness 1.

use glam::DVec3;
use std::f64::consts::TAU;

/// π D for a normal whose squared components are `xy2` in the plane, each divided by its roughness, and `z2` along the
/// surface's normal (Walter et al. 2007, eq. 33).
#[inline]
pub(super) fn density(xy2: f64, z2: f64) -> f64 {
    let sum = xy2 + z2;
    1.0 / (sum * sum)
}

/// cos θ (1 + Λ) for a direction of height `z` whose components in the plane, each times its roughness, have the squared
/// length `xy2` (Heitz 2014, eq. 72).
#[inline]
pub(super) fn projected_area(xy2: f64, z: f64) -> f64 {
    0.5 * (z + (z * z + xy2).sqrt())
}

/// A normal seen from `w` (Heitz 2018, "Sampling the GGX distribution of visible normals"): facets of the roughness 1 are
/// turned like those of a half-sphere, whose projection along `w` is a disk, one half of it squeezed.
#[inline]
pub(super) fn sample_visible(w: DVec3, [u, v]: [f32; 2]) -> DVec3 {
    let flat = (w.x * w.x + w.y * w.y).sqrt();
    let first = if flat > 0.0 {
        DVec3::new(-w.y / flat, w.x / flat, 0.0)
    } else {
        DVec3::X
    };
    let second = w.cross(first);
    let (sin, cos) = libm::sincos(TAU * f64::from(v));
    let radius = f64::from(u).sqrt();
    let (a, b) = (radius * cos, radius * sin);
    let squeeze = 0.5 * (1.0 + w.z);
    let b = (1.0 - squeeze) * (1.0 - a * a).max(0.0).sqrt() + squeeze * b;
    let c = (1.0 - a * a - b * b).max(0.0).sqrt();
    let normal = first * a + second * b + w * c;
    // At grazing angles the half-sphere's rim is vertical up to rounding.
    DVec3::new(normal.x, normal.y, normal.z.max(0.0))
}
