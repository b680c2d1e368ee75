//! Unit vectors as two numbers in [-1, 1]: the octahedral map (Meyer et al. 2010; survey: Cigolle et al. 2014).

use glam::{DVec2, DVec3};

/// The coordinates of a direction (need not be of unit length, must not be zero).
#[must_use]
pub fn encode(n: DVec3) -> DVec2 {
    let n = n / (n.x.abs() + n.y.abs() + n.z.abs());
    let (x, y) = if n.z < 0.0 {
        ((1.0 - n.y.abs()).copysign(n.x), (1.0 - n.x.abs()).copysign(n.y))
    } else {
        (n.x, n.y)
    };
    DVec2::new(x, y)
}

/// The unit vector at coordinates `p`.
#[must_use]
pub fn decode(p: DVec2) -> DVec3 {
    let DVec2 { x, y } = p;
    let z = 1.0 - x.abs() - y.abs();
    let folded = (-z).max(0.0);
    DVec3::new(x - folded.copysign(x), y - folded.copysign(y), z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey, warp};

    #[test]
    fn directions_survive_the_round_trip() {
        let mut stream = StreamKey::new(1, 0, 0).stream(Purpose::SCATTER, 0);
        let mut worst = 0.0_f64;
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
        let random = (0..10_000).map(|_| warp::uniform_sphere(stream.next_pair()).as_dvec3().normalize());
        for n in axes.into_iter().chain(random) {
            let back = decode(encode(n));
            assert!((back.length() - 1.0).abs() < 1e-15);
            worst = worst.max(back.distance(n));
        }
        assert!(worst < 1e-15, "largest deviation {worst}");
    }
}
