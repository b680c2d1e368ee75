//! Surface points: what a hit is in the world.

use super::{Geometry, octahedral};
use crate::tolerance::{ORIGIN_OFFSET_FLOOR, ORIGIN_OFFSET_UNITS};
use glam::{Vec2, Vec3};

/// One shape of the scene.
#[derive(Clone, Copy, Debug)]
pub struct Instance {
    /// Its kind and where its rows are.
    pub shape: InstanceShape,
    /// Global number of its first primitive.
    pub first_primitive: u32,
}

/// What an instance is.
#[derive(Clone, Copy, Debug)]
pub enum InstanceShape {
    /// A triangle mesh.
    Mesh {
        /// First row in the triangle table.
        first_triangle: u32,
        /// Number of triangles.
        triangle_count: u32,
        /// First row in the position table.
        first_vertex: u32,
        /// First row in the normal table, if the mesh is smooth.
        first_normal: Option<u32>,
    },
    /// An analytic sphere, world space.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
    },
}

impl Instance {
    /// Number of primitives.
    #[must_use]
    pub fn primitive_count(&self) -> u32 {
        match self.shape {
            InstanceShape::Mesh { triangle_count, .. } => triangle_count,
            InstanceShape::Sphere { .. } => 1,
        }
    }
}

/// A point on a surface as a path stores it: which primitive, and where on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Instance number.
    pub instance: u32,
    /// Primitive number inside the instance.
    pub primitive: u32,
    /// Coordinates on the primitive, see [`HitUv`](super::HitUv).
    pub uv: Vec2,
}

/// A surface point in world space.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Position.
    pub position: Vec3,
    /// Unit normal of the surface itself: by winding for triangles, outwards for spheres.
    pub geometric_normal: Vec3,
    /// Unit normal to shade with: interpolated from vertices, on the geometric normal's side.
    pub shading_normal: Vec3,
    /// How far a ray's origin has to move along the geometric normal to be surely on its side, see [`offset_origin`].
    pub offset: f32,
    /// Material number.
    pub material: u32,
    /// Light number, or [`NOT_EMITTING`](super::NOT_EMITTING).
    pub light: u32,
}

impl Geometry {
    /// The corners of a mesh's triangle, world space; `None` if there is no such triangle.
    pub(crate) fn corners(&self, instance: &Instance, primitive: u32) -> Option<[Vec3; 3]> {
        let InstanceShape::Mesh {
            first_triangle,
            triangle_count,
            first_vertex,
            ..
        } = instance.shape
        else {
            return None;
        };
        let triangle = (primitive < triangle_count).then(|| self.triangles[(first_triangle + primitive) as usize])?;
        Some(triangle.map(|corner| self.positions[(first_vertex + corner) as usize]))
    }

    /// The surface point of a hit. The hit must name an instance and a primitive of this geometry.
    #[must_use]
    pub fn surface_point(&self, hit: Hit) -> SurfacePoint {
        let instance = &self.instances[hit.instance as usize];
        let (position, normal, shading, size) = match instance.shape {
            InstanceShape::Mesh {
                first_triangle,
                first_vertex,
                first_normal,
                ..
            } => {
                let corners = self.triangles[(first_triangle + hit.primitive) as usize];
                let [a, b, c] = corners.map(|i| self.positions[(first_vertex + i) as usize].as_dvec3());
                let (u, v) = (f64::from(hit.uv.x), f64::from(hit.uv.y));
                let (ab, ac) = (b - a, c - a);
                let normal = ab.cross(ac).normalize();
                let shading = first_normal.map_or(normal, |first| {
                    let [na, nb, nc] = corners.map(|i| self.normals[(first + i) as usize].as_dvec3());
                    let interpolated = na * (1.0 - u - v) + nb * u + nc * v;
                    let smooth = interpolated.try_normalize().unwrap_or(normal);
                    if smooth.dot(normal) < 0.0 { -smooth } else { smooth }
                });
                (a + ab * u + ac * v, normal, shading, ab.length() + ac.length())
            }
            InstanceShape::Sphere { center, radius } => {
                let normal = octahedral::decode(hit.uv);
                let radius = f64::from(radius);
                (center.as_dvec3() + normal * radius, normal, normal, radius)
            }
        };
        let global = (instance.first_primitive + hit.primitive) as usize;
        let position = position.as_vec3();
        let geometric_normal = normal.as_vec3();
        SurfacePoint {
            position,
            geometric_normal,
            shading_normal: shading.as_vec3(),
            offset: offset_distance(position, geometric_normal, size as f32),
            material: self.materials[global],
            light: self.lights[global],
        }
    }
}

/// How far a surface point may be off its surface, with margin: in proportion to its coordinates and, for points near
/// the world's origin, to the size of the shape. See [`crate::tolerance`].
pub(crate) fn offset_distance(position: Vec3, normal: Vec3, size: f32) -> f32 {
    let rounding = normal.abs().dot(position.abs()) * (0.5 * f32::EPSILON);
    ORIGIN_OFFSET_UNITS * rounding + ORIGIN_OFFSET_FLOOR * (size + position.abs().max_element())
}

/// The origin of a ray that leaves a surface point in `direction`: moved along the geometric normal to the side that
/// the direction points to, by the point's own `offset`.
#[inline]
#[must_use]
pub fn offset_origin(position: Vec3, geometric_normal: Vec3, offset: f32, direction: Vec3) -> Vec3 {
    let side = if geometric_normal.dot(direction) < 0.0 {
        -offset
    } else {
        offset
    };
    position + geometric_normal * side
}
