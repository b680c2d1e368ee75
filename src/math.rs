//! Elementary functions that give the same bits on every platform.
//!
//! The standard library forwards `sin`, `exp` and their kin to the platform's C library, whose last bits differ. A
//! picture's bytes must not, so everything that shapes one calls these (`clippy.toml` forbids the others). They
//! forward to the [`libm`] crate, which is written in Rust. Square roots are exact everywhere and need no wrapper.

/// Sine of an angle in radians.
#[inline]
#[must_use]
pub fn sin(x: f32) -> f32 {
    libm::sinf(x)
}

/// Cosine of an angle in radians.
#[inline]
#[must_use]
pub fn cos(x: f32) -> f32 {
    libm::cosf(x)
}

/// Tangent of an angle in radians.
#[inline]
#[must_use]
pub fn tan(x: f32) -> f32 {
    libm::tanf(x)
}

/// Natural exponential.
#[inline]
#[must_use]
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// Natural logarithm.
#[inline]
#[must_use]
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// `x` to the power `y`.
#[inline]
#[must_use]
pub fn pow(x: f32, y: f32) -> f32 {
    libm::powf(x, y)
}
