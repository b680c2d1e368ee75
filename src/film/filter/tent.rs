//! The tent: 1 − |x| on [−1, 1].

/// Inverts the distribution: x²/2 + x + 1/2 on the left half, mirrored on the right.
#[inline]
pub fn sample(u: f32) -> f32 {
    if u < 0.5 {
        (2.0 * u).sqrt() - 1.0
    } else {
        1.0 - (2.0 * (1.0 - u)).sqrt()
    }
}

/// The density at `x`.
pub fn density(x: f32) -> f32 {
    (1.0 - x.abs()).max(0.0)
}
