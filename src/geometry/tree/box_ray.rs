//! A ray prepared for many boxes.

use crate::geometry::triangle::RayFrame;
use crate::tolerance::{BOX_EXIT_SLACK, CULL_SLACK};

/// A ray prepared for many boxes.
#[derive(Clone, Copy, Debug)]
pub struct BoxRay {
    /// Its origin.
    pub origin: [f32; 3],
    /// One over each component of the direction.
    pub inverse: [f32; 3],
    /// Which bound of a box the ray meets first along each axis: 0 the least, 1 the largest.
    pub near: [u32; 3],
}

impl BoxRay {
    /// Prepares a ray.
    #[inline(always)]
    pub fn new(ray: &RayFrame) -> Self {
        let inverse = ray.direction.recip().as_vec3().to_array();
        Self {
            origin: ray.origin.as_vec3().to_array(),
            inverse,
            near: inverse.map(|component| u32::from(component.is_sign_negative())),
        }
    }

    /// Whether the ray enters a box, no farther than `limit`: as boxes of nodes are, of which it takes that of every node around it to be
    /// entered too, however much larger that is, since roundings keep order.
    #[inline(always)]
    pub fn enters(&self, bounds: [[f32; 2]; 3], limit: f32) -> bool {
        let (mut enter, mut exit) = (0.0_f32, f32::INFINITY);
        for axis in 0..3 {
            let [first, last] = [0, 1].map(|side| {
                let plane = bounds[axis][((self.near[axis] ^ side) & 1) as usize];
                (plane - self.origin[axis]) * self.inverse[axis]
            });
            enter = if first > enter { first } else { enter };
            exit = if last < exit { last } else { exit };
        }
        enter <= exit * BOX_EXIT_SLACK && enter <= limit * CULL_SLACK
    }

    /// The numbers, among the planes of a node, of those that the ray meets first and last along an axis.
    #[inline(always)]
    pub fn planes(&self, axis: usize) -> [usize; 2] {
        let near = (self.near[axis] & 1) as usize;
        [2 * axis + near, 2 * axis + (near ^ 1)]
    }
}
