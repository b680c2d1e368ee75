//! A triangle that emits: points uniform over its area.

use super::EmitterPoint;
use crate::sampling::warp;
use glam::Vec3;

/// The unit geometric normal, by winding.
#[must_use]
pub(super) fn normal(corners: [Vec3; 3]) -> Vec3 {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    (b - a).cross(c - a).normalize().as_vec3()
}

/// A point on the triangle with this unit normal, uniform in area; `None` if the reference point `from` sees its back or its edge.
#[inline]
#[must_use]
pub(super) fn sample(corners: [Vec3; 3], normal: Vec3, area: f32, from: Vec3, u: [f32; 2]) -> Option<EmitterPoint> {
    let [b1, b2] = warp::triangle(u).map(f64::from);
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (ab, ac) = (b - a, c - a);
    let position = (a + ab * b1 + ac * b2).as_vec3();
    let density = density(area, from, position, normal);
    (density > 0.0 && density.is_finite()).then_some(EmitterPoint {
        position,
        normal,
        density,
    })
}

/// The density, per solid angle at `from`, with which [`sample`] chooses `position`; 0 where it cannot.
#[inline]
#[must_use]
pub(super) fn density(area: f32, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
    let to_reference = from - position;
    let distance_squared = to_reference.length_squared();
    // |r|² / (A cos θ) with cos θ = n·r / |r|.
    let projected = normal.dot(to_reference);
    if projected > 0.0 {
        distance_squared * distance_squared.sqrt() / (projected * area)
    } else {
        0.0
    }
}
