//! A sphere that emits: directions uniform over the cone in which a point outside sees it
//! (Shirley, Wang and Zimmerman 1996; Pharr, Jakob and Humphreys 2023, §6.2.4).

use super::EmitterPoint;
use crate::material::Frame;
use crate::sampling::warp;
use glam::Vec3;
use std::f32::consts::TAU;

/// 1 − cos θ of the cone in which the sphere is seen from `from`; `None` from inside it.
#[inline]
fn cone(center: Vec3, radius: f32, from: Vec3) -> Option<f32> {
    let distance_squared = (center.as_dvec3() - from.as_dvec3()).length_squared();
    let sin2 = f64::from(radius) * f64::from(radius) / distance_squared;
    // 1 − cos from sin², which keeps its digits when the sphere is small or far away.
    (sin2 < 1.0).then(|| (sin2 / (1.0 + (1.0 - sin2).sqrt())) as f32)
}

/// A point on the side of the sphere that `from` sees; `None` from inside, where nothing shines.
#[inline(never)]
#[must_use]
pub(super) fn sample(center: Vec3, radius: f32, from: Vec3, u: [f32; 2]) -> Option<EmitterPoint> {
    let one_minus_cos = cone(center, radius, from)?;
    let axis = center.as_dvec3() - from.as_dvec3();
    let distance = axis.length();
    let axis = axis / distance;
    let frame = Frame::new(axis.as_vec3());
    let direction = frame
        .to_world(warp::uniform_cone(u, one_minus_cos))
        .as_dvec3()
        .normalize();
    // The nearer of the two points where the direction meets the sphere; at the cone's rim the root may round below 0.
    let along = direction.dot(axis) * distance;
    let off_axis = axis * distance - direction * along;
    let half = (f64::from(radius) * f64::from(radius) - off_axis.length_squared())
        .max(0.0)
        .sqrt();
    let normal = (direction * (along - half) - axis * distance).normalize();
    let position = (center.as_dvec3() + normal * f64::from(radius)).as_vec3();
    let density = 1.0 / (TAU * one_minus_cos);
    density.is_finite().then_some(EmitterPoint {
        position,
        normal: normal.as_vec3(),
        // As drawn, not as the rounded positions have it: a point of the sphere itself that rounding put outside of it sees
        // points of it so near that the direction between the two is any, and would be lit by them.
        direction: direction.as_vec3(),
        density,
    })
}

/// The density, per solid angle at `from`, with which [`sample`] chooses any point that `from` sees.
#[inline]
#[must_use]
pub(super) fn density(center: Vec3, radius: f32, from: Vec3) -> f32 {
    cone(center, radius, from).map_or(0.0, |one_minus_cos| {
        let density = 1.0 / (TAU * one_minus_cos);
        if density.is_finite() { density } else { 0.0 }
    })
}

/// A point uniform over the whole sphere's area, and its outward unit normal.
#[inline]
#[must_use]
pub(super) fn point(center: Vec3, radius: f32, u: [f32; 2]) -> (Vec3, Vec3) {
    let normal = warp::uniform_sphere(u).as_dvec3().normalize();
    let position = center.as_dvec3() + normal * f64::from(radius);
    (position.as_vec3(), normal.as_vec3())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};

    #[test]
    fn a_sphere_does_not_shine_on_itself() {
        let mut stream = StreamKey::new(1, 0, 0).stream(Purpose::LIGHT, 0);
        let (center, radius) = (Vec3::new(0.7, 1.0, -0.2), 0.7);
        let mut outside = 0;
        for _ in 0..100_000 {
            // Rounding puts some points of the sphere outside of it.
            let (from, normal) = point(center, radius, stream.next_pair());
            if let Some(sampled) = sample(center, radius, from, stream.next_pair()) {
                outside += 1;
                let above = sampled.direction.dot(normal);
                assert!(above < 1e-6, "{from}: {sampled:?}, cosine {above}");
            }
        }
        assert!(outside > 10_000, "{outside}");
    }
}
