//! Local frames.

use glam::Vec3;

/// An orthonormal, right-handed frame whose z axis is a normal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

impl Frame {
    /// The frame about a unit normal (Duff et al. 2017, "Building an orthonormal basis, revisited").
    #[inline]
    #[must_use]
    pub fn new(normal: Vec3) -> Self {
        let sign = 1.0_f32.copysign(normal.z);
        let a = -1.0 / (sign + normal.z);
        let b = normal.x * normal.y * a;
        Self {
            x: Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
            y: Vec3::new(b, sign + normal.y * normal.y * a, -normal.y),
            z: normal,
        }
    }

    /// The frame about a unit normal whose x axis is `tangent`, unit and orthogonal to it up to rounding. A call: few surfaces have
    /// one, and those that have none need not carry it.
    #[inline(never)]
    #[must_use]
    pub fn with_tangent(normal: Vec3, tangent: Vec3) -> Self {
        let y = normal.cross(tangent).normalize();
        Self {
            x: y.cross(normal),
            y,
            z: normal,
        }
    }

    /// The two unit vectors across the normal.
    #[inline]
    #[must_use]
    pub fn tangents(&self) -> (Vec3, Vec3) {
        (self.x, self.y)
    }

    /// A world direction in this frame.
    #[inline]
    #[must_use]
    pub fn to_local(&self, world: Vec3) -> Vec3 {
        Vec3::new(self.x.dot(world), self.y.dot(world), self.z.dot(world))
    }

    /// A direction of this frame in the world.
    #[inline]
    #[must_use]
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        self.x * local.x + self.y * local.y + self.z * local.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey, warp};

    #[test]
    fn frames_are_orthonormal_right_handed_and_invert() {
        let mut stream = StreamKey::new(3, 0, 0).stream(Purpose::SCATTER, 0);
        let random = (0..1000).map(|_| warp::uniform_sphere(stream.next_pair()));
        let poles = [Vec3::Z, Vec3::NEG_Z, Vec3::new(1e-4, 0.0, -1.0).normalize(), Vec3::X];
        for normal in poles.into_iter().chain(random) {
            let frame = Frame::new(normal);
            assert!(frame.x.cross(frame.y).distance(frame.z) < 1e-6, "{normal}");
            let v = Vec3::new(0.3, -0.5, 0.7);
            assert!(frame.to_local(frame.to_world(v)).distance(v) < 1e-6, "{normal}");
        }
    }
}
