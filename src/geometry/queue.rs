//! The columns of ray queues, and the views that a queue is passed as.

use crate::color::Rgb;
use crate::columns;
use glam::{DVec2, Vec3};

/// The instance of a ray that met nothing.
pub const NO_HIT: u32 = u32::MAX;

columns! {
    /// Origin of a ray or segment, world space, already moved off its surface.
    pub RayOrigin: Vec3;
    /// Direction of a ray, world space, of unit length up to rounding; distances are in units of its length.
    pub RayDirection: Vec3;
    /// Distance to the nearest hit, in units of the ray direction's length; infinite if nothing was met.
    pub HitDistance: f32;
    /// Instance that was hit, or [`NO_HIT`].
    pub HitInstance: u32;
    /// Primitive that was hit, counted inside its instance.
    pub HitPrimitive: u32;
    /// Where on the primitive: barycentric weights of a triangle's second and third corner, a sphere's octahedral
    /// coordinates, radii along the axes of a disk, or how far around a tube (in [0, 4)) and along it (in [0, 1]). In f64: across a large triangle, f32 would move the point by more than its rounding.
    pub HitUv: DVec2;
    /// The far end of a segment, world space, already moved off its surface.
    pub SegmentTarget: Vec3;
    /// The share of light that a segment lets through, per channel.
    pub SegmentTransmittance: Rgb;
}

/// Rays to trace: the first `len` of each column.
#[derive(Clone, Copy)]
pub struct RayColumns<'a> {
    /// Where rays start.
    pub origin: &'a [RayOrigin],
    /// Where they go.
    pub direction: &'a [RayDirection],
    /// How many there are.
    pub len: usize,
}

/// Where hits are written, in the order of the rays.
pub struct HitColumns<'a> {
    /// Distances.
    pub distance: &'a mut [HitDistance],
    /// Instances, or [`NO_HIT`].
    pub instance: &'a mut [HitInstance],
    /// Primitives.
    pub primitive: &'a mut [HitPrimitive],
    /// Coordinates on the primitive.
    pub uv: &'a mut [HitUv],
}

/// Segments to trace: the first `len` of each column.
#[derive(Clone, Copy)]
pub struct SegmentColumns<'a> {
    /// Where segments start.
    pub origin: &'a [RayOrigin],
    /// Where they end.
    pub target: &'a [SegmentTarget],
    /// How many there are.
    pub len: usize,
}
