//! `Orthographic`: a camera whose rays are all parallel; things look as large far away as they do near.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `origin` | the centre of the film's image in the scene; what lies behind it is not seen | scene units, world | required |
//! | `target` | a point that projects to the centre of the film | scene units, world | required |
//! | `up` | a direction that points up in the picture | world, any length but zero | (0, 1, 0) |
//! | `height` | what the film's height spans | scene units, [1e-9, 1e9] | required |
//!
//! Use it for plans and elevations, and for pictures to measure in. The width follows from the film's shape; pixels are
//! square. Do not use it for pictures as an eye sees them: far things do not look smaller (Pharr, Jakob and Humphreys 2023,
//! §5.2.1). A pixel is the radiance towards the camera, averaged over the pixel's image.

use super::frame::{FilmPlane, Pose};
use super::{CameraRay, Projection};
use glam::{Vec2, Vec3};

/// A camera of parallel rays in world space.
#[derive(Clone, Copy, Debug)]
pub struct Orthographic {
    origin: Vec3,
    /// Its vectors to the right and up are in scene units.
    plane: FilmPlane,
    density: f32,
}

impl Orthographic {
    /// A camera whose film of `film` pixels spans `height` scene units from its lower edge to the upper.
    pub(super) fn new(pose: Pose, height: f64, film: Vec2) -> Self {
        let [right, up, forward] = pose.axes();
        let half = 0.5 * height;
        let across = half * f64::from(film.x) / f64::from(film.y);
        let vectors = [right * across, up * half, forward].map(|vector| vector.as_vec3());
        let plane = FilmPlane::new(vectors, film);
        Self {
            origin: Vec3::from_array(pose.origin),
            plane,
            density: (1.0 / plane.area()) as f32,
        }
    }

    /// The centre of the film's image in the scene, world space.
    #[must_use]
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// The ray into the scene through film position `film` (pixels).
    #[inline]
    #[must_use]
    pub fn ray(&self, film: Vec2) -> CameraRay {
        let ndc = self.plane.ndc(film).as_dvec2();
        let beside = self.plane.right.as_dvec3() * ndc.x - self.plane.up.as_dvec3() * ndc.y;
        CameraRay {
            origin: (self.origin.as_dvec3() + beside).as_vec3(),
            direction: self.plane.forward,
        }
    }

    /// See [`Camera::density`](super::Camera::density): one over the area that the film spans.
    #[inline]
    #[must_use]
    pub fn density(&self) -> f32 {
        self.density
    }

    /// See [`Camera::project`](super::Camera::project).
    #[inline]
    #[must_use]
    pub fn project(&self, point: Vec3) -> Option<Projection> {
        let parts = self.plane.parts(point.as_dvec3() - self.origin.as_dvec3());
        if parts.z.is_nan() || parts.z <= 0.0 {
            return None;
        }
        Some(Projection {
            film: self.plane.position(parts.truncate())?,
            direction: self.plane.forward,
            origin: (point.as_dvec3() - self.plane.forward.as_dvec3() * parts.z).as_vec3(),
        })
    }
}
