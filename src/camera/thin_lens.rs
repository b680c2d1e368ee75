//! `ThinLens`: a camera with depth of field; what is off its focal plane is blurred over a disk.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `origin` | the centre of the lens | scene units, world | required |
//! | `target` | a point that projects to the centre of the film | scene units, world | required |
//! | `up` | a direction that points up in the picture | world, any length but zero | (0, 1, 0) |
//! | `fov` | full angle of view across the film's side named by `fov_axis` | degrees, [1e-4, 179.9999] | required |
//! | `fov_axis` | `Horizontal`, `Vertical`, `Smaller` or `Larger` | | `Vertical` |
//! | `aperture_radius` | radius of the lens: focal length / (2 · f-number) | scene units, [1e-9, 1e9] | required |
//! | `focus_distance` | from the lens to the plane that is in focus, along the view | scene units, [1e-9, 1e9] | to `target` |
//!
//! Use it where blur tells depth. Do not use it where everything is to be sharp: each sample needs two more numbers, and blurred
//! highlights many more samples, and `Perspective` costs less. The picture is that of `Perspective` at the focal plane, whatever
//! the radius, and exposure does not depend on it: a pixel is the mean radiance over lens and pixel. The lens is thin, round
//! and without aberration or vignetting (Potmesil and Chakravarty 1981; Kolb, Mitchell and Hanrahan 1995, §2).
//!
//! Its rays through one film position meet on the focal plane. Over that plane, film positions are uniform wherever on the
//! lens a ray starts, so the density of directions is that of the pinhole: (d² / cos θ) / area = 1 / (A cos³ θ), with A the
//! film's area at distance 1.

use super::perspective::Perspective;
use super::{CameraRay, Projection};
use crate::sampling::warp;
use glam::{DVec3, Vec2, Vec3};

/// A thin lens in world space.
#[derive(Clone, Copy, Debug)]
pub struct ThinLens {
    /// The camera that remains as the radius goes to zero.
    pinhole: Perspective,
    /// To the right edge of the lens.
    right: DVec3,
    /// To its upper edge.
    up: DVec3,
    focus_distance: f64,
}

impl ThinLens {
    /// A lens in place of a pinhole; radius and distance in scene units, positive.
    pub(super) fn new(pinhole: Perspective, aperture_radius: f64, focus_distance: f64) -> Self {
        let plane = pinhole.plane();
        let right = plane.right.as_dvec3().normalize();
        let up = right.cross(plane.forward.as_dvec3()).normalize();
        Self {
            pinhole,
            right: right * aperture_radius,
            up: up * aperture_radius,
            focus_distance,
        }
    }

    /// The point of the lens that two uniform numbers choose, uniform in area, world space.
    #[inline]
    #[must_use]
    pub fn lens_point(&self, lens: [f32; 2]) -> Vec3 {
        let on_disk = warp::disk(lens).as_dvec2();
        (self.pinhole.origin().as_dvec3() + self.right * on_disk.x + self.up * on_disk.y).as_vec3()
    }

    /// The ray into the scene through film position `film` (pixels) from the lens point that `lens` chooses.
    #[inline]
    #[must_use]
    pub fn ray(&self, film: Vec2, lens: [f32; 2]) -> CameraRay {
        self.ray_from(self.lens_point(lens), film)
    }

    /// The same from the point `origin` of the lens.
    #[inline]
    #[must_use]
    pub fn ray_from(&self, origin: Vec3, film: Vec2) -> CameraRay {
        // In f64 and from the rounded origin, so that rays meet on the focal plane as nearly as directions can say.
        let focused = self.pinhole.origin().as_dvec3() + self.pinhole.towards(film).as_dvec3() * self.focus_distance;
        CameraRay {
            origin,
            direction: (focused - origin.as_dvec3()).normalize().as_vec3(),
        }
    }

    /// See [`Camera::density`](super::Camera::density).
    #[inline]
    #[must_use]
    pub fn density(&self, direction: Vec3) -> f32 {
        self.pinhole.density(direction)
    }

    /// See [`Camera::project`](super::Camera::project).
    #[inline]
    #[must_use]
    pub fn project(&self, origin: Vec3, point: Vec3) -> Option<Projection> {
        let plane = self.pinhole.plane();
        let to = point.as_dvec3() - origin.as_dvec3();
        let (from, along) = (
            plane.parts(origin.as_dvec3() - self.pinhole.origin().as_dvec3()),
            plane.parts(to),
        );
        if along.z.is_nan() || along.z <= 0.0 {
            return None;
        }
        // Where the line through both points meets the focal plane.
        let focused = from + along * ((self.focus_distance - from.z) / along.z);
        Some(Projection {
            film: plane.position(focused.truncate() / self.focus_distance)?,
            direction: to.normalize().as_vec3(),
            origin,
        })
    }
}
