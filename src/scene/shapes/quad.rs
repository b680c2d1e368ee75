//! Quads: parallelograms, as two triangles.

use super::checked;
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::mesh::Mesh;
use glam::{DAffine3, Vec2};

/// Texture coordinates of the corners, counter-clockwise from the lower left.
pub(super) const CORNERS: [Vec2; 4] = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];

/// The two triangles of a quad. Vertices: corner, corner + u, corner + u + v, corner + v.
pub(in crate::scene) fn mesh(
    at: &At,
    corner: [f32; 3],
    edges: [[f32; 3]; 2],
    map: &DAffine3,
    material: u32,
) -> Result<Mesh, SceneError> {
    let corner = wide(corner);
    let [u, v] = edges.map(wide);
    let mut mesh = Mesh {
        uvs: CORNERS.to_vec(),
        ..Mesh::default()
    };
    mesh.add(
        &[corner, corner + u, corner + u + v, corner + v],
        [[0, 1, 2], [0, 2, 3]].into_iter(),
        map,
        material,
    );
    checked(at, mesh)
}

#[cfg(test)]
mod tests {
    use crate::scene::testing::{areas, flatten_one, mesh_of, normals};
    use glam::Vec3;

    const QUAD: &str = "Quad(corner: (1, 2, 3), edge_u: (2, 0, 0), edge_v: (0, 0, -3))";

    #[test]
    fn a_quad_is_two_triangles_of_its_area_facing_u_cross_v() {
        let mesh = mesh_of(&flatten_one(QUAD, ""));
        assert_eq!(mesh.positions.len(), 4);
        assert_eq!(areas(&mesh), [3.0, 3.0]);
        assert_eq!(normals(&mesh), [Vec3::Y; 2]);
    }

    #[test]
    fn a_mirrored_quad_faces_the_mirrored_side() {
        let across = mesh_of(&flatten_one(QUAD, "Scale((1, -1, 1))"));
        assert_eq!(normals(&across), [Vec3::NEG_Y; 2]);
        let along = mesh_of(&flatten_one(QUAD, "Scale((-1, 1, 1))"));
        assert_eq!(normals(&along), [Vec3::Y; 2]);
        assert_eq!(areas(&along), [3.0, 3.0]);
    }

    #[test]
    fn transforms_apply_in_the_order_listed() {
        let mesh = mesh_of(&flatten_one(
            QUAD,
            "Translate((1, 0, 0)), Scale((2, 1, 1)), Rotate(axis: (0, 0, 1), degrees: 90)",
        ));
        // (1, 2, 3) -> (2, 2, 3) -> (4, 2, 3) -> (-2, 4, 3)
        assert!(
            mesh.positions[0].distance(Vec3::new(-2.0, 4.0, 3.0)) < 1.0e-6,
            "{}",
            mesh.positions[0]
        );
        let mesh = mesh_of(&flatten_one(QUAD, "Scale((2, 1, 1)), Translate((1, 0, 0))"));
        assert_eq!(mesh.positions[0], Vec3::new(3.0, 2.0, 3.0));
    }

    #[test]
    fn a_matrix_is_four_rows() {
        let mesh = mesh_of(&flatten_one(
            QUAD,
            "Matrix(((1, 0, 0, 10), (0, 0, -1, 20), (0, 1, 0, 30), (0, 0, 0, 1)))",
        ));
        assert_eq!(mesh.positions[0], Vec3::new(11.0, 17.0, 32.0));
        assert_eq!(normals(&mesh), [Vec3::Z; 2]);
    }
}
