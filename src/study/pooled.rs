//! What stands in for a reference where there is none: the pictures of several pilots, pooled.
//!
//! Relative errors are divided by r² + ε, so noise in r does harm: a pixel that a sample of light missed seems dark, and its error large.
//! So r is the pictures' mean, weighted by what each is worth as a whole (weights by pixel would follow the noise: dark pixels state
//! small errors), and then moved towards the mean of its neighbourhood as far as its own error says that it is noise (Lee 1980, whose
//! filter of local statistics is Wiener's in a window).

use crate::color::Rgb;
use crate::film::Picture;
use crate::stats::metrics::{REL_MSE_EPSILON, TRIMMED_SHARE};

/// Pixels on either side of a pixel that are its neighbourhood.
const REACH: usize = 2;

/// A relative mean squared error that a picture is expected to have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedError {
    /// Over all pixels.
    pub rel_mse: f64,
    /// Without the 0.1 % of the pixels where it is largest.
    pub rel_mse_trimmed: f64,
}

/// What relative errors are relative to.
#[derive(Clone, Debug)]
pub struct Pooled {
    width: usize,
    /// 1 / (r² + ε) by pixel and channel.
    weights: Vec<[f64; 3]>,
}

impl Pooled {
    /// The pool of pictures of the same sides, whose errors are known. `None` without any.
    #[must_use]
    pub fn of(pictures: &[&Picture]) -> Option<Self> {
        let known: Vec<&Picture> = pictures.iter().copied().filter(|picture| is_known(picture)).collect();
        let width = known.first()?.width as usize;
        // What each is worth is told by a first pool, of equal weights.
        let first = Self::weighted(width, &known, &vec![1.0; known.len()]);
        let worth = |picture: &&Picture| {
            let error = first
                .expected(&picture.error)
                .map_or(f64::INFINITY, |error| error.rel_mse_trimmed);
            1.0 / error.max(f64::MIN_POSITIVE)
        };
        let worth: Vec<f64> = known.iter().map(worth).collect();
        Some(Self::weighted(width, &known, &worth))
    }

    fn weighted(width: usize, pictures: &[&Picture], worth: &[f64]) -> Self {
        let total: f64 = worth.iter().sum();
        let pixels = pictures.iter().map(|picture| picture.rgb.len()).min().unwrap_or(0);
        let (mut mean, mut variance) = (vec![[0.0; 3]; pixels], vec![[0.0; 3]; pixels]);
        for (picture, worth) in pictures.iter().zip(worth) {
            let share = worth / total;
            for (pixel, (mean, variance)) in mean.iter_mut().zip(&mut variance).enumerate() {
                let (value, error) = (wide(picture.rgb[pixel]), wide(picture.error[pixel]));
                for channel in 0..3 {
                    mean[channel] += share * value[channel];
                    variance[channel] += share * share * error[channel] * error[channel];
                }
            }
        }
        let weights = (0..pixels)
            .map(|pixel| {
                let smooth = smoothed(width, &mean, &variance, pixel);
                smooth.map(|r| 1.0 / (r * r + REL_MSE_EPSILON))
            })
            .collect();
        Self { width, weights }
    }

    /// Pixels in a row.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// The error that a picture with these standard errors is expected to have. `None` where nothing is known of one.
    #[must_use]
    pub fn expected(&self, errors: &[Rgb]) -> Option<ExpectedError> {
        let of_pixel = |(error, weights): (&Rgb, &[f64; 3])| {
            wide(*error).iter().zip(weights).map(|(e, weight)| e * e * weight).sum()
        };
        let mut pixels: Vec<f64> = errors.iter().zip(&self.weights).map(of_pixel).collect();
        if pixels.is_empty() || !pixels.iter().all(|error| error.is_finite()) {
            return None;
        }
        let mean = |pixels: &[f64]| pixels.iter().sum::<f64>() / (3 * pixels.len()) as f64;
        let rel_mse = mean(&pixels);
        pixels.sort_by(f64::total_cmp);
        let left_out = (pixels.len() as f64 * TRIMMED_SHARE).ceil() as usize;
        let kept = pixels.len().saturating_sub(left_out).max(1);
        Some(ExpectedError {
            rel_mse,
            rel_mse_trimmed: mean(&pixels[..kept]),
        })
    }
}

/// Whether all its pixels are numbers, and their errors too.
fn is_known(picture: &Picture) -> bool {
    let finite = |colors: &[Rgb]| colors.iter().all(|color| color.is_finite());
    !picture.rgb.is_empty()
        && picture.error.len() == picture.rgb.len()
        && finite(&picture.rgb)
        && finite(&picture.error)
}

/// A pixel's colour, moved towards the mean of its neighbourhood by the share of the variance there that is noise.
fn smoothed(width: usize, mean: &[[f64; 3]], variance: &[[f64; 3]], pixel: usize) -> [f64; 3] {
    let height = mean.len() / width.max(1);
    let (x, y) = (pixel % width, pixel / width);
    let rows = y.saturating_sub(REACH)..(y + REACH + 1).min(height);
    let columns = x.saturating_sub(REACH)..(x + REACH + 1).min(width);
    let (mut count, mut sums, mut squares, mut noise) = (0.0, [0.0; 3], [0.0; 3], [0.0; 3]);
    for neighbour in rows.flat_map(|row| columns.clone().map(move |column| row * width + column)) {
        count += 1.0;
        for channel in 0..3 {
            let value = mean[neighbour][channel];
            sums[channel] += value;
            squares[channel] += value * value;
            noise[channel] += variance[neighbour][channel];
        }
    }
    let mut smooth = mean[pixel];
    for channel in 0..3 {
        let local = sums[channel] / count;
        let spread = (squares[channel] / count - local * local).max(0.0);
        let own = variance[pixel][channel];
        // What the neighbourhood varies by beyond its noise is the picture's own.
        let signal = (spread - noise[channel] / count).max(0.0);
        if own > 0.0 {
            smooth[channel] = local + signal / (signal + own) * (smooth[channel] - local);
        }
    }
    smooth
}

fn wide(color: Rgb) -> [f64; 3] {
    color.to_array().map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, Stream, StreamKey};

    const SIDE: u32 = 64;

    fn picture(rgb: Vec<Rgb>, error: Vec<Rgb>) -> Picture {
        let weight = vec![1.0; rgb.len()];
        Picture::new(SIDE, SIDE, rgb, error, weight)
    }

    fn normal(stream: &mut Stream) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - stream.next_f64())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * stream.next_f64())
    }

    /// A picture of `truth` with noise of the standard deviation `error`, which it knows.
    fn noisy(truth: impl Fn(u32) -> f64, error: f64, seed: u64) -> Picture {
        let mut stream = StreamKey::new(seed, 0, 0).stream(Purpose::FILM, 0);
        let values = (0..SIDE * SIDE).map(|pixel| Rgb::splat((truth(pixel) + error * normal(&mut stream)) as f32));
        picture(values.collect(), vec![Rgb::splat(error as f32); (SIDE * SIDE) as usize])
    }

    #[test]
    fn without_noise_errors_are_as_computed_by_hand() {
        let truth = |pixel: u32| f64::from(pixel % 7);
        let pooled = Pooled::of(&[&noisy(truth, 0.0, 1)]).expect("a picture");
        let mut errors = vec![Rgb::splat(0.1); (SIDE * SIDE) as usize];
        let own = |pixel: u32| 0.01 / (truth(pixel) * truth(pixel) + 0.01);
        let plain: f64 = (0..SIDE * SIDE).map(own).sum::<f64>() / f64::from(SIDE * SIDE);
        let expected = pooled.expected(&errors).expect("known");
        assert!((expected.rel_mse / plain - 1.0).abs() < 1e-5, "{expected:?}");
        // Pixel 1 is of brightness 1: 100² / 1.01, which the trimmed error leaves out.
        errors[1] = Rgb::splat(100.0);
        let spoilt = pooled.expected(&errors).expect("known");
        assert!((spoilt.rel_mse * 4096.0 / (1e4 / 1.01) - 1.0).abs() < 0.1, "{spoilt:?}");
        assert!(spoilt.rel_mse_trimmed < plain);
    }

    /// A single pixel has a noise of half its brightness, and as much as it: divided by itself, its error would be far too large.
    #[test]
    fn noise_in_what_errors_are_relative_to_does_not_show() {
        for truth in [|_| 1.0, |pixel: u32| if pixel % SIDE < 32 { 2.0 } else { 0.5 }] {
            let picture = noisy(truth, 0.5, 3);
            let exact = Pooled::of(&[&noisy(truth, 0.0, 1)]).expect("a picture");
            let expected = |pooled: &Pooled| pooled.expected(&picture.error).expect("known").rel_mse;
            let ratio = expected(&Pooled::of(&[&picture]).expect("a picture")) / expected(&exact);
            assert!((0.9..1.35).contains(&ratio), "{ratio}");
            // What it would be.
            let divided = |color: &Rgb| 0.25 / (f64::from(color.r) * f64::from(color.r) + REL_MSE_EPSILON);
            let raw = picture.rgb.iter().map(divided).sum::<f64>() / f64::from(SIDE * SIDE);
            assert!(raw > 1.5 * expected(&exact), "{raw}");
        }
    }

    #[test]
    fn better_pictures_count_more_and_those_that_know_nothing_not_at_all() {
        let truth = |_| 1.0;
        let (good, bad) = (noisy(truth, 0.01, 5), noisy(|_| 3.0, 1.0, 6));
        let pooled = Pooled::of(&[&good, &bad]).expect("pictures");
        let errors = vec![Rgb::splat(0.1); good.rgb.len()];
        let expected = pooled.expected(&errors).expect("known").rel_mse;
        assert!((expected / (0.01 / 1.01) - 1.0).abs() < 0.05, "{expected}");
        let unknown = picture(good.rgb.clone(), vec![Rgb::splat(f32::INFINITY); good.rgb.len()]);
        assert!(Pooled::of(&[&unknown]).is_none() && Pooled::of(&[]).is_none());
        let alone = Pooled::of(&[&unknown, &good]).expect("one");
        assert_eq!(alone.expected(&unknown.error), None);
    }
}
