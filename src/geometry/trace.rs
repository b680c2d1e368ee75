//! Tracing queues: closest hits of rays, transmittance of segments.

use super::Geometry;
use super::queue::{HitColumns, NO_HIT, RayColumns, SegmentColumns, SegmentTransmittance};
use super::stack::Stack;
use super::tree::Walk;
use super::triangle::RayFrame;
use crate::color::Rgb;
use crate::table::Rows;
use glam::DVec2;

/// A hit as it is compared: the least (distance, instance, primitive) wins. In f64: of two surfaces that lie closer than
/// f32 tells apart at that distance, the nearer one is still seen.
struct Nearest {
    distance: f64,
    instance: u32,
    primitive: u32,
    uv: DVec2,
}

impl Geometry {
    /// Writes the closest hit of every ray: the lexicographic minimum of (distance, instance, primitive).
    pub fn closest_hits(&self, rays: RayColumns<'_>, hits: HitColumns<'_>) {
        let mut stack = Stack::default();
        for i in 0..rays.len {
            let ray = RayFrame::new(rays.origin.at(i), rays.direction.at(i).as_dvec3());
            let nearest = self.closest_hit(&ray, &mut stack);
            hits.distance.put(i, nearest.distance as f32);
            hits.instance.put(i, nearest.instance);
            hits.primitive.put(i, nearest.primitive);
            hits.uv.put(i, nearest.uv);
        }
    }

    /// Writes the share of light that passes along every segment, ends excluded. Every surface is opaque so far, so it
    /// is one or zero.
    pub fn transmittances(&self, segments: SegmentColumns<'_>, transmittance: &mut [SegmentTransmittance]) {
        let mut stack = Stack::default();
        for i in 0..segments.len {
            let origin = segments.origin.at(i);
            // In f64, so that a segment to a far target ends where the target is.
            let span = segments.target.at(i).as_dvec3() - origin.as_dvec3();
            let blocked = self.blocked(&RayFrame::new(origin, span), &mut stack);
            transmittance.put(i, if blocked { Rgb::BLACK } else { Rgb::ONE });
        }
    }

    #[inline]
    fn closest_hit(&self, ray: &RayFrame, stack: &mut Stack) -> Nearest {
        let mut nearest = Nearest {
            distance: f64::INFINITY,
            instance: NO_HIT,
            primitive: NO_HIT,
            uv: DVec2::ZERO,
        };
        self.tree.walk(ray, stack, f32::INFINITY, |leaf| {
            for primitive in leaf {
                let Some((t, uv)) = primitive.hit(ray) else { continue };
                let key = (t, primitive.instance, primitive.primitive);
                if key < (nearest.distance, nearest.instance, nearest.primitive) {
                    (nearest.distance, nearest.instance, nearest.primitive) = key;
                    nearest.uv = uv;
                }
            }
            // Rounded up: a box no farther than the hit is looked into.
            Walk::Within((nearest.distance as f32).next_up())
        });
        nearest
    }

    #[inline]
    fn blocked(&self, ray: &RayFrame, stack: &mut Stack) -> bool {
        let mut blocked = false;
        self.tree.walk(ray, stack, 1.0, |leaf| {
            blocked = leaf.iter().any(|primitive| primitive.blocks(ray));
            if blocked { Walk::Stop } else { Walk::Within(1.0) }
        });
        blocked
    }
}
