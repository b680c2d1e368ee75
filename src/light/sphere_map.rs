//! A function over the directions of a sphere, given at the crossings of circles of latitude and of longitude and
//! bilinear between them, and directions drawn with a density in exact proportion to it.
//!
//! "Bilinear" is meant in coordinates in which solid angle is area ([`Polar`]): the angle around the pole, and 1 − cos θ.
//! So the integral over a patch is its area times the mean of its corners, and no factor sin θ, which vanishes at the
//! poles, stands in any density. Drawn is first the latitude, from its marginal, which is linear between circles; then the
//! longitude, from the mixture of the two circles' piecewise linear densities. Both are inverted in closed form, so the map
//! from uniform numbers is continuous and monotone in each.

use super::infinite::Polar;

/// The function and its integrals.
#[derive(Clone, Debug)]
pub(super) struct SphereMap {
    /// Number of meridians.
    width: usize,
    /// Depth of every circle, ascending.
    depths: Vec<f64>,
    /// Values at the crossings, circle by circle; the meridians stand in the middles of `width` equal parts of a turn.
    values: Vec<f32>,
    /// For every circle the integral from its first meridian to the one after each, in units of parts.
    cumulative: Vec<f64>,
    /// The integral up to the end of every band between two circles, in units of parts times depth.
    bands: Vec<f64>,
}

/// The patch that a direction lies in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// The circle above it; the next is the one below.
    pub circle: usize,
    /// The meridians at its sides.
    pub meridians: [usize; 2],
    /// Share of the circle below.
    pub down: f64,
    /// Share of the second meridian.
    pub across: f64,
}

impl SphereMap {
    /// A map over the given circles (at least two) and `width` meridians. `value(circle, meridian)` is finite and not
    /// negative.
    pub fn new(width: usize, depths: Vec<f64>, value: impl Fn(usize, usize) -> f32) -> Self {
        let mut values = Vec::with_capacity(width * depths.len());
        let mut cumulative = Vec::with_capacity(width * depths.len());
        for circle in 0..depths.len() {
            values.extend((0..width).map(|meridian| value(circle, meridian)));
            let row = &values[circle * width..];
            let mut sum = 0.0;
            for meridian in 0..width {
                sum += 0.5 * (f64::from(row[meridian]) + f64::from(row[(meridian + 1) % width]));
                cumulative.push(sum);
            }
        }
        let of = |circle: usize| cumulative[circle * width + width - 1];
        let mut sum = 0.0;
        let bands = depths.windows(2).enumerate().map(|(circle, depths)| {
            sum += 0.5 * (of(circle) + of(circle + 1)) * (depths[1] - depths[0]);
            sum
        });
        let bands = bands.collect();
        Self {
            width,
            depths,
            values,
            cumulative,
            bands,
        }
    }

    /// The integral over all directions.
    pub fn total(&self) -> f64 {
        self.bands.last().copied().unwrap_or(0.0) * std::f64::consts::TAU / self.width as f64
    }

    /// The patch of a direction; `None` beyond the first and the last circle.
    #[inline]
    pub fn place(&self, polar: Polar) -> Option<Place> {
        let below = self.depths.partition_point(|&depth| depth <= polar.depth);
        // The last circle belongs to the band above it.
        let below = if polar.depth == self.depths[self.depths.len() - 1] {
            below - 1
        } else {
            below
        };
        let circle = below.checked_sub(1).filter(|_| below < self.depths.len())?;
        let (above, below) = (self.depths[circle], self.depths[below]);
        let part = polar.turn * self.width as f64 - 0.5;
        let first = part.floor();
        // Before the first meridian lies the patch that the last one begins.
        let meridian = if first < 0.0 {
            self.width - 1
        } else {
            (first as usize).min(self.width - 1)
        };
        Some(Place {
            circle,
            meridians: [meridian, (meridian + 1) % self.width],
            down: (polar.depth - above) / (below - above),
            across: part - first,
        })
    }

    /// The density per solid angle with which [`sample`](Self::sample) draws a direction; 0 where it never does.
    #[inline]
    pub fn density(&self, polar: Polar) -> f64 {
        let total = self.total();
        match self.place(polar) {
            Some(place) if total > 0.0 => {
                let corners = place.corners().into_iter();
                let value = corners.map(|(circle, meridian, share)| self.value(circle, meridian) * share);
                value.sum::<f64>() / total
            }
            _ => 0.0,
        }
    }

    /// A direction; `None` if the map is zero everywhere.
    #[inline]
    pub fn sample(&self, [u, v]: [f64; 2]) -> Option<Polar> {
        let total = self.bands.last().copied().filter(|&total| total > 0.0)?;
        let wanted = (v * total).min(total.next_down());
        let band = self.bands.partition_point(|&sum| sum <= wanted);
        let before = if band > 0 { self.bands[band - 1] } else { 0.0 };
        let [above, below] = [band, band + 1].map(|circle| self.cumulative[(circle + 1) * self.width - 1]);
        let down = linear(above, below, (wanted - before) / (self.bands[band] - before));
        // The longitude, given the latitude.
        let sum = |meridian: usize| {
            let [above, below] = [band, band + 1].map(|circle| self.cumulative[circle * self.width + meridian]);
            above + (below - above) * down
        };
        let total = sum(self.width - 1);
        let wanted = (u * total).min(total.next_down());
        let (mut meridian, mut end) = (0, self.width - 1);
        while meridian < end {
            let middle = (meridian + end) / 2;
            if sum(middle) <= wanted {
                meridian = middle + 1;
            } else {
                end = middle;
            }
        }
        let before = if meridian > 0 { sum(meridian - 1) } else { 0.0 };
        let [left, right] = [meridian, (meridian + 1) % self.width].map(|meridian| {
            let [above, below] = [band, band + 1].map(|circle| self.value(circle, meridian));
            above + (below - above) * down
        });
        let across = linear(left, right, (wanted - before) / (sum(meridian) - before));
        let turn = (meridian as f64 + across + 0.5) / self.width as f64;
        let (above, below) = (self.depths[band], self.depths[band + 1]);
        Some(Polar {
            depth: above + (below - above) * down,
            turn: if turn < 1.0 { turn } else { turn - 1.0 },
        })
    }

    #[inline]
    fn value(&self, circle: usize, meridian: usize) -> f64 {
        f64::from(self.values[circle * self.width + meridian])
    }
}

impl Place {
    /// The four corners as (circle, meridian, share); the shares add up to 1.
    #[inline]
    pub fn corners(&self) -> [(usize, usize, f64); 4] {
        let [left, right] = self.meridians;
        let (above, below) = (self.circle, self.circle + 1);
        let (up, back) = (1.0 - self.down, 1.0 - self.across);
        [
            (above, left, up * back),
            (above, right, up * self.across),
            (below, left, self.down * back),
            (below, right, self.down * self.across),
        ]
    }
}

/// The place in [0, 1] up to which a linear density that goes from `a` to `b` has the share `r` of its integral.
fn linear(a: f64, b: f64, r: f64) -> f64 {
    let r = r.clamp(0.0, 1.0);
    let below = a + ((1.0 - r) * a * a + r * b * b).sqrt();
    if below > 0.0 { (r * (a + b) / below).min(1.0) } else { r }
}
