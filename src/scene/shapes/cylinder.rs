//! Cylinders: tubes without ends.

use super::{MIN_RADIUS, axes_about, similarity, too_far, too_small, unit_axes};
use crate::scene::at::{At, wide};
use crate::scene::error::SceneError;
use crate::scene::flatten::Geometry;
use crate::scene::mesh::MAX_COORDINATE;
use glam::{DAffine3, Vec3};

/// A tube in the world. `at` is the shape's place, for what its transform does to it.
pub(in crate::scene) fn geometry(
    at: &At,
    ends: [[f32; 3]; 2],
    radius: f32,
    map: &DAffine3,
    material: u32,
) -> Result<Geometry, SceneError> {
    let scale = similarity(at, map, "this transform would flatten the cylinder, or tilt its ends")?;
    let ends = ends.map(wide);
    let frame = unit_axes(map, axes_about(ends[1] - ends[0]));
    let [from, to] = ends.map(|end| map.transform_point3(end));
    let radius = scale * f64::from(radius);
    if from.abs().max(to.abs()).max_element() + radius > f64::from(MAX_COORDINATE) {
        return Err(too_far(at));
    }
    if radius < MIN_RADIUS {
        return Err(too_small(at, "cylinder", radius));
    }
    let [from, to]: [Vec3; 2] = [from, to].map(|end| end.as_vec3());
    let length = to.as_dvec3().distance(from.as_dvec3());
    let coordinates = f64::from(from.abs().max(to.abs()).max_element());
    if length < MIN_RADIUS || length < f64::from(8.0 * f32::EPSILON) * coordinates {
        let message = format!(
            "this cylinder's length in world space is {:e}, too small for its distance from the origin",
            length as f32
        );
        let help = "choose a smaller unit of length, move the scene to the origin, or use a `Disk`";
        return Err(at.error(message, help));
    }
    Ok(Geometry::Cylinder {
        from,
        to,
        radius: radius as f32,
        frame,
        material,
    })
}

#[cfg(test)]
mod tests {
    use crate::scene::Geometry;
    use crate::scene::testing::{flatten_one, try_flatten_one};
    use glam::{Mat3, Vec3};

    const TUBE: &str = "Cylinder(from: (1, 0, 0), to: (1, 0, 4), radius: 0.5)";

    #[test]
    fn a_similarity_moves_scales_and_turns_a_cylinder() {
        let tube = flatten_one(
            TUBE,
            "Scale((2, 2, 2)), Rotate(axis: (1, 0, 0), degrees: 90), Translate((0, 1, 0))",
        );
        let Geometry::Cylinder {
            from,
            to,
            radius,
            frame,
            ..
        } = tube.geometry
        else {
            panic!("{tube:?}")
        };
        // (1, 0, 4) -> (2, 0, 8) -> (2, -8, 0) -> (2, -7, 0)
        assert!(from.distance(Vec3::new(2.0, 1.0, 0.0)) < 1e-5 && to.distance(Vec3::new(2.0, -7.0, 0.0)) < 1e-5);
        assert!(radius == 1.0 && frame.y_axis.distance(Vec3::NEG_Y) < 1e-6);
        assert!((frame.transpose() * frame).abs_diff_eq(Mat3::IDENTITY, 1e-6));
    }

    #[test]
    fn what_is_no_similarity_or_leaves_no_length_is_refused() {
        for (transform, said) in [
            ("Scale((1, 1, 2))", "tilt its ends"),
            ("Translate((0, 0, 1e8))", "too small for its distance"),
            ("Scale((1e-9, 1e-9, 1e-9))", "radius in world space"),
            ("Translate((0, 0, 1e9))", "1e9 scene units"),
        ] {
            let error = try_flatten_one(TUBE, transform).expect_err(transform);
            assert!(error.plain().contains(said), "{transform}: {}", error.plain());
        }
    }
}
