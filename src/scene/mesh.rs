//! Triangle meshes in world space.

use glam::{DAffine3, DVec3, Vec2, Vec3};

/// Triangles that share vertices. World space, f32.
///
/// Every mesh that [`flatten`](crate::scene::flatten()) returns keeps these promises:
/// - `triangles` is not empty, every index is below `positions.len()`, and `materials` has one entry per triangle;
/// - `normals` and `uvs` are either empty or as long as `positions`;
/// - coordinates are finite and at most [`MAX_COORDINATE`] in magnitude;
/// - the squared length of every triangle's [`triangle_cross`] is a positive, normal, finite `f32`, so that areas and
///   geometric normals can be computed without a check;
/// - every shading normal that a triangle uses has unit length and lies within 90 degrees of its geometric normal.
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

/// The largest magnitude of a coordinate. With it, edges are at most 2e9 along an axis, a component of
/// [`triangle_cross`] at most 8e18, and its squared length at most 2e38: below the largest `f32`.
pub const MAX_COORDINATE: f32 = 1.0e9;

/// The cross product (p1 - p0) x (p2 - p0): along the geometric normal, and twice as long as the triangle's area.
#[must_use]
pub fn triangle_cross(p0: Vec3, p1: Vec3, p2: Vec3) -> Vec3 {
    (p1 - p0).cross(p2 - p0)
}

/// What [`Mesh::repair_normals`] replaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct NormalRepairs {
    /// Corners whose normal was missing or of length zero.
    pub(super) missing: usize,
    /// Corners whose normal pointed to the other side of the triangle.
    pub(super) opposed: usize,
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

    /// The unit geometric normal of a triangle.
    #[must_use]
    pub fn geometric_normal(&self, triangle: usize) -> Vec3 {
        let [p0, p1, p2] = self.corners(triangle);
        triangle_cross(p0, p1, p2).normalize_or_zero()
    }

    /// Adds triangles given by their own vertices, placed in the world by `map`. A map that mirrors also turns their
    /// winding over, so that a geometric normal stays on the side of the surface where it was.
    pub(super) fn add(
        &mut self,
        points: &[DVec3],
        triangles: impl Iterator<Item = [u32; 3]>,
        map: &DAffine3,
        material: u32,
    ) {
        let first = self.positions.len() as u32;
        let mirrored = map.matrix3.determinant() < 0.0;
        self.positions
            .extend(points.iter().map(|point| map.transform_point3(*point).as_vec3()));
        let before = self.triangles.len();
        self.triangles.extend(triangles.map(|[a, b, c]| {
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            [first + a, first + b, first + c]
        }));
        let added = self.triangles.len() - before;
        self.materials.extend(std::iter::repeat_n(material, added));
    }

    /// Whether every position is finite and within [`MAX_COORDINATE`].
    pub(super) fn is_within_bounds(&self) -> bool {
        self.positions
            .iter()
            .all(|position| position.abs().max_element() <= MAX_COORDINATE && !position.is_nan())
    }

    /// Whether a triangle has an area that `f32` can compute with.
    pub(super) fn has_area(&self, triangle: usize) -> bool {
        let [p0, p1, p2] = self.corners(triangle);
        triangle_cross(p0, p1, p2).length_squared().is_normal()
    }

    /// Gives every corner whose shading normal is zero, or points away from the geometric normal, a vertex of its own
    /// with the geometric normal: a path tracer can make nothing of either. Returns how many.
    pub(super) fn repair_normals(&mut self) -> NormalRepairs {
        let mut repairs = NormalRepairs::default();
        if self.normals.is_empty() {
            return repairs;
        }
        for triangle in 0..self.triangles.len() {
            let normal = self.geometric_normal(triangle);
            for corner in 0..3 {
                let vertex = self.triangles[triangle][corner] as usize;
                let shading = self.normals[vertex];
                if shading.dot(normal) > 0.0 {
                    continue;
                }
                if shading == Vec3::ZERO {
                    repairs.missing += 1;
                } else {
                    repairs.opposed += 1;
                }
                self.triangles[triangle][corner] = self.positions.len() as u32;
                self.positions.push(self.positions[vertex]);
                self.normals.push(normal);
                if let Some(uv) = self.uvs.get(vertex).copied() {
                    self.uvs.push(uv);
                }
            }
        }
        repairs
    }
}
