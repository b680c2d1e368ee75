//! A sphere around a whole scene.

use glam::Vec3;

/// A sphere that nothing of a scene reaches out of. World space; its radius is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// Its centre.
    pub center: Vec3,
    /// Its radius, in scene units.
    pub radius: f32,
}

impl Default for BoundingSphere {
    /// The unit sphere: of a scene with nothing in it.
    fn default() -> Self {
        Self {
            center: Vec3::ZERO,
            radius: 1.0,
        }
    }
}

impl BoundingSphere {
    /// The sphere around a box, with room for the rounding of points on it to `f32`.
    #[must_use]
    pub fn around(least: Vec3, most: Vec3) -> Self {
        let center = ((least.as_dvec3() + most.as_dvec3()) * 0.5).as_vec3();
        let reach = (most.as_dvec3() - center.as_dvec3()).abs();
        let reach = reach.max((least.as_dvec3() - center.as_dvec3()).abs());
        // Four units of the largest coordinate's rounding, and as much again of the radius.
        let rounding = 4.0 * f64::from(f32::EPSILON);
        let largest = f64::from(center.abs().max_element()) + reach.max_element();
        let radius = (reach.length() * (1.0 + rounding) + largest * rounding) as f32;
        if radius > 0.0 && radius.is_finite() {
            Self { center, radius }
        } else {
            Self {
                center,
                ..Self::default()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sphere_holds_the_corners_of_its_box() {
        for (least, most) in [
            (Vec3::splat(-1.0), Vec3::splat(1.0)),
            (Vec3::new(1e6, -3.0, 2.0), Vec3::new(1_000_001.0, 4.0, 2.0)),
            (Vec3::splat(1e9), Vec3::splat(1e9)),
            (Vec3::ZERO, Vec3::new(1e-20, 0.0, 0.0)),
        ] {
            let sphere = BoundingSphere::around(least, most);
            for corner in [least, most, Vec3::new(least.x, most.y, least.z)] {
                let distance = corner.as_dvec3().distance(sphere.center.as_dvec3());
                assert!(distance < f64::from(sphere.radius), "{least} {most}: {sphere:?}");
            }
        }
    }

    #[test]
    fn a_point_at_the_origin_has_the_unit_sphere() {
        assert_eq!(
            BoundingSphere::around(Vec3::ZERO, Vec3::ZERO),
            BoundingSphere::default()
        );
    }
}
