//! Primitives as the tree's leaves keep them: everything an intersection needs, in tree order, one behind the other.

use super::octahedral;
use super::surface::InstanceShape;
use super::triangle::{CornerRows, RayFrame};
use super::{Geometry, cylinder, disk, sphere};
use glam::{DVec2, DVec3, Vec3, Vec3A};
use obvhs::aabb::Aabb;

/// A primitive, with the names a hit reports.
#[derive(Clone, Copy, Debug)]
pub struct LeafPrimitive {
    /// A triangle's corners by axis. The others have three columns in their place: a sphere's centre and radius; a disk's
    /// centre, normal and radius; a tube's ends and radius. A radius stands in every component of its column.
    corners: CornerRows,
    /// Instance number.
    pub instance: u32,
    /// Primitive number inside the instance.
    pub primitive: u32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Triangle,
    Sphere,
    Disk,
    Cylinder,
}

impl LeafPrimitive {
    /// Primitive `primitive` of instance `instance`; `None` if there is no such primitive.
    pub fn new(geometry: &Geometry, instance: u32, primitive: u32) -> Option<Self> {
        let row = geometry.instances.get(instance as usize)?;
        let (columns, kind) = match row.shape {
            InstanceShape::Mesh { .. } => (geometry.corners(row, primitive)?, Kind::Triangle),
            InstanceShape::Sphere { center, radius } => ([center, Vec3::splat(radius), Vec3::ZERO], Kind::Sphere),
            InstanceShape::Disk { center, normal, radius } => ([center, normal, Vec3::splat(radius)], Kind::Disk),
            InstanceShape::Cylinder { from, to, radius } => ([from, to, Vec3::splat(radius)], Kind::Cylinder),
        };
        let [a, b, c] = columns.map(|column| column.to_array());
        Some(Self {
            corners: [0, 1, 2].map(|axis| [a[axis], b[axis], c[axis]]),
            instance,
            primitive,
            kind,
        })
    }

    /// Whether it is a triangle.
    pub fn is_triangle(&self) -> bool {
        self.kind == Kind::Triangle
    }

    /// A triangle's corners.
    pub const fn corners(&self) -> &CornerRows {
        &self.corners
    }

    /// A triangle's corner, or what stands there for other kinds.
    #[inline]
    fn column(&self, corner: usize) -> Vec3 {
        Vec3::from_array(self.corners.map(|row| row[corner]))
    }

    /// Whether the primitive can be hit: its numbers are finite, and it has an area in f64. The tree is built over such
    /// primitives only; one box with a number that is not finite would spoil the order of all.
    pub fn can_be_hit(&self) -> bool {
        let [a, b, c] = [0, 1, 2].map(|corner| self.column(corner).as_dvec3());
        let finite = a.is_finite() && b.is_finite() && c.is_finite();
        finite
            && match self.kind {
                Kind::Triangle => (b - a).cross(c - a).length_squared() > 0.0,
                Kind::Sphere => b.x > 0.0,
                Kind::Disk => b != DVec3::ZERO && c.x > 0.0,
                Kind::Cylinder => a != b && c.x > 0.0,
            }
    }

    /// The primitive's box, rounded outwards.
    pub fn bounds(&self) -> Aabb {
        let [a, b, c] = [0, 1, 2].map(|corner| self.column(corner));
        let outwards = |min: Vec3, max: Vec3, extent: DVec3| {
            let min = (min.as_dvec3() - extent).as_vec3().to_array().map(f32::next_down);
            let max = (max.as_dvec3() + extent).as_vec3().to_array().map(f32::next_up);
            (min.into(), max.into())
        };
        let (min, max) = match self.kind {
            Kind::Triangle => (a.min(b).min(c), a.max(b).max(c)),
            Kind::Sphere => outwards(a, a, b.as_dvec3()),
            Kind::Disk => outwards(a, a, disk::extent(a, b, c.x)),
            Kind::Cylinder => outwards(a.min(b), a.max(b), cylinder::extent(a, b, c.x)),
        };
        Aabb::new(Vec3A::from(min), Vec3A::from(max))
    }

    /// The nearest hit in front of the origin: distance and coordinates on the primitive.
    #[inline]
    pub fn hit(&self, ray: &RayFrame) -> Option<(f64, DVec2)> {
        match self.kind {
            Kind::Triangle => {
                let crossing = ray.cross(&self.corners)?;
                (crossing.t > 0.0).then(|| (crossing.t, DVec2::new(crossing.u, crossing.v)))
            }
            Kind::Sphere => {
                let (center, radius) = (self.column(0), self.corners[0][1]);
                let roots = sphere::cross(ray, center, radius)?;
                let t = roots.into_iter().find(|&t| t > 0.0)?;
                let outward = ray.origin + ray.direction * t - center.as_dvec3();
                Some((t, octahedral::encode(outward)))
            }
            Kind::Disk => {
                let (normal, radius) = (self.column(1), self.corners[0][2]);
                let (t, from_center) = disk::cross(ray, self.column(0), normal, radius)?;
                (t > 0.0).then(|| (t, disk::coordinates(from_center, normal, radius)))
            }
            Kind::Cylinder => {
                let (from, to) = (self.column(0), self.column(1));
                let crossings = cylinder::cross(ray, from, to, self.corners[0][2]);
                let crossing = crossings.into_iter().flatten().find(|crossing| crossing.t > 0.0)?;
                Some((crossing.t, cylinder::coordinates(&crossing, from, to)))
            }
        }
    }

    /// Whether the segment from the ray's origin to origin + direction meets the primitive, ends excluded.
    #[inline]
    pub fn blocks(&self, ray: &RayFrame) -> bool {
        let between = |t: f64| t > 0.0 && t < 1.0;
        match self.kind {
            Kind::Triangle => ray.cross(&self.corners).is_some_and(|crossing| between(crossing.t)),
            Kind::Sphere => sphere::cross(ray, self.column(0), self.corners[0][1])
                .is_some_and(|roots| roots.into_iter().any(between)),
            Kind::Disk => {
                let crossing = disk::cross(ray, self.column(0), self.column(1), self.corners[0][2]);
                crossing.is_some_and(|(t, _)| between(t))
            }
            Kind::Cylinder => {
                let crossings = cylinder::cross(ray, self.column(0), self.column(1), self.corners[0][2]);
                crossings.into_iter().flatten().any(|crossing| between(crossing.t))
            }
        }
    }
}
