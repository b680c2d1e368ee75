//! Walking the tree with many rays at a time.
//!
//! Rays that look into a node next take that step one after another, then those that look into a block theirs, and so on: no step has
//! to find out what it is about, and nothing that one ray does waits for another, so that the processor works on several at once. Where
//! the tree is larger than the caches, what a step needs was asked for when the ray queued for it.

use super::Tree;
use super::lanes::{Lanes, Task};
use super::node::Reference;
use super::prefetch::Prefetch;
use super::query::Query;
use super::stack::{Entry, Stack};
use super::walk::{Prepared, Queue, look_into};
use crate::geometry::tracer::MOST_RAYS;
use crate::tolerance::CULL_SLACK;

/// The most rays that are on their way at a time.
const MOST: usize = MOST_RAYS as usize;

/// Many rays at a time.
pub struct Interleaved<'a, J> {
    /// What they walk.
    pub tree: &'a Tree,
    /// The rays.
    pub queue: &'a mut J,
    /// How many at a time, up to [`MOST`].
    pub rays: usize,
}

/// A ray on its way.
#[derive(Clone, Copy)]
struct Traveller<Q> {
    ray: Prepared,
    query: Q,
    /// Which of its kind it looks into next.
    next: u32,
    /// How many boxes it has left for later, the end included.
    left: u32,
    /// Which ray of the queue it is.
    number: u32,
}

/// Who queues for what: places of travellers, by the kind of their next step.
struct Waiting {
    places: [[u8; MOST]; Reference::KINDS],
    counts: [usize; Reference::KINDS],
}

impl Waiting {
    /// Queues for a step, without a branch on which.
    #[inline(always)]
    fn push(&mut self, kind: usize, place: u8) {
        let kind = kind & (Reference::KINDS - 1);
        self.places[kind][self.counts[kind] & (MOST - 1)] = place;
        self.counts[kind] += 1;
    }

    /// Takes everyone who queues for a step.
    #[inline(always)]
    fn take(&mut self, kind: usize) -> ([u8; MOST], usize) {
        (self.places[kind], std::mem::take(&mut self.counts[kind]))
    }
}

/// All that are on their way.
struct Journey<'a, J: Queue> {
    tree: &'a Tree,
    queue: &'a mut J,
    travellers: Vec<Traveller<J::Query>>,
    /// Their stacks, one behind the other.
    memory: Vec<Entry>,
    waiting: Waiting,
    prefetch: Prefetch<{ Reference::KINDS }>,
    /// Rays that have set out.
    started: usize,
}

impl<J: Queue> Journey<'_, J> {
    /// Sends the next ray of the queue on its way, if there is one, from a place that is free.
    #[inline(always)]
    fn set_out(&mut self, place: usize) {
        if self.started == self.queue.len() {
            return;
        }
        let room = self.tree.stack_len;
        let stack = Stack::empty(&mut self.memory[place * room..(place + 1) * room]);
        self.travellers[place] = Traveller {
            ray: Prepared::new(self.queue.ray(self.started), self.tree.reach),
            query: J::Query::new(),
            next: Entry::ROOT.reference().number() as u32,
            left: stack.len() as u32,
            number: self.started as u32,
        };
        self.started += 1;
        self.waiting.push(Reference::NODE, place as u8);
    }

    /// Takes the next step of a kind of everyone who queues for it.
    #[inline(always)]
    fn step<L: Lanes>(&mut self, lanes: L, kind: usize) {
        let (places, count) = self.waiting.take(kind);
        let room = self.tree.stack_len;
        for &place in &places[..count] {
            let place = place as usize;
            let traveller = &mut self.travellers[place];
            let memory = &mut self.memory[place * room..(place + 1) * room];
            let mut stack = Stack::resume(memory, traveller.left as usize);
            let number = traveller.next as usize;
            let query = &mut traveller.query;
            match kind {
                Reference::NODE => {
                    look_into(
                        lanes,
                        &self.tree.nodes[number],
                        &traveller.ray,
                        query.limit(),
                        &mut stack,
                    );
                }
                Reference::BLOCK => query.block(lanes, &self.tree.blocks[number], &traveller.ray),
                Reference::SHAPE => query.shape(&self.tree.shapes[number], &traveller.ray),
                _ => {}
            }
            let next = if query.is_answered() {
                Entry::END
            } else {
                stack.pop(query.limit() * CULL_SLACK)
            };
            let reference = next.reference();
            traveller.left = stack.len() as u32;
            traveller.next = reference.number() as u32;
            self.waiting.push(reference.kind(), place as u8);
            self.prefetch.fetch(reference.kind(), reference.number());
        }
    }

    /// Hands in the answers of those who have arrived, and sends others on their way.
    #[inline(always)]
    fn arrive(&mut self) {
        let (places, count) = self.waiting.take(Reference::OVER);
        for &place in &places[..count] {
            let traveller = &self.travellers[place as usize];
            self.queue.answer(traveller.number as usize, &traveller.query);
            self.set_out(place as usize);
        }
    }
}

impl<J: Queue> Task for Interleaved<'_, J> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { tree, queue, rays } = self;
        let rays = rays.clamp(1, MOST).min(queue.len());
        if rays == 0 {
            return;
        }
        let mut journey = Journey {
            tree,
            travellers: vec![
                Traveller {
                    ray: Prepared::new(queue.ray(0), tree.reach),
                    query: J::Query::new(),
                    next: 0,
                    left: 0,
                    number: 0,
                };
                rays
            ],
            queue,
            memory: vec![Entry::ROOT; tree.stack_len * rays],
            waiting: Waiting {
                places: [[0; MOST]; Reference::KINDS],
                counts: [0; Reference::KINDS],
            },
            prefetch: Prefetch::new()
                .with(Reference::NODE, &tree.nodes)
                .with(Reference::BLOCK, &tree.blocks),
            started: 0,
        };
        for place in 0..rays {
            journey.set_out(place);
        }
        while journey.waiting.counts != [0; Reference::KINDS] {
            journey.step(lanes, Reference::NODE);
            journey.step(lanes, Reference::BLOCK);
            if journey.waiting.counts[Reference::SHAPE] > 0 {
                journey.step(lanes, Reference::SHAPE);
            }
            journey.arrive();
        }
    }
}
