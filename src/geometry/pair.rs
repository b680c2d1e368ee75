//! Two sibling boxes of the tree, and a ray against both.

use super::triangle::RayFrame;
use crate::tolerance::{BOX_EXIT_SLACK, CULL_SLACK};
use obvhs::bvh2::node::Bvh2Node;

/// Two sibling boxes and where they lead.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Pair {
    /// Least (0) and largest (1) coordinate of each child, `[axis][bound][child]`.
    pub bounds: [[[f32; 2]; 2]; 3],
    /// First primitive of a leaf, or the pair of an inner child.
    pub first: [u32; 2],
    /// Primitives of a leaf; 0 for an inner child.
    pub count: [u32; 2],
}

impl Pair {
    /// Two boxes that no ray meets.
    pub const EMPTY: Self = Self {
        bounds: [[[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]]; 3],
        first: [0; 2],
        count: [1; 2],
    };

    /// Takes over the box of one of obvhs' nodes.
    pub fn set_box(&mut self, side: usize, node: &Bvh2Node) {
        let (min, max) = (node.aabb().min.to_array(), node.aabb().max.to_array());
        for axis in 0..3 {
            self.bounds[axis][0][side] = min[axis];
            self.bounds[axis][1][side] = max[axis];
        }
    }
}

/// A ray prepared for many boxes.
pub struct BoxRay {
    origin: [f32; 3],
    /// One over each component of the direction.
    inverse: [f32; 3],
    /// Which bound of a box the ray meets first along each axis.
    near: [usize; 3],
}

impl BoxRay {
    /// Prepares a ray.
    #[inline]
    pub fn new(ray: &RayFrame) -> Self {
        let inverse = ray.direction.recip().as_vec3().to_array();
        Self {
            origin: ray.origin.as_vec3().to_array(),
            inverse,
            near: inverse.map(|component| usize::from(component.is_sign_negative())),
        }
    }

    /// The distances at which the ray enters two boxes, infinity where it misses one or enters it beyond `limit`.
    ///
    /// 0 · ∞ (a ray inside a slab's plane, parallel to it) is not a number; every comparison is written so that it
    /// leaves the interval as it was.
    #[inline(always)]
    pub fn distances(&self, pair: &Pair, limit: f32) -> [f32; 2] {
        let (mut enter, mut exit) = ([0.0; 2], [f32::INFINITY; 2]);
        for axis in 0..3 {
            let near = pair.bounds[axis][self.near[axis] & 1];
            let far = pair.bounds[axis][(self.near[axis] & 1) ^ 1];
            for side in 0..2 {
                let near = (near[side] - self.origin[axis]) * self.inverse[axis];
                let far = (far[side] - self.origin[axis]) * self.inverse[axis];
                enter[side] = if near > enter[side] { near } else { enter[side] };
                exit[side] = if far < exit[side] { far } else { exit[side] };
            }
        }
        let limit = limit * CULL_SLACK;
        [0, 1].map(|side| {
            if enter[side] <= exit[side] * BOX_EXIT_SLACK && enter[side] <= limit {
                enter[side]
            } else {
                f32::INFINITY
            }
        })
    }
}
