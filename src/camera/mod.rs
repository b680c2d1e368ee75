//! Cameras: from a point on the film, and one on the lens, to a ray into the scene, and back. One file per model.
//!
//! Film coordinates are in pixels: (0, 0) is the top left corner, x to the right, y down, pixel (i, j) covers
//! [i, i+1) × [j, j+1). A pixel's value is the radiance that arrives through it, averaged over the pixel by the filter.
//! A model maps the plane of the film beyond its edges as well, since filters reach there.

mod frame;
mod orthographic;
mod perspective;
mod thin_lens;

pub use orthographic::Orthographic;
pub use perspective::Perspective;
pub use thin_lens::ThinLens;

use crate::scene::CameraDescription;
use glam::{Vec2, Vec3};

/// A camera in world space, before a film of a certain size.
#[derive(Clone, Copy, Debug)]
pub enum Camera {
    /// A pinhole.
    Perspective(Perspective),
    /// A lens that is in focus at one distance.
    ThinLens(ThinLens),
    /// Parallel rays.
    Orthographic(Orthographic),
}

/// A ray that leaves a camera. World space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraRay {
    /// Where it starts: on the lens; on the film's image in the scene for a camera of parallel rays.
    pub origin: Vec3,
    /// Its unit direction.
    pub direction: Vec3,
}

/// How a camera sees a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Where on the film, in pixels; may lie outside it.
    pub film: Vec2,
    /// The unit direction from the camera to the point.
    pub direction: Vec3,
    /// Where the segment from the point ends, world space.
    pub origin: Vec3,
}

impl Camera {
    /// The camera that a (validated) description names, before a film of `width` x `height` pixels.
    #[must_use]
    pub fn new(description: &CameraDescription, width: u32, height: u32) -> Self {
        let film = Vec2::new(width as f32, height as f32);
        match *description {
            CameraDescription::Perspective {
                origin,
                target,
                up,
                fov,
                fov_axis,
            } => Self::Perspective(Perspective::new(
                frame::Pose { origin, target, up },
                fov,
                fov_axis,
                film,
            )),
            CameraDescription::ThinLens {
                origin,
                target,
                up,
                fov,
                fov_axis,
                aperture_radius,
                focus_distance,
            } => {
                let pose = frame::Pose { origin, target, up };
                let distance = focus_distance.map_or_else(|| pose.distance(), f64::from);
                let pinhole = Perspective::new(pose, fov, fov_axis, film);
                Self::ThinLens(ThinLens::new(pinhole, f64::from(aperture_radius), distance))
            }
            CameraDescription::Orthographic {
                origin,
                target,
                up,
                height,
            } => Self::Orthographic(Orthographic::new(
                frame::Pose { origin, target, up },
                f64::from(height),
                film,
            )),
        }
    }

    /// The ray through film position `film` (pixels) and the lens point that the two uniform numbers `lens` choose. They
    /// are ignored unless the camera [has an aperture](Self::has_aperture).
    #[inline(always)]
    #[must_use]
    pub fn ray(&self, film: Vec2, lens: [f32; 2]) -> CameraRay {
        match self {
            Self::Perspective(camera) => camera.ray(film),
            Self::ThinLens(camera) => camera.ray(film, lens),
            Self::Orthographic(camera) => camera.ray(film),
        }
    }

    /// The ray through film position `film` from the point `origin` of the lens, which cameras without an aperture ignore.
    #[inline]
    #[must_use]
    pub fn ray_from(&self, origin: Vec3, film: Vec2) -> CameraRay {
        match self {
            Self::Perspective(camera) => camera.ray(film),
            Self::ThinLens(camera) => camera.ray_from(origin, film),
            Self::Orthographic(camera) => camera.ray(film),
        }
    }

    /// The point of the lens that two uniform numbers choose, uniform in area: where rays start that [`ray`](Self::ray)
    /// makes of the same numbers. The camera's own origin for one of parallel rays, whose rays do not meet.
    #[inline]
    #[must_use]
    pub fn lens_point(&self, lens: [f32; 2]) -> Vec3 {
        match self {
            Self::Perspective(camera) => camera.origin(),
            Self::ThinLens(camera) => camera.lens_point(lens),
            Self::Orthographic(camera) => camera.origin(),
        }
    }

    /// Whether rays through one film position start at different points, so that numbers for the lens are used.
    #[must_use]
    pub const fn has_aperture(&self) -> bool {
        matches!(self, Self::ThinLens(_))
    }

    /// Whether all rays are parallel: a path's first vertex then has a direction and no position, as a light at infinity.
    #[must_use]
    pub const fn is_directional(&self) -> bool {
        matches!(self, Self::Orthographic(_))
    }

    /// The density of rays where film positions are uniform over the whole film: per solid angle of the unit `direction`
    /// at any point of the lens; for a directional camera per unit area of a plane that faces it. Beyond the film's edges
    /// it goes on as if the film did; zero for directions that no film position has.
    ///
    /// It is the camera's importance too: light that arrives at the lens counts by it.
    #[inline]
    #[must_use]
    pub fn density(&self, direction: Vec3) -> f32 {
        match self {
            Self::Perspective(camera) => camera.density(direction),
            Self::ThinLens(camera) => camera.density(direction),
            Self::Orthographic(camera) => camera.density(),
        }
    }

    /// How `point` is seen from the point `origin` of the lens (ignored by cameras that have only one, or none). `None`
    /// where it is not in front of the camera, or so nearly beside it that its film position is beyond all numbers.
    #[inline]
    #[must_use]
    pub fn project(&self, origin: Vec3, point: Vec3) -> Option<Projection> {
        match self {
            Self::Perspective(camera) => camera.project(point),
            Self::ThinLens(camera) => camera.project(origin, point),
            Self::Orthographic(camera) => camera.project(point),
        }
    }
}
