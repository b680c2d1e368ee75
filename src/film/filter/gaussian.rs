//! A normal density cut off at ± radius, sampled by inverting its distribution function.
//!
//! The distribution is F(x) = (erf(x / σ√2) + E) / 2E with E = erf(r / σ√2). Its inverse is tabulated exactly at equally
//! spaced u, with its slope 1/F′, and interpolated by cubic Hermite pieces between. Where a piece strays (the tails, where
//! the inverse steepens) the sample is polished by Newton steps on F itself; which pieces do is measured when the table is
//! made.

use std::f64::consts::{PI, SQRT_2};

/// Pieces of the table.
const CELLS: usize = 512;
/// How far a piece may stray, in radii, before its samples are polished: an eighth of an `f32`'s rounding.
const TOLERANCE: f64 = 1.0 / (1 << 27) as f64;

/// The density of one coordinate.
#[derive(Clone, Debug)]
pub struct TruncatedGaussian {
    radius: f64,
    sigma: f64,
    /// E: the share of the whole normal density within the radius.
    kept: f64,
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
        (((d * t + c) * t + b) * t + a).clamp(self.low, self.high)
    }
}

impl TruncatedGaussian {
    pub fn new(radius: f64, sigma: f64) -> Self {
        let mut table = Self {
            radius,
            sigma,
            kept: libm::erf(radius / (sigma * SQRT_2)),
            cells: Vec::new(),
        };
        let knot = |i: usize| table.invert(i as f64 / CELLS as f64, -radius, radius);
        let knots: Vec<f64> = (0..=CELLS).map(knot).collect();
        let slope = |x: f64| 1.0 / (table.density(x) * CELLS as f64);
        let mut cells = Vec::with_capacity(CELLS);
        for (i, ends) in knots.windows(2).enumerate() {
            let (low, high) = (ends[0], ends[1]);
            let mut cell = Cell::between(low, high, [slope(low), slope(high)]);
            cell.polished = [0.125, 0.25, 0.5, 0.75, 0.875].into_iter().any(|t| {
                let exact = table.invert((i as f64 + t) / CELLS as f64, low, high);
                let stray = (cell.at(t) - exact).abs();
                // Where the density underflows at the radius, the slope is endless and the piece not a number.
                stray.is_nan() || stray > TOLERANCE * radius
            });
            if cell.polished {
                cell.coefficients = [low, high - low, 0.0, 0.0];
            }
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
        let end = self.radius / (self.sigma * SQRT_2);
        if z < -0.5 {
            // erf(z) − erf(−end), of numbers near −1, as a difference of small complements.
            (libm::erfc(-z) - libm::erfc(end)) / (2.0 * self.kept)
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

    /// The x in [low, high] with `below(x)` = u, by Newton steps kept within a shrinking bracket. Mirrored onto the left
    /// half, where `below` keeps its digits.
    fn invert(&self, u: f64, low: f64, high: f64) -> f64 {
        if u > 0.5 {
            return -self.invert(1.0 - u, -high, -low);
        }
        let (mut low, mut high) = (low, high.min(0.0));
        let mut x = 0.5 * (low + high);
        for _ in 0..200 {
            let excess = self.below(x) - u;
            if excess == 0.0 {
                return x;
            }
            if excess > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let newton = x - excess / self.density(x);
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - x).abs() <= 1e-15 * self.radius {
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
        let x = if cell.polished {
            self.invert(u, cell.low, cell.high)
        } else {
            cell.at(place - i as f64)
        };
        x as f32
    }
}
