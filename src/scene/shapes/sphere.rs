//! Spheres.

use super::too_far;
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::flatten::Geometry;
use crate::scene::mesh::MAX_COORDINATE;
use crate::scene::transform::similarity_scale;
use glam::DAffine3;

/// The smallest radius in world space: with it, areas and their reciprocals stay in the range of `f32`.
const MIN_RADIUS: f64 = 1.0e-9;

/// A sphere in the world. `at` is the shape's place, for what its transform does to it.
pub(in crate::scene) fn geometry(
    at: &At,
    center: [f32; 3],
    radius: f32,
    map: &DAffine3,
    material: u32,
) -> Result<Geometry, SceneError> {
    let Some(scale) = similarity_scale(map) else {
        let message = "this transform would make an ellipsoid of the sphere";
        return Err(at
            .key("transform")
            .error(message, "scale it alike along all axes, or use an `Obj` mesh instead"));
    };
    let center = map.transform_point3(wide(center));
    let radius = scale * f64::from(radius);
    if center.abs().max_element() + radius > f64::from(MAX_COORDINATE) {
        return Err(too_far(at));
    }
    if radius < MIN_RADIUS {
        let message = format!(
            "this sphere's radius in world space is {:e}, too small to compute with",
            radius as f32
        );
        return Err(at.error(message, "choose a smaller unit of length"));
    }
    Ok(Geometry::Sphere {
        center: center.as_vec3(),
        radius: radius as f32,
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
            material,
        } = moved.geometry
        else {
            panic!("{moved:?}")
        };
        // (1, 0, 0) -> (-3, 0, 0) -> (0, 0, 3) -> (0, 1, 3)
        assert!(center.distance(Vec3::new(0.0, 1.0, 3.0)) < 1.0e-5, "{center}");
        assert_eq!((radius, material), (6.0, 0));
    }

    #[test]
    fn an_ellipsoid_is_refused_and_a_rounded_matrix_is_not() {
        let error = try_flatten_one(SPHERE, "Scale((1, 1, 1.01))").expect_err("an ellipsoid");
        assert!(error.advice().contains("Obj"), "{}", error.plain());
        let rounded = "Matrix(((0.707107, -0.707107, 0, 0), (0.707107, 0.707107, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))";
        assert!(try_flatten_one(SPHERE, rounded).is_ok());
    }
}
