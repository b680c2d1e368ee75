//! The tree over primitives: built by obvhs, kept as pairs of sibling boxes, one cache line each.

use super::leaf::LeafPrimitive;
use super::pair::{BoxRay, Pair};
use super::stack::{Entry, Stack};
use super::triangle::RayFrame;
use crate::tolerance::CULL_SLACK;
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use std::time::Duration;

/// What it costs to look at two boxes, in intersections with a primitive: with it the builder weighs small leaves against
/// a shallow tree. Measured: 1 to 2 are best for a box of 36 triangles (3: a sixth slower), 2 to 3 for 200 000 triangles.
const PAIR_COST: f32 = 2.0;

/// A binary tree of boxes over primitives.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    pairs: Vec<Pair>,
    primitives: Vec<LeafPrimitive>,
}

/// Whether a walk goes on, and up to which distance.
pub enum Walk {
    /// Look at boxes up to this distance only.
    Within(f32),
    /// Nothing more to find.
    Stop,
}

impl Tree {
    /// Builds a tree. The order of `primitives` shapes it, threads do not.
    pub fn build(primitives: Vec<LeafPrimitive>) -> Self {
        if primitives.is_empty() {
            return Self::default();
        }
        let boxes: Vec<_> = primitives.iter().map(LeafPrimitive::bounds).collect();
        let mut build_time = Duration::ZERO;
        let parameters = BvhBuildParams {
            collapse_traversal_cost: PAIR_COST,
            ..BvhBuildParams::medium_build()
        };
        let bvh = build_bvh2(&boxes, parameters, &mut build_time);
        let in_order = bvh.primitive_indices.iter().map(|&i| primitives[i as usize]).collect();
        Self {
            pairs: pair_up(&bvh),
            primitives: in_order,
        }
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.pairs.as_slice()) + size_of_val(self.primitives.as_slice())
    }

    /// The box around everything, or `None` if the tree is empty.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let root = self.pairs.first()?;
        let corner = |bound: usize, pick: fn(f32, f32) -> f32| {
            Vec3::from_array(root.bounds.map(|bounds| pick(bounds[bound][0], bounds[bound][1])))
        };
        Some((corner(0, f32::min), corner(1, f32::max)))
    }

    /// Shows `visit` the primitives of every leaf whose box the ray meets within `limit` (in units of the direction's
    /// length), nearer boxes first; `visit` answers how far it still wants to look.
    #[inline]
    pub fn walk(
        &self,
        ray: &RayFrame,
        stack: &mut Stack,
        mut limit: f32,
        mut visit: impl FnMut(&[LeafPrimitive]) -> Walk,
    ) {
        if self.pairs.is_empty() {
            return;
        }
        let lines = BoxRay::new(ray);
        stack.clear();
        let mut next = Some(Entry {
            first: 0,
            count: 0,
            distance: 0.0,
        });
        while let Some(entry) = next {
            if entry.distance > limit * CULL_SLACK {
                next = stack.pop();
                continue;
            }
            if entry.count > 0 {
                let first = entry.first as usize;
                match visit(&self.primitives[first..first + entry.count as usize]) {
                    Walk::Within(nearer) => limit = nearer,
                    Walk::Stop => return,
                }
                next = stack.pop();
                continue;
            }
            let pair = &self.pairs[entry.first as usize];
            let distances = lines.distances(pair, limit);
            let entries = [0, 1].map(|side| Entry {
                first: pair.first[side],
                count: pair.count[side],
                distance: distances[side],
            });
            let (near, far) = if entries[1].distance < entries[0].distance {
                (entries[1], entries[0])
            } else {
                (entries[0], entries[1])
            };
            if far.distance < f32::INFINITY {
                stack.push(far);
            }
            next = if near.distance < f32::INFINITY {
                Some(near)
            } else {
                stack.pop()
            };
        }
    }
}

/// Siblings of obvhs' tree, depth first, so that a near child often lies on the next cache line.
fn pair_up(bvh: &Bvh2) -> Vec<Pair> {
    let root = &bvh.nodes[0];
    let mut pairs = Vec::with_capacity(bvh.nodes.len() / 2 + 1);
    pairs.push(Pair::EMPTY);
    if root.is_leaf() {
        pairs[0].set_box(0, root);
        pairs[0].first[0] = root.first_index;
        pairs[0].count[0] = root.prim_count;
        return pairs;
    }
    let mut todo = vec![(0, root.first_index)];
    while let Some((pair, children)) = todo.pop() {
        for side in 0..2 {
            let node = &bvh.nodes[children as usize + side];
            let mut first = node.first_index;
            if !node.is_leaf() {
                first = pairs.len() as u32;
                pairs.push(Pair::EMPTY);
                todo.push((first as usize, node.first_index));
            }
            pairs[pair].set_box(side, node);
            pairs[pair].first[side] = first;
            pairs[pair].count[side] = node.prim_count;
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Geometry, Instance, InstanceShape};
    use glam::DVec3;

    /// Triangles across the x axis at x = 0, 1, 2, ...; each is half of its box.
    fn sheets(count: u32) -> Vec<LeafPrimitive> {
        let mut geometry = Geometry::default();
        for x in 0..count {
            let x = x as f32;
            geometry
                .positions
                .extend([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(y, z)| Vec3::new(x, y, z)));
        }
        geometry.triangles = (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        geometry.instances.push(Instance {
            shape: InstanceShape::Mesh {
                first_uv: None,
                first_triangle: 0,
                triangle_count: count,
                first_vertex: 0,
                first_normal: None,
            },
            first_primitive: 0,
        });
        (0..count).filter_map(|t| LeafPrimitive::new(&geometry, 0, t)).collect()
    }

    /// The deepest tree there is: every pair is a leaf of one sheet, and all the sheets behind it.
    fn chain(primitives: Vec<LeafPrimitive>) -> Tree {
        let last = primitives.len() as u32 - 1;
        let pairs = (0..last).map(|i| {
            let mut pair = Pair::EMPTY;
            let behind = if i + 1 == last { (last, 1) } else { (i + 1, 0) };
            for (side, low, high, (first, count)) in [(0, i, i, (i, 1)), (1, i + 1, last, behind)] {
                for axis in 0..3 {
                    pair.bounds[axis][0][side] = [low as f32, 0.0, 0.0][axis];
                    pair.bounds[axis][1][side] = [high as f32, 1.0, 1.0][axis];
                }
                (pair.first[side], pair.count[side]) = (first, count);
            }
            pair
        });
        Tree {
            pairs: pairs.collect(),
            primitives,
        }
    }

    #[test]
    fn a_tree_far_deeper_than_the_fixed_stack_is_walked_in_full() {
        let mut stack = Stack::default();
        for count in [2, 48, 49, 50, 51, 1000] {
            let tree = chain(sheets(count));
            // From the far end the walk goes down to the last pair first, and leaves every leaf on the way for later.
            let ray = RayFrame::new(Vec3::new(2000.0, 0.75, 0.75), DVec3::NEG_X);
            let mut seen = Vec::new();
            tree.walk(&ray, &mut stack, f32::INFINITY, |leaf| {
                seen.extend(leaf.iter().map(|primitive| primitive.primitive));
                Walk::Within(f32::INFINITY)
            });
            assert!(seen.into_iter().eq((0..count).rev()), "{count}");
        }
    }
}
