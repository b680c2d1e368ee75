//! ꟻLIP: how different two pictures look to somebody who flips between them (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and
//! Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images").
//!
//! Both pictures are shown as a display shows them: linear colours, scaled by an exposure and clipped to 0..1. Two differences are
//! made: of colours, after what an eye at that distance cannot resolve is filtered away, and of edges and points. Their combination is
//! a number per pixel from 0, the same, to 1, black beside white.

use super::metrics::SizeMismatch;
use crate::color::Rgb;
use crate::film::{ImageView, ToneMap};
use std::f64::consts::PI;

/// Pixels per degree of the display: 3840 over 0.7 m, seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f64 = 67.020_642_2;

/// Exponent of colour differences.
const QC: f64 = 0.7;
/// Colour differences below this share of the largest take up the share [`PT`] of what is shown.
const PC: f64 = 0.4;
const PT: f64 = 0.95;
/// Exponent of feature differences.
const QF: f64 = 0.5;
/// Width of the feature detectors in degrees.
const FEATURE_WIDTH: f64 = 0.082;

/// D65, for which (1, 1, 1) is white.
const WHITE: [f64; 3] = [0.950_428_545, 1.0, 1.088_900_371];
/// sRGB's primaries in XYZ, row by row.
const TO_XYZ: [[f64; 3]; 3] = [
    [
        10_135_552.0 / 24_577_794.0,
        8_788_810.0 / 24_577_794.0,
        4_435_075.0 / 24_577_794.0,
    ],
    [
        2_613_072.0 / 12_288_897.0,
        8_788_810.0 / 12_288_897.0,
        887_015.0 / 12_288_897.0,
    ],
    [
        1_425_312.0 / 73_733_382.0,
        8_788_810.0 / 73_733_382.0,
        70_074_185.0 / 73_733_382.0,
    ],
];
/// The inverse of [`TO_XYZ`].
const FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_275, -1.537_398_934, -0.498_615_861],
    [-0.969_224_334, 1.875_930_071, 0.041_554_224],
    [0.055_639_423, -0.204_011_202, 1.057_148_933],
];

/// A Gaussian of contrast sensitivity: a √(π/b) exp(−π² x² / b), x in degrees.
#[derive(Clone, Copy)]
struct Sensitivity {
    a: f64,
    b: f64,
}

/// What an eye resolves of lightness, red against green, and blue against yellow: sums of up to two Gaussians.
const SENSITIVITIES: [&[Sensitivity]; 3] = [
    &[Sensitivity { a: 1.0, b: 0.0047 }],
    &[Sensitivity { a: 1.0, b: 0.0053 }],
    &[Sensitivity { a: 34.1, b: 0.04 }, Sensitivity { a: 13.5, b: 0.025 }],
];
/// The widest b.
const WIDEST: f64 = 0.04;

/// One channel of a picture, row by row.
type Plane = Vec<f64>;

/// The sides of a picture.
#[derive(Clone, Copy)]
struct Sides {
    width: usize,
    height: usize,
}

/// ꟻLIP of every pixel of `image` beside `reference`, both shown by `tone`, row by row from the top left. Pixels that are not finite are
/// shown black.
///
/// # Errors
/// Where their sides differ.
pub fn flip(image: ImageView<'_>, reference: ImageView<'_>, tone: ToneMap) -> Result<Vec<f32>, SizeMismatch> {
    SizeMismatch::refuse(image, reference)?;
    let sides = Sides {
        width: image.width as usize,
        height: image.height as usize,
    };
    if image.rgb.is_empty() {
        return Ok(Vec::new());
    }
    let scale = libm::exp2(f64::from(tone.exposure));
    let [a, r] = [image, reference].map(|picture| opponent(picture.rgb, scale));
    let colors = color_differences([&a, &r], sides);
    let features = feature_differences([&a[0], &r[0]], sides);
    let combined = |(&color, &feature): (&f64, &f64)| libm::pow(color, 1.0 - feature) as f32;
    Ok(colors.iter().zip(&features).map(combined).collect())
}

/// The mean of [`flip`].
///
/// # Errors
/// Where their sides differ.
pub fn mean_flip(image: ImageView<'_>, reference: ImageView<'_>, tone: ToneMap) -> Result<f64, SizeMismatch> {
    let values = flip(image, reference, tone)?;
    Ok(values.iter().copied().map(f64::from).sum::<f64>() / values.len().max(1) as f64)
}

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// What is shown, in YCxCz, the linear form of CIELAB that spatial filters are made for.
fn opponent(rgb: &[Rgb], scale: f64) -> [Plane; 3] {
    let mut planes = std::array::from_fn(|_| Plane::with_capacity(rgb.len()));
    for color in rgb {
        let shown = color.to_array().map(|v| {
            let v = f64::from(v) * scale;
            if v.is_finite() { v.clamp(0.0, 1.0) } else { 0.0 }
        });
        let [x, y, z] = relative(times(&TO_XYZ, shown));
        for (plane, value) in planes
            .iter_mut()
            .zip([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])
        {
            plane.push(value);
        }
    }
    planes
}

fn relative(xyz: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| xyz[i] / WHITE[i])
}

/// CIELAB, with chroma that grows with lightness (Hunt's effect), of a colour in YCxCz, clipped to what can be shown.
fn lab_of_opponent([luma, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (luma + 16.0) / 116.0;
    let (x, z) = (y + cx / 500.0, y - cz / 200.0);
    let shown = times(&FROM_XYZ, [x * WHITE[0], y * WHITE[1], z * WHITE[2]]).map(|v| v.clamp(0.0, 1.0));
    lab(shown)
}

fn lab(rgb: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let [x, y, z] = relative(times(&TO_XYZ, rgb)).map(|t| {
        if t > DELTA * DELTA * DELTA {
            libm::cbrt(t)
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    [lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z)]
}

/// Distances of lightness and of chroma, added (Abasi, Amani Tehran and Fairchild 2020).
fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + libm::hypot(a[1] - b[1], a[2] - b[2])
}

fn color_differences(pictures: [&[Plane; 3]; 2], sides: Sides) -> Plane {
    let filtered = pictures.map(|planes| -> [Plane; 3] {
        std::array::from_fn(|channel| seen_from_afar(&planes[channel], SENSITIVITIES[channel], sides))
    });
    // Green beside blue.
    let largest = libm::pow(hyab(lab([0.0, 1.0, 0.0]), lab([0.0, 0.0, 1.0])), QC);
    let knee = PC * largest;
    (0..sides.width * sides.height)
        .map(|i| {
            let [a, r] = [0, 1].map(|k: usize| lab_of_opponent(std::array::from_fn(|c| filtered[k][c][i])));
            let difference = libm::pow(hyab(a, r), QC);
            if difference < knee {
                difference * PT / knee
            } else {
                PT + (difference - knee) / (largest - knee) * (1.0 - PT)
            }
        })
        .collect()
}

/// A channel as an eye sees it.
fn seen_from_afar(plane: &Plane, gaussians: &[Sensitivity], sides: Sides) -> Plane {
    let radius = libm::ceil(3.0 * libm::sqrt(WIDEST / (2.0 * PI * PI)) * PIXELS_PER_DEGREE) as usize;
    let mut sum = vec![0.0; plane.len()];
    let mut total = 0.0;
    for &Sensitivity { a, b } in gaussians {
        let kernel = kernel(radius, |x| {
            let degrees = x / PIXELS_PER_DEGREE;
            libm::exp(-PI * PI * degrees * degrees / b)
        });
        let height = a * libm::sqrt(PI / b);
        let width: f64 = kernel.iter().sum();
        total += height * width * width;
        let filtered = convolve(plane, &kernel, &kernel, sides);
        sum.iter_mut()
            .zip(filtered)
            .for_each(|(sum, value)| *sum += height * value);
    }
    sum.iter_mut().for_each(|value| *value /= total);
    sum
}

/// How much more of an edge, or of a point, one picture has than the other, by their lightness.
fn feature_differences(lightness: [&Plane; 2], sides: Sides) -> Plane {
    let sigma = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    let radius = libm::ceil(3.0 * sigma) as usize;
    let gaussian = |x: f64| libm::exp(-x * x / (2.0 * sigma * sigma));
    let blur = kernel(radius, gaussian);
    let blur: Vec<f64> = blur.iter().map(|v| v / blur.iter().sum::<f64>()).collect();
    let edge = balanced(kernel(radius, |x| -x * gaussian(x)));
    let point = balanced(kernel(radius, |x| (x * x / (sigma * sigma) - 1.0) * gaussian(x)));
    let strengths = lightness.map(|plane| {
        let grey: Plane = plane.iter().map(|y| (y + 16.0) / 116.0).collect();
        [&edge, &point].map(|feature| {
            let across = convolve(&grey, feature, &blur, sides);
            let down = convolve(&grey, &blur, feature, sides);
            across
                .into_iter()
                .zip(down)
                .map(|(x, y)| libm::hypot(x, y))
                .collect::<Plane>()
        })
    });
    let [a, r] = &strengths;
    (0..sides.width * sides.height)
        .map(|i| {
            let difference = (a[0][i] - r[0][i]).abs().max((a[1][i] - r[1][i]).abs());
            libm::pow(difference / std::f64::consts::SQRT_2, QF)
        })
        .collect()
}

fn kernel(radius: usize, f: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=2 * radius).map(|i| f(i as f64 - radius as f64)).collect()
}

/// The kernel with positive values that add up to 1, and negative ones to −1.
fn balanced(kernel: Vec<f64>) -> Vec<f64> {
    let positive: f64 = kernel.iter().filter(|v| **v > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|v| **v < 0.0).sum::<f64>();
    kernel
        .into_iter()
        .map(|v| if v > 0.0 { v / positive } else { v / negative })
        .collect()
}

/// The plane under a kernel that is the product of one over columns and one over rows; beyond its edges it goes on as there.
fn convolve(plane: &Plane, across: &[f64], down: &[f64], Sides { width, height }: Sides) -> Plane {
    let mut rows = vec![0.0; plane.len()];
    let radius = across.len() / 2;
    for (row, out) in plane.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
        for (x, out) in out.iter_mut().enumerate() {
            let at = |i: usize| row[(x + i).saturating_sub(radius).min(width - 1)];
            *out = across.iter().enumerate().map(|(i, k)| k * at(i)).sum();
        }
    }
    let mut columns = vec![0.0; plane.len()];
    let radius = down.len() / 2;
    for (y, out) in columns.chunks_exact_mut(width).enumerate() {
        for (i, k) in down.iter().enumerate() {
            let row = (y + i).saturating_sub(radius).min(height - 1) * width;
            out.iter_mut()
                .zip(&rows[row..row + width])
                .for_each(|(out, value)| *out += k * value);
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: u32 = 40;
    const HEIGHT: u32 = 30;

    /// Checks of ramps and waves; with `changed`, other here and there.
    fn picture(changed: bool) -> Vec<Rgb> {
        let pixel = |x: u32, y: u32| {
            let channel = |c: u32| {
                let value = if (x / 8 + y / 8).is_multiple_of(2) {
                    ((x * (7 + c) + y * (5 + 2 * c)) % 32) as f32 / 32.0
                } else {
                    ((x + y * (c + 1)) % 16) as f32 / 16.0
                };
                let more = (((x * 13 + y * 29) % 17) as f32 - 8.0) / 64.0;
                match (changed, c) {
                    (false, _) => value,
                    (true, 1) => (value - 0.5 * more).clamp(0.0, 1.0),
                    (true, _) => (value + more).clamp(0.0, 1.0),
                }
            };
            match (x, y) {
                (20, 10) if changed => Rgb::ONE,
                (30..34, 5..9) if changed => Rgb::new(0.0, 0.25, 1.0),
                _ => Rgb::new(channel(0), channel(1), channel(2)),
            }
        };
        (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| pixel(x, y))).collect()
    }

    fn view(rgb: &[Rgb]) -> ImageView<'_> {
        ImageView {
            width: WIDTH,
            height: HEIGHT,
            rgb,
        }
    }

    /// Values of the authors' own program (version 1.7 of its Python package) for the same pictures.
    #[test]
    fn differences_are_those_of_the_authors_program() {
        let (r, a) = (picture(false), picture(true));
        let tone = ToneMap { exposure: 0.0 };
        let values = flip(view(&a), view(&r), tone).expect("same sides");
        for ((x, y), expected) in [
            ((0, 0), 0.179_549_74),
            ((20, 10), 0.219_049_54),
            ((31, 6), 0.768_069_2),
            ((39, 29), 0.062_959_775),
            ((12, 17), 0.048_956_167),
            ((5, 25), 0.019_666_275),
        ] {
            let got = values[y * WIDTH as usize + x];
            assert!((got - expected).abs() < 2e-5, "({x}, {y}): {got}, not {expected}");
        }
        let mean = mean_flip(view(&a), view(&r), tone).expect("same sides");
        assert!((mean - 0.083_900_7).abs() < 1e-5, "{mean}");
    }

    #[test]
    fn a_picture_looks_like_itself_and_black_unlike_white() {
        let r = picture(false);
        let tone = ToneMap { exposure: 0.0 };
        assert_eq!(mean_flip(view(&r), view(&r), tone), Ok(0.0));
        let [black, white] = [Rgb::BLACK, Rgb::ONE].map(|color| vec![color; (WIDTH * HEIGHT) as usize]);
        let mean = mean_flip(view(&black), view(&white), tone).expect("same sides");
        assert!(mean > 0.95 && mean <= 1.0, "{mean}");
        // What is brighter than a display can show looks the same.
        let brighter = vec![Rgb::splat(3.0); white.len()];
        assert_eq!(mean_flip(view(&brighter), view(&white), tone), Ok(0.0));
        let stops = ToneMap { exposure: -2.0 };
        assert!(mean_flip(view(&brighter), view(&white), stops).expect("same sides") > 0.3);
    }

    #[test]
    fn one_row_and_pixels_that_are_not_finite_are_compared() {
        let row = [Rgb::ONE, Rgb::splat(f32::NAN), Rgb::splat(f32::INFINITY)];
        let view = ImageView {
            width: 3,
            height: 1,
            rgb: &row,
        };
        let values = flip(view, view, ToneMap::default()).expect("same sides");
        assert_eq!(values, [0.0; 3]);
        let none = ImageView {
            width: 0,
            height: 0,
            rgb: &[],
        };
        assert_eq!(mean_flip(none, none, ToneMap::default()), Ok(0.0));
    }
}
