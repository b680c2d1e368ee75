//! Boxes, as twelve triangles.

use super::checked;
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::mesh::Mesh;
use glam::{DAffine3, DVec3};

/// The faces, counter-clockwise seen from outside. Bit 0 of a corner's number chooses x from `max`, bit 1 y, bit 2 z.
const FACES: [[u32; 4]; 6] = [
    [0, 4, 6, 2], // -x
    [1, 3, 7, 5], // +x
    [0, 1, 5, 4], // -y
    [2, 6, 7, 3], // +y
    [0, 2, 3, 1], // -z
    [4, 5, 7, 6], // +z
];

/// The twelve triangles of a box; its eight vertices are shared.
pub(in crate::scene) fn mesh(
    at: &At,
    min: [f32; 3],
    max: [f32; 3],
    map: &DAffine3,
    material: u32,
) -> Result<Mesh, SceneError> {
    let (min, max) = (wide(min), wide(max));
    let pick = |corner: u32, axis: usize| if corner >> axis & 1 == 1 { max[axis] } else { min[axis] };
    let corners: Vec<DVec3> = (0..8)
        .map(|corner| DVec3::new(pick(corner, 0), pick(corner, 1), pick(corner, 2)))
        .collect();
    let triangles = FACES.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let mut mesh = Mesh::default();
    mesh.add(&corners, triangles, map, material);
    checked(at, mesh)
}

#[cfg(test)]
mod tests {
    use crate::scene::testing::{areas, flatten_one, mesh_of, volume};
    use glam::Vec3;

    const BOX: &str = "Box(min: (-1, 0, 2), max: (1, 3, 6))";

    #[test]
    fn a_box_has_its_area_and_its_volume_with_normals_outward() {
        let mesh = mesh_of(&flatten_one(BOX, ""));
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8, 12));
        assert_eq!(
            areas(&mesh).iter().sum::<f32>(),
            2.0 * (2.0 * 3.0 + 3.0 * 4.0 + 2.0 * 4.0)
        );
        // By the divergence theorem: positive when normals point outward.
        assert!((volume(&mesh) - 24.0).abs() < 1.0e-4);
        let centre = Vec3::new(0.0, 1.5, 4.0);
        for triangle in 0..12 {
            assert!(mesh.geometric_normal(triangle).dot(mesh.corners(triangle)[0] - centre) > 0.0);
        }
    }

    #[test]
    fn normals_stay_outward_under_mirroring_and_shear() {
        for transform in [
            "Scale((-1, 1, 1))",
            "Scale((-1, -2, -3)), Rotate(axis: (1, 2, 3), degrees: 77)",
            "Matrix(((1, 0.5, 0, 0), (0, 1, 0, 0), (0, 0.25, -1, 7), (0, 0, 0, 1)))",
        ] {
            assert!(volume(&mesh_of(&flatten_one(BOX, transform))) > 1.0, "{transform}");
        }
    }
}
