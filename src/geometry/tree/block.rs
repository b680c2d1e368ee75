//! Four triangles side by side, as leaves keep them.

use crate::geometry::leaf::LeafPrimitive;

/// Triangles of a block.
pub const BLOCK: usize = 4;

/// Up to four triangles, with the names that hits report: three cache lines. What is not filled is a point at the origin, which no
/// ray meets.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Block {
    /// Corners, `[axis][corner][triangle]`.
    pub rows: [[[f32; BLOCK]; 3]; 3],
    /// Instance of each triangle.
    pub instances: [u32; BLOCK],
    /// Its number inside the instance.
    pub primitives: [u32; BLOCK],
    /// Fills the last line.
    unused: [u32; BLOCK],
}

impl Block {
    /// A block of the first four `triangles`.
    pub fn new(triangles: &[LeafPrimitive]) -> Self {
        let mut block = Self {
            rows: [[[0.0; BLOCK]; 3]; 3],
            instances: [0; BLOCK],
            primitives: [0; BLOCK],
            unused: [0; BLOCK],
        };
        for (place, triangle) in triangles.iter().take(BLOCK).enumerate() {
            for (axis, corners) in triangle.corners().iter().enumerate() {
                for (corner, &coordinate) in corners.iter().enumerate() {
                    block.rows[axis][corner][place] = coordinate;
                }
            }
            block.instances[place] = triangle.instance;
            block.primitives[place] = triangle.primitive;
        }
        block
    }

    /// The box around a triangle, least and largest coordinate by axis.
    #[inline(always)]
    pub fn bounds(&self, place: usize) -> [[f32; 2]; 3] {
        [0, 1, 2].map(|axis| {
            let [a, b, c] = [0, 1, 2].map(|corner| self.rows[axis][corner][place]);
            [a.min(b).min(c), a.max(b).max(c)]
        })
    }
}

/// Where a ray crosses the triangles of a block; only lanes of the mask mean something.
#[derive(Clone, Copy, Debug)]
pub struct Crossings {
    /// A bit for each triangle that is crossed, edges included.
    pub mask: u32,
    /// Distances in units of the direction's length; may be negative.
    pub t: [f64; BLOCK],
    /// Barycentric weights of the second corners.
    pub u: [f64; BLOCK],
    /// Barycentric weights of the third corners.
    pub v: [f64; BLOCK],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_three_cache_lines() {
        assert_eq!((size_of::<Block>(), align_of::<Block>()), (192, 64));
    }
}
