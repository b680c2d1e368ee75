//! Ray against triangle, watertight.

use crate::tolerance::DISTANCE_SLACK;
use glam::{DVec3, Vec3};

/// A ray prepared for many triangles: its dominant axis becomes z, and a shear maps its direction onto z
/// (Woop, Benthin and Wald 2013, "Watertight ray/triangle intersection").
///
/// Computed in f64 from f32 inputs: vertex offsets are then practically exact, so neither a hit very near the origin
/// nor one far from the world's origin is lost, and f32's need for a second try on edges does not arise.
#[derive(Clone, Copy, Debug)]
pub struct RayFrame {
    /// Origin.
    pub origin: DVec3,
    /// Direction.
    pub direction: DVec3,
    /// Axes in the order that makes the dominant one the last.
    pub(super) axes: [u8; 3],
    /// The origin in that order.
    pub(super) ordered_origin: [f64; 3],
    pub(super) shear: [f64; 3],
}

/// Axes in the order that makes the dominant one the last, by that and by whether the direction goes backwards along it: then the
/// others change places, which keeps the winding.
const AXES: [[[u8; 3]; 2]; 3] = [[[1, 2, 0], [2, 1, 0]], [[2, 0, 1], [0, 2, 1]], [[0, 1, 2], [1, 0, 2]]];

/// A triangle's corners by axis, `[axis][corner]`: a ray picks whole rows in its own order of axes.
pub type CornerRows = [[f32; 3]; 3];

/// Where a ray meets a triangle's plane inside the triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance in units of the direction's length; may be negative.
    pub t: f64,
    /// Barycentric weight of the second corner.
    pub u: f64,
    /// Barycentric weight of the third corner.
    pub v: f64,
}

impl RayFrame {
    /// Prepares a ray. The direction must be finite and not zero.
    #[inline]
    #[must_use]
    pub fn new(origin: Vec3, direction: DVec3) -> Self {
        let (d, o) = (direction.to_array(), origin.as_dvec3().to_array());
        let size = d.map(f64::abs);
        // Without branches: which axis it is is anybody's guess.
        let is_first = (size[0] > size[1]) & (size[0] > size[2]);
        let dominant = usize::from(!is_first) * (2 - usize::from(size[1] > size[2]));
        let axes = AXES[dominant][usize::from(d[dominant] < 0.0)];
        let [x, y, z] = axes.map(usize::from);
        let shear = [d[x] / d[z], d[y] / d[z], 1.0 / d[z]];
        Self {
            origin: DVec3::from_array(o),
            direction,
            axes,
            ordered_origin: [o[x], o[y], o[z]],
            shear,
        }
    }

    /// How far off the distance of a triangle may be, with coordinates up to `reach`, by the roundings of [`cross`](Self::cross): some units
    /// of f64 in proportion to the coordinates, seen from the origin. More where it is seen edge-on.
    #[inline]
    #[must_use]
    pub fn distance_slack(&self, reach: f64) -> f64 {
        DISTANCE_SLACK * (reach + self.origin.abs().max_element()) * self.shear[2].abs()
    }

    /// Where the ray's line crosses a triangle, edges included; `None` if it does not, if the triangle is seen edge-on,
    /// or if a number is not finite.
    #[inline]
    #[must_use]
    pub fn cross(&self, corners: &CornerRows) -> Option<Crossing> {
        let row = |i: usize| corners[usize::from(self.axes[i])].map(|x| f64::from(x) - self.ordered_origin[i]);
        let (x, y, z) = (row(0), row(1), row(2));
        let [ax, bx, cx] = [0, 1, 2].map(|corner| x[corner] - self.shear[0] * z[corner]);
        let [ay, by, cy] = [0, 1, 2].map(|corner| y[corner] - self.shear[1] * z[corner]);
        let wa = cx * by - cy * bx;
        let wb = ax * cy - ay * cx;
        let wc = bx * ay - by * ax;
        let inside = (wa >= 0.0 && wb >= 0.0 && wc >= 0.0) || (wa <= 0.0 && wb <= 0.0 && wc <= 0.0);
        let det = wa + wb + wc;
        if !inside || det == 0.0 {
            return None;
        }
        let inverse = 1.0 / det;
        // From the first corner on, not as a sum of three weighted corners: where all are equally far, it is exact.
        let depth = z[0] + (wb * (z[1] - z[0]) + wc * (z[2] - z[0])) * inverse;
        Some(Crossing {
            t: depth * self.shear[2],
            u: wb * inverse,
            v: wc * inverse,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners (0, 0, 0), (1, 0, 0), (0, 1, 0).
    const UNIT: CornerRows = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];

    #[test]
    fn a_crossing_tells_distance_and_barycentric_weights() {
        let ray = RayFrame::new(Vec3::new(0.25, 0.5, 2.0), DVec3::new(0.0, 0.0, -2.0));
        assert_eq!(
            ray.cross(&UNIT),
            Some(Crossing {
                t: 1.0,
                u: 0.25,
                v: 0.5
            })
        );
    }

    #[test]
    fn edges_and_corners_belong_to_the_triangle() {
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.5, 0.0), (0.0, 0.5)] {
            let ray = RayFrame::new(Vec3::new(x, y, 1.0), DVec3::NEG_Z);
            assert!(ray.cross(&UNIT).is_some(), "({x}, {y})");
        }
    }

    #[test]
    fn numbers_that_are_not_finite_are_never_hit() {
        let ray = RayFrame::new(Vec3::new(0.25, 0.25, 1.0), DVec3::NEG_Z);
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for corner in 0..3 {
                for axis in 0..3 {
                    let mut triangle = UNIT;
                    triangle[axis][corner] = bad;
                    let hit = ray.cross(&triangle);
                    assert!(hit.is_none_or(|h| h.t.is_nan()), "{bad} at {corner}.{axis}: {hit:?}");
                }
            }
        }
    }
}
