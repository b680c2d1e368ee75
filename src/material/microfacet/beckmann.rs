//! Facets of Beckmann, of the roughness 1: both slopes are normal with the variance 1/2.

use crate::math::erf_inverse;
use glam::DVec3;
use std::f64::consts::PI;

/// Half of the distance between uniform numbers: a draw stands for the middle of what it rounds, so that no slope is
/// infinite.
const HALF_STEP: f64 = 1.0 / (1_u32 << 25) as f64;
/// The slope is found when the distribution function is as near as this: a thousandth of the distance of draws.
const CLOSE: f64 = 1e-10;
/// Newton's steps; with bisection where they leave the bracket five are the rule.
const MOST_STEPS: u32 = 64;

/// π D for a normal whose squared components are `xy2` in the plane, each divided by its roughness, and `z2` along the
/// surface's normal (Walter et al. 2007, eq. 25).
#[inline]
pub(super) fn density(xy2: f64, z2: f64) -> f64 {
    libm::exp(-xy2 / z2) / (z2 * z2)
}

/// cos θ (1 + Λ) for a direction of height `z` whose components in the plane, each times its roughness, have the squared
/// length `xy2` (Heitz 2014, eq. 66), without approximation: densities of visible normals integrate to 1.
#[inline]
pub(super) fn projected_area(xy2: f64, z: f64) -> f64 {
    let flat = xy2.sqrt();
    // Infinite at normal incidence, where the exponential then vanishes.
    let a = z / flat;
    0.5 * (z * (1.0 + libm::erf(a)) + flat * libm::exp(-a * a) / PI.sqrt())
}

/// A normal seen from `w`, of any length: the slope towards `w` by [`slope_towards`], that across it by its own normal
/// distribution (Heitz and d'Eon 2014, §5.2; Jakob 2014, "An improved visible normal sampling routine for the Beckmann
/// distribution").
#[inline]
pub(super) fn sample_visible(w: DVec3, [u, v]: [f32; 2]) -> DVec3 {
    let flat = (w.x * w.x + w.y * w.y).sqrt();
    let (x, y) = if flat > 0.0 {
        (w.x / flat, w.y / flat)
    } else {
        (1.0, 0.0)
    };
    let towards = slope_towards(flat, w.z, f64::from(u) + HALF_STEP);
    let across = erf_inverse(2.0 * (f64::from(v) + HALF_STEP) - 1.0);
    DVec3::new(towards * x - across * y, towards * y + across * x, 1.0)
}

/// The slope t below which lies the share `u` of the facets that are seen from the direction (`sine`, `cosine`). What is
/// seen of the slope t is (cos + t sin)⁺ exp(−t²)/√π, so that in terms of b = erf t the distribution function is
///
/// cos · (b + e) − sin/√π · (exp(−t²) − exp(−a²)), over its value at b = 1; a = cot θ, e = erf a,
///
/// convex with the derivative cos + t sin. Newton's method in b, kept between bounds by bisection, solves it for any
/// direction down to the horizon; it starts from Jakob's fit.
fn slope_towards(sine: f64, cosine: f64, u: f64) -> f64 {
    let a = cosine / sine;
    let e = libm::erf(a);
    let flat = sine / PI.sqrt();
    let start = flat * libm::exp(-a * a);
    let total = cosine * (1.0 + e) + start;
    let (mut low, mut high) = (-e, 1.0);
    let theta = libm::acos(cosine.min(1.0));
    let fit = 1.0 + theta * (-0.876 + theta * (0.4265 - 0.0594 * theta));
    let mut b = (1.0 + e) * libm::pow(u, fit) - e;
    let mut slope = 0.0;
    for _ in 0..MOST_STEPS {
        if !(b > low && b < high) {
            b = 0.5 * (low + high);
            if b <= low || b >= high {
                break;
            }
        }
        slope = erf_inverse(b);
        let above = cosine * (b + e) - flat * libm::exp(-slope * slope) + start - u * total;
        if above.abs() < CLOSE * total {
            break;
        }
        if above > 0.0 {
            high = b;
        } else {
            low = b;
        }
        b -= above / (cosine + slope * sine);
    }
    slope
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distribution function in terms of the slope itself.
    fn below(sine: f64, cosine: f64, slope: f64) -> f64 {
        let a = cosine / sine;
        let part = |b: f64, t: f64| cosine * b - sine / PI.sqrt() * libm::exp(-t * t);
        let start = part(-libm::erf(a), a);
        (part(libm::erf(slope), slope) - start) / (cosine - start)
    }

    #[test]
    fn slopes_lie_where_the_distribution_says_down_to_the_horizon() {
        for cosine in [1.0, 0.999_999, 0.9, 0.5, 0.1, 1e-3, 1e-6, 1e-12, 0.0] {
            let sine = (1.0_f64 - cosine * cosine).sqrt();
            for i in 0..=1000 {
                let u = (f64::from(i) * 1e-3).clamp(HALF_STEP, 1.0 - HALF_STEP);
                let slope = slope_towards(sine, cosine, u);
                let found = below(sine, cosine, slope);
                assert!((found - u).abs() < 1e-7, "{cosine} {u}: slope {slope}, {found}");
                assert!(cosine + slope * sine >= 0.0, "{cosine} {u}: {slope} is not seen");
            }
        }
    }
}
