//! Measures: in which units the density of a path's vertex is, and how it follows from that of a direction.
//!
//! A vertex has its density **per unit area** where it is on a surface, **per unit solid angle** of its direction where it is
//! at infinity, and a probability where it is one of a few (a point light). Directions are drawn per unit solid angle, or, by
//! an end at infinity, all alike over a plane that faces them: **per unit area of that plane**. Discrete scattering draws
//! with a probability, which is carried along as if it were per solid angle: only ratios of densities are ever used, and
//! [`Scattered::reverse`](crate::material::Scattered::reverse) has the factor that makes them right.

use super::columns::{VERTEX_DISCRETE, VERTEX_INFINITE};
use glam::{DVec3, Vec3};

/// Where a vertex is, as far as measures need to know.
#[derive(Clone, Copy, Debug)]
pub struct Site {
    /// Its kind.
    pub kind: u32,
    /// World-space position; of no meaning at infinity.
    pub position: Vec3,
    /// Unit geometric normal of the surface; zero for a point without one. At infinity, the unit direction from there into
    /// the scene.
    pub normal: Vec3,
}

impl Site {
    /// Whether the vertex has a direction and no position.
    #[inline]
    #[must_use]
    pub const fn is_infinite(&self) -> bool {
        self.kind == VERTEX_INFINITE
    }

    /// Whether a path that goes through this vertex can be joined to another one here.
    #[inline]
    #[must_use]
    pub const fn connects(&self) -> bool {
        self.kind != VERTEX_DISCRETE
    }

    /// The density of the vertex `to`, of a path that leaves this one in its direction with `density`: per solid angle, or, if
    /// this one is at infinity, per area of a plane that faces the direction.
    #[inline]
    #[must_use]
    pub fn arriving(&self, to: &Self, density: f32) -> f64 {
        let density = f64::from(density);
        if to.is_infinite() {
            return density;
        }
        if self.is_infinite() {
            return density * facing(to.normal, self.normal.as_dvec3());
        }
        let span = to.position.as_dvec3() - self.position.as_dvec3();
        let squared = span.length_squared();
        if squared == 0.0 {
            return 0.0;
        }
        density * facing(to.normal, span / squared.sqrt()) / squared
    }

    /// The same where a ray in the unit direction `ray`, there or back, found one vertex from the other: the cosine is the ray's.
    ///
    /// Rays start off their surfaces, and positions are rounded, so that the direction between positions is off by as much over
    /// their distance. Mirrors and clear glass send light on at an angle that follows exactly from the one at which it came; where
    /// an edge is short and light grazes, cosines from positions would not cancel along a path through them.
    #[inline]
    #[must_use]
    pub fn arriving_along(&self, to: &Self, density: f32, ray: Vec3) -> f64 {
        if to.is_infinite() || self.is_infinite() {
            return self.arriving(to, density);
        }
        let squared = (to.position.as_dvec3() - self.position.as_dvec3()).length_squared();
        if squared == 0.0 {
            return 0.0;
        }
        f64::from(density) * facing(to.normal, ray.as_dvec3()) / squared
    }
}

/// |cos| between a normal and a unit direction; 1 for a point without a normal.
#[inline]
fn facing(normal: Vec3, direction: DVec3) -> f64 {
    if normal == Vec3::ZERO {
        1.0
    } else {
        normal.as_dvec3().dot(direction).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::VERTEX_SURFACE;

    fn at(position: Vec3, normal: Vec3) -> Site {
        Site {
            kind: VERTEX_SURFACE,
            position,
            normal,
        }
    }

    #[test]
    fn a_solid_angle_covers_area_with_the_square_of_the_distance_over_the_cosine() {
        let tilted = Vec3::new(0.0, 0.6, -0.8);
        let (from, to) = (at(Vec3::ZERO, Vec3::Z), at(Vec3::new(0.0, 0.0, 2.0), tilted));
        assert!((from.arriving(&to, 3.0) - 3.0 * 0.8 / 4.0).abs() < 1e-7);
        let point = at(Vec3::new(0.0, 0.0, 2.0), Vec3::ZERO);
        assert_eq!(from.arriving(&point, 3.0), 0.75);
    }

    #[test]
    fn cosines_along_a_ray_are_those_of_the_ray_and_not_of_rounded_positions() {
        let ray = Vec3::new(0.0, 0.998_749_2, -0.05);
        let (from, to) = (at(Vec3::ZERO, Vec3::Z), at(Vec3::new(0.0, 1e-3, -5.1e-5), Vec3::Z));
        let squared = to.position.as_dvec3().length_squared();
        for along in [ray, -ray] {
            let density = from.arriving_along(&to, 1.0, along);
            assert!((density * squared - f64::from(0.05_f32)).abs() < 1e-9, "{density}");
        }
        assert!(from.arriving(&to, 1.0) * squared > 0.0508);
        let point = at(to.position, Vec3::ZERO);
        assert!((from.arriving_along(&point, 1.0, ray) * squared - 1.0).abs() < 1e-12);
        assert_eq!(to.arriving_along(&to, 1.0, ray), 0.0);
    }

    #[test]
    fn ends_at_infinity_send_parallel_light_and_are_met_by_solid_angle() {
        let sky = Site {
            kind: VERTEX_INFINITE,
            position: Vec3::ZERO,
            normal: Vec3::NEG_Z,
        };
        let floor = at(Vec3::new(5.0, 1e6, 0.0), Vec3::new(0.0, 0.6, 0.8));
        assert!((sky.arriving(&floor, 0.5) - 0.4).abs() < 1e-7);
        assert_eq!(floor.arriving(&sky, 0.5), 0.5);
    }

    #[test]
    fn vertices_in_one_place_have_no_density_rather_than_an_infinite_one() {
        let here = at(Vec3::ONE, Vec3::Z);
        assert_eq!(here.arriving(&here, 1.0), 0.0);
    }
}
