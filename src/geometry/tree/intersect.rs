//! A ray against eight boxes, and against four triangles.

use super::block::{BLOCK, Block, Crossings};
use super::box_ray::BoxRay;
use super::lanes::Lanes;
use super::node::{Node, WIDTH};
use crate::geometry::triangle::{CornerRows, RayFrame};
use crate::tolerance::{BOX_EXIT_SLACK, CULL_SLACK};

// No closures below: one that is not inlined has none of the instructions that it is compiled for.

/// Distances to planes at right angles to an axis.
#[inline(always)]
fn distance<L: Lanes>(lanes: L, planes: &[f32; WIDTH], ray: &BoxRay, axis: usize) -> L::Single {
    let from = lanes.single_sub(lanes.single(planes), lanes.single_splat(ray.origin[axis]));
    lanes.single_mul(from, lanes.single_splat(ray.inverse[axis]))
}

/// Where a ray enters the boxes of a node, and a bit for each that it enters no farther than `limit`.
///
/// 0 · ∞ (a ray inside a slab's plane, parallel to it) is not a number, and leaves the interval as it was.
#[inline(always)]
pub fn enter<L: Lanes>(lanes: L, node: &Node, ray: &BoxRay, limit: f32) -> (u32, L::Single) {
    let mut enter = lanes.single_splat(0.0);
    let mut exit = lanes.single_splat(f32::INFINITY);
    for axis in 0..3 {
        let [near, far] = ray.planes(axis);
        enter = lanes.single_max(distance(lanes, &node.planes[near], ray, axis), enter);
        exit = lanes.single_min(distance(lanes, &node.planes[far], ray, axis), exit);
    }
    let exit = lanes.single_mul(exit, lanes.single_splat(BOX_EXIT_SLACK));
    let limit = lanes.single_splat(limit * CULL_SLACK);
    let mask = lanes.single_le(enter, exit) & lanes.single_le(enter, limit);
    (mask, enter)
}

/// Edge functions of a ray with the triangles of a block, after Woop, Benthin and Wald 2013: what [`RayFrame::cross`] does with one
/// triangle, operation by operation, with four.
struct Edges<L: Lanes> {
    mask: u32,
    wb: L::Double,
    wc: L::Double,
    det: L::Double,
    z: [L::Double; 3],
    /// What depths along the rays' last axes are multiplied by to be distances.
    scale: L::Double,
}

/// Corners of four triangles along an axis, from an origin.
#[inline(always)]
fn row<L: Lanes>(lanes: L, [a, b, c]: &[[f32; BLOCK]; 3], origin: L::Double) -> [L::Double; 3] {
    [
        lanes.double_sub(lanes.double(a), origin),
        lanes.double_sub(lanes.double(b), origin),
        lanes.double_sub(lanes.double(c), origin),
    ]
}

/// across − shear · z, of all corners.
#[inline(always)]
fn sheared<L: Lanes>(lanes: L, across: [L::Double; 3], shear: L::Double, z: [L::Double; 3]) -> [L::Double; 3] {
    [
        lanes.double_sub(across[0], lanes.double_mul(shear, z[0])),
        lanes.double_sub(across[1], lanes.double_mul(shear, z[1])),
        lanes.double_sub(across[2], lanes.double_mul(shear, z[2])),
    ]
}

/// a · b − c · d.
#[inline(always)]
fn turn<L: Lanes>(lanes: L, a: L::Double, b: L::Double, c: L::Double, d: L::Double) -> L::Double {
    lanes.double_sub(lanes.double_mul(a, b), lanes.double_mul(c, d))
}

/// Rays prepared for triangles, one for each of a block: [`RayFrame`]'s fields. The same ray four times, or four rays.
struct Frames<L: Lanes> {
    origin: [L::Double; 3],
    shear: [L::Double; 3],
}

/// Edge functions with four triangles, whose corners are given by the axes of the rays.
#[inline(always)]
fn edges<L: Lanes>(lanes: L, rows: [&[[f32; BLOCK]; 3]; 3], rays: &Frames<L>) -> Edges<L> {
    let z = row(lanes, rows[2], rays.origin[2]);
    let [ax, bx, cx] = sheared(lanes, row(lanes, rows[0], rays.origin[0]), rays.shear[0], z);
    let [ay, by, cy] = sheared(lanes, row(lanes, rows[1], rays.origin[1]), rays.shear[1], z);
    let wa = turn(lanes, cx, by, cy, bx);
    let wb = turn(lanes, ax, cy, ay, cx);
    let wc = turn(lanes, bx, ay, by, ax);
    let zero = lanes.double_splat(0.0);
    let positive = lanes.double_le(zero, wa) & lanes.double_le(zero, wb) & lanes.double_le(zero, wc);
    let negative = lanes.double_le(wa, zero) & lanes.double_le(wb, zero) & lanes.double_le(wc, zero);
    let det = lanes.double_add(lanes.double_add(wa, wb), wc);
    Edges {
        mask: (positive | negative) & lanes.double_ne(det, zero),
        wb,
        wc,
        det,
        z,
        scale: rays.shear[2],
    }
}

#[inline(always)]
fn splat<L: Lanes>(lanes: L, [x, y, z]: [f64; 3]) -> [L::Double; 3] {
    [lanes.double_splat(x), lanes.double_splat(y), lanes.double_splat(z)]
}

/// Edge functions of one ray with a block.
#[inline(always)]
fn edges_of<L: Lanes>(lanes: L, block: &Block, ray: &RayFrame) -> Edges<L> {
    let [x, y, z] = ray.axes;
    let rows = [
        &block.rows[usize::from(x)],
        &block.rows[usize::from(y)],
        &block.rows[usize::from(z)],
    ];
    let rays = Frames {
        origin: splat(lanes, ray.ordered_origin),
        shear: splat(lanes, ray.shear),
    };
    edges(lanes, rows, &rays)
}

impl<L: Lanes> Edges<L> {
    /// One over the determinant, and the distance.
    #[inline(always)]
    fn depth(&self, lanes: L) -> (L::Double, L::Double) {
        let inverse = lanes.double_div(lanes.double_splat(1.0), self.det);
        let [a, b, c] = self.z;
        let weighted = lanes.double_add(
            lanes.double_mul(self.wb, lanes.double_sub(b, a)),
            lanes.double_mul(self.wc, lanes.double_sub(c, a)),
        );
        let depth = lanes.double_add(a, lanes.double_mul(weighted, inverse));
        (inverse, lanes.double_mul(depth, self.scale))
    }

    #[inline(always)]
    fn crossings(&self, lanes: L) -> Crossings {
        let (inverse, t) = self.depth(lanes);
        Crossings {
            mask: self.mask,
            t: lanes.double_array(t),
            u: lanes.double_array(lanes.double_mul(self.wb, inverse)),
            v: lanes.double_array(lanes.double_mul(self.wc, inverse)),
        }
    }
}

/// Where the ray's line crosses the triangles of a block; `None` if none.
#[inline(always)]
pub fn cross<L: Lanes>(lanes: L, block: &Block, ray: &RayFrame) -> Option<Crossings> {
    let edges = edges_of(lanes, block, ray);
    if edges.mask == 0 {
        return None;
    }
    Some(edges.crossings(lanes))
}

/// A bit for each triangle of the block whose plane the ray crosses inside of it between its origin and origin + direction, ends
/// excluded.
#[inline(always)]
pub fn between<L: Lanes>(lanes: L, block: &Block, ray: &RayFrame) -> u32 {
    // Without a branch on whether the line crosses one: that is anybody's guess, and a division costs less than a wrong one.
    let edges = edges_of(lanes, block, ray);
    let (_, t) = edges.depth(lanes);
    let between = lanes.double_lt(lanes.double_splat(0.0), t) & lanes.double_lt(t, lanes.double_splat(1.0));
    edges.mask & between
}

/// Four rays, each with a triangle.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Pairs {
    /// Corners, by axis of the ray: `[axis][corner][pair]`.
    rows: [[[f32; BLOCK]; 3]; 3],
    origin: [[f64; BLOCK]; 3],
    shear: [[f64; BLOCK]; 3],
}

impl Pairs {
    /// No pairs: a point at the origin, which no ray meets.
    pub const NONE: Self = Self {
        rows: [[[0.0; BLOCK]; 3]; 3],
        origin: [[0.0; BLOCK]; 3],
        shear: [[0.0; BLOCK]; 3],
    };

    /// Puts a pair into a place.
    #[inline(always)]
    pub fn put(&mut self, place: usize, ray: &RayFrame, corners: &CornerRows) {
        let place = place & (BLOCK - 1);
        for axis in 0..3 {
            let row = &corners[usize::from(ray.axes[axis])];
            for (own, &coordinate) in self.rows[axis].iter_mut().zip(row) {
                own[place] = coordinate;
            }
            self.origin[axis][place] = ray.ordered_origin[axis];
            self.shear[axis][place] = ray.shear[axis];
        }
    }

    /// Where the lines of the rays cross their triangles.
    #[inline(always)]
    pub fn cross<L: Lanes>(&self, lanes: L) -> Crossings {
        let [x, y, z] = &self.rows;
        let rays = Frames {
            origin: three(lanes, &self.origin),
            shear: three(lanes, &self.shear),
        };
        edges(lanes, [x, y, z], &rays).crossings(lanes)
    }
}

#[inline(always)]
fn three<L: Lanes>(lanes: L, [x, y, z]: &[[f64; BLOCK]; 3]) -> [L::Double; 3] {
    [lanes.double_load(x), lanes.double_load(y), lanes.double_load(z)]
}
