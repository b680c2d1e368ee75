//! Walking the tree one ray after another, and what all walks share.

use super::Tree;
use super::box_ray::BoxRay;
use super::intersect::enter;
use super::lanes::{Lanes, Task};
use super::node::{Node, Target};
use super::query::Query;
use super::stack::{Entry, Stack};
use crate::geometry::triangle::RayFrame;
use crate::tolerance::CULL_SLACK;
use glam::{DVec3, Vec3};

/// Rays that ask the same, and where answers go.
pub trait Queue {
    /// What they ask.
    type Query: Query;
    /// How many there are.
    fn len(&self) -> usize;
    /// One of them: its origin and direction.
    fn line(&self, number: usize) -> (Vec3, DVec3);
    /// One of them, prepared for triangles.
    #[inline(always)]
    fn ray(&self, number: usize) -> RayFrame {
        let (origin, direction) = self.line(number);
        RayFrame::new(origin, direction)
    }
    /// Takes the answer for one of them.
    fn answer(&mut self, number: usize, answer: &Self::Query);
}

/// A ray prepared for boxes and triangles.
#[derive(Clone, Copy)]
pub struct Prepared {
    pub frame: RayFrame,
    pub boxes: BoxRay,
    /// How far off distances of triangles may be that are not seen edge-on, whatever they are.
    pub slack: f64,
}

impl Prepared {
    /// Prepares a ray for what has coordinates up to `reach`.
    #[inline(always)]
    pub fn new(frame: RayFrame, reach: f64) -> Self {
        Self {
            slack: frame.distance_slack(reach),
            boxes: BoxRay::new(&frame),
            frame,
        }
    }
}

/// Leaves the boxes of a node that the ray enters for later, the nearest of them on top.
#[inline(always)]
pub fn look_into<L: Lanes>(lanes: L, node: &Node, ray: &Prepared, limit: f32, stack: &mut Stack<'_>) {
    let (mask, distances) = enter(lanes, node, &ray.boxes, limit);
    let count = lanes.leave(mask, distances, &node.children, stack.room());
    stack.keep(count);
}

/// Entries of a stack that a walk has without asking for memory.
const OWN_STACK: usize = 96;

/// One ray after another.
pub struct OneByOne<'a, J>(pub &'a Tree, pub &'a mut J);

impl<J: Queue> Task for OneByOne<'_, J> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self(tree, queue) = self;
        let mut own = [Entry::ROOT; OWN_STACK];
        let mut more = Vec::new();
        let memory = if tree.stack_len <= OWN_STACK {
            &mut own[..]
        } else {
            more.resize(tree.stack_len, Entry::ROOT);
            &mut more[..]
        };
        for number in 0..queue.len() {
            let ray = Prepared::new(queue.ray(number), tree.reach);
            let mut query = J::Query::new();
            let mut stack = Stack::empty(memory);
            let mut next = Entry::ROOT;
            loop {
                match next.reference().target() {
                    Target::Node(node) => {
                        look_into(lanes, &tree.nodes[node as usize], &ray, query.limit(), &mut stack);
                    }
                    Target::Block(block) => query.block(lanes, &tree.blocks[block as usize], &ray),
                    Target::Shape(shape) => query.shape(&tree.shapes[shape as usize], &ray),
                    Target::End => break,
                }
                if query.is_answered() {
                    break;
                }
                next = stack.pop(query.limit() * CULL_SLACK);
            }
            queue.answer(number, &query);
        }
    }
}
