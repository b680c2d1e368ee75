//! Surface points: what a hit is in the world.

use super::{Geometry, cylinder, disk, octahedral};
use crate::tolerance::{EDGE_INSET_UNITS, LEAST_INSET_HEIGHT, ORIGIN_OFFSET_FLOOR, ORIGIN_OFFSET_UNITS};
use glam::{DVec2, DVec3, Vec3};

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
        /// First row in the table of texture coordinates, if the mesh has any and the scene asks for them.
        first_uv: Option<u32>,
    },
    /// An analytic sphere, world space.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
    },
    /// An analytic disk, world space.
    Disk {
        /// Centre.
        center: Vec3,
        /// Unit normal.
        normal: Vec3,
        /// Radius.
        radius: f32,
    },
    /// An analytic tube, open at its ends, world space.
    Cylinder {
        /// Centre of one end.
        from: Vec3,
        /// Centre of the other end.
        to: Vec3,
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
            InstanceShape::Sphere { .. } | InstanceShape::Disk { .. } | InstanceShape::Cylinder { .. } => 1,
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
    pub uv: DVec2,
}

/// A surface point in world space.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Position.
    pub position: Vec3,
    /// Unit normal of the surface itself: by winding for triangles, outwards for spheres and tubes.
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

    /// The unit shading normal of a triangle of a mesh whose normals begin at `first_normal`, at a point with weights `uv` of
    /// its second and third corner; `normal`, the triangle's own, where it has none.
    #[inline(always)]
    pub(super) fn shading_normal(
        &self,
        first_normal: Option<u32>,
        corners: [u32; 3],
        uv: DVec2,
        normal: DVec3,
    ) -> DVec3 {
        first_normal.map_or(normal, |first| {
            let [na, nb, nc] = corners.map(|i| self.normals[(first + i) as usize].as_dvec3());
            let interpolated = na * (1.0 - uv.x - uv.y) + nb * uv.x + nc * uv.y;
            let smooth = interpolated.try_normalize().unwrap_or(normal);
            if smooth.dot(normal) < 0.0 { -smooth } else { smooth }
        })
    }

    /// The surface point of a hit. The hit must name an instance and a primitive of this geometry.
    #[must_use]
    pub fn surface_point(&self, hit: Hit) -> SurfacePoint {
        let instance = &self.instances[hit.instance as usize];
        let found = match instance.shape {
            InstanceShape::Mesh {
                first_triangle,
                first_vertex,
                first_normal,
                ..
            } => {
                let corners = self.triangles[(first_triangle + hit.primitive) as usize];
                let [a, b, c] = corners.map(|i| self.positions[(first_vertex + i) as usize].as_dvec3());
                let (u, v) = (hit.uv.x, hit.uv.y);
                let (ab, ac) = (b - a, c - a);
                let cross = ab.cross(ac);
                let normal = cross.normalize();
                let shading = self.shading_normal(first_normal, corners, hit.uv, normal);
                let size = ab.length() + ac.length();
                let position = inset([a, b, c], u, v, size, cross.length());
                // Left from here: triangles are met far more often than the others, and are slowed down by what they share.
                return self.point(instance, hit.primitive, (position, normal, shading, size));
            }
            InstanceShape::Sphere { center, radius } => sphere_point(center, radius, hit.uv),
            InstanceShape::Disk { center, normal, radius } => disk_point(center, normal, radius, hit.uv),
            InstanceShape::Cylinder { from, to, radius } => cylinder_point([from, to], radius, hit.uv),
        };
        self.point(instance, hit.primitive, found)
    }

    /// The surface point of a primitive of an instance.
    #[inline(always)]
    fn point(&self, instance: &Instance, primitive: u32, (position, normal, shading, size): Found) -> SurfacePoint {
        let global = (instance.first_primitive + primitive) as usize;
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

/// Position, normal, shading normal and size, in the world.
type Found = (DVec3, DVec3, DVec3, f64);

/// The point of a sphere.
#[inline(never)]
fn sphere_point(center: Vec3, radius: f32, uv: DVec2) -> Found {
    let normal = octahedral::decode(uv);
    let radius = f64::from(radius);
    (center.as_dvec3() + normal * radius, normal, normal, radius)
}

/// The point of a disk.
#[inline(never)]
fn disk_point(center: Vec3, normal: Vec3, radius: f32, uv: DVec2) -> Found {
    let [normal, x, y] = disk::basis(normal);
    let center_distance = uv.length();
    let r = f64::from(radius);
    let inset = rim_inset(center.as_dvec3().abs().max_element() + r, r) + disk::slack(center, radius);
    let most = 1.0 - (inset / r).min(MOST_INSET);
    let inside = if center_distance > most {
        uv * (most / center_distance)
    } else {
        uv
    };
    let position = center.as_dvec3() + (x * inside.x + y * inside.y) * r;
    (position, normal, normal, r)
}

/// The point of a cylinder.
#[inline(never)]
fn cylinder_point([from, to]: [Vec3; 2], radius: f32, uv: DVec2) -> Found {
    let [_, x, y] = cylinder::basis(from, to);
    let around = cylinder::direction(uv.x);
    let normal = x * around.x + y * around.y;
    let (r, axis) = (f64::from(radius), to.as_dvec3() - from.as_dvec3());
    let size = axis.length() + r;
    let coordinates = from.as_dvec3().abs().max(to.as_dvec3().abs()).max_element() + r;
    let inset = rim_inset(coordinates, size) + cylinder::slack(from, to, radius);
    let least = (inset / axis.length()).min(MOST_INSET);
    let along = uv.y.clamp(least, 1.0 - least);
    (from.as_dvec3() + axis * along + normal * r, normal, normal, size)
}

/// The most that a point is moved off an edge or a rim, as a share of the shape.
const MOST_INSET: f64 = 0.125;

/// How far points keep from rims, as from the edges of triangles: what closes the shape there must not come to lie before
/// them by rounding. `coordinates` is the largest of the shape.
fn rim_inset(coordinates: f64, size: f64) -> f64 {
    let rounding = 0.5 * f64::from(f32::EPSILON) * coordinates;
    f64::from(EDGE_INSET_UNITS) * rounding + f64::from(ORIGIN_OFFSET_FLOOR) * size
}

/// The point of a triangle with weights `u`, `v` of its second and third corner, or the one beside it that is off the
/// edges by [`EDGE_INSET_UNITS`], or as far as a small or thin triangle allows: what rounding does to the point must not
/// put it behind a wall that shares an edge. `cross` is twice the triangle's area.
fn inset([a, b, c]: [DVec3; 3], u: f64, v: f64, size: f64, cross: f64) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let point = a + ab * u + ac * v;
    let rounding = 0.5 * f64::from(f32::EPSILON) * point.abs().max_element();
    let distance = f64::from(EDGE_INSET_UNITS) * rounding + f64::from(ORIGIN_OFFSET_FLOOR) * size;
    // A corner's least weight: the distance over the corner's height above the opposite edge. Were it not for the lower
    // bound of the height, the tips of needles would move far.
    let least = |edge: DVec3| (distance / (cross / edge.length()).max(LEAST_INSET_HEIGHT * size)).min(MOST_INSET);
    let (wa, wb, wc) = (1.0 - u - v, u, v);
    let (la, lb, lc) = (least(c - b), least(ac), least(ab));
    if wa >= la && wb >= lb && wc >= lc {
        return point;
    }
    let (wa, wb, wc) = (wa.max(la), wb.max(lb), wc.max(lc));
    let share = 1.0 / (wa + wb + wc);
    a + ab * (wb * share) + ac * (wc * share)
}

/// How far a surface point may be off its surface, with margin: in proportion to its coordinates and, for points near
/// the world's origin, to the size of the shape. See [`crate::tolerance`].
pub(crate) fn offset_distance(position: Vec3, normal: Vec3, size: f32) -> f32 {
    let rounding = normal.abs().dot(position.abs()) * (0.5 * f32::EPSILON);
    ORIGIN_OFFSET_UNITS * rounding + ORIGIN_OFFSET_FLOOR * (size + position.abs().max_element())
}

/// The origin of a ray that leaves a surface point in `direction`: moved along the geometric normal to the side that
/// the direction points to, by the point's own `offset`. It never meets that primitive again if the direction makes an
/// angle with the surface of 2⁻²² or more; below, directions and normals in f32 do not tell the sides apart.
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
