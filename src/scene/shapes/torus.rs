//! Tori, as meshes whose vertices and shading normals are those of the torus.

use super::{axes_about, checked, normal_map};
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::mesh::Mesh;
use glam::{DAffine3, DVec3, Vec2};
use std::f64::consts::TAU;

/// A torus as the scene says it.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct Torus {
    pub(in crate::scene) center: [f32; 3],
    pub(in crate::scene) axis: [f32; 3],
    pub(in crate::scene) major_radius: f32,
    pub(in crate::scene) minor_radius: f32,
    /// Around the axis, and around the tube.
    pub(in crate::scene) segments: [u32; 2],
}

/// The triangles of a torus. Rows of vertices go around the axis, from below the tube's inside over its bottom, outside and
/// top; the first and the last of each row, and of all rows, are the same points with other texture coordinates.
pub(in crate::scene) fn mesh(at: &At, torus: Torus, map: &DAffine3, material: u32) -> Result<Mesh, SceneError> {
    let frame = axes_about(wide(torus.axis));
    let (center, major, minor) = (
        wide(torus.center),
        f64::from(torus.major_radius),
        f64::from(torus.minor_radius),
    );
    let [around, along] = torus.segments;
    let normals = normal_map(map);
    // The last is the first, to the last bit: sines of a whole turn are not.
    let turns = |segments: u32| {
        (0..=segments).map(move |i| {
            let angle = TAU * (f64::from(i % segments) / f64::from(segments) - 0.5);
            (libm::sin(angle), libm::cos(angle), i as f32 / segments as f32)
        })
    };
    let mut mesh = Mesh::default();
    let mut points = Vec::with_capacity((around as usize + 1) * (along as usize + 1));
    for (tube_sine, tube_cosine, v) in turns(along) {
        for (sine, cosine, u) in turns(around) {
            let outward = DVec3::new(sine, 0.0, cosine);
            let normal = outward * tube_cosine + DVec3::Y * tube_sine;
            points.push(center + frame * (outward * major + normal * minor));
            mesh.normals.push((normals * (frame * normal)).normalize().as_vec3());
            mesh.uvs.push(Vec2::new(u, v));
        }
    }
    let row = around + 1;
    let faces = (0..along).flat_map(|j| (0..around).map(move |i| j * row + i));
    let triangles = faces.flat_map(|a| [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]);
    mesh.add(&points, triangles, map, material);
    let mut mesh = checked(at, mesh)?;
    mesh.repair_normals();
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use crate::scene::testing::{areas, flatten_one, mesh_of, normals, volume};
    use glam::Vec3;
    use std::f64::consts::PI;

    fn torus(segments: &str, transform: &str) -> crate::scene::Mesh {
        let shape = format!(
            "Torus(center: (1, 2, 3), axis: (0, 0, 1), major_radius: 2, minor_radius: 0.5, segments: {segments})"
        );
        mesh_of(&flatten_one(&shape, transform))
    }

    fn total(values: Vec<f32>) -> f64 {
        values.into_iter().map(f64::from).sum()
    }

    /// Pappus: area 4π²Rr, volume 2π²Rr². Both fall short by terms quadratic in the size of a segment.
    #[test]
    fn area_and_volume_approach_those_of_the_torus() {
        let mut last = [f64::INFINITY; 2];
        for segments in ["(16, 8)", "(32, 16)", "(64, 32)", "(128, 64)"] {
            let mesh = torus(segments, "Translate((-1, -2, -3))");
            let missing = [
                1.0 - total(areas(&mesh)) / (4.0 * PI * PI),
                1.0 - f64::from(volume(&mesh)) / (PI * PI),
            ];
            for (missing, last) in missing.into_iter().zip(last) {
                assert!(
                    missing > 0.0 && missing < last / 3.5,
                    "{segments}: {missing} after {last}"
                );
            }
            last = missing;
        }
        assert!(last[0] < 1e-3 && last[1] < 3e-3, "{last:?}");
    }

    #[test]
    fn normals_point_outward_however_it_is_transformed() {
        for transform in [
            "",
            "Scale((-1, 1, 1))",
            "Scale((3, 0.2, 1)), Rotate(axis: (1, 2, 3), degrees: 77)",
        ] {
            let mesh = torus("(48, 24)", transform);
            assert!(
                volume(&torus("(48, 24)", &format!("Translate((-1, -2, -3)), {transform}"))) > 0.5,
                "{transform}"
            );
            for (triangle, normal) in normals(&mesh).into_iter().enumerate() {
                for corner in mesh.triangles[triangle] {
                    let shading = mesh.normals[corner as usize];
                    assert!(
                        shading.is_normalized() && shading.dot(normal) > 0.5,
                        "{transform}: {shading} on {normal}"
                    );
                }
            }
        }
    }

    #[test]
    fn vertices_lie_on_the_torus_and_their_normals_are_its_own() {
        let mesh = torus("(20, 10)", "");
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            let p = position.as_dvec3() - glam::DVec3::new(1.0, 2.0, 3.0);
            let ring = glam::DVec3::new(p.x, p.y, 0.0).normalize() * 2.0;
            assert!((p.distance(ring) - 0.5).abs() < 1e-6);
            assert!((p - ring).normalize().distance(normal.as_dvec3()) < 1e-6);
        }
    }

    #[test]
    fn the_seams_are_closed_to_the_last_bit() {
        let mesh = torus("(7, 5)", "Rotate(axis: (1, 2, 3), degrees: 33)");
        let at = |i: usize, j: usize| mesh.positions[j * 8 + i].to_array().map(f32::to_bits);
        for j in 0..=5 {
            assert_eq!(at(0, j), at(7, j));
        }
        for i in 0..=7 {
            assert_eq!(at(i, 0), at(i, 5));
        }
    }

    #[test]
    fn texture_coordinates_go_around_and_up_the_outside() {
        let mesh = mesh_of(&flatten_one(
            "Torus(major_radius: 2, minor_radius: 0.5, segments: (8, 4))",
            "",
        ));
        // Half of both turns: the outermost point towards +z, with the axis upright.
        let outermost = 2 * 9 + 4;
        assert!(mesh.positions[outermost].distance(Vec3::new(0.0, 0.0, 2.5)) < 1e-6);
        assert_eq!(mesh.uvs[outermost].to_array(), [0.5, 0.5]);
        assert!(mesh.positions[outermost + 1].x > 0.1, "u grows to the right");
        assert!(mesh.positions[outermost + 9].y > 0.1, "v grows upwards");
    }
}
