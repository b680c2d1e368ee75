//! Warps: uniform numbers in the unit square turned into points and directions, each with its density.

use crate::math;
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// A point on the unit disk, uniform in area (density 1/π per unit area); the concentric map of Shirley and Chiu (1997),
/// which keeps neighbours together.
#[inline]
#[must_use]
pub fn disk([u, v]: [f32; 2]) -> Vec2 {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    if x == 0.0 && y == 0.0 {
        return Vec2::ZERO;
    }
    let (radius, angle) = if x.abs() > y.abs() {
        (x, FRAC_PI_4 * (y / x))
    } else {
        (y, FRAC_PI_2 - FRAC_PI_4 * (x / y))
    };
    Vec2::new(radius * math::cos(angle), radius * math::sin(angle))
}

/// A direction about +z with density cos θ / π per solid angle (Malley's method: a disk point lifted to the hemisphere).
#[inline]
#[must_use]
pub fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let p = disk(u);
    // The disk keeps |p| <= 1 up to rounding.
    let z = (1.0 - p.length_squared()).max(0.0).sqrt();
    Vec3::new(p.x, p.y, z)
}

/// The density per solid angle of [`cosine_hemisphere`], given the cosine to +z.
#[inline]
#[must_use]
pub fn cosine_hemisphere_density(cos_theta: f32) -> f32 {
    cos_theta.max(0.0) * FRAC_1_PI
}

/// A direction uniform over the sphere (density 1/(4π) per solid angle).
#[inline]
#[must_use]
pub fn uniform_sphere([u, v]: [f32; 2]) -> Vec3 {
    let z = 1.0 - 2.0 * u;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let phi = 2.0 * PI * v;
    Vec3::new(r * math::cos(phi), r * math::sin(phi), z)
}

/// A direction uniform in the cone about +z whose half angle θ has `one_minus_cos` = 1 − cos θ: density
/// 1 / (2π (1 − cos θ)) per solid angle. Taking 1 − cos θ rather than cos θ keeps narrow cones exact.
#[inline]
#[must_use]
pub fn uniform_cone([u, v]: [f32; 2], one_minus_cos: f32) -> Vec3 {
    let one_minus_z = u * one_minus_cos;
    // sin² = (1 − z)(1 + z), without the cancellation of 1 − z².
    let r = (one_minus_z * (2.0 - one_minus_z)).max(0.0).sqrt();
    let phi = 2.0 * PI * v;
    Vec3::new(r * math::cos(phi), r * math::sin(phi), 1.0 - one_minus_z)
}

/// Barycentric weights (of the second and third corner) of a point uniform over a triangle's area
/// (Heitz 2019, "A low-distortion map between triangle and square").
#[inline]
#[must_use]
pub fn triangle([u, v]: [f32; 2]) -> [f32; 2] {
    if v > u {
        let b1 = 0.5 * u;
        [b1, v - b1]
    } else {
        let b2 = 0.5 * v;
        [u - b2, b2]
    }
}
