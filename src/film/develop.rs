//! From sums to a picture: means and their standard errors.
//!
//! For n independent samples with sum S and sum of squares S₂ the mean is S/n and the unbiased estimate of its variance
//! (n S₂ − S²) / (n² (n − 1)). The numerator is the difference of two nearly equal numbers wherever the noise is small
//! beside the mean; it is taken exactly ([`super::wide`]), so that nothing cancels.

use super::accumulate::{Film, PixelSums};
use super::fixed::{VALUE_FRACTION_BITS, power_of_two};
use super::picture::Picture;
use super::wide::scatter;
use crate::color::Rgb;

impl Film {
    /// The picture of the film's samples: each pixel the mean over its own samples, with its standard error
    /// (infinite for fewer than two samples). A pixel without samples is black.
    #[must_use]
    pub fn develop(&self) -> Picture {
        self.picture(|pixel| pixel.samples, 1.0)
    }

    /// The picture of the film's splats: each pixel `scale` times its sum, divided by `paths`, the number of independent
    /// paths that were traced for the whole film. The error is that of a mean over `paths` independent contributions, most
    /// of them zero: right when no path adds to the same pixel twice, and not right for the states of one chain, which are
    /// correlated (their error is the spread across independent groups). A film without paths is black.
    #[must_use]
    pub fn develop_splats(&self, paths: u64, scale: f64) -> Picture {
        self.picture(|_| paths, scale)
    }

    fn picture(&self, samples: impl Fn(&PixelSums) -> u64, scale: f64) -> Picture {
        let pixels = self.width() as usize * self.height() as usize;
        let mut picture = Picture {
            width: self.width(),
            height: self.height(),
            rgb: Vec::with_capacity(pixels),
            error: Vec::with_capacity(pixels),
            weight: Vec::with_capacity(pixels),
        };
        let exponent = self.unit().exponent();
        self.for_each_pixel(|pixel| {
            let n = samples(pixel);
            let channel = |c: usize| mean_and_error(pixel, c, n, exponent);
            let [r, g, b] = [channel(0), channel(1), channel(2)];
            let scaled = |v: f64| (v * scale) as f32;
            picture.rgb.push(Rgb::new(scaled(r.0), scaled(g.0), scaled(b.0)));
            let scaled = |v: f64| {
                if v.is_infinite() {
                    f32::INFINITY
                } else {
                    (v * scale.abs()) as f32
                }
            };
            picture.error.push(Rgb::new(scaled(r.1), scaled(g.1), scaled(b.1)));
            picture.weight.push(n as f32);
        });
        picture
    }
}

/// The mean of one channel over `n` samples and its standard error, in radiance.
fn mean_and_error(pixel: &PixelSums, channel: usize, n: u64, unit_exponent: i32) -> (f64, f64) {
    if n == 0 {
        return (0.0, f64::INFINITY);
    }
    let (sum, squares) = (pixel.sum[channel], pixel.squares[channel]);
    let count = n as f64;
    let step = power_of_two(unit_exponent - VALUE_FRACTION_BITS);
    let mean = sum as f64 / count * step;
    if n == 1 || squares.is_pinned() {
        return (mean, f64::INFINITY);
    }
    let variance_of_mean = scatter(n, squares.limbs(), sum) / (count * count * (n - 1) as f64);
    (mean, variance_of_mean.sqrt() * step)
}
