//! `Perspective`: a pinhole camera; everything is in focus.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `origin` | the pinhole | scene units, world | required |
//! | `target` | a point that projects to the centre of the film | scene units, world | required |
//! | `up` | a direction that points up in the picture | world, any length | +y |
//! | `fov` | full angle of view across the film's side named by `fov_axis` | degrees, (0, 180) | required |
//! | `fov_axis` | `Horizontal`, `Vertical`, `Smaller` or `Larger` | | `Vertical` |
//!
//! Film coordinates are in pixels: (0, 0) is the top left corner, x to the right, y down, pixel (i, j) covers
//! [i, i+1) × [j, j+1). A pixel's value is the radiance that arrives through it, averaged over the pixel by the filter.

use crate::math;
use crate::scene::{CameraDescription, FovAxis};
use glam::{Vec2, Vec3};

/// A pinhole camera in world space.
#[derive(Clone, Copy, Debug)]
pub struct Perspective {
    origin: Vec3,
    forward: Vec3,
    /// From the film's centre to its right edge, on the plane at distance 1.
    right: Vec3,
    /// From the film's centre to its top edge, on the plane at distance 1.
    up: Vec3,
    /// Film size in pixels.
    film: Vec2,
}

impl Perspective {
    /// The camera that a (validated) description names, before a film of `width` x `height` pixels.
    #[must_use]
    pub fn new(description: &CameraDescription, width: u32, height: u32) -> Self {
        let CameraDescription::Perspective {
            origin,
            target,
            up,
            fov,
            fov_axis,
        } = description;
        let (origin, target) = (Vec3::from_array(*origin), Vec3::from_array(*target));
        let forward = (target.as_dvec3() - origin.as_dvec3()).normalize();
        let right = forward.cross(Vec3::from_array(*up).as_dvec3()).normalize();
        let up = right.cross(forward);
        let (w, h) = (width as f32, height as f32);
        let spanned = match fov_axis {
            FovAxis::Horizontal => w,
            FovAxis::Vertical => h,
            FovAxis::Smaller => w.min(h),
            FovAxis::Larger => w.max(h),
        };
        let half = math::tan((0.5 * fov).to_radians());
        Self {
            origin,
            forward: forward.as_vec3(),
            right: right.as_vec3() * (half * (w / spanned)),
            up: up.as_vec3() * (half * (h / spanned)),
            film: Vec2::new(w, h),
        }
    }

    /// The pinhole, world space.
    #[must_use]
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// The unit direction into the scene through film position `film` (pixels).
    #[inline]
    #[must_use]
    pub fn direction(&self, film: Vec2) -> Vec3 {
        let ndc = film / self.film * 2.0 - 1.0;
        (self.forward + self.right * ndc.x - self.up * ndc.y).normalize()
    }
}
