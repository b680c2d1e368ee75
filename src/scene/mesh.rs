//! Triangle meshes in world space.

use glam::{Vec2, Vec3};

/// Triangles that share vertices. World space, f32.
///
/// Every mesh that [`flatten`](crate::scene::flatten()) returns keeps these promises:
/// - `triangles` is not empty, every index is below `positions.len()`, and `materials` has one entry per triangle;
/// - `normals` and `uvs` are either empty or as long as `positions`;
/// - coordinates are finite and at most [`MAX_COORDINATE`] in magnitude;
/// - every triangle's [`triangle_cross`] has a squared length that is a positive, normal, finite `f32`, so that its
///   area and its normal can be computed without a check;
/// - every normal has unit length and lies within 90 degrees of the geometric normal of the triangles that use it,
///   or is the geometric normal itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, in scene units.
    pub positions: Vec<Vec3>,
    /// Unit shading normals per vertex; empty when the mesh is shaded flat.
    pub normals: Vec<Vec3>,
    /// Texture coordinates per vertex; empty when there are none.
    pub uvs: Vec<Vec2>,
    /// Vertex indices, counter-clockwise seen from the side of the geometric normal.
    pub triangles: Vec<[u32; 3]>,
    /// The material of each triangle: an index into [`Flattened::materials`](crate::scene::Flattened::materials).
    pub materials: Vec<u32>,
}

/// The largest magnitude of a world-space coordinate: with it, the squared length of [`triangle_cross`] cannot
/// overflow (4 * 3 * (2 * 2e9 * 2e9)² is too much, so half-extents are bounded at 1e9: 3 * (8e18)² < 3.4e38).
pub const MAX_COORDINATE: f32 = 1.0e9;

/// The cross product (p1 - p0) x (p2 - p0): along the geometric normal, twice as long as the triangle is large.
#[must_use]
pub fn triangle_cross(p0: Vec3, p1: Vec3, p2: Vec3) -> Vec3 {
    (p1 - p0).cross(p2 - p0)
}

impl Mesh {
    /// The positions of a triangle's three vertices.
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }

    /// The area of a triangle, in squared scene units.
    #[must_use]
    pub fn area(&self, triangle: usize) -> f32 {
        let [p0, p1, p2] = self.corners(triangle);
        0.5 * triangle_cross(p0, p1, p2).length()
    }
}
