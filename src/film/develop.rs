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
    /// correlated (their error is the spread across independent groups). A film without paths is black. `scale` is finite.
    #[must_use]
    pub fn develop_splats(&self, paths: u64, scale: f64) -> Picture {
        self.picture(|_| paths, scale)
    }

    fn picture(&self, samples: impl Fn(&PixelSums) -> u64, scale: f64) -> Picture {
        let pixels = self.width() as usize * self.height() as usize;
        let lists = (Vec::with_capacity(pixels), Vec::with_capacity(pixels));
        let mut picture = Picture::new(
            self.width(),
            self.height(),
            lists.0,
            lists.1,
            Vec::with_capacity(pixels),
        );
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Splat;

    fn exposed(max_radiance: f32, values: impl IntoIterator<Item = f32>) -> Film {
        let film = Film::new(1, 1, max_radiance).expect("a small film");
        let samples: Vec<Splat> = values
            .into_iter()
            .map(|v| Splat {
                pixel: 0,
                value: Rgb::splat(v),
            })
            .collect();
        film.add_samples(&samples);
        film
    }

    /// Mean and standard error before they are rounded to `f32`.
    fn developed(film: &Film) -> (f64, f64) {
        let mut out = (f64::NAN, f64::NAN);
        film.for_each_pixel(|p| out = mean_and_error(p, 0, p.samples, film.unit().exponent()));
        out
    }

    /// The estimators as textbooks write them: two passes, in `f64`.
    fn textbook(values: &[f32]) -> (f64, f64) {
        let n = values.len() as f64;
        let mean = values.iter().map(|&v| f64::from(v)).sum::<f64>() / n;
        let scatter: f64 = values
            .iter()
            .map(|&v| (f64::from(v) - mean) * (f64::from(v) - mean))
            .sum();
        (mean, (scatter / (n * (n - 1.0))).sqrt())
    }

    fn assert_close(got: (f64, f64), expected: (f64, f64), tolerance: f64) {
        let close = |a: f64, b: f64| (a - b).abs() <= tolerance * b.abs();
        assert!(
            close(got.0, expected.0) && close(got.1, expected.1),
            "{got:?} is not {expected:?}"
        );
    }

    /// A fixed sequence that looks uniform in [0, 1).
    fn noise(n: usize) -> impl Iterator<Item = f32> {
        (0..n as u32).map(|i| (i.wrapping_mul(0x9e37_79b9) >> 8) as f32 / 16_777_216.0)
    }

    #[test]
    fn mean_and_error_are_the_textbook_estimators() {
        let spiky: Vec<f32> = noise(1000).map(|u| if u > 0.99 { 1e4 } else { u * u }).collect();
        let signed: Vec<f32> = noise(777).map(|u| u - 0.5).collect();
        for values in [
            spiky,
            signed,
            vec![1.0, 2.0],
            vec![0.1; 3].into_iter().chain([0.2]).collect(),
        ] {
            assert_close(
                developed(&exposed(10.0, values.iter().copied())),
                textbook(&values),
                1e-12,
            );
        }
    }

    #[test]
    fn tiny_noise_on_a_bright_constant_is_not_lost_to_cancellation() {
        // 1e4 with steps of the last bit of an f32 (about 1e-3): n S₂ and S² agree in their first 14 digits.
        let values: Vec<f32> = noise(10_000)
            .map(|u| f32::from_bits(1e4_f32.to_bits() + (u * 3.0) as u32))
            .collect();
        assert_close(
            developed(&exposed(1.0, values.iter().copied())),
            textbook(&values),
            1e-9,
        );
    }

    #[test]
    fn a_constant_signal_has_no_error_at_all() {
        for v in [1e4_f32, 0.1, 1e-3, 123_456.79] {
            assert_eq!(
                developed(&exposed(1.0, std::iter::repeat_n(v, 1000))),
                (f64::from(v), 0.0)
            );
        }
    }

    #[test]
    fn ten_million_small_splats_sum_without_drift() {
        let film = Film::new(1, 1, 1.0).expect("a small film");
        let batch = vec![
            Splat {
                pixel: 0,
                value: Rgb::splat(1e-3)
            };
            100_000
        ];
        for _ in 0..100 {
            film.add_splats(&batch);
        }
        let sum = film.develop_splats(1, 1.0).rgb[0].r;
        assert!((sum - 1e4).abs() <= 1e4 * 1e-6, "{sum}");
        let mean = film.develop_splats(10_000_000, 1.0).rgb[0].r;
        assert_eq!(mean, 1e-3);
    }

    #[test]
    fn a_dim_pixel_under_a_blinding_light_still_has_an_error() {
        // The unit is 2³⁰; the values lie near 2⁻⁴⁰ units, where squares keep 24 bits.
        let values: Vec<f32> = noise(1000).map(|u| 1e-3 * u).collect();
        assert_close(
            developed(&exposed(1e9, values.iter().copied())),
            textbook(&values),
            1e-6,
        );
    }

    #[test]
    fn too_few_samples_have_an_infinite_error_and_nothing_is_ever_not_a_number() {
        let none = exposed(1.0, []).develop();
        assert_eq!(
            (none.rgb[0], none.error[0], none.weight[0]),
            (Rgb::BLACK, Rgb::splat(f32::INFINITY), 0.0)
        );
        let one = exposed(1.0, [0.25]).develop();
        assert_eq!(
            (one.rgb[0], one.error[0], one.weight[0]),
            (Rgb::splat(0.25), Rgb::splat(f32::INFINITY), 1.0)
        );
        let pinned = exposed(1.0, std::iter::repeat_n(1e12, 400)).develop();
        assert_eq!(
            (pinned.rgb[0], pinned.error[0]),
            (Rgb::splat(1e12), Rgb::splat(f32::INFINITY))
        );
    }

    #[test]
    fn splats_are_scaled_and_their_error_counts_the_paths_that_missed() {
        let film = Film::new(2, 1, 1.0).expect("a small film");
        film.add_splats(&[
            Splat {
                pixel: 1,
                value: Rgb::splat(3.0),
            },
            Splat {
                pixel: 1,
                value: Rgb::splat(1.0),
            },
        ]);
        let picture = film.develop_splats(4, 2.0);
        let (mean, error) = textbook(&[3.0, 1.0, 0.0, 0.0]);
        assert_eq!(picture.rgb, [Rgb::BLACK, Rgb::splat(2.0 * mean as f32)]);
        assert_eq!(picture.error, [Rgb::BLACK, Rgb::splat((2.0 * error) as f32)]);
        assert_eq!(film.develop_splats(0, 2.0).rgb[1], Rgb::BLACK);
    }
}
