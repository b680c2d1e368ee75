//! Building the tree: obvhs makes a binary one, and its nodes become nodes of eight boxes over blocks of four triangles.

use super::block::{BLOCK, Block};
use super::node::{Node, Reference, Target, WIDTH};
use super::shape::Shape;
use super::stack::Stack;
use crate::geometry::leaf::LeafPrimitive;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use std::time::Duration;

/// What a binary node costs in the surface area heuristic, in intersections with a block: of eight boxes at once, it is one and a half.
const NODE_COST: f32 = 0.3;

/// The parts of a tree.
#[derive(Debug, Default)]
pub struct Parts {
    /// The root first.
    pub nodes: Vec<Node>,
    /// Triangles.
    pub blocks: Vec<Block>,
    /// Other primitives.
    pub shapes: Vec<Shape>,
}

/// The tree over `primitives`, whose order shapes it; threads do not.
pub fn build(primitives: &[LeafPrimitive]) -> Parts {
    if primitives.is_empty() {
        return Parts::default();
    }
    let boxes: Vec<Aabb> = primitives.iter().map(LeafPrimitive::bounds).collect();
    let parameters = BvhBuildParams {
        max_prims_per_leaf: 1,
        post_collapse_reinsertion_batch_ratio_multiplier: 0.0,
        ..BvhBuildParams::medium_build()
    };
    let mut build_time = Duration::ZERO;
    let bvh = build_bvh2(&boxes, parameters, &mut build_time);
    widen(&bvh, &leaves_of(&bvh, primitives), primitives)
}

/// Which nodes of the binary tree become leaves. Up to four triangles become one where the surface area heuristic finds a block cheaper
/// than what is below: it costs the same however many triangles it has. Everything else is a leaf of its own.
fn leaves_of(bvh: &Bvh2, primitives: &[LeafPrimitive]) -> Vec<bool> {
    let mut is_leaf = vec![false; bvh.nodes.len()];
    let mut costs = vec![0.0_f32; bvh.nodes.len()];
    // Triangles below; more than fit into a block where there is anything else.
    let mut triangles = vec![0_usize; bvh.nodes.len()];
    for &number in top_down(bvh).iter().rev() {
        let node = &bvh.nodes[number];
        let area = node.aabb().half_area();
        if node.is_leaf() {
            let is_triangle = primitives[own_primitive(bvh, number)].is_triangle();
            triangles[number] = if is_triangle { 1 } else { BLOCK + 1 };
            costs[number] = area;
            is_leaf[number] = true;
            continue;
        }
        let [a, b] = children(bvh, number);
        triangles[number] = triangles[a].saturating_add(triangles[b]);
        costs[number] = costs[a] + costs[b] + NODE_COST * area;
        if triangles[number] <= BLOCK && area <= costs[number] {
            costs[number] = area;
            is_leaf[number] = true;
        }
    }
    is_leaf
}

fn children(bvh: &Bvh2, number: usize) -> [usize; 2] {
    let first = bvh.nodes[number].first_index as usize;
    [first, first + 1]
}

/// All nodes, parents before their children.
fn top_down(bvh: &Bvh2) -> Vec<usize> {
    let mut order = vec![0];
    let mut next = 0;
    while let Some(&number) = order.get(next) {
        if !bvh.nodes[number].is_leaf() {
            order.extend(children(bvh, number));
        }
        next += 1;
    }
    order
}

/// The primitive of a leaf of the binary tree, which has one.
fn own_primitive(bvh: &Bvh2, leaf: usize) -> usize {
    bvh.primitive_indices[bvh.nodes[leaf].first_index as usize] as usize
}

/// All primitives below a node.
fn primitives_below(bvh: &Bvh2, number: usize) -> Vec<usize> {
    let (mut below, mut todo) = (Vec::with_capacity(BLOCK), vec![number]);
    while let Some(number) = todo.pop() {
        if bvh.nodes[number].is_leaf() {
            below.push(own_primitive(bvh, number));
        } else {
            todo.extend(children(bvh, number));
        }
    }
    below
}

/// Makes nodes of eight boxes: opens the box with the largest area until there are eight.
fn widen(bvh: &Bvh2, is_leaf: &[bool], primitives: &[LeafPrimitive]) -> Parts {
    let mut parts = Parts::default();
    parts.nodes.push(Node::EMPTY);
    let mut todo = vec![(0, 0)];
    while let Some((place, number)) = todo.pop() {
        let mut boxes = if is_leaf[number] {
            vec![number]
        } else {
            children(bvh, number).to_vec()
        };
        let area = |&number: &usize| bvh.nodes[number].aabb().half_area();
        while boxes.len() < WIDTH {
            let inner = (0..boxes.len()).filter(|&i| !is_leaf[boxes[i]]);
            let Some(largest) = inner.max_by(|&a, &b| area(&boxes[a]).total_cmp(&area(&boxes[b]))) else {
                break;
            };
            let opened = boxes.swap_remove(largest);
            boxes.extend(children(bvh, opened));
        }
        for (lane, &number) in boxes.iter().enumerate() {
            let reference = if is_leaf[number] {
                parts.push_leaf(&primitives_below(bvh, number), primitives)
            } else {
                let next = parts.nodes.len();
                parts.nodes.push(Node::EMPTY);
                todo.push((next, number));
                Reference::new(Reference::NODE, next as u32)
            };
            parts.nodes[place].put(lane, bvh.nodes[number].aabb(), reference);
        }
    }
    parts
}

impl Parts {
    fn push_leaf(&mut self, below: &[usize], primitives: &[LeafPrimitive]) -> Reference {
        if let &[only] = below
            && !primitives[only].is_triangle()
        {
            self.shapes.push(Shape::new(primitives[only]));
            return Reference::new(Reference::SHAPE, self.shapes.len() as u32 - 1);
        }
        let triangles: Vec<LeafPrimitive> = below.iter().map(|&i| primitives[i]).collect();
        self.blocks.push(Block::new(&triangles));
        Reference::new(Reference::BLOCK, self.blocks.len() as u32 - 1)
    }

    /// Memory of a stack that has room for all that a walk leaves for later at a time.
    pub fn stack_len(&self) -> usize {
        let mut needs = vec![0; self.nodes.len()];
        // Nodes come before those below them.
        for (number, node) in self.nodes.iter().enumerate().rev() {
            let boxes = node.planes[0].iter().filter(|low| low.is_finite()).count();
            let below = node
                .children
                .iter()
                .take(boxes)
                .filter_map(|child| match child.target() {
                    Target::Node(below) => Some(needs[below as usize]),
                    _ => None,
                });
            needs[number] = boxes.max(below.max().map_or(0, |need: usize| need + boxes - 1));
        }
        needs.first().copied().unwrap_or(0) + Stack::SLACK
    }
}
