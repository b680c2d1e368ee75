//! Disks.

use super::{MIN_RADIUS, similarity, too_far, too_small, unit_axes};
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::flatten::Geometry;
use crate::scene::mesh::MAX_COORDINATE;
use glam::{DAffine3, DMat3, DVec3};

/// A disk in the world. `at` is the shape's place, for what its transform does to it.
pub(in crate::scene) fn geometry(
    at: &At,
    center: [f32; 3],
    normal: [f32; 3],
    radius: f32,
    map: &DAffine3,
    material: u32,
) -> Result<Geometry, SceneError> {
    let scale = similarity(at, map, "this transform would make an ellipse of the disk")?;
    let center = map.transform_point3(wide(center));
    let radius = scale * f64::from(radius);
    if center.abs().max_element() + radius > f64::from(MAX_COORDINATE) {
        return Err(too_far(at));
    }
    if radius < MIN_RADIUS {
        return Err(too_small(at, "disk", radius));
    }
    Ok(Geometry::Disk {
        center: center.as_vec3(),
        radius: radius as f32,
        frame: unit_axes(map, facing(wide(normal))),
        material,
    })
}

/// What is right, up and towards somebody who looks at a surface from its front: up is +y as far as that goes, and -z on a
/// surface that lies flat.
fn facing(normal: DVec3) -> DMat3 {
    let normal = normal.normalize();
    let upwards = if normal.y.abs() < 0.999 { DVec3::Y } else { DVec3::NEG_Z };
    let right = upwards.cross(normal).normalize();
    DMat3::from_cols(right, normal.cross(right), normal)
}

#[cfg(test)]
mod tests {
    use crate::scene::Geometry;
    use crate::scene::testing::{flatten_one, try_flatten_one};
    use glam::{Mat3, Vec3};

    fn disk(normal: &str, transform: &str) -> (Vec3, f32, Mat3) {
        let shape = format!("Disk(center: (1, 2, 3), normal: {normal}, radius: 0.5)");
        let Geometry::Disk {
            center,
            radius,
            frame,
            material: 0,
        } = flatten_one(&shape, transform).geometry
        else {
            panic!("no disk")
        };
        (center, radius, frame)
    }

    #[test]
    fn a_similarity_moves_scales_and_turns_a_disk() {
        let (center, radius, frame) = disk("(0, 0, 2)", "Scale((3, 3, 3)), Rotate(axis: (0, 1, 0), degrees: 90)");
        // (1, 2, 3) -> (3, 6, 9) -> (9, 6, -3)
        assert!(center.distance(Vec3::new(9.0, 6.0, -3.0)) < 1e-5, "{center}");
        assert!(radius == 1.5 && frame.z_axis.distance(Vec3::X) < 1e-6 && frame.y_axis.distance(Vec3::Y) < 1e-6);
        assert!(frame.x_axis.distance(Vec3::NEG_Z) < 1e-6);
    }

    #[test]
    fn a_mirrored_disk_faces_the_mirrored_side() {
        let (center, _, frame) = disk("(0, 1, 1)", "Scale((1, 1, -1))");
        assert_eq!(center, Vec3::new(1.0, 2.0, -3.0));
        let expected = Vec3::new(0.0, 1.0, -1.0).normalize();
        assert!(frame.z_axis.distance(expected) < 1e-6 && frame.determinant() < 0.0);
    }

    #[test]
    fn the_axes_of_a_disk_are_at_right_angles_however_it_faces() {
        for normal in ["(0, 1, 0)", "(0, -3, 0)", "(1e-6, 1, 0)", "(1, 2, 3)", "(0, 0, -1)"] {
            let (_, _, frame) = disk(normal, "");
            assert!(
                (frame.transpose() * frame).abs_diff_eq(Mat3::IDENTITY, 1e-6),
                "{normal}: {frame}"
            );
            assert!(frame.determinant() > 0.0, "{normal}");
        }
    }

    #[test]
    fn an_ellipse_is_refused() {
        let shape = "Disk(center: (0, 0, 0), normal: (0, 1, 0), radius: 1)";
        let error = try_flatten_one(shape, "Scale((2, 1, 1))").expect_err("an ellipse");
        assert!(error.plain().contains("ellipse"), "{}", error.plain());
    }
}
