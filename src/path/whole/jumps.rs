//! Small changes of directions and film positions, of every order of magnitude in a range: as likely one way as the other.

use glam::{DVec3, Vec2, Vec3};

/// The sizes of small changes: their logarithm is uniform between those of two bounds (Veach 1997, §11.3.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// The smallest.
    pub smallest: f64,
    /// The largest.
    pub largest: f64,
}

impl Sizes {
    /// The size that `u` in [0, 1) chooses.
    #[must_use]
    pub fn sample(&self, u: f64) -> f64 {
        self.smallest * libm::pow(self.largest / self.smallest, u)
    }

    /// The same sizes times `scale`.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        Self {
            smallest: self.smallest * scale,
            largest: self.largest * scale,
        }
    }

    /// Whether a size is one of these.
    #[must_use]
    pub fn contains(&self, size: f64) -> bool {
        (self.smallest..=self.largest).contains(&size)
    }
}

/// A film position as far away as a size says, in a direction that `u` in [0, 1) chooses.
#[must_use]
pub fn jump(film: Vec2, size: f64, u: f64) -> Vec2 {
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * u);
    (film.as_dvec2() + size * glam::DVec2::new(cos, sin)).as_vec2()
}

/// A step of a length across a unit direction, the way that `u` in [0, 1) chooses.
#[must_use]
pub fn aside(direction: Vec3, length: f64, u: f64) -> DVec3 {
    let (across, along) = direction.as_dvec3().normalize().any_orthonormal_pair();
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * u);
    (across * cos + along * sin) * length
}

/// A unit direction at `angle` to another, turned about it as `u` in [0, 1) chooses.
#[must_use]
pub fn tilt(direction: Vec3, angle: f64, u: f64) -> Vec3 {
    let axis = direction.as_dvec3().normalize();
    let (sin, cos) = libm::sincos(angle);
    (axis * cos + aside(direction, sin, u)).normalize().as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_every_order_of_magnitude_are_as_likely() {
        let sizes = Sizes {
            smallest: 1e-3,
            largest: 10.0,
        };
        for (u, size) in [(0.0, 1e-3), (0.25, 1e-2), (0.5, 0.1), (0.75, 1.0)] {
            assert!((sizes.sample(u) / size - 1.0).abs() < 1e-12, "{u}");
        }
        assert!(sizes.sample(1.0 - 1e-16) <= 10.0 && sizes.contains(sizes.sample(0.3)));
        let doubled = sizes.scaled(2.0);
        assert_eq!((doubled.smallest, doubled.largest), (2e-3, 20.0));
        assert!(!doubled.contains(1.9e-3) && !doubled.contains(20.1));
    }

    #[test]
    fn jumps_and_tilts_are_of_their_size_and_go_all_around() {
        let (mut films, mut directions) = (Vec2::ZERO, Vec3::ZERO);
        let start = Vec3::new(0.6, -0.48, 0.64);
        const TURNS: u32 = 64;
        for u in (0..TURNS).map(|i| f64::from(i) / f64::from(TURNS)) {
            let film = jump(Vec2::ZERO, 3.0, u);
            assert!((film.length() - 3.0).abs() < 1e-6);
            let tilted = tilt(start, 0.01, u).as_dvec3();
            assert!((tilted.cross(start.as_dvec3()).length() - libm::sin(0.01)).abs() < 1e-7);
            films += film;
            directions += tilted.as_vec3();
        }
        assert!(films.length() < 1e-4, "{films}");
        assert!((directions / TURNS as f32 - start * libm::cos(0.01) as f32).length() < 1e-6);
    }
}
