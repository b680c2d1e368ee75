//! Ray against an open tube, and points on tubes.

use super::triangle::RayFrame;
use crate::tolerance::RIM_SLACK;
use glam::{DVec2, DVec3, Vec3};

/// Where a line crosses a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance in units of the direction's length; may be negative.
    pub t: f64,
    /// How far along from the first end to the second, as a share of the length.
    pub along: f64,
    /// From the axis to the point, at a right angle to the axis.
    pub outward: DVec3,
}

/// Where the ray's line crosses the tube, nearest first; `None` for what lies beyond its ends. In f64, as for spheres: the
/// discriminant comes from the distance of the line to the axis (Haines et al. 2019), and the near root from the product of
/// both. A line parallel to the axis never crosses.
#[inline]
#[must_use]
pub fn cross(ray: &RayFrame, from: Vec3, to: Vec3, radius: f32) -> [Option<Crossing>; 2] {
    let r = f64::from(radius);
    let axis = to.as_dvec3() - from.as_dvec3();
    let inverse = 1.0 / axis.length_squared();
    let w = ray.origin - from.as_dvec3();
    // Origin and direction along the axis, as shares of its length, and what is left at a right angle to it.
    let (w_along, d_along) = (w.dot(axis) * inverse, ray.direction.dot(axis) * inverse);
    let (w, d) = (w - axis * w_along, ray.direction - axis * d_along);
    let dd = d.length_squared();
    let closest = -w.dot(d) / dd;
    let off_axis = w + d * closest;
    let half_squared = (r * r - off_axis.length_squared()) / dd;
    // Not a number for a parallel line.
    if half_squared.is_nan() || half_squared < 0.0 {
        return [None; 2];
    }
    let half = half_squared.sqrt();
    let far = if closest >= 0.0 { closest + half } else { closest - half };
    let product = (w.length_squared() - r * r) / dd;
    let near = if far == 0.0 { 0.0 } else { product / far };
    let roots = if near <= far { [near, far] } else { [far, near] };
    roots.map(|t| {
        let along = w_along + d_along * t;
        let beyond = (-along).max(along - 1.0);
        let inside = beyond <= 0.0 || beyond * axis.length() <= slack(from, to, radius);
        inside.then(|| Crossing {
            t,
            along,
            outward: w + d * t,
        })
    })
}

/// The coordinates of a crossing: the angle around, as [`around`] counts it, and how far along.
#[inline]
#[must_use]
pub fn coordinates(crossing: &Crossing, from: Vec3, to: Vec3) -> DVec2 {
    let [_, x, y] = basis(from, to);
    let angle = around(crossing.outward.dot(x), crossing.outward.dot(y));
    DVec2::new(angle, crossing.along)
}

/// The unit vector along the tube, and two axes at right angles to it.
#[inline]
#[must_use]
pub fn basis(from: Vec3, to: Vec3) -> [DVec3; 3] {
    let axis = (to.as_dvec3() - from.as_dvec3()).normalize();
    let (x, y) = axis.any_orthonormal_pair();
    [axis, x, y]
}

/// The direction (x, y) as one number in [0, 4): how far around the square |x| + |y| = 1. Cheaper than an angle, and as
/// exact.
fn around(x: f64, y: f64) -> f64 {
    let sum = x.abs() + y.abs();
    let (x, y) = (x / sum, y / sum);
    match (x >= 0.0, y >= 0.0) {
        (true, true) => y,
        (false, true) => 1.0 - x,
        (false, false) => 2.0 - y,
        (true, false) => 3.0 + x,
    }
}

/// The unit vector at [`around`]'s number.
#[inline]
#[must_use]
pub fn direction(around: f64) -> DVec2 {
    let quarter = around.floor();
    let rest = around - quarter;
    let (x, y) = match quarter as i32 {
        0 => (1.0 - rest, rest),
        1 => (-rest, 1.0 - rest),
        2 => (rest - 1.0, -rest),
        // At 4 itself, to which the last quarter may round, the first direction again.
        3 => (rest, rest - 1.0),
        _ => (1.0, 0.0),
    };
    DVec2::new(x, y).normalize()
}

/// How far the tube reaches from both ends along each axis of the world, rim slack included.
#[must_use]
pub fn extent(from: Vec3, to: Vec3, radius: f32) -> DVec3 {
    let [a, ..] = basis(from, to);
    let across = |a: f64, b: f64| (a * a + b * b).sqrt();
    let reach = DVec3::new(across(a.y, a.z), across(a.x, a.z), across(a.x, a.y)) * f64::from(radius);
    reach + 2.0 * slack(from, to, radius)
}

/// How far beyond its ends a tube is still met, so that disks of the same radius close it: their normals are rounded, and so
/// are the ends, which turns the tube by the rounding over its length.
#[inline]
#[must_use]
pub fn slack(from: Vec3, to: Vec3, radius: f32) -> f64 {
    let length = (to.as_dvec3() - from.as_dvec3()).length();
    let coordinates = f64::from(from.abs().max(to.abs()).max_element());
    f64::from(radius) * RIM_SLACK * (1.0 + 2.0 * coordinates / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENDS: (Vec3, Vec3) = (Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 3.0, 0.0));

    fn roots(origin: Vec3, direction: DVec3, radius: f32) -> [Option<f64>; 2] {
        let ray = RayFrame::new(origin, direction);
        cross(&ray, ENDS.0, ENDS.1, radius).map(|crossing| crossing.map(|c| c.t))
    }

    #[test]
    fn a_line_across_the_tube_crosses_it_twice() {
        assert_eq!(
            roots(Vec3::new(5.0, 2.0, 0.0), DVec3::NEG_X, 1.0),
            [Some(4.0), Some(6.0)]
        );
        assert_eq!(roots(Vec3::new(0.0, 2.0, 0.0), DVec3::Z, 1.0), [Some(-1.0), Some(1.0)]);
        assert_eq!(roots(Vec3::new(5.0, 2.0, 1.000_001), DVec3::NEG_X, 1.0), [None; 2]);
    }

    #[test]
    fn what_lies_beyond_the_ends_is_missed() {
        assert_eq!(roots(Vec3::new(5.0, 3.1, 0.0), DVec3::NEG_X, 1.0), [None; 2]);
        // In through the open end, out through the side.
        assert_eq!(
            roots(Vec3::new(0.0, 5.0, 0.0), DVec3::new(0.5, -2.0, 0.0), 1.0),
            [None, Some(2.0)]
        );
        assert_eq!(
            roots(Vec3::new(5.0, 3.0, 0.0), DVec3::NEG_X, 1.0),
            [Some(4.0), Some(6.0)]
        );
    }

    #[test]
    fn a_line_along_the_axis_misses() {
        for x in [0.0, 0.5, 1.0, 2.0] {
            assert_eq!(roots(Vec3::new(x, -5.0, 0.0), DVec3::Y, 1.0), [None; 2], "{x}");
        }
    }

    #[test]
    fn directions_around_survive_the_round_trip() {
        for i in 0..=4000 {
            let angle = f64::from(i) * std::f64::consts::TAU / 4000.0;
            let (x, y) = (libm::cos(angle), libm::sin(angle));
            let back = direction(around(3.0 * x, 3.0 * y));
            assert!(back.distance(DVec2::new(x, y)) < 1e-15, "{angle}: {back}");
        }
        assert_eq!(direction(4.0), DVec2::X);
    }

    #[test]
    fn a_thin_distant_tube_is_met_where_it_is() {
        let (from, to) = (Vec3::new(-1.0, 0.0, -1e6), Vec3::new(1.0, 0.0, -1e6));
        let ray = RayFrame::new(Vec3::ZERO, DVec3::NEG_Z);
        let [near, far] = cross(&ray, from, to, 1e-3).map(|crossing| crossing.expect("straight at its axis"));
        assert!((near.t - (1e6 - 1e-3)).abs() < 1e-8 && (far.t - (1e6 + 1e-3)).abs() < 1e-8);
        assert_eq!((near.along, far.along), (0.5, 0.5));
    }
}
