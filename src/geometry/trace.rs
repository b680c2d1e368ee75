//! Tracing queues: closest hits of rays, transmittance of segments.

use super::Geometry;
use super::queue::{HitColumns, RayColumns, SegmentColumns, SegmentTransmittance};
use super::tree::{Blocked, Nearest, Queue};
use crate::color::Rgb;
use crate::table::Rows;
use glam::{DVec3, Vec3};

/// Rays, and their hits.
struct Rays<'a> {
    rays: RayColumns<'a>,
    hits: HitColumns<'a>,
}

impl Queue for Rays<'_> {
    type Query = Nearest;

    #[inline(always)]
    fn len(&self) -> usize {
        self.rays.len
    }

    #[inline(always)]
    fn line(&self, number: usize) -> (Vec3, DVec3) {
        (self.rays.origin.at(number), self.rays.direction.at(number).as_dvec3())
    }

    #[inline(always)]
    fn answer(&mut self, number: usize, nearest: &Nearest) {
        self.hits.distance.put(number, nearest.distance as f32);
        self.hits.instance.put(number, nearest.instance);
        self.hits.primitive.put(number, nearest.primitive);
        self.hits.uv.put(number, nearest.uv);
    }
}

/// Segments, and how much light they let through.
struct Segments<'a> {
    segments: SegmentColumns<'a>,
    transmittance: &'a mut [SegmentTransmittance],
}

impl Queue for Segments<'_> {
    type Query = Blocked;

    #[inline(always)]
    fn len(&self) -> usize {
        self.segments.len
    }

    /// In f64, so that a segment to a far target ends where the target is.
    #[inline(always)]
    fn line(&self, number: usize) -> (Vec3, DVec3) {
        let origin = self.segments.origin.at(number);
        (origin, self.segments.target.at(number).as_dvec3() - origin.as_dvec3())
    }

    #[inline(always)]
    fn answer(&mut self, number: usize, blocked: &Blocked) {
        let passing = if blocked.0 { Rgb::BLACK } else { Rgb::ONE };
        self.transmittance.put(number, passing);
    }
}

impl Geometry {
    /// Writes the closest hit of every ray: the lexicographic minimum of (distance, instance, primitive).
    pub fn closest_hits(&self, rays: RayColumns<'_>, hits: HitColumns<'_>) {
        self.tree.answer(self.tracing, &mut Rays { rays, hits });
    }

    /// Writes the share of light that passes along every segment, ends excluded. Every surface is opaque so far, so it
    /// is one or zero.
    pub fn transmittances(&self, segments: SegmentColumns<'_>, transmittance: &mut [SegmentTransmittance]) {
        let mut queue = Segments {
            segments,
            transmittance,
        };
        self.tree.answer(self.tracing, &mut queue);
    }
}
