//! Ray against disk, and points on disks.

use super::triangle::RayFrame;
use crate::tolerance::RIM_SLACK;
use glam::{DVec2, DVec3, Vec3};

/// The distance at which the ray's line crosses the disk, rim included, and where on it: in radii along the
/// [axes](basis) of its plane. `None` where it does not, or runs parallel to it. In f64, so that points near the origin
/// and rays that graze are found.
#[inline]
#[must_use]
pub fn cross(ray: &RayFrame, center: Vec3, normal: Vec3, radius: f32) -> Option<(f64, DVec3)> {
    let n = normal.as_dvec3();
    let to_center = center.as_dvec3() - ray.origin;
    let t = n.dot(to_center) / n.dot(ray.direction);
    let from_center = ray.direction * t - to_center;
    let reach = f64::from(radius) + slack(center, radius);
    // False too where the line is parallel: its distance is infinite, or not a number.
    (from_center.length_squared() <= reach * reach).then_some((t, from_center))
}

/// The coordinates of a vector from the centre: in radii along the axes of the disk's plane.
#[inline]
#[must_use]
pub fn coordinates(from_center: DVec3, normal: Vec3, radius: f32) -> DVec2 {
    let [_, x, y] = basis(normal);
    DVec2::new(from_center.dot(x), from_center.dot(y)) / f64::from(radius)
}

/// The unit normal, and two axes of the plane, all at right angles.
#[inline]
#[must_use]
pub fn basis(normal: Vec3) -> [DVec3; 3] {
    let normal = normal.as_dvec3().normalize();
    let (x, y) = normal.any_orthonormal_pair();
    [normal, x, y]
}

/// How far the disk reaches along each axis of the world, rim slack included.
#[must_use]
pub fn extent(center: Vec3, normal: Vec3, radius: f32) -> DVec3 {
    let n = normal.as_dvec3().normalize();
    let across = |a: f64, b: f64| (a * a + b * b).sqrt();
    let slack = slack(center, radius);
    DVec3::new(across(n.y, n.z), across(n.x, n.z), across(n.x, n.y)) * f64::from(radius) + 2.0 * slack
}

/// How far beyond its rim a disk is still met, so that a tube of the same radius that ends in its plane is closed by it.
/// Ends of a tube about as long as its radius are rounded, so that it is not quite at a right angle to the disk; the gap
/// is quadratic in the angle.
#[inline]
#[must_use]
pub fn slack(center: Vec3, radius: f32) -> f64 {
    let radius = f64::from(radius);
    let tilt = 2.0 * RIM_SLACK * f64::from(center.abs().max_element()) / radius;
    radius * (RIM_SLACK + tilt * tilt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_the_disk_crosses_it_once() {
        let ray = RayFrame::new(Vec3::new(0.5, 1.0, 5.0), DVec3::NEG_Z);
        let (t, at) = cross(&ray, Vec3::new(0.0, 1.0, 2.0), Vec3::Z, 1.0).expect("inside");
        assert_eq!((t, at), (3.0, DVec3::new(0.5, 0.0, 0.0)));
        let uv = coordinates(at, Vec3::Z, 1.0);
        assert!((uv.length() - 0.5).abs() < 1e-15);
        assert!(cross(&ray, Vec3::new(0.0, 1.0, 2.0), Vec3::Z, 0.499_999).is_none());
    }

    #[test]
    fn a_line_in_the_plane_or_parallel_to_it_misses() {
        for height in [0.0, 1.0] {
            let ray = RayFrame::new(Vec3::new(-5.0, 0.0, height), DVec3::X);
            assert!(cross(&ray, Vec3::ZERO, Vec3::Z, 1.0).is_none(), "{height}");
        }
    }

    #[test]
    fn the_rim_belongs_to_the_disk() {
        let ray = RayFrame::new(Vec3::new(0.6, 0.8, 1.0), DVec3::NEG_Z);
        assert!(cross(&ray, Vec3::ZERO, Vec3::Z, 1.0).is_some());
    }
}
