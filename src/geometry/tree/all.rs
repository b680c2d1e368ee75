//! Every ray against everything, without a tree: for scenes of a few primitives.
//!
//! Sixteen rays at a time are held against one triangle after another in f32, by a sieve that lets a triangle through wherever rounding
//! might hide a hit. What it lets through, a little more than one triangle for each ray, is intersected as in leaves of the tree, four
//! rays at a time.

use super::block::BLOCK;
use super::bundle::{BUNDLE, Bundle, CHUNK, Sift, Sifted};
use super::facet::{Facet, Frame};
use super::intersect::Pairs;
use super::lanes::{Lanes, Task};
use super::query::Query;
use super::shape::Shape;
use super::walk::{Prepared, Queue};
use crate::geometry::leaf::LeafPrimitive;
use crate::geometry::triangle::RayFrame;
use glam::Vec3;

/// A few primitives, of which every ray looks at all.
#[derive(Clone, Debug)]
pub struct Few {
    triangles: Vec<Shape>,
    /// The triangles again, for the sieve.
    facets: Vec<Facet>,
    /// Where the sieve's numbers are small.
    frame: Frame,
    /// What is no triangle.
    others: Vec<Shape>,
    /// The largest coordinate.
    reach: f64,
}

impl Few {
    /// From this many rays on, looking at everything for all of them at once is faster than the tree one by one.
    pub const LEAST_RAYS: usize = BUNDLE / 2;

    /// Primitives in a box.
    pub fn new(primitives: &[LeafPrimitive], (low, high): (Vec3, Vec3)) -> Self {
        let frame = Frame::around(low, high);
        let shape = |&primitive| Shape::new(primitive);
        let triangles = primitives.iter().filter(|primitive| primitive.is_triangle());
        let others = primitives.iter().filter(|primitive| !primitive.is_triangle());
        Self {
            facets: triangles
                .clone()
                .map(|triangle| Facet::new(triangle.corners(), frame))
                .collect(),
            triangles: triangles.map(shape).collect(),
            others: others.map(shape).collect(),
            frame,
            reach: f64::from(low.abs().max(high.abs()).max_element()),
        }
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        (self.triangles.len() + self.others.len()) * size_of::<Shape>() + size_of_val(self.facets.as_slice())
    }
}

/// Everything, for every ray.
pub struct All<'a, J>(pub &'a Few, pub &'a mut J);

impl<J: Queue> Task for All<'_, J> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self(few, queue) = self;
        if queue.len() == 0 {
            return;
        }
        let (mut bundle, mut sifted) = (Bundle::EMPTY, Sifted::NOTHING);
        let mut asked = Asked::<J::Query> {
            reach: few.reach,
            frames: [queue.ray(0); BUNDLE],
            prepared: 0,
            queries: [J::Query::new(); BUNDLE],
        };
        for first in (0..queue.len()).step_by(BUNDLE) {
            let count = BUNDLE.min(queue.len() - first);
            for place in 0..count {
                let (origin, direction) = queue.line(first + place);
                bundle.put(place, origin, direction, J::Query::ENDS);
            }
            bundle.prepare(few.frame, J::Query::ENDS);
            (asked.queries, asked.prepared) = ([J::Query::new(); BUNDLE], 0);
            // Rays that are still asked about.
            let mut open = u32::MAX >> (32 - count);
            let mut blocked = 0;
            for (facets, triangles) in few.facets.chunks(CHUNK).zip(few.triangles.chunks(CHUNK)) {
                lanes.run(Sift {
                    facets,
                    bundle: &mut bundle,
                    ends: J::Query::ENDS,
                    sifted: &mut sifted,
                });
                blocked |= sifted.blocked & open;
                open &= !blocked;
                asked.look_at_the_nearest(lanes, queue, first, open & sifted.certain, &mut sifted, triangles);
                for (triangle, &rays) in triangles.iter().zip(&sifted.open) {
                    let mut todo = rays & open;
                    while todo != 0 {
                        let place = todo.trailing_zeros() as usize & (BUNDLE - 1);
                        todo &= todo - 1;
                        asked.prepare(queue, first, place);
                        let ray = Prepared::new(asked.frames[place], few.reach);
                        asked.queries[place].shape(triangle, &ray);
                    }
                }
            }
            for place in 0..count {
                if open >> place & 1 != 0 && !few.others.is_empty() {
                    asked.prepare(queue, first, place);
                    let ray = Prepared::new(asked.frames[place], few.reach);
                    for shape in &few.others {
                        asked.queries[place].shape(shape, &ray);
                    }
                }
                if blocked >> place & 1 != 0 {
                    asked.queries[place].learn_blocked();
                }
                queue.answer(first + place, &asked.queries[place]);
            }
        }
    }
}

/// What the rays of a bundle ask.
struct Asked<Q> {
    /// The largest coordinate of what there is.
    reach: f64,
    frames: [RayFrame; BUNDLE],
    /// A bit for each frame that is this bundle's.
    prepared: u32,
    queries: [Q; BUNDLE],
}

impl<Q: Query> Asked<Q> {
    #[inline(always)]
    fn prepare<J: Queue>(&mut self, queue: &J, first: usize, place: usize) {
        if self.prepared >> place & 1 == 0 {
            self.frames[place] = queue.ray(first + place);
            self.prepared |= 1 << place;
        }
    }

    /// Looks, with every ray of a mask, at the nearest triangle that it crosses for certain, and takes these off what is open.
    ///
    /// Without branches on what the rays are about, for that is anybody's guess.
    #[inline(always)]
    fn look_at_the_nearest<L: Lanes, J: Queue>(
        &mut self,
        lanes: L,
        queue: &J,
        first: usize,
        rays: u32,
        sifted: &mut Sifted,
        triangles: &[Shape],
    ) {
        const FOUR: u32 = (1 << BLOCK) - 1;
        for from in (0..BUNDLE).step_by(BLOCK) {
            let mask = rays >> from & FOUR;
            if mask == 0 {
                continue;
            }
            let mut pairs = Pairs::NONE;
            let mut numbers = [0; BLOCK];
            for (pair, own) in numbers.iter_mut().enumerate() {
                let place = from + pair;
                // The first triangle in the place of none: what comes of it is not looked at.
                let is_one = mask >> pair & 1;
                let number = (sifted.nearest[place].max(0.0) as usize).min(triangles.len() - 1);
                sifted.open[number] &= !(is_one << place);
                self.frames[place] = queue.ray((first + place).min(queue.len() - 1));
                pairs.put(pair, &self.frames[place], triangles[number].primitive.corners());
                *own = number;
            }
            self.prepared |= FOUR << from;
            let crossings = pairs.cross(lanes);
            for (pair, &number) in numbers.iter().enumerate() {
                let query = &mut self.queries[from + pair];
                let t = crossings.t[pair];
                if mask >> pair & 1 == 0 || !query.counts(t) {
                    continue;
                }
                // Who crosses a triangle for certain enters its box too, but not always before the distance that rounding leaves of a near hit.
                let ray = Prepared::new(self.frames[from + pair], self.reach);
                let Shape { primitive, bounds } = &triangles[number];
                if ray.boxes.enters(*bounds, query.box_limit(t, &ray)) {
                    let uv = [crossings.u[pair], crossings.v[pair]].into();
                    query.take(t, primitive.instance, primitive.primitive, uv, &ray);
                }
            }
        }
    }
}
