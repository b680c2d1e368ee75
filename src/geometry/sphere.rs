//! Ray against sphere.

use super::triangle::RayFrame;
use glam::{DVec3, Vec3};

/// The distances at which the ray's line enters and leaves the sphere, in units of the direction's length; `None` if
/// it misses. Computed in f64, with the discriminant from the distance of the centre to the line rather than from
/// b² − 4ac, which cancels for small or distant spheres (Hearn and Baker; Haines et al. 2019, "Precision
/// improvements for ray/sphere intersection").
#[inline]
#[must_use]
pub fn cross(ray: &RayFrame, center: Vec3, radius: f32) -> Option<[f64; 2]> {
    let radius = f64::from(radius);
    let d = ray.direction;
    let to_center = center.as_dvec3() - ray.origin;
    let dd = d.dot(d);
    let closest = to_center.dot(d) / dd;
    let off_line: DVec3 = to_center - d * closest;
    let half_squared = (radius * radius - off_line.dot(off_line)) / dd;
    if half_squared.is_nan() || half_squared < 0.0 {
        return None;
    }
    let half = half_squared.sqrt();
    // The root farther from the origin is exact; the nearer one follows from their product without cancellation.
    let far = if closest >= 0.0 { closest + half } else { closest - half };
    let product = (to_center.dot(to_center) - radius * radius) / dd;
    let near = if far == 0.0 { 0.0 } else { product / far };
    Some(if near <= far { [near, far] } else { [far, near] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_the_centre_enters_and_leaves_a_radius_away() {
        let ray = RayFrame::new(Vec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z);
        assert_eq!(cross(&ray, Vec3::ZERO, 2.0), Some([3.0, 7.0]));
        let inside = RayFrame::new(Vec3::ZERO, DVec3::X);
        assert_eq!(cross(&inside, Vec3::ZERO, 2.0), Some([-2.0, 2.0]));
        let behind = RayFrame::new(Vec3::new(5.0, 0.0, 0.0), DVec3::X);
        assert_eq!(cross(&behind, Vec3::ZERO, 2.0), Some([-7.0, -3.0]));
    }

    #[test]
    fn a_line_past_the_sphere_misses() {
        let ray = RayFrame::new(Vec3::new(0.0, 2.000_001, 5.0), DVec3::NEG_Z);
        assert_eq!(cross(&ray, Vec3::ZERO, 2.0), None);
    }

    #[test]
    fn a_tiny_distant_sphere_is_met_where_it_is() {
        let (center, radius) = (Vec3::new(0.0, 0.0, -1e6), 1e-3);
        let ray = RayFrame::new(Vec3::ZERO, DVec3::NEG_Z);
        let [near, far] = cross(&ray, center, radius).expect("straight at its centre");
        assert!(
            (near - (1e6 - 1e-3)).abs() < 1e-8 && (far - (1e6 + 1e-3)).abs() < 1e-8,
            "{near} {far}"
        );
    }
}
