//! What is asked of a tree: the closest hit, or whether anything is in the way.

use super::block::Block;
use super::bundle::Ends;
use super::intersect::{between, cross};
use super::lanes::Lanes;
use super::shape::Shape;
use super::walk::Prepared;
use crate::geometry::queue::NO_HIT;
use glam::DVec2;

/// A question about one ray, answered by looking into leaves.
///
/// A hit counts if the ray enters the box of its own primitive too. Then it enters all boxes around that, as roundings keep order, so that a
/// walk through a tree finds what a look at every primitive finds. (What this leaves out was found by rounding alone: a ray may be
/// said to cross a large triangle just beside its corner.)
pub trait Query: Copy {
    /// Where it ends to matter what there is.
    const ENDS: Ends;
    /// The question before anything was looked into.
    fn new() -> Self;
    /// How far it still matters what there is, in units of the direction's length.
    fn limit(&self) -> f32;
    /// Whether nothing more can change the answer.
    fn is_answered(&self) -> bool;
    /// Looks into a block of triangles.
    fn block<L: Lanes>(&mut self, lanes: L, block: &Block, ray: &Prepared);
    /// Whether a hit at such a distance matters.
    fn counts(&self, distance: f64) -> bool;
    /// Takes a hit that matters.
    fn take(&mut self, distance: f64, instance: u32, primitive: u32, uv: DVec2, ray: &Prepared);
    /// How far the box may be of a primitive that the ray hits at such a distance.
    fn box_limit(&self, distance: f64, ray: &Prepared) -> f32;
    /// Looks at one primitive.
    fn shape(&mut self, shape: &Shape, ray: &Prepared);
    /// Learns that something lies before the target.
    fn learn_blocked(&mut self);
}

/// The closest hit: the least (distance, instance, primitive). In f64: of two surfaces that lie closer than f32 tells apart at that
/// distance, the nearer one is still seen.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// In units of the direction's length; infinite where nothing was met.
    pub distance: f64,
    /// Instance, or [`NO_HIT`].
    pub instance: u32,
    /// Primitive inside it.
    pub primitive: u32,
    /// Coordinates on the primitive.
    pub uv: DVec2,
    /// How far boxes may be that are still looked into.
    limit: f32,
}

/// A distance in f32, rounded up, and farther by what it may be off: so that a box that may be no farther than the hit is looked into.
#[inline(always)]
fn rounded_up(distance: f64, ray: &Prepared) -> f32 {
    ((distance + ray.slack) as f32).next_up()
}

impl Query for Nearest {
    const ENDS: Ends = Ends::AtTheNearest;

    #[inline(always)]
    fn new() -> Self {
        Self {
            distance: f64::INFINITY,
            instance: NO_HIT,
            primitive: NO_HIT,
            uv: DVec2::ZERO,
            limit: f32::INFINITY,
        }
    }

    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        false
    }

    #[inline(always)]
    fn block<L: Lanes>(&mut self, lanes: L, block: &Block, ray: &Prepared) {
        let Some(crossings) = cross(lanes, block, &ray.frame) else {
            return;
        };
        let mut mask = crossings.mask;
        while mask != 0 {
            let lane = (mask.trailing_zeros() & 3) as usize;
            mask &= mask - 1;
            let t = crossings.t[lane];
            if self.counts(t) && ray.boxes.enters(block.bounds(lane), self.box_limit(t, ray)) {
                let uv = DVec2::new(crossings.u[lane], crossings.v[lane]);
                self.take(t, block.instances[lane], block.primitives[lane], uv, ray);
            }
        }
    }

    #[inline(always)]
    fn shape(&mut self, shape: &Shape, ray: &Prepared) {
        if let Some((t, uv)) = shape.primitive.hit(&ray.frame)
            && ray.boxes.enters(shape.bounds, self.box_limit(t, ray))
        {
            self.take(t, shape.primitive.instance, shape.primitive.primitive, uv, ray);
        }
    }

    #[inline(always)]
    fn counts(&self, distance: f64) -> bool {
        distance > 0.0 && distance <= self.distance
    }

    #[inline(always)]
    fn take(&mut self, distance: f64, instance: u32, primitive: u32, uv: DVec2, ray: &Prepared) {
        if (distance, instance, primitive) < (self.distance, self.instance, self.primitive) {
            *self = Self {
                distance,
                instance,
                primitive,
                uv,
                limit: rounded_up(distance, ray),
            };
        }
    }

    #[inline(always)]
    fn box_limit(&self, distance: f64, ray: &Prepared) -> f32 {
        rounded_up(distance, ray)
    }

    #[inline(always)]
    fn learn_blocked(&mut self) {}
}

/// Whether anything lies between the origin and origin + direction, ends excluded.
#[derive(Clone, Copy, Debug)]
pub struct Blocked(pub bool);

impl Query for Blocked {
    const ENDS: Ends = Ends::AtTheTarget;

    #[inline(always)]
    fn new() -> Self {
        Self(false)
    }

    #[inline(always)]
    fn limit(&self) -> f32 {
        1.0
    }

    #[inline(always)]
    fn is_answered(&self) -> bool {
        self.0
    }

    #[inline(always)]
    fn block<L: Lanes>(&mut self, lanes: L, block: &Block, ray: &Prepared) {
        let mut mask = between(lanes, block, &ray.frame);
        while mask != 0 {
            let lane = (mask.trailing_zeros() & 3) as usize;
            self.0 |= ray.boxes.enters(block.bounds(lane), self.limit());
            mask &= mask - 1;
        }
    }

    #[inline(always)]
    fn shape(&mut self, shape: &Shape, ray: &Prepared) {
        self.0 |= shape.primitive.blocks(&ray.frame) && ray.boxes.enters(shape.bounds, self.limit());
    }

    #[inline(always)]
    fn counts(&self, distance: f64) -> bool {
        distance > 0.0 && distance < 1.0
    }

    #[inline(always)]
    fn take(&mut self, _: f64, _: u32, _: u32, _: DVec2, _: &Prepared) {
        self.0 = true;
    }

    #[inline(always)]
    fn box_limit(&self, _: f64, _: &Prepared) -> f32 {
        self.limit()
    }

    #[inline(always)]
    fn learn_blocked(&mut self) {
        self.0 = true;
    }
}
