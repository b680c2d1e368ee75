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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, Stream, StreamKey, warp};

    fn geometry(shape: InstanceShape, frame: Mat3) -> Geometry {
        Geometry {
            instances: vec![Instance {
                shape,
                first_primitive: 0,
            }],
            frames: vec![frame],
            ..Geometry::default()
        }
    }

    fn hit(uv: DVec2) -> Hit {
        Hit {
            instance: 0,
            primitive: 0,
            uv,
        }
    }

    fn stream(case: u32) -> Stream {
        StreamKey::new(90, case, 0).stream(Purpose::SCATTER, 0)
    }

    /// A turned frame, mirrored or not.
    fn frame(stream: &mut Stream, mirrored: bool) -> Mat3 {
        let z = warp::uniform_sphere(stream.next_pair()).normalize();
        let (x, y) = z.any_orthonormal_pair();
        Mat3::from_cols(if mirrored { -x } else { x }, y, z)
    }

    /// That the tangent is where `position` goes as u grows, by differences, and at a right angle to `normal`.
    fn check_tangent(point: TexturePoint, normal: DVec3, position: impl Fn(DVec2) -> DVec3) {
        let (uv, step) = (point.uv.as_dvec2(), DVec2::new(1e-4, 0.0));
        let along = (position(uv + step) - position(uv - step)).normalize();
        let tangent = point.tangent.as_dvec3();
        assert!(tangent.distance(along) < 1e-3, "{point:?}: {along}");
        assert!(
            tangent.dot(normal).abs() < 1e-6 && (tangent.length() - 1.0).abs() < 1e-6,
            "{point:?}"
        );
    }

    #[test]
    fn spheres_are_textured_like_globes() {
        let mut stream = stream(0);
        for case in 0..2000 {
            let frame = frame(&mut stream, case % 2 == 0);
            let shape = InstanceShape::Sphere {
                center: Vec3::ZERO,
                radius: 2.0,
            };
            let geometry = geometry(shape, frame);
            let normal = warp::uniform_sphere(stream.next_pair()).as_dvec3().normalize();
            let point = geometry.texture_point(hit(octahedral::encode(normal)));
            // Longitude and latitude back to the direction.
            let position = |uv: DVec2| {
                let (longitude, latitude) = (TAU * (uv.x - 0.5), std::f64::consts::PI * (uv.y - 0.5));
                let (sine, cosine) = (libm::sin(latitude), libm::cos(latitude));
                let local = DVec3::new(cosine * libm::sin(longitude), sine, cosine * libm::cos(longitude));
                frame.as_dmat3() * local
            };
            assert!(
                position(point.uv.as_dvec2()).distance(normal) < 2e-6,
                "{point:?} for {normal}"
            );
            if point.uv.y > 0.01 && point.uv.y < 0.99 {
                check_tangent(point, normal, position);
            }
        }
    }

    #[test]
    fn the_poles_of_a_sphere_have_no_tangent_and_exact_latitudes() {
        let shape = InstanceShape::Sphere {
            center: Vec3::ONE,
            radius: 1.0,
        };
        let geometry = geometry(shape, Mat3::IDENTITY);
        for (normal, v) in [(DVec3::Y, 1.0), (DVec3::NEG_Y, 0.0)] {
            let point = geometry.texture_point(hit(octahedral::encode(normal)));
            assert_eq!((point.uv.y, point.tangent), (v, Vec3::ZERO));
        }
        // As near to the pole as f64 tells: still a direction.
        let beside = DVec3::new(0.0, 1.0, 1e-9).normalize();
        let point = geometry.texture_point(hit(octahedral::encode(beside)));
        assert!(
            point.tangent.distance(Vec3::X) < 1e-6 && (point.uv.x - 0.5).abs() < 1e-6,
            "{point:?}"
        );
    }

    #[test]
    fn the_seam_of_a_sphere_runs_where_its_shape_says() {
        let shape = InstanceShape::Sphere {
            center: Vec3::ZERO,
            radius: 1.0,
        };
        let geometry = geometry(shape, Mat3::IDENTITY);
        let u = |x: f64, z: f64| {
            geometry
                .texture_point(hit(octahedral::encode(DVec3::new(x, 0.0, z))))
                .uv
                .x
        };
        assert_eq!(u(0.0, 1.0), 0.5);
        assert_eq!((u(1.0, 0.0), u(-1.0, 0.0)), (0.75, 0.25));
        assert!(u(1e-6, -1.0) > 0.999_999 && u(-1e-6, -1.0) < 1e-6);
    }

    #[test]
    fn disks_and_tubes_are_textured_by_their_axes() {
        let mut stream = stream(1);
        for case in 0..2000 {
            let frame = frame(&mut stream, case % 2 == 0);
            let wide = frame.as_dmat3();
            let shape = InstanceShape::Disk {
                center: Vec3::ZERO,
                normal: frame.z_axis,
                radius: 3.0,
            };
            let on_disk = warp::disk(stream.next_pair()).as_dvec2();
            let point = geometry(shape, frame).texture_point(hit(on_disk));
            let [normal, x, y] = disk::basis(frame.z_axis);
            let position = |uv: DVec2| wide.x_axis * (2.0 * uv.x - 1.0) + wide.y_axis * (2.0 * uv.y - 1.0);
            let expected = x * on_disk.x + y * on_disk.y;
            assert!(position(point.uv.as_dvec2()).distance(expected) < 1e-6, "{point:?}");
            check_tangent(point, normal, position);

            let (from, to) = (Vec3::ONE, Vec3::ONE + frame.y_axis * 5.0);
            let shape = InstanceShape::Cylinder { from, to, radius: 3.0 };
            let around = DVec2::new(f64::from(stream.next_f32()) * 4.0, stream.next_f64());
            let point = geometry(shape, frame).texture_point(hit(around));
            let [_, x, y] = cylinder::basis(from, to);
            let at = cylinder::direction(around.x);
            let normal = x * at.x + y * at.y;
            let position = |uv: DVec2| {
                let angle = TAU * (uv.x - 0.5);
                wide.x_axis * libm::sin(angle) + wide.z_axis * libm::cos(angle)
            };
            assert!(
                position(point.uv.as_dvec2()).distance(normal) < 2e-6,
                "{point:?} for {normal}"
            );
            assert!((f64::from(point.uv.y) - around.y).abs() < 1e-7);
            check_tangent(point, normal, position);
        }
    }

    #[test]
    fn meshes_are_textured_by_their_vertices() {
        let mut stream = stream(2);
        for case in 0..2000 {
            let mut corner = || warp::uniform_sphere(stream.next_pair());
            let (positions, normal) = (vec![corner(), corner(), corner()], corner());
            let cross = (positions[1] - positions[0]).cross(positions[2] - positions[0]);
            if cross.length() < 0.2 {
                continue;
            }
            let mut number = || Vec2::from_array(stream.next_pair());
            let uvs = vec![number(), number(), number()];
            let extent = (uvs[1] - uvs[0]).perp_dot(uvs[2] - uvs[0]);
            let smooth = case % 2 == 0 && normal.dot(cross.normalize()) > 0.3;
            let shading = if smooth { normal.normalize() } else { cross.normalize() };
            let shape = InstanceShape::Mesh {
                first_triangle: 0,
                triangle_count: 1,
                first_vertex: 0,
                first_normal: smooth.then_some(0),
                first_uv: Some(0),
            };
            let geometry = Geometry {
                positions: positions.clone(),
                normals: if smooth { vec![shading; 3] } else { Vec::new() },
                uvs: uvs.clone(),
                triangles: vec![[0, 1, 2]],
                ..geometry(shape, Mat3::IDENTITY)
            };
            let point = geometry.texture_point(hit(DVec2::new(0.25, 0.5)));
            let expected = uvs[0] * 0.25 + uvs[1] * 0.25 + uvs[2] * 0.5;
            assert!(point.uv.distance(expected) < 1e-6);
            if extent.abs() < 0.05 {
                continue;
            }
            // From texture coordinates to weights to positions, flattened onto the shading plane.
            let wide: Vec<DVec3> = positions.iter().map(|p| p.as_dvec3()).collect();
            let texture = glam::DMat2::from_cols((uvs[1] - uvs[0]).as_dvec2(), (uvs[2] - uvs[0]).as_dvec2());
            let normal = shading.as_dvec3().normalize();
            check_tangent(point, normal, |uv| {
                let weights = texture.inverse() * (uv - uvs[0].as_dvec2());
                let p = (wide[1] - wide[0]) * weights.x + (wide[2] - wide[0]) * weights.y;
                p - normal * normal.dot(p)
            });
        }
    }

    #[test]
    fn triangles_without_extent_on_the_texture_have_no_tangent() {
        let shape = |first_uv| InstanceShape::Mesh {
            first_triangle: 0,
            triangle_count: 1,
            first_vertex: 0,
            first_normal: None,
            first_uv,
        };
        let geometry = |first_uv, uvs: [Vec2; 3]| Geometry {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            uvs: uvs.to_vec(),
            triangles: vec![[0, 1, 2]],
            ..geometry(shape(first_uv), Mat3::IDENTITY)
        };
        let at = hit(DVec2::new(0.25, 0.25));
        for uvs in [[Vec2::splat(0.3); 3], [Vec2::ZERO, Vec2::ONE, Vec2::splat(0.25)]] {
            let point = geometry(Some(0), uvs).texture_point(at);
            assert!(point.tangent == Vec3::ZERO && point.uv.is_finite(), "{point:?}");
        }
        assert_eq!(geometry(None, [Vec2::ONE; 3]).texture_point(at), TexturePoint::NONE);
    }
}
