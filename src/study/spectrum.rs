//! Where in a picture's frequencies an error is. Errors of independent pixels are as strong at all frequencies; those of chains, which
//! stay in one part of the picture for a while, are stronger at low ones, as patches.

use crate::color::Rgb;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Bands of radial frequency: that of the whole picture, then octaves up to the corner's, 0.71 cycles per pixel.
pub const BANDS: usize = 8;

/// For each band, the power of the error's luminance per frequency, relative to that of an error with the same mean square and as much of
/// it everywhere: 1 everywhere where pixels err independently.
pub type Spectrum = [f64; BANDS];

/// The frequencies of a band, in words.
#[must_use]
pub fn band_name(band: usize) -> String {
    let edge = |band: usize| match band {
        1 => "0".to_owned(),
        band if band < BANDS => format!("1/{}", 1 << (BANDS - band)),
        _ => "0.71".to_owned(),
    };
    match band {
        0 => "whole picture".to_owned(),
        band => format!("{} to {} cycles per pixel", edge(band), edge(band + 1)),
    }
}

/// The band of a radial frequency in cycles per pixel.
fn band(frequency: f64) -> usize {
    if frequency == 0.0 {
        return 0;
    }
    // Half a cycle per pixel begins the last one.
    let octaves = libm::floor(libm::log2(frequency)) as i64 + BANDS as i64;
    octaves.clamp(1, BANDS as i64 - 1) as usize
}

/// The spectrum of what lies between two pictures that are `width` pixels wide; zeros where nothing does. Pixels that are not finite count as alike.
#[must_use]
pub fn spectrum(image: &[Rgb], reference: &[Rgb], width: usize) -> Spectrum {
    let height = reference.len() / width.max(1);
    let mut values: Vec<Complex<f64>> = image
        .iter()
        .zip(reference)
        .map(|(a, r)| {
            let difference = f64::from(a.luminance()) - f64::from(r.luminance());
            Complex::new(if difference.is_finite() { difference } else { 0.0 }, 0.0)
        })
        .collect();
    let mut spectrum = [0.0; BANDS];
    if width * height == 0 || values.len() != width * height {
        return spectrum;
    }
    let mut planner = FftPlanner::new();
    planner.plan_fft_forward(width).process(&mut values);
    let mut columns: Vec<Complex<f64>> = (0..width)
        .flat_map(|x| (0..height).map(move |y| (x, y)))
        .map(|(x, y)| values[y * width + x])
        .collect();
    planner.plan_fft_forward(height).process(&mut columns);
    let mut counts = [0_u64; BANDS];
    let mut total = 0.0;
    let folded = |k: usize, n: usize| k.min(n - k) as f64 / n as f64;
    for (i, value) in columns.iter().enumerate() {
        let band = band(libm::hypot(folded(i / height, width), folded(i % height, height)));
        let power = value.norm_sqr();
        spectrum[band] += power;
        counts[band] += 1;
        total += power;
    }
    let even = total / (width * height) as f64;
    for (power, count) in spectrum.iter_mut().zip(counts) {
        *power = if even > 0.0 && count > 0 {
            *power / count as f64 / even
        } else {
            0.0
        };
    }
    spectrum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};

    const WIDTH: usize = 96;
    const HEIGHT: usize = 80;

    fn of(value: impl Fn(usize, usize) -> f32) -> Spectrum {
        let pixels = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
        let image: Vec<Rgb> = pixels.map(|(x, y)| Rgb::splat(value(x, y))).collect();
        spectrum(&image, &vec![Rgb::BLACK; image.len()], WIDTH)
    }

    #[test]
    fn independent_errors_are_as_strong_at_all_frequencies() {
        let spectrum = of(|x, y| {
            let key = StreamKey::new(3, (y * WIDTH + x) as u32, 0);
            key.stream(Purpose::FILM, 0).next_f64() as f32 - 0.5
        });
        // Of band 1 there are a few frequencies only.
        assert!(
            spectrum[2..].iter().all(|power| (power - 1.0).abs() < 0.35),
            "{spectrum:?}"
        );
    }

    #[test]
    fn a_wave_is_in_its_band_and_evenness_in_the_first() {
        let wave = of(|x, _| libm::cosf(std::f32::consts::TAU * x as f32 / 6.0));
        let strongest = (0..BANDS).max_by(|&a, &b| wave[a].total_cmp(&wave[b]));
        // A sixth of a cycle per pixel; a seventh of all frequencies are in its band.
        assert_eq!(strongest, Some(5));
        assert!(wave[5] > 6.5 && wave[4] < 1e-6 && wave[6] < 1e-6, "{wave:?}");
        let even = of(|_, _| 0.3);
        assert!((even[0] - (WIDTH * HEIGHT) as f64).abs() < 1.0 && even[1..].iter().all(|&power| power < 1e-6));
        assert_eq!(of(|_, _| 0.0), [0.0; BANDS]);
    }

    #[test]
    fn bands_are_octaves() {
        assert_eq!([0.0, 0.004, 0.02, 0.3, 0.5, 0.7].map(band), [0, 1, 2, 6, 7, 7]);
        assert_eq!(band_name(1), "0 to 1/64 cycles per pixel");
        assert_eq!(band_name(6), "1/4 to 1/2 cycles per pixel");
        assert_eq!(band_name(7), "1/2 to 0.71 cycles per pixel");
    }
}
