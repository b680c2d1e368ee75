//! Boxes, as twelve triangles.

use super::checked;
use super::quad::CORNERS;
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::mesh::Mesh;
use glam::{DAffine3, DVec3};

/// The faces, counter-clockwise seen from outside, and which of their corners is the lower left of the texture: up is +y on
/// the sides, -z on top and +z below. Bit 0 of a corner's number chooses x from `max`, bit 1 y, bit 2 z.
const FACES: [([u32; 4], usize); 6] = [
    ([0, 4, 6, 2], 0), // -x
    ([1, 3, 7, 5], 3), // +x
    ([0, 1, 5, 4], 0), // -y
    ([2, 6, 7, 3], 1), // +y
    ([0, 2, 3, 1], 3), // -z
    ([4, 5, 7, 6], 0), // +z
];

/// The twelve triangles of a box. Each face has corners of its own, for its texture coordinates.
pub(in crate::scene) fn mesh(
    at: &At,
    min: [f32; 3],
    max: [f32; 3],
    map: &DAffine3,
    material: u32,
) -> Result<Mesh, SceneError> {
    let (min, max) = (wide(min), wide(max));
    let pick = |corner: u32, axis: usize| if corner >> axis & 1 == 1 { max[axis] } else { min[axis] };
    let corner = |corner: u32| DVec3::new(pick(corner, 0), pick(corner, 1), pick(corner, 2));
    let corners: Vec<DVec3> = FACES.into_iter().flat_map(|(corners, _)| corners).map(corner).collect();
    let triangles = (0..6).flat_map(|face| [[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|i| 4 * face + i)));
    let mut mesh = Mesh {
        uvs: FACES
            .iter()
            .flat_map(|(_, first)| (0..4).map(move |i| CORNERS[(i + 4 - first) % 4]))
            .collect(),
        ..Mesh::default()
    };
    mesh.add(&corners, triangles, map, material);
    checked(at, mesh)
}

#[cfg(test)]
mod tests {
    use crate::scene::testing::{areas, flatten_one, mesh_of, volume};
    use glam::{Vec2, Vec3};

    const BOX: &str = "Box(min: (-1, 0, 2), max: (1, 3, 6))";

    #[test]
    fn a_box_has_its_area_and_its_volume_with_normals_outward() {
        let mesh = mesh_of(&flatten_one(BOX, ""));
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (24, 12));
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
    fn faces_are_textured_upright() {
        let mesh = mesh_of(&flatten_one(BOX, ""));
        for face in 0..6 {
            let at = |uv: Vec2| {
                (0..4)
                    .find(|i| mesh.uvs[4 * face + i] == uv)
                    .map(|i| mesh.positions[4 * face + i])
            };
            let [a, b, d] = [Vec2::ZERO, Vec2::X, Vec2::Y].map(|uv| at(uv).expect("a corner"));
            let (right, up, normal) = (b - a, d - a, mesh.geometric_normal(2 * face));
            assert!(right.cross(up).dot(normal) > 0.0, "face {face} is seen from behind");
            let expected = if normal.y == 0.0 {
                Vec3::Y
            } else {
                Vec3::NEG_Z * normal.y
            };
            assert!(up.normalize().distance(expected) < 1e-6, "face {face}: {up}");
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
