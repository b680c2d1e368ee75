//! The tree over primitives: nodes of eight boxes over blocks of four triangles, and the ways to walk it.
//!
//! obvhs builds a binary tree, of which nodes are merged until they have eight children (Wald, Benthin and Boulos 2008, "Getting rid of
//! packets"): a node is intersected at once, its children are visited nearest first, and what lies behind the nearest hit is dropped
//! when it is taken from the stack. Of many rays sixteen or so are on their way at a time: each takes a step and asks for the memory of
//! its next, which arrives while the others take theirs. In scenes of a few primitives many rays are held against all of them, without
//! a tree.
//!
//! Triangles are intersected in f64, four at a time, operation by operation as [`RayFrame::cross`](super::triangle::RayFrame::cross)
//! does with one. Boxes are only ever entered too often. So hits are the same to the bit whichever way they are found, and by
//! whichever instructions.

mod all;
mod block;
mod box_ray;
mod build;
mod bundle;
mod facet;
mod intersect;
mod lanes;
mod node;
mod prefetch;
mod query;
mod shape;
mod stack;
mod stream;
mod walk;

use query::Query;
pub use query::{Blocked, Nearest};
pub use walk::Queue;

use super::leaf::LeafPrimitive;
use super::tracer::{Instructions, Tracer, Tracing};
use all::{All, Few};
use block::Block;
use glam::Vec3;
#[cfg(target_arch = "x86_64")]
use lanes::{Avx2, Avx512};
use lanes::{Lanes, Plain};
use node::Node;
use shape::Shape;
use stream::Interleaved;
use walk::OneByOne;

/// A tree of boxes over primitives.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    nodes: Vec<Node>,
    blocks: Vec<Block>,
    /// Primitives that are no triangles.
    shapes: Vec<Shape>,
    /// All primitives without boxes, where that is how rays are traced.
    few: Option<Few>,
    /// The most that a walk leaves for later at a time.
    stack_len: usize,
    /// The box around everything.
    bounds: Option<(Vec3, Vec3)>,
    /// Its largest coordinate.
    reach: f64,
}

fn bounds_of(primitives: &[LeafPrimitive]) -> Option<(Vec3, Vec3)> {
    let boxes = primitives.iter().map(LeafPrimitive::bounds);
    boxes
        .reduce(|a, b| a.union(&b))
        .map(|all| (all.min.into(), all.max.into()))
}

impl Tree {
    /// Builds a tree. The order of `primitives` shapes it, threads do not.
    pub fn build(primitives: &[LeafPrimitive]) -> Self {
        let parts = build::build(primitives);
        let bounds = bounds_of(primitives);
        Self {
            stack_len: parts.stack_len(),
            bounds,
            reach: bounds.map_or(0.0, |(low, high)| f64::from(low.abs().max(high.abs()).max_element())),
            nodes: parts.nodes,
            blocks: parts.blocks,
            shapes: parts.shapes,
            ..Self::default()
        }
    }

    /// Sees to it that all primitives can be looked at without boxes, or no longer.
    pub fn keep_few(&mut self, primitives: Option<&[LeafPrimitive]>) {
        self.few = primitives
            .zip(self.bounds)
            .map(|(primitives, bounds)| Few::new(primitives, bounds));
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.blocks.as_slice())
            + size_of_val(self.shapes.as_slice())
            + self.few.as_ref().map_or(0, Few::bytes)
    }

    /// The box around everything, or `None` if there is nothing.
    pub const fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.bounds
    }

    /// Answers every ray of a queue.
    pub fn answer<J: Queue>(&self, tracing: Tracing, queue: &mut J) {
        if self.nodes.is_empty() {
            return (0..queue.len()).for_each(|number| queue.answer(number, &J::Query::new()));
        }
        let tracer = tracing.tracer;
        match tracing.instructions {
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512 => {
                if let Some(lanes) = Avx512::detect() {
                    return self.answer_with(lanes, tracer, queue);
                }
            }
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => {
                if let Some(lanes) = Avx2::detect() {
                    return self.answer_with(lanes, tracer, queue);
                }
            }
            _ => {}
        }
        self.answer_with(Plain, tracer, queue);
    }

    fn answer_with<L: Lanes, J: Queue>(&self, lanes: L, tracer: Tracer, queue: &mut J) {
        if let Some(few) = &self.few
            && queue.len() >= Few::LEAST_RAYS
        {
            return lanes.run(All(few, queue));
        }
        match tracer {
            Tracer::Interleaved(rays) if queue.len() > 1 => lanes.run(Interleaved {
                tree: self,
                queue,
                rays: rays as usize,
            }),
            _ => lanes.run(OneByOne(self, queue)),
        }
    }
}
