//! A primitive that emits: its shape, and what all shapes have in common.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `emission` (of a shape) | radiance on the side of the geometric normal, the same in every direction | W sr⁻¹ m⁻², [0, 1e12] per channel | none |
//!
//! Use it for lamps, windows and anything that has a size: such light can be met by scattering, and shadows are soft. A
//! mesh is one light per triangle. Do not use it for tiny lamps far away, where a `Point` costs less, nor for large meshes of
//! thousands of triangles: each is a light of its own. Light leaves by Lambert's law (Lambert 1760), with density cos θ / π, from
//! points uniform in area.

use super::{EmitterPoint, cylinder, disk, sphere, triangle};
use crate::color::Rgb;
use glam::Vec3;
use std::f64::consts::PI;

/// A primitive that emits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    /// Its shape in world space.
    pub shape: EmitterShape,
    /// Emitted radiance, W sr⁻¹ m⁻² per channel.
    pub radiance: Rgb,
    /// Area in squared scene units.
    pub area: f32,
}

/// The shape of an emitter, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EmitterShape {
    /// A triangle by its corners.
    Triangle([Vec3; 3]),
    /// A sphere.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
    },
    /// A disk; shines on the side of its normal.
    Disk {
        /// Centre.
        center: Vec3,
        /// Unit normal.
        normal: Vec3,
        /// Radius.
        radius: f32,
    },
    /// A tube without ends; shines outward.
    Cylinder {
        /// Centre of one end.
        from: Vec3,
        /// Centre of the other end.
        to: Vec3,
        /// Radius.
        radius: f32,
    },
}

impl Emitter {
    /// Mean of the channels' powers in W: π · area · radiance.
    pub(super) fn power(&self) -> f64 {
        PI * f64::from(self.area) * f64::from(self.radiance.mean())
    }

    /// The one unit normal of a triangle or disk; the others have one per point.
    pub(super) fn flat_normal(&self) -> Vec3 {
        match self.shape {
            EmitterShape::Triangle(corners) => triangle::normal(corners),
            EmitterShape::Disk { normal, .. } => normal,
            EmitterShape::Sphere { .. } | EmitterShape::Cylinder { .. } => Vec3::ZERO,
        }
    }

    /// A point as seen from `from`; `None` where nothing shines from there to `from`. Triangles are part of the caller, the
    /// others calls: they are met far less often.
    #[inline(always)]
    pub(super) fn sample(&self, flat_normal: Vec3, from: Vec3, u: [f32; 2]) -> Option<EmitterPoint> {
        match self.shape {
            EmitterShape::Triangle(corners) => triangle::sample(corners, flat_normal, self.area, from, u),
            EmitterShape::Sphere { center, radius } => sphere::sample(center, radius, from, u),
            EmitterShape::Disk { .. } | EmitterShape::Cylinder { .. } => self.sample_round(flat_normal, from, u),
        }
    }

    /// [`sample`](Self::sample) of shapes whose points are drawn uniformly, triangles apart.
    #[inline(never)]
    fn sample_round(&self, flat_normal: Vec3, from: Vec3, u: [f32; 2]) -> Option<EmitterPoint> {
        let (position, normal) = self.point(flat_normal, u);
        EmitterPoint::uniform_in_area(self.area, from, position, normal)
    }

    /// The density, per solid angle at `from`, with which [`sample`](Self::sample) finds a point.
    #[inline]
    pub(super) fn density(&self, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        match self.shape {
            EmitterShape::Sphere { center, radius } => sphere::density(center, radius, from),
            EmitterShape::Triangle(_) | EmitterShape::Disk { .. } | EmitterShape::Cylinder { .. } => {
                super::area_density(self.area, from, position, normal)
            }
        }
    }

    /// A point uniform over the area, and the unit normal there.
    #[inline]
    pub(super) fn point(&self, flat_normal: Vec3, u: [f32; 2]) -> (Vec3, Vec3) {
        match self.shape {
            EmitterShape::Triangle(corners) => (triangle::point(corners, u), flat_normal),
            EmitterShape::Sphere { center, radius } => sphere::point(center, radius, u),
            EmitterShape::Disk { center, normal, radius } => (disk::point(center, normal, radius, u), normal),
            EmitterShape::Cylinder { from, to, radius } => cylinder::point(from, to, radius, u),
        }
    }
}
