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

/// A point uniform over the triangle's area.
#[inline]
#[must_use]
pub(super) fn point(corners: [Vec3; 3], u: [f32; 2]) -> Vec3 {
    let [b1, b2] = warp::triangle(u).map(f64::from);
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (ab, ac) = (b - a, c - a);
    (a + ab * b1 + ac * b2).as_vec3()
}

/// A point on the triangle with this unit normal, uniform in area; `None` if the reference point `from` sees its back or its edge.
#[inline(always)]
#[must_use]
pub(super) fn sample(corners: [Vec3; 3], normal: Vec3, area: f32, from: Vec3, u: [f32; 2]) -> Option<EmitterPoint> {
    EmitterPoint::uniform_in_area(area, from, point(corners, u), normal)
}
