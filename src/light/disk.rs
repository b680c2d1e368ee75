//! A disk that emits: points uniform over its area.

use crate::material::Frame;
use crate::sampling::warp;
use glam::Vec3;

/// A point uniform over the disk's area.
#[inline]
#[must_use]
pub(super) fn point(center: Vec3, normal: Vec3, radius: f32, u: [f32; 2]) -> Vec3 {
    let p = warp::disk(u).as_dvec2() * f64::from(radius);
    let (x, y) = Frame::new(normal).tangents();
    // In f64: a small disk far from the world's origin keeps its shape up to the rounding of the point itself.
    (center.as_dvec3() + x.as_dvec3() * p.x + y.as_dvec3() * p.y).as_vec3()
}
