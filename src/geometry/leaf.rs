//! Primitives as the tree's leaves keep them: everything an intersection needs, in tree order, one behind the other.

use super::octahedral;
use super::surface::InstanceShape;
use super::triangle::{CornerRows, RayFrame};
use super::{Geometry, sphere};
use glam::{DVec2, Vec3, Vec3A};
use obvhs::aabb::Aabb;

/// A triangle or a sphere, with the names a hit reports.
#[derive(Clone, Copy, Debug)]
pub struct LeafPrimitive {
    /// A triangle's corners by axis; a sphere keeps its centre in the first column and its radius in the second.
    corners: CornerRows,
    /// Instance number.
    pub instance: u32,
    /// Primitive number inside the instance.
    pub primitive: u32,
    is_sphere: bool,
}

impl LeafPrimitive {
    /// Primitive `primitive` of instance `instance`; `None` if there is no such primitive.
    pub fn new(geometry: &Geometry, instance: u32, primitive: u32) -> Option<Self> {
        let row = geometry.instances.get(instance as usize)?;
        let (corners, is_sphere) = match row.shape {
            InstanceShape::Mesh { .. } => (geometry.corners(row, primitive)?, false),
            InstanceShape::Sphere { center, radius } => ([center, Vec3::splat(radius), Vec3::ZERO], true),
        };
        let [a, b, c] = corners.map(|corner| corner.to_array());
        Some(Self {
            corners: [0, 1, 2].map(|axis| [a[axis], b[axis], c[axis]]),
            instance,
            primitive,
            is_sphere,
        })
    }

    /// A triangle's corner, a sphere's centre (0) or its radius in every component (1).
    #[inline]
    fn column(&self, corner: usize) -> Vec3 {
        Vec3::from_array(self.corners.map(|row| row[corner]))
    }

    /// Whether the primitive can be hit: its numbers are finite, and it has an area in f64. The tree is built over such
    /// primitives only; one box with a number that is not finite would spoil the order of all.
    pub fn can_be_hit(&self) -> bool {
        let [a, b, c] = [0, 1, 2].map(|corner| self.column(corner).as_dvec3());
        if self.is_sphere {
            a.is_finite() && b.is_finite() && b.x > 0.0
        } else {
            let finite = a.is_finite() && b.is_finite() && c.is_finite();
            finite && (b - a).cross(c - a).length_squared() > 0.0
        }
    }

    /// The primitive's box, rounded outwards.
    pub fn bounds(&self) -> Aabb {
        let [a, b, c] = [0, 1, 2].map(|corner| self.column(corner));
        let (min, max) = if self.is_sphere {
            (
                (a - b).to_array().map(f32::next_down).into(),
                (a + b).to_array().map(f32::next_up).into(),
            )
        } else {
            (a.min(b).min(c), a.max(b).max(c))
        };
        Aabb::new(Vec3A::from(min), Vec3A::from(max))
    }

    /// The nearest hit in front of the origin: distance and coordinates on the primitive.
    #[inline]
    pub fn hit(&self, ray: &RayFrame) -> Option<(f64, DVec2)> {
        if self.is_sphere {
            let (center, radius) = (self.column(0), self.corners[0][1]);
            let roots = sphere::cross(ray, center, radius)?;
            let t = roots.into_iter().find(|&t| t > 0.0)?;
            let outward = ray.origin + ray.direction * t - center.as_dvec3();
            Some((t, octahedral::encode(outward)))
        } else {
            let crossing = ray.cross(&self.corners)?;
            (crossing.t > 0.0).then(|| (crossing.t, DVec2::new(crossing.u, crossing.v)))
        }
    }

    /// Whether the segment from the ray's origin to origin + direction meets the primitive, ends excluded.
    #[inline]
    pub fn blocks(&self, ray: &RayFrame) -> bool {
        let between = |t: f64| t > 0.0 && t < 1.0;
        if self.is_sphere {
            sphere::cross(ray, self.column(0), self.corners[0][1]).is_some_and(|roots| roots.into_iter().any(between))
        } else {
            ray.cross(&self.corners).is_some_and(|crossing| between(crossing.t))
        }
    }
}
