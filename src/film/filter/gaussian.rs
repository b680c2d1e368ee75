//! A normal density cut off at ± radius, sampled by inverting its distribution function.
//!
//! The distribution is F(x) = (erf(x / σ√2) + E) / 2E with E = erf(r / σ√2). Its inverse is tabulated exactly at equally
//! spaced u, with its slope 1/F′, and interpolated by cubic Hermite pieces between. Where a piece strays (the tails, where
//! the inverse steepens) the sample is polished by Newton steps on F itself; which pieces do is measured when the table is
//! made.

use std::f64::consts::{PI, SQRT_2};

/// Pieces of the table.
const CELLS: usize = 512;
/// How far a piece may stray, in radii, before its samples are polished: half an `f32`'s rounding near the radius.
const TOLERANCE: f64 = 1.0 / (1 << 25) as f64;
/// A Newton step below this, in radii, is the last: the error after it is of the order of its square.
const LAST_STEP: f64 = 1e-9;

/// The density of one coordinate.
#[derive(Clone, Debug)]
pub struct TruncatedGaussian {
    radius: f64,
    sigma: f64,
    /// E: the share of the whole normal density within the radius.
    kept: f64,
    /// 1 − E, with all its digits.
    cut: f64,
    cells: Vec<Cell>,
}

/// The inverse between two knots, as a cubic in t from 0 to 1.
#[derive(Clone, Copy, Debug)]
struct Cell {
    coefficients: [f64; 4],
    low: f64,
    high: f64,
    polished: bool,
}

impl Cell {
    fn between(low: f64, high: f64, slopes: [f64; 2]) -> Self {
        let rise = high - low;
        let coefficients = [
            low,
            slopes[0],
            3.0 * rise - 2.0 * slopes[0] - slopes[1],
            slopes[0] + slopes[1] - 2.0 * rise,
        ];
        Self {
            coefficients,
            low,
            high,
            polished: false,
        }
    }

    fn at(&self, t: f64) -> f64 {
        let [a, b, c, d] = self.coefficients;
        // Not `clamp`: rounding may leave the two ends of a piece in the wrong order.
        (((d * t + c) * t + b) * t + a).max(self.low).min(self.high)
    }
}

impl TruncatedGaussian {
    pub fn new(radius: f64, sigma: f64) -> Self {
        let end = radius / (sigma * SQRT_2);
        let mut table = Self {
            radius,
            sigma,
            kept: libm::erf(end),
            cut: libm::erfc(end),
            cells: Vec::new(),
        };
        let knot = |i: usize| table.invert(i as f64 / CELLS as f64, 0.0, [-radius, radius]);
        let knots: Vec<f64> = (0..=CELLS).map(knot).collect();
        let slope = |x: f64| 1.0 / (table.density(x) * CELLS as f64);
        let mut cells = Vec::with_capacity(CELLS);
        for (i, ends) in knots.windows(2).enumerate() {
            let (low, high) = (ends[0], ends[1]);
            let mut cell = Cell::between(low, high, [slope(low), slope(high)]);
            cell.polished = [0.125, 0.25, 0.5, 0.75, 0.875].into_iter().any(|t| {
                let exact = table.invert((i as f64 + t) / CELLS as f64, 0.5 * (low + high), [low, high]);
                (cell.at(t) - exact).abs() > TOLERANCE * radius
            });
            cells.push(cell);
        }
        table.cells = cells;
        table
    }

    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The share of the density at or below `x`, from whichever end is nearer, so that tails keep their digits.
    fn below(&self, x: f64) -> f64 {
        let z = x / (self.sigma * SQRT_2);
        if z < -0.5 {
            // erf(z) − erf(−end), of numbers near −1, as a difference of small complements.
            (libm::erfc(-z) - self.cut) / (2.0 * self.kept)
        } else {
            (libm::erf(z) + self.kept) / (2.0 * self.kept)
        }
    }

    /// The density at `x`, per pixel.
    pub fn density(&self, x: f64) -> f64 {
        if x.abs() > self.radius {
            return 0.0;
        }
        let z = x / self.sigma;
        libm::exp(-0.5 * z * z) / (self.sigma * (2.0 * PI).sqrt() * self.kept)
    }

    /// The x within `bracket` with `below(x)` = u, by Newton steps from `start`, kept within the shrinking bracket.
    /// Mirrored onto the left half, where `below` keeps its digits.
    fn invert(&self, u: f64, start: f64, bracket: [f64; 2]) -> f64 {
        if u > 0.5 {
            return -self.invert(1.0 - u, -start, [-bracket[1], -bracket[0]]);
        }
        let [mut low, mut high] = [bracket[0], bracket[1].min(0.0)];
        if u <= 0.0 {
            return low;
        }
        let mut x = if start >= low && start <= high {
            start
        } else {
            0.5 * (low + high)
        };
        for _ in 0..200 {
            let excess = self.below(x) - u;
            if excess > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let newton = x - excess / self.density(x);
            let next = if newton >= low && newton <= high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - x).abs() <= LAST_STEP * self.radius {
                return next;
            }
            x = next;
        }
        x
    }

    /// The offset for a uniform number in [0, 1).
    #[inline]
    pub fn sample(&self, u: f32) -> f32 {
        let u = f64::from(u);
        let place = u * CELLS as f64;
        let i = (place as usize).min(CELLS - 1);
        let cell = &self.cells[i];
        let x = cell.at(place - i as f64);
        (if cell.polished {
            self.invert(u, x, [cell.low, cell.high])
        } else {
            x
        }) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{ContinuousCDF, Normal};

    const SHAPES: [(f64, f64); 5] = [(1.5, 0.5), (2.0, 0.3), (1.0, 3.0), (1.0, 100.0), (3.0, 0.1)];

    #[test]
    fn samples_invert_the_distribution_to_the_last_digits() {
        for (radius, sigma) in SHAPES {
            let gaussian = TruncatedGaussian::new(radius, sigma);
            let normal = Normal::new(0.0, sigma).expect("a distribution");
            let (low, kept) = (normal.cdf(-radius), normal.cdf(radius) - normal.cdf(-radius));
            for i in 0..=10_000_u32 {
                let u = (i as f32 / 10_000.0).min(1.0 - f32::EPSILON / 2.0);
                let x = gaussian.sample(u);
                let back = (normal.cdf(f64::from(x)) - low) / kept;
                // An f32's rounding of x, seen through the density; and the other implementation's own error.
                let allowed = gaussian.density(f64::from(x)) * 1.2e-7 * radius + 1e-8;
                assert!(
                    (back - f64::from(u)).abs() < allowed,
                    "{radius} {sigma}: u = {u}, x = {x}, F(x) = {back}"
                );
            }
        }
    }

    #[test]
    fn most_samples_are_read_from_the_table() {
        for (radius, sigma) in [(1.5, 0.5), (1.0, 3.0)] {
            let gaussian = TruncatedGaussian::new(radius, sigma);
            let polished = gaussian.cells.iter().filter(|c| c.polished).count();
            assert!(polished * 10 < CELLS, "{polished} of {CELLS} pieces are polished");
        }
    }
}
