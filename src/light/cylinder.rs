//! A tube that emits, open at its ends: points uniform over its area. Seen from outside, about half of them show their
//! back, and nothing comes of those.

use crate::material::Frame;
use crate::math;
use glam::Vec3;
use std::f32::consts::TAU;

/// A point uniform over the tube's area, and its outward unit normal.
#[inline]
#[must_use]
pub(super) fn point(from: Vec3, to: Vec3, radius: f32, [along, around]: [f32; 2]) -> (Vec3, Vec3) {
    let (from, to) = (from.as_dvec3(), to.as_dvec3());
    let axis = to - from;
    let angle = TAU * around;
    let frame = Frame::new(axis.normalize().as_vec3());
    let normal = frame.to_world(Vec3::new(math::cos(angle), math::sin(angle), 0.0));
    let normal = normal.as_dvec3().normalize();
    let position = from + axis * f64::from(along) + normal * f64::from(radius);
    (position.as_vec3(), normal.as_vec3())
}
