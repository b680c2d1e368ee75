//! `Perspective`: a pinhole camera; everything is in focus.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `origin` | the pinhole | scene units, world | required |
//! | `target` | a point that projects to the centre of the film | scene units, world | required |
//! | `up` | a direction that points up in the picture | world, any length but zero | (0, 1, 0) |
//! | `fov` | full angle of view across the film's side named by `fov_axis` | degrees, [1e-4, 179.9999] | required |
//! | `fov_axis` | `Horizontal`, `Vertical`, `Smaller` or `Larger` | | `Vertical` |
//!
//! Use it for most pictures. Do not use it where blur is to tell depth: `ThinLens` has a lens with a size. Lines stay straight, and a
//! pixel is the radiance that arrives at the pinhole through it (Pharr, Jakob and Humphreys 2023, §5.2.2).

use super::frame::{FilmPlane, Pose};
use super::{CameraRay, Projection};
use crate::math;
use crate::scene::FovAxis;
use glam::{Vec2, Vec3};

/// A pinhole camera in world space.
#[derive(Clone, Copy, Debug)]
pub struct Perspective {
    origin: Vec3,
    /// At distance 1.
    plane: FilmPlane,
}

impl Perspective {
    /// A camera with the full angle of view `fov`, in degrees, along an axis of the film, whose size is in pixels.
    pub(super) fn new(pose: Pose, fov: f32, fov_axis: FovAxis, film: Vec2) -> Self {
        let [right, up, forward] = pose.axes().map(|axis| axis.as_vec3());
        let (w, h) = (film.x, film.y);
        let spanned = match fov_axis {
            FovAxis::Horizontal => w,
            FovAxis::Vertical => h,
            FovAxis::Smaller => w.min(h),
            FovAxis::Larger => w.max(h),
        };
        let half = math::tan((0.5 * fov).to_radians());
        let vectors = [right * (half * (w / spanned)), up * (half * (h / spanned)), forward];
        Self {
            origin: Vec3::from_array(pose.origin),
            plane: FilmPlane::new(vectors, film),
        }
    }

    /// The pinhole, world space.
    #[must_use]
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// The film's image at distance 1.
    pub(super) fn plane(&self) -> &FilmPlane {
        &self.plane
    }

    /// The vector from the pinhole to the image of film position `film` at distance 1.
    #[inline]
    pub(super) fn towards(&self, film: Vec2) -> Vec3 {
        let ndc = self.plane.ndc(film);
        self.plane.forward + self.plane.right * ndc.x - self.plane.up * ndc.y
    }

    /// The ray into the scene through film position `film` (pixels).
    #[inline]
    #[must_use]
    pub fn ray(&self, film: Vec2) -> CameraRay {
        CameraRay {
            origin: self.origin,
            direction: self.towards(film).normalize(),
        }
    }

    /// See [`Camera::density`](super::Camera::density).
    #[inline]
    #[must_use]
    pub fn density(&self, direction: Vec3) -> f32 {
        self.plane.density(direction)
    }

    /// See [`Camera::project`](super::Camera::project).
    #[inline]
    #[must_use]
    pub fn project(&self, point: Vec3) -> Option<Projection> {
        let to = point.as_dvec3() - self.origin.as_dvec3();
        let parts = self.plane.parts(to);
        if parts.z.is_nan() || parts.z <= 0.0 {
            return None;
        }
        Some(Projection {
            film: self.plane.position(parts.truncate() / parts.z)?,
            direction: to.normalize().as_vec3(),
            origin: self.origin,
        })
    }
}
