//! Where on a texture a hit is, and which way the texture runs there.
//!
//! | shape | u | v |
//! |---|---|---|
//! | quad | along `edge_u` | along `edge_v` |
//! | box | to the right over each face, as seen from outside | up each face |
//! | sphere | around the shape's y axis, to the right as seen from outside; 0.5 towards +z, the seam towards -z | from the pole at -y to the one at +y, in equal angles |
//! | disk | to the right over the square around it, as seen from the front | up that square |
//! | cylinder | around the axis, to the right as seen from outside | from `from` to `to` |
//! | torus | around the axis, to the right as seen from outside | around the tube, from the inside over the bottom, the outside and the top |
//! | height field | along `edge_u` | along `edge_v` |
//! | mesh | `vt` | `vt` |
//!
//! Round shapes turn with their transforms: a table of frames holds their axes. It and the tables of texture coordinates are
//! empty in scenes whose materials ask for neither.

use super::surface::{Hit, Instance, InstanceShape};
use super::{Geometry, cylinder, disk, octahedral};
use glam::{DVec2, DVec3, Mat3, Vec2, Vec3};
use std::f64::consts::TAU;

/// What textures and materials that are not the same all around ask of a surface point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexturePoint {
    /// Texture coordinates.
    pub uv: Vec2,
    /// The direction in which u grows, world space, unit, orthogonal to the shading normal; zero where there is none, and any
    /// orthogonal direction will do.
    pub tangent: Vec3,
}

impl TexturePoint {
    /// A point of a surface without texture coordinates.
    pub const NONE: Self = Self {
        uv: Vec2::ZERO,
        tangent: Vec3::ZERO,
    };

    fn new(uv: DVec2, along_u: DVec3, normal: DVec3) -> Self {
        let tangent = along_u - normal * normal.dot(along_u);
        // What rounding leaves of a vector along the normal is no direction.
        let is_direction = tangent.length_squared() > 1e-24 * along_u.length_squared() && tangent.is_finite();
        Self {
            uv: uv.as_vec2(),
            tangent: if is_direction {
                tangent.normalize().as_vec3()
            } else {
                Vec3::ZERO
            },
        }
    }
}

impl Geometry {
    /// Texture coordinates and tangent of a hit. The hit must name an instance and a primitive of this geometry.
    #[must_use]
    pub fn texture_point(&self, hit: Hit) -> TexturePoint {
        let instance = &self.instances[hit.instance as usize];
        let frame = self
            .frames
            .get(hit.instance as usize)
            .copied()
            .unwrap_or(Mat3::IDENTITY);
        match instance.shape {
            InstanceShape::Mesh { .. } => self.on_mesh(instance, hit),
            InstanceShape::Sphere { .. } => {
                let normal = octahedral::decode(hit.uv);
                let (u, along_u) = around(normal, frame);
                let up = frame.y_axis.as_dvec3().dot(normal);
                // From both sides, so that it is exact at the poles.
                let aside = (normal - frame.y_axis.as_dvec3() * up).length();
                let v = 1.0 - libm::atan2(aside, up) / std::f64::consts::PI;
                TexturePoint::new(DVec2::new(u, v.clamp(0.0, 1.0)), along_u, normal)
            }
            InstanceShape::Disk { normal, .. } => {
                let [normal, x, y] = disk::basis(normal);
                let at = x * hit.uv.x + y * hit.uv.y;
                let (right, up) = (frame.x_axis.as_dvec3(), frame.y_axis.as_dvec3());
                let uv = DVec2::new(at.dot(right), at.dot(up)) * 0.5 + 0.5;
                TexturePoint::new(uv, right, normal)
            }
            InstanceShape::Cylinder { from, to, .. } => {
                let [_, x, y] = cylinder::basis(from, to);
                let at = cylinder::direction(hit.uv.x);
                let normal = x * at.x + y * at.y;
                let (u, along_u) = around(normal, frame);
                TexturePoint::new(DVec2::new(u, hit.uv.y.clamp(0.0, 1.0)), along_u, normal)
            }
        }
    }

    fn on_mesh(&self, instance: &Instance, hit: Hit) -> TexturePoint {
        let InstanceShape::Mesh {
            first_triangle,
            first_vertex,
            first_normal,
            first_uv: Some(first_uv),
            ..
        } = instance.shape
        else {
            return TexturePoint::NONE;
        };
        let corners = self.triangles[(first_triangle + hit.primitive) as usize];
        let [a, b, c] = corners.map(|i| self.positions[(first_vertex + i) as usize].as_dvec3());
        let [ta, tb, tc] = corners.map(|i| self.uvs[(first_uv + i) as usize].as_dvec2());
        let (u, v) = (hit.uv.x, hit.uv.y);
        let (ab, ac) = (b - a, c - a);
        let (to_b, to_c) = (tb - ta, tc - ta);
        let normal = self.shading_normal(first_normal, corners, hit.uv, ab.cross(ac).normalize());
        // The derivative of the position by u (Pharr, Jakob and Humphreys 2016, §3.6.2), times the determinant, whose sign
        // alone matters; zero where the triangle has no extent on the texture.
        let determinant = to_b.perp_dot(to_c);
        let along_u = if determinant == 0.0 {
            DVec3::ZERO
        } else {
            (ab * to_c.y - ac * to_b.y) * determinant.signum()
        };
        TexturePoint::new(ta + to_b * u + to_c * v, along_u, normal)
    }
}

/// u of a direction around a frame's y axis, and the direction in which it grows.
fn around(normal: DVec3, frame: Mat3) -> (f64, DVec3) {
    let (x, z) = (frame.x_axis.as_dvec3(), frame.z_axis.as_dvec3());
    let (right, towards) = (normal.dot(x), normal.dot(z));
    let u = 0.5 + libm::atan2(right, towards) / TAU;
    (u, x * towards - z * right)
}
