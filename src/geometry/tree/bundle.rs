//! Sixteen rays against triangles, in f32: which of them the exact test has to look at.

use super::facet::{Facet, Frame};
pub use super::lanes::wide::BUNDLE;
use super::lanes::{Lanes, Task};
use crate::tolerance::F32_ROUNDING;
use glam::{DVec3, Vec3};

/// Facets that are gone through at a time.
pub const CHUNK: usize = 64;

/// A ray is edge-on where the normal, its components' sizes adding to one, has less than this along the direction, the largest component
/// of which is one: neither the sieve nor the exact test tell well at which distance it crosses.
pub const EDGE_ON: f32 = 1.0 / 4096.0;

/// How far off that is by rounding: 7 u; the rest is for the roundings of the fractions made with it.
const ALONG_SLACK: f32 = 16.0 * F32_ROUNDING;

/// A number for each ray.
type Each = [f32; BUNDLE];

/// Rays of unknown length, or segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Only what is nearest matters.
    AtTheNearest,
    /// It matters whether there is anything before the end, which is origin + direction.
    AtTheTarget,
}

/// Sixteen rays in the sieve's frame.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Bundle {
    origin: [[f64; BUNDLE]; 3],
    /// Of segments, their ends.
    target: [[f64; BUNDLE]; 3],
    /// Its largest component is one.
    direction: [Each; 3],
    /// origin × direction.
    moment: [Each; 3],
    /// The largest coordinate of the origin.
    reach: Each,
    /// What the exact test's rounding adds to the slack of sides.
    slack: Each,
    /// (1 + reach)², the target's reach included, which heights over planes are off by in some proportion.
    square: Each,
    /// Of rays, the distance of the nearest hit that is certain, as a fraction: that spares divisions, as products are compared as well.
    over: Each,
    under: Each,
}

impl Bundle {
    /// A bundle of nothing.
    pub const EMPTY: Self = Self {
        origin: [[0.0; BUNDLE]; 3],
        target: [[0.0; BUNDLE]; 3],
        direction: [[0.0; BUNDLE]; 3],
        moment: [[0.0; BUNDLE]; 3],
        reach: [0.0; BUNDLE],
        slack: [0.0; BUNDLE],
        square: [0.0; BUNDLE],
        over: [0.0; BUNDLE],
        under: [0.0; BUNDLE],
    };

    /// Puts a ray into a place.
    #[inline(always)]
    pub fn put(&mut self, place: usize, origin: Vec3, direction: DVec3, ends: Ends) {
        let place = place & (BUNDLE - 1);
        let origin = origin.as_dvec3();
        for axis in 0..3 {
            self.origin[axis][place] = origin[axis];
            self.direction[axis][place] = direction[axis] as f32;
            if ends == Ends::AtTheTarget {
                self.target[axis][place] = origin[axis] + direction[axis];
            }
        }
    }

    /// Moves all rays that were put into it to the sieve's frame.
    #[inline(always)]
    pub fn prepare(&mut self, frame: Frame, ends: Ends) {
        /// Lengths that f32 can square, and divide by.
        const LARGEST: f32 = 1e15;
        /// With a larger reach nothing is said of heights.
        const FAR: f32 = 32.0;
        let (center, scale) = (frame.center.as_dvec3().to_array(), f64::from(frame.scale));
        for i in 0..BUNDLE {
            let origin = [0, 1, 2].map(|axis| (self.origin[axis][i] - center[axis]) * scale);
            let [x, y, z] = origin.map(|coordinate| coordinate as f32);
            let [dx, dy, dz] = [0, 1, 2].map(|axis| self.direction[axis][i]);
            let (length, reach) = (largest([dx, dy, dz]), largest([x, y, z]));
            let is_usable = (length > 1.0 / LARGEST) & (length < LARGEST) & (reach < LARGEST);
            // Of others nothing is known, which is what numbers that are none say of everything they are compared with.
            let inverse = if is_usable { 1.0 / length } else { f32::NAN };
            let [dx, dy, dz] = [dx * inverse, dy * inverse, dz * inverse];
            [self.origin[0][i], self.origin[1][i], self.origin[2][i]] = origin;
            [self.direction[0][i], self.direction[1][i], self.direction[2][i]] = [dx, dy, dz];
            self.moment[0][i] = y * dz - z * dy;
            self.moment[1][i] = z * dx - x * dz;
            self.moment[2][i] = x * dy - y * dx;
            let square = |reach: f32| (1.0 + reach) * (1.0 + reach);
            self.reach[i] = reach;
            self.slack[i] = 1e-14 * square(reach);
            let mut whole_reach = reach;
            if ends == Ends::AtTheTarget {
                let target = [0, 1, 2].map(|axis| (self.target[axis][i] - center[axis]) * scale);
                [self.target[0][i], self.target[1][i], self.target[2][i]] = target;
                whole_reach = reach.max(largest(target.map(|coordinate| coordinate as f32)));
            }
            self.square[i] = if whole_reach < FAR {
                square(whole_reach)
            } else {
                f32::INFINITY
            };
            (self.over[i], self.under[i]) = (f32::INFINITY, 1.0);
        }
    }
}

#[inline(always)]
fn largest([x, y, z]: [f32; 3]) -> f32 {
    x.abs().max(y.abs()).max(z.abs())
}

/// What the sieve lets through of up to [`CHUNK`] facets.
#[derive(Debug)]
#[repr(C, align(64))]
pub struct Sifted {
    /// The least that distances may be, `over` and `under`.
    lows: [[Each; 2]; CHUNK],
    /// For each facet, a bit for each ray that the exact test has to look at.
    pub open: [u32; CHUNK],
    /// For each ray, the number of the nearest facet that it crosses for certain, if that is nearer than those of chunks before.
    pub nearest: Each,
    /// A bit for each ray that has such a facet.
    pub certain: u32,
    /// A bit for each segment that is blocked for certain.
    pub blocked: u32,
}

impl Sifted {
    /// Nothing.
    pub const NOTHING: Self = Self {
        lows: [[[0.0; BUNDLE]; 2]; CHUNK],
        open: [0; CHUNK],
        nearest: [0.0; BUNDLE],
        certain: 0,
        blocked: 0,
    };
}

/// Which rays cross a facet.
struct Crossed<L: Lanes> {
    /// It may be so.
    may: L::Flags,
    /// It is so for certain.
    does: L::Flags,
}

/// One part of a bundle, in registers.
struct Part<L: Lanes> {
    origin: [L::Doubles; 3],
    direction: [L::Numbers; 3],
    moment: [L::Numbers; 3],
    reach: L::Numbers,
    slack: L::Numbers,
    square: L::Numbers,
}

#[inline(always)]
fn three<L: Lanes>(lanes: L, numbers: &[Each; 3], part: usize) -> [L::Numbers; 3] {
    [
        lanes.wide(&numbers[0], part),
        lanes.wide(&numbers[1], part),
        lanes.wide(&numbers[2], part),
    ]
}

/// a · b + c.
#[inline(always)]
fn dot_add<L: Lanes>(lanes: L, a: [L::Numbers; 3], b: &[f32; 3], c: L::Numbers) -> L::Numbers {
    let c = lanes.wide_mul_add(a[0], lanes.wide_splat(b[0]), c);
    let c = lanes.wide_mul_add(a[1], lanes.wide_splat(b[1]), c);
    lanes.wide_mul_add(a[2], lanes.wide_splat(b[2]), c)
}

/// a · b.
#[inline(always)]
fn dot<L: Lanes>(lanes: L, a: [L::Numbers; 3], b: &[f32; 3]) -> L::Numbers {
    let c = lanes.wide_mul(a[0], lanes.wide_splat(b[0]));
    let c = lanes.wide_mul_add(a[1], lanes.wide_splat(b[1]), c);
    lanes.wide_mul_add(a[2], lanes.wide_splat(b[2]), c)
}

impl<L: Lanes> Part<L> {
    #[inline(always)]
    fn of(lanes: L, bundle: &Bundle, part: usize) -> Self {
        Self {
            origin: [
                lanes.doubles(&bundle.origin[0], part),
                lanes.doubles(&bundle.origin[1], part),
                lanes.doubles(&bundle.origin[2], part),
            ],
            direction: three(lanes, &bundle.direction, part),
            moment: three(lanes, &bundle.moment, part),
            reach: lanes.wide(&bundle.reach, part),
            slack: lanes.wide(&bundle.slack, part),
            square: lanes.wide(&bundle.square, part),
        }
    }

    #[inline(always)]
    fn side(&self, lanes: L, facet: &Facet, edge: usize) -> L::Numbers {
        let along = dot(lanes, self.direction, &facet.normals[edge]);
        dot_add(lanes, self.moment, &facet.edges[edge], along)
    }

    /// Whether the rays' lines cross a facet. Where a number is none, everything may be.
    #[inline(always)]
    fn cross(&self, lanes: L, facet: &Facet) -> Crossed<L> {
        let [a, b, c] = [
            self.side(lanes, facet, 0),
            self.side(lanes, facet, 1),
            self.side(lanes, facet, 2),
        ];
        let least = lanes.wide_min(lanes.wide_min(a, b), c);
        let largest = lanes.wide_max(lanes.wide_max(a, b), c);
        let own = lanes.wide_add(self.slack, lanes.wide_splat(facet.slack));
        let slack = lanes.wide_mul_add(self.reach, lanes.wide_splat(facet.slack_by_reach), own);
        let minus_slack = lanes.wide_sub(lanes.wide_splat(0.0), slack);
        Crossed {
            may: lanes.either(lanes.wide_not_lt(least, minus_slack), lanes.wide_not_lt(slack, largest)),
            does: lanes.either(lanes.wide_lt(slack, least), lanes.wide_lt(largest, minus_slack)),
        }
    }

    /// How far off heights over a facet's plane may be.
    #[inline(always)]
    fn height_slack(&self, lanes: L, facet: &Facet) -> L::Numbers {
        lanes.wide_mul(self.square, lanes.wide_splat(facet.height_slack))
    }
}

/// How high points are over a facet's plane.
#[inline(always)]
fn height<L: Lanes>(lanes: L, facet: &Facet, points: [L::Doubles; 3]) -> L::Numbers {
    lanes.minus_dot(facet.height, &facet.plane_f64, points)
}

/// The number of no facet.
const NONE: f32 = -1.0;

/// Looking at up to [`CHUNK`] facets with all rays of a bundle.
pub struct Sift<'a> {
    /// What is looked at.
    pub facets: &'a [Facet],
    /// The rays.
    pub bundle: &'a mut Bundle,
    /// Whether they are segments.
    pub ends: Ends,
    /// What comes of it.
    pub sifted: &'a mut Sifted,
}

impl Task for Sift<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self {
            facets,
            bundle,
            ends,
            sifted,
        } = self;
        sifted.open = [0; CHUNK];
        (sifted.certain, sifted.blocked) = (0, 0);
        for part in 0..BUNDLE / L::WIDTH {
            match ends {
                Ends::AtTheNearest => up_to_the_nearest(lanes, facets, bundle, part, sifted),
                Ends::AtTheTarget => up_to_the_target(lanes, facets, bundle, part, sifted),
            }
        }
    }
}

#[inline(always)]
fn up_to_the_nearest<L: Lanes>(lanes: L, facets: &[Facet], bundle: &mut Bundle, part: usize, sifted: &mut Sifted) {
    let rays = Part::of(lanes, bundle, part);
    let shift = part * L::WIDTH;
    let (mut over, mut under) = (lanes.wide(&bundle.over, part), lanes.wide(&bundle.under, part));
    let mut may = [0; CHUNK];
    let (zero, none) = (lanes.wide_splat(0.0), lanes.wide_splat(NONE));
    let (mut nearest, mut number) = (none, 0.0);
    for (facet, (low, may)) in facets.iter().zip(sifted.lows.iter_mut().zip(&mut may)) {
        let crossed = rays.cross(lanes, facet);
        let along = dot(lanes, rays.direction, &facet.plane);
        let height = lanes.wide_turned(height(lanes, facet, rays.origin), along);
        let (slack, share) = (rays.height_slack(lanes, facet), lanes.wide_abs(along));
        let (low_over, high_over) = (lanes.wide_sub(height, slack), lanes.wide_add(height, slack));
        let low_under = lanes.wide_add(share, lanes.wide_splat(ALONG_SLACK));
        let high_under = lanes.wide_sub(share, lanes.wide_splat(EDGE_ON));
        let is_edge_on = lanes.wide_not_lt(zero, high_under);
        let may_front = lanes.either(is_edge_on, lanes.wide_not_lt(high_over, zero));
        let is_front = lanes.both(lanes.wide_lt(zero, low_over), lanes.wide_lt(zero, high_under));
        *may = lanes.bits(lanes.both(crossed.may, may_front));
        let low_over = lanes.wide_select(is_edge_on, lanes.wide_splat(f32::NEG_INFINITY), low_over);
        lanes.wide_put(&mut low[0], part, low_over);
        lanes.wide_put(&mut low[1], part, low_under);
        let is_nearer = lanes.wide_lt(lanes.wide_mul(high_over, under), lanes.wide_mul(over, high_under));
        let is_nearest = lanes.both(lanes.both(crossed.does, is_front), is_nearer);
        over = lanes.wide_select(is_nearest, high_over, over);
        under = lanes.wide_select(is_nearest, high_under, under);
        nearest = lanes.wide_select(is_nearest, lanes.wide_splat(number), nearest);
        number += 1.0;
    }
    lanes.wide_put(&mut sifted.nearest, part, nearest);
    sifted.certain |= lanes.bits(lanes.wide_lt(none, nearest)) << shift;
    for ((open, low), may) in sifted.open.iter_mut().zip(&sifted.lows).zip(&may).take(facets.len()) {
        let (low_over, low_under) = (lanes.wide(&low[0], part), lanes.wide(&low[1], part));
        let is_near = lanes.wide_not_lt(lanes.wide_mul(over, low_under), lanes.wide_mul(low_over, under));
        *open |= (may & lanes.bits(is_near)) << shift;
    }
    lanes.wide_put(&mut bundle.over, part, over);
    lanes.wide_put(&mut bundle.under, part, under);
}

/// A segment crosses a plane if its ends are on different sides of it.
#[inline(always)]
fn up_to_the_target<L: Lanes>(lanes: L, facets: &[Facet], bundle: &Bundle, part: usize, sifted: &mut Sifted) {
    let rays = Part::of(lanes, bundle, part);
    let target = [
        lanes.doubles(&bundle.target[0], part),
        lanes.doubles(&bundle.target[1], part),
        lanes.doubles(&bundle.target[2], part),
    ];
    let shift = part * L::WIDTH;
    let mut blocked = 0;
    for (facet, open) in facets.iter().zip(&mut sifted.open) {
        let crossed = rays.cross(lanes, facet);
        let (from, to) = (height(lanes, facet, rays.origin), height(lanes, facet, target));
        let (low, high) = (lanes.wide_min(from, to), lanes.wide_max(from, to));
        let slack = rays.height_slack(lanes, facet);
        let minus_slack = lanes.wide_sub(lanes.wide_splat(0.0), slack);
        let may_between = lanes.both(lanes.wide_not_lt(slack, low), lanes.wide_not_lt(high, minus_slack));
        let is_between = lanes.both(lanes.wide_lt(low, minus_slack), lanes.wide_lt(slack, high));
        *open |= lanes.bits(lanes.both(crossed.may, may_between)) << shift;
        blocked |= lanes.bits(lanes.both(crossed.does, is_between));
    }
    sifted.blocked |= blocked << shift;
}

#[cfg(test)]
mod tests;
