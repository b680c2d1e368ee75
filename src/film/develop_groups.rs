//! From the films of independent groups of chains to a picture, and to means over blocks.
//!
//! The states of a chain are correlated, so the error of the mean over G groups is taken from the groups alone: their
//! spread is s/√G, with s² = Σ(v_g − v̄)² / (G − 1). Whoever claims an interval from it needs Student's t with G − 1 degrees
//! of freedom.

use super::blocks::BlockGrid;
use super::group_film::{GroupFilm, to_f64};
use super::picture::{ImageView, Picture};
use super::tally::FilmError;
use crate::color::Rgb;

/// The picture of independent groups: per pixel and channel the mean over the groups of `scales[g]` times the group's sum,
/// and the standard error of that mean over groups (infinite for a single group, zero where all agree). `scales[g]` is the
/// radiance that one unit of the sum of group `g` stands for; `weight` is what the picture says of every pixel, such as
/// mutations per pixel.
///
/// # Errors
/// Where there is no group, another number of scales than of groups, a scale that is not finite, or films of different
/// sizes.
pub fn develop_groups(films: &[&GroupFilm], scales: &[f64], weight: f32) -> Result<Picture, FilmError> {
    develop_combined(films, scales, weight, |_| {})
}

/// [`develop_groups`], where `combine` makes of the groups' values of a pixel and channel those whose mean and spread the
/// picture shows.
///
/// # Errors
/// As [`develop_groups`].
pub fn develop_combined(
    films: &[&GroupFilm],
    scales: &[f64],
    weight: f32,
    combine: impl Fn(&mut [f64]),
) -> Result<Picture, FilmError> {
    let Some(first) = films.first().filter(|_| films.len() == scales.len()) else {
        return Err(FilmError::Groups {
            groups: films.len(),
            scales: scales.len(),
        });
    };
    if let Some(group) = scales.iter().position(|scale| !scale.is_finite()) {
        return Err(FilmError::Scale { group });
    }
    let size = (first.width(), first.height());
    if let Some(other) = films
        .iter()
        .map(|f| (f.width(), f.height()))
        .find(|&other| other != size)
    {
        return Err(FilmError::SizesDiffer {
            first: size,
            second: other,
        });
    }
    let pixels = first.pixels();
    let (mut rgb, mut error) = (Vec::with_capacity(pixels.len()), Vec::with_capacity(pixels.len()));
    let mut values = [0, 1, 2].map(|_| vec![0.0; films.len()]);
    for pixel in pixels {
        for (group, (film, scale)) in films.iter().zip(scales).enumerate() {
            for (values, sum) in values.iter_mut().zip(film.sum(pixel)) {
                values[group] = sum * scale;
            }
        }
        values.iter_mut().for_each(|values| combine(values));
        let [r, g, b] = [0, 1, 2].map(|channel: usize| mean_and_error(values[channel].iter().copied()));
        rgb.push(Rgb::new(r.0 as f32, g.0 as f32, b.0 as f32));
        error.push(Rgb::new(r.1 as f32, g.1 as f32, b.1 as f32));
    }
    let weight = vec![weight; rgb.len()];
    Ok(Picture::new(size.0, size.1, rgb, error, weight))
}

/// The mean of values and its standard error, in two passes. Everything is taken from the first value on, so that values
/// that are all equal have exactly their own mean, and no error.
fn mean_and_error(values: impl ExactSizeIterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.len() as f64;
    let origin = values.clone().next().unwrap_or(0.0);
    let mean = origin + values.clone().map(|v| v - origin).sum::<f64>() / n;
    if values.len() < 2 {
        return (mean, f64::INFINITY);
    }
    let scatter: f64 = values.map(|v| (v - mean) * (v - mean)).sum();
    (mean, (scatter / (n * (n - 1.0))).sqrt())
}

/// A group's mean radiance per block and channel, at index `3 * block + channel`. `scale` is the radiance that one unit of
/// the film's sum stands for. Sums over blocks are exact; only the mean is rounded.
///
/// # Errors
/// Where the film is not of the grid's size.
pub fn block_means(film: &GroupFilm, grid: &BlockGrid, scale: f64) -> Result<Vec<f64>, FilmError> {
    grid.check((film.width(), film.height()))?;
    let means = (0..grid.blocks()).flat_map(|block| {
        let mut total = [0_i128; 3];
        for pixel in grid.pixels_in(block) {
            for (total, sum) in total.iter_mut().zip(film.total(pixel)) {
                *total = total.saturating_add(sum);
            }
        }
        let count = f64::from(grid.pixel_count(block));
        total.map(|total| to_f64(total) / count * scale)
    });
    Ok(means.collect())
}

/// A picture's mean per block and channel, at index `3 * block + channel`.
///
/// # Errors
/// Where the picture is not of the grid's size.
pub fn block_means_of(picture: ImageView<'_>, grid: &BlockGrid) -> Result<Vec<f64>, FilmError> {
    grid.check((picture.width, picture.height))?;
    Ok(over_blocks(picture.rgb, grid, |v| v, |count| count))
}

/// The variance of a picture's mean per block and channel, at index `3 * block + channel`, from the standard errors of
/// its pixels. It holds where pixels are independent, as those of `pt` are; those of chains are not. Infinite where an error
/// is.
///
/// # Errors
/// Where the picture is not of the grid's size.
pub fn block_variances(picture: &Picture, grid: &BlockGrid) -> Result<Vec<f64>, FilmError> {
    grid.check((picture.width, picture.height))?;
    Ok(over_blocks(&picture.error, grid, |v| v * v, |count| count * count))
}

/// Per block and channel the sum of `f` of each pixel, over `divisor` of the number of pixels.
fn over_blocks(pixels: &[Rgb], grid: &BlockGrid, f: impl Fn(f64) -> f64, divisor: impl Fn(f64) -> f64) -> Vec<f64> {
    let of_block = |block| {
        let mut sums = [0.0; 3];
        for rgb in grid.pixels_in(block).filter_map(|pixel| pixels.get(pixel as usize)) {
            for (sum, v) in sums.iter_mut().zip(rgb.to_array()) {
                *sum += f(f64::from(v));
            }
        }
        let divisor = divisor(f64::from(grid.pixel_count(block)));
        sums.map(|sum| sum / divisor)
    };
    (0..grid.blocks()).flat_map(of_block).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Splat;
    use crate::film::fixed::power_of_two;
    use proptest::prelude::*;

    /// A film of one row whose pixels were given these values.
    fn film(values: &[[f32; 3]]) -> GroupFilm {
        let mut film = GroupFilm::new(values.len() as u32, 1).expect("a small film");
        let splat = |(pixel, &value): (u32, &[f32; 3])| Splat {
            pixel,
            value: value.into(),
        };
        film.add(&(0..).zip(values).map(splat).collect::<Vec<_>>());
        film
    }

    fn developed(films: &[GroupFilm], scales: &[f64]) -> Picture {
        develop_groups(&films.iter().collect::<Vec<_>>(), scales, 7.5).expect("groups that go together")
    }

    #[test]
    fn the_picture_is_the_mean_over_groups_with_its_standard_error() {
        let films = [
            film(&[[1.0, 2.0, 0.0], [0.5; 3]]),
            film(&[[3.0, 2.0, 0.0], [0.25; 3]]),
            film(&[[8.0, 2.0, 0.75], [1.0; 3]]),
        ];
        let picture = developed(&films, &[2.0, 4.0, 0.5]);
        // Red of the first pixel: 2, 12, 4, with a spread of sqrt(28).
        let red = (6.0, 28.0_f64.sqrt() / 3.0_f64.sqrt());
        assert_eq!((picture.rgb[0].r, picture.error[0].r), (red.0, red.1 as f32));
        // Blue: 0, 0, 0.375: the error of a single lucky group is its mean.
        assert_eq!((picture.rgb[0].b, picture.error[0].b), (0.125, 0.125));
        // Green: 4, 8, 1.
        let green = (((1.0_f64 + 121.0 + 100.0) / 9.0) / 6.0).sqrt();
        assert!((f64::from(picture.error[0].g) - green).abs() < 1e-6 * green);
        assert_eq!(picture.weight, [7.5; 2]);
        assert_eq!((picture.width, picture.height), (2, 1));
    }

    #[test]
    fn a_single_group_tells_nothing_of_its_error_and_equal_ones_have_none() {
        let one = film(&[[0.1, 0.7, -3.0]]);
        let picture = developed(std::slice::from_ref(&one), &[0.3]);
        let expected = [0.1_f32, 0.7, -3.0].map(|v| (f64::from(v) * 0.3) as f32);
        assert_eq!(
            (picture.rgb[0].to_array(), picture.error[0]),
            (expected, Rgb::splat(f32::INFINITY))
        );
        for groups in [2, 3, 7, 16] {
            let equal = developed(&vec![one.clone(); groups], &vec![0.3; groups]);
            assert_eq!((equal.rgb[0].to_array(), equal.error[0]), (expected, Rgb::BLACK));
        }
    }

    #[test]
    fn small_differences_of_bright_groups_are_not_lost_to_cancellation() {
        // Sums near 10⁶ that differ by some 2⁻³⁰: their squares agree in all digits of an f64.
        let step = Splat {
            pixel: 0,
            value: Rgb::splat(power_of_two(-30) as f32),
        };
        let films: Vec<GroupFilm> = (0..4)
            .map(|group| {
                let mut film = film(&[[1e6; 3]]);
                film.add(&vec![step; group]);
                film
            })
            .collect();
        let picture = developed(&films, &[1.0; 4]);
        // 0, 1, 2, 3 steps: a spread of sqrt(5/3) over sqrt(4).
        let expected = power_of_two(-30) * (5.0_f64 / 12.0).sqrt();
        assert_eq!(picture.error[0], Rgb::splat(expected as f32));
    }

    #[test]
    fn groups_that_do_not_go_together_are_refused_in_words() {
        let (a, b) = (film(&[[1.0; 3]]), film(&[[1.0; 3]; 2]));
        let refused = |films: &[&GroupFilm], scales: &[f64]| develop_groups(films, scales, 1.0).expect_err("refused");
        assert_eq!(refused(&[], &[]), FilmError::Groups { groups: 0, scales: 0 });
        assert_eq!(refused(&[&a], &[1.0; 2]), FilmError::Groups { groups: 1, scales: 2 });
        assert_eq!(refused(&[&a, &a], &[1.0, f64::NAN]), FilmError::Scale { group: 1 });
        assert_eq!(
            refused(&[&a, &b], &[1.0; 2]).to_string(),
            "1 x 1 pixels and 2 x 1 do not go together"
        );
    }

    #[test]
    fn block_means_of_a_film_and_of_its_picture_agree() {
        let (width, height) = (13, 7);
        let mut film = GroupFilm::new(width, height).expect("a small film");
        for i in 0..5000_u32 {
            let v = (i.wrapping_mul(0x9e37_79b9) >> 8) as f32 / 16_777_216.0;
            film.add(&[Splat {
                pixel: i * 31 % (width * height),
                value: Rgb::new(v, 1.0 - v, v * v),
            }]);
        }
        let grid = BlockGrid::new(width, height, 4);
        let means = block_means(&film, &grid, 0.25).expect("one size");
        let picture = develop_groups(&[&film], &[0.25], 1.0).expect("one group");
        let of_picture = block_means_of(picture.view(), &grid).expect("one size");
        assert_eq!(means.len(), grid.blocks() * 3);
        for (i, (a, b)) in means.iter().zip(&of_picture).enumerate() {
            assert!(
                (a - b).abs() <= 1e-6 * a,
                "{}, channel {}: {a} and {b}",
                grid.name(i / 3),
                i % 3
            );
        }
        let by_hand: f64 = grid.pixels_in(5).map(|pixel| film.sum(pixel)[1] * 0.25).sum();
        let mean = by_hand / f64::from(grid.pixel_count(5));
        assert!((means[5 * 3 + 1] - mean).abs() < 1e-12 * mean);
    }

    #[test]
    fn block_variances_are_those_of_means_of_independent_pixels() {
        let mut picture = develop_groups(&[&film(&[[1.0; 3]; 5])], &[1.0], 1.0).expect("one group");
        picture.error = [1.0, 2.0, 3.0, 4.0, 5.0].map(|e| Rgb::new(e, 0.0, 2.0 * e)).to_vec();
        let grid = BlockGrid::new(5, 1, 2);
        let expected = [5.0 / 4.0, 0.0, 5.0, 50.0 / 9.0, 0.0, 200.0 / 9.0];
        assert_eq!(block_variances(&picture, &grid), Ok(expected.to_vec()));
        picture.error[4].g = f32::INFINITY;
        let infinite = block_variances(&picture, &grid).expect("one size");
        assert_eq!((infinite[1], infinite[4]), (0.0, f64::INFINITY));
    }

    #[test]
    fn blocks_of_another_size_are_refused() {
        let film = film(&[[1.0; 3]; 4]);
        let picture = develop_groups(&[&film], &[1.0], 1.0).expect("one group");
        let grid = BlockGrid::new(2, 2, 2);
        let refusals = [
            block_means(&film, &grid, 1.0),
            block_means_of(picture.view(), &grid),
            block_variances(&picture, &grid),
        ];
        for refusal in refusals {
            assert_eq!(
                refusal,
                Err(FilmError::SizesDiffer {
                    first: (4, 1),
                    second: (2, 2)
                })
            );
        }
    }

    proptest! {
        #[test]
        fn mean_and_error_are_the_textbook_estimators(values in prop::collection::vec(-1e3_f64..1e3, 2..40)) {
            let n = values.len() as f64;
            let mean = values.iter().sum::<f64>() / n;
            let scatter: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
            let (m, e) = mean_and_error(values.iter().copied());
            prop_assert!((m - mean).abs() <= 1e-10 && (e - (scatter / (n * (n - 1.0))).sqrt()).abs() <= 1e-10);
        }
    }
}
