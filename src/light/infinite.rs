//! Lights at infinity that rays meet when they leave the scene.

use crate::color::Rgb;
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// Radiance from outside the scene by direction, and how directions are drawn. All directions are unit vectors from the
/// scene to the light.
pub(super) trait Infinite {
    /// A direction with density [`density`](Self::density); `None` where none can be drawn.
    fn sample(&self, u: [f64; 2]) -> Option<Vec3>;

    /// Density per solid angle with which a direction is drawn.
    fn density(&self, direction: Vec3) -> f32;

    /// Radiance from a direction, W sr⁻¹ m⁻².
    fn radiance(&self, direction: Vec3) -> Rgb;

    /// Mean of the channels' radiance, integrated over all directions: what lights are chosen by.
    fn total(&self) -> f64;

    /// The largest radiance of any channel.
    fn max_radiance(&self) -> f32;
}

/// A direction in coordinates in which solid angle is area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Polar {
    /// 1 − cos θ to the pole: 0 there, 2 at the other. It keeps the digits near both poles that cos θ loses.
    pub depth: f64,
    /// The angle around the pole, in turns, in [0, 1).
    pub turn: f64,
}

/// A pole and two axes across it, all unit and perpendicular to each other, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axes {
    /// Where `turn` is 0.
    pub first: DVec3,
    /// Where `turn` is a quarter.
    pub second: DVec3,
    /// Where `depth` is 0.
    pub pole: DVec3,
}

impl Axes {
    /// The coordinates of a direction.
    #[inline]
    pub fn polar(&self, direction: Vec3) -> Polar {
        let d = direction.as_dvec3();
        let (x, y, z) = (d.dot(self.first), d.dot(self.second), d.dot(self.pole));
        let across = x * x + y * y;
        let length = (across + z * z).sqrt();
        // 1 − z/|d| = (x² + y²) / (|d|(|d| + z)), and its mirror image below.
        let depth = if z > 0.0 {
            across / (length * (length + z))
        } else {
            2.0 - across / (length * (length - z))
        };
        let turn = libm::atan2(y, x) / TAU;
        let turn = if turn < 0.0 { turn + 1.0 } else { turn };
        Polar {
            depth,
            // A tiny negative angle rounds to a whole turn.
            turn: if turn < 1.0 { turn } else { 0.0 },
        }
    }

    /// The unit direction at coordinates.
    #[inline]
    pub fn direction(&self, polar: Polar) -> Vec3 {
        let across = (polar.depth * (2.0 - polar.depth)).max(0.0).sqrt();
        let angle = TAU * polar.turn;
        let around = self.first * libm::cos(angle) + self.second * libm::sin(angle);
        (around * across + self.pole * (1.0 - polar.depth))
            .normalize()
            .as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};

    #[test]
    fn directions_survive_their_coordinates_even_at_the_poles() {
        let axes = Axes {
            first: DVec3::NEG_Z,
            second: DVec3::X,
            pole: DVec3::Y,
        };
        let mut stream = StreamKey::new(4, 0, 0).stream(Purpose::LIGHT, 0);
        for i in 0..10_000 {
            let near = [1.0, 1e-3, 1e-7, 1e-12][i % 4];
            let depth = near * 2.0 * stream.next_f64();
            let polar = Polar {
                depth: if i % 8 < 4 { depth } else { 2.0 - depth },
                turn: stream.next_f64(),
            };
            let back = axes.polar(axes.direction(polar));
            let across = (polar.depth * (2.0 - polar.depth)).sqrt();
            // A direction in f32 is off by 1e-7 at most; across the pole that is an angle around it.
            assert!(
                (back.depth - polar.depth).abs() <= 3e-7 * across + 1e-13,
                "{polar:?} {back:?}"
            );
            let turn = (back.turn - polar.turn).abs();
            assert!(turn.min(1.0 - turn) < 2e-7, "{polar:?} {back:?}");
        }
    }
}
