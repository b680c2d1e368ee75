//! Spheres.

use super::{MIN_RADIUS, similarity, too_far, too_small, unit_axes};
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::flatten::Geometry;
use crate::scene::mesh::MAX_COORDINATE;
use glam::{DAffine3, DMat3};

/// A sphere in the world. `at` is the shape's place, for what its transform does to it.
pub(in crate::scene) fn geometry(
    at: &At,
    center: [f32; 3],
    radius: f32,
    map: &DAffine3,
    material: u32,
) -> Result<Geometry, SceneError> {
    let scale = similarity(at, map, "this transform would make an ellipsoid of the sphere")?;
    let center = map.transform_point3(wide(center));
    let radius = scale * f64::from(radius);
    if center.abs().max_element() + radius > f64::from(MAX_COORDINATE) {
        return Err(too_far(at));
    }
    if radius < MIN_RADIUS {
        return Err(too_small(at, "sphere", radius));
    }
    Ok(Geometry::Sphere {
        center: center.as_vec3(),
        radius: radius as f32,
        frame: unit_axes(map, DMat3::IDENTITY),
        material,
    })
}

#[cfg(test)]
mod tests {
    use crate::scene::Geometry;
    use crate::scene::testing::{flatten_one, try_flatten_one};
    use glam::Vec3;

    const SPHERE: &str = "Sphere(center: (1, 0, 0), radius: 2)";

    #[test]
    fn a_similarity_moves_and_scales_a_sphere() {
        let moved = flatten_one(
            SPHERE,
            "Scale((-3, 3, 3)), Rotate(axis: (0, 2, 0), degrees: 90), Translate((0, 1, 0))",
        );
        let Geometry::Sphere {
            center,
            radius,
            frame,
            material,
        } = moved.geometry
        else {
            panic!("{moved:?}")
        };
        // (1, 0, 0) -> (-3, 0, 0) -> (0, 0, 3) -> (0, 1, 3)
        assert!(center.distance(Vec3::new(0.0, 1.0, 3.0)) < 1.0e-5, "{center}");
        assert_eq!((radius, material), (6.0, 0));
        // Mirrored along x, then turned about y.
        assert!(
            frame.x_axis.distance(Vec3::Z) < 1e-6 && frame.y_axis == Vec3::Y && frame.z_axis.distance(Vec3::X) < 1e-6
        );
    }

    #[test]
    fn an_ellipsoid_is_refused_and_a_rounded_matrix_is_not() {
        let error = try_flatten_one(SPHERE, "Scale((1, 1, 1.01))").expect_err("an ellipsoid");
        assert!(error.advice().contains("Obj"), "{}", error.plain());
        let rounded = "Matrix(((0.707107, -0.707107, 0, 0), (0.707107, 0.707107, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))";
        assert!(try_flatten_one(SPHERE, rounded).is_ok());
    }
}
