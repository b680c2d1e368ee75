//! The film of one group of chains: sums only.
//!
//! The states of a chain are correlated, so squares of splats tell nothing about the picture's error; the spread over
//! independent groups does. Each group therefore keeps a film of its own, and there are many: 24 bytes a pixel, where
//! [`super::Film`] takes 128.

use super::accumulate::Splat;
use super::tally::{FilmError, Tally};
use std::collections::BTreeMap;

/// Bits after the binary point of a sum.
const FRACTION_BITS: u32 = 40;
/// The value of one step: a power of two, so that multiplying by it is exact.
const STEP: f64 = 1.0 / (1_u64 << FRACTION_BITS) as f64;
/// The largest magnitude of a channel that is added to the table of sums; larger ones go to the spilled sums at once.
const NARROW: f32 = (1 << 20) as f32;
/// The largest magnitude of a channel that is added as it is.
const LIMIT: f32 = (1_u64 << 50) as f32;
/// A sum whose magnitude passes this moves to the spilled sums. One more splat is at most 2⁶⁰, so no addition overflows.
pub(super) const SPILL_ABOVE: u64 = 1 << 62;

/// The accumulator of one group of chains: exact sums in fixed point, the same for any order of additions.
///
/// Splats are of order one, however bright the scene is: of chains they are colour over target function, times the state's
/// weight; of independent samples light over what a few samples found in the mean. What brings them to radiance is one factor
/// for the whole film ([`super::develop_groups`]).
///
/// # Range and resolution
///
/// - A splat's channel is rounded to the nearest multiple of 2⁻⁴⁰, ties to even; of values from 2⁻¹⁷ up no bit is lost. One
///   that rounds to nothing is counted ([`Tally::vanished`]).
/// - A channel beyond ± 2⁵⁰ is brought down to that, and counted ([`Tally::saturated`]).
/// - Sums are exact for any number of splats: one that passes 2⁶² steps (2²², radiance being one) moves into a sparse map of
///   128-bit sums, and starts again from zero; splats with a channel beyond ± 2²⁰ go there at once. Those hold 2³⁴ splats of
///   the largest value.
///
/// Films are equal where their sizes, their sums and their tallies are, however the sums came about.
///
/// # Example
/// ```
/// use chainlight::{color::Rgb, film::{GroupFilm, Splat}};
///
/// let mut film = GroupFilm::new(2, 1)?;
/// film.add(&[Splat { pixel: 1, value: Rgb::ONE }, Splat { pixel: 1, value: Rgb::splat(0.5) }]);
/// assert_eq!((film.sum(0), film.sum(1)), ([0.0; 3], [1.5; 3]));
/// # Ok::<(), chainlight::film::FilmError>(())
/// ```
#[derive(Clone, Debug)]
pub struct GroupFilm {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Per pixel and channel, in steps of 2⁻⁴⁰; of magnitude [`SPILL_ABOVE`] at most.
    pub(super) sums: Vec<[i64; 3]>,
    /// What was moved out of `sums`, by pixel.
    pub(super) spilled: BTreeMap<u32, [i128; 3]>,
    pub(super) tally: Tally,
}

impl GroupFilm {
    /// An empty film of `width` by `height` pixels.
    ///
    /// # Errors
    /// Where a side is zero, or there is no memory for 24 bytes a pixel.
    pub fn new(width: u32, height: u32) -> Result<Self, FilmError> {
        let too_large = || FilmError::TooLarge {
            width,
            height,
            bytes: Self::bytes(width, height),
        };
        let pixels = u32::try_from(u64::from(width) * u64::from(height)).map_err(|_| too_large())? as usize;
        if pixels == 0 {
            return Err(FilmError::Empty { width, height });
        }
        let mut sums = Vec::new();
        sums.try_reserve_exact(pixels).map_err(|_| too_large())?;
        sums.resize(pixels, [0; 3]);
        Ok(Self {
            width,
            height,
            sums,
            spilled: BTreeMap::new(),
            tally: Tally::default(),
        })
    }

    /// The memory a film of this size takes, without sums that spilled (some hundred bytes each).
    #[must_use]
    pub const fn bytes(width: u32, height: u32) -> u64 {
        (width as u64 * height as u64).saturating_mul(size_of::<[i64; 3]>() as u64)
    }

    /// Pixels in a row.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// What the film could not take as it was, over all that was ever added.
    #[must_use]
    pub const fn tally(&self) -> Tally {
        self.tally
    }

    /// Adds splats, in any order. Returns what of this list was not taken as it was.
    pub fn add(&mut self, splats: &[Splat]) -> Tally {
        let mut tally = Tally::default();
        for splat in splats {
            if !splat.value.is_finite() {
                tally.non_finite += 1;
                continue;
            }
            let Some(sum) = self.sums.get_mut(splat.pixel as usize) else {
                tally.outside += 1;
                continue;
            };
            let value = splat.value.to_array();
            if value.iter().any(|v| v.abs() > NARROW) {
                add_wide(&mut self.spilled, splat.pixel, value, &mut tally);
                continue;
            }
            let steps = value.map(steps);
            for (sum, steps) in sum.iter_mut().zip(steps) {
                *sum += steps;
            }
            if sum.iter().any(|s| s.unsigned_abs() > SPILL_ABOVE) {
                spill(&mut self.spilled, splat.pixel, sum);
            }
            tally.vanished += u64::from(steps.iter().zip(value).any(|(&s, v)| s == 0 && v != 0.0));
        }
        self.tally.add(&tally);
        tally
    }

    /// Adds all that another film was given.
    ///
    /// # Errors
    /// Where the films are of different sizes; nothing is added then.
    pub fn merge(&mut self, other: &Self) -> Result<(), FilmError> {
        let sizes = [(self.width, self.height), (other.width, other.height)];
        if sizes[0] != sizes[1] {
            return Err(FilmError::SizesDiffer {
                first: sizes[0],
                second: sizes[1],
            });
        }
        for (pixel, (sums, added)) in self.sums.iter_mut().zip(&other.sums).enumerate() {
            let fits = |(s, a): (&i64, &i64)| s.checked_add(*a).is_some_and(|t| t.unsigned_abs() <= SPILL_ABOVE);
            if !sums.iter().zip(added).all(fits) {
                spill(&mut self.spilled, pixel as u32, sums);
            }
            for (sum, &added) in sums.iter_mut().zip(added) {
                *sum += added;
            }
        }
        for (&pixel, added) in &other.spilled {
            let sum = self.spilled.entry(pixel).or_default();
            for (sum, &added) in sum.iter_mut().zip(added) {
                *sum = sum.saturating_add(added);
            }
        }
        self.tally.add(&other.tally);
        Ok(())
    }

    /// The sums of a pixel, each the `f64` nearest to the exact one; zeros for a pixel that the film does not have.
    #[must_use]
    pub fn sum(&self, pixel: u32) -> [f64; 3] {
        match self.sums.get(pixel as usize) {
            // Nearly always, and without wide arithmetic.
            Some(sums) if self.spilled.is_empty() => sums.map(|s| s as f64 * STEP),
            _ => self.total(pixel).map(to_f64),
        }
    }

    /// The exact sums of a pixel, in steps of 2⁻⁴⁰.
    pub(super) fn total(&self, pixel: u32) -> [i128; 3] {
        let own = self.sums.get(pixel as usize).copied().unwrap_or_default();
        let mut total = own.map(i128::from);
        // Nearly always empty, and then not worth a call.
        if !self.spilled.is_empty()
            && let Some(spilled) = self.spilled.get(&pixel)
        {
            for (total, &spilled) in total.iter_mut().zip(spilled) {
                *total = total.saturating_add(spilled);
            }
        }
        total
    }

    pub(super) fn pixels(&self) -> std::ops::Range<u32> {
        // As many as `new` counted with 32 bits.
        0..self.sums.len() as u32
    }
}

impl PartialEq for GroupFilm {
    fn eq(&self, other: &Self) -> bool {
        let films = [self, other].map(|film| (film.width, film.height, film.tally));
        films[0] == films[1]
            && if self.spilled.is_empty() && other.spilled.is_empty() {
                self.sums == other.sums
            } else {
                self.pixels().all(|pixel| self.total(pixel) == other.total(pixel))
            }
    }
}

impl Eq for GroupFilm {}

/// Steps of 2⁻⁴⁰ in one.
const STEPS_OF_ONE: f64 = (1_u64 << FRACTION_BITS) as f64;

/// A value of at most [`NARROW`] in steps of 2⁻⁴⁰, rounded to nearest, ties to even.
#[inline]
fn steps(value: f32) -> i64 {
    /// An `f64` of about this size has no room for a fraction, so adding this rounds, and as wanted. (The library's
    /// function is a call where the processor is not known to have an instruction for it.)
    const WHOLE: f64 = (3_u64 << 51) as f64;
    // Exact: a power of two.
    let scaled = f64::from(value) * STEPS_OF_ONE;
    // From 2²³ on, an f32 has no fraction by itself; from 2⁵¹ on, it would not fit beside the constant.
    let rounded = if scaled.abs() < (1 << 30) as f64 {
        (scaled + WHOLE) - WHOLE
    } else {
        scaled
    };
    rounded as i64
}

/// Steps to the value they stand for, rounded once.
pub(super) fn to_f64(steps: i128) -> f64 {
    steps as f64 * STEP
}

/// A finite value, brought into the limits, in steps of 2⁻⁴⁰; those beyond [`NARROW`] are whole numbers of them.
fn wide_steps(value: f32) -> i128 {
    if value.abs() > NARROW {
        (f64::from(value.clamp(-LIMIT, LIMIT)) * STEPS_OF_ONE) as i128
    } else {
        i128::from(steps(value))
    }
}

/// Adds a splat to the sums beside the film's table.
#[cold]
#[inline(never)]
fn add_wide(spilled: &mut BTreeMap<u32, [i128; 3]>, pixel: u32, value: [f32; 3], tally: &mut Tally) {
    let steps = value.map(wide_steps);
    let totals = spilled.entry(pixel).or_default();
    for (total, steps) in totals.iter_mut().zip(steps) {
        *total = total.saturating_add(steps);
    }
    tally.saturated += u64::from(value.iter().any(|v| v.abs() > LIMIT));
    tally.vanished += u64::from(steps.iter().zip(value).any(|(&s, v)| s == 0 && v != 0.0));
}

/// Moves a pixel's sums out of the film's table; a film whose values are of order one never comes here.
#[cold]
#[inline(never)]
fn spill(spilled: &mut BTreeMap<u32, [i128; 3]>, pixel: u32, sums: &mut [i64; 3]) {
    let totals = spilled.entry(pixel).or_default();
    for (total, sum) in totals.iter_mut().zip(std::mem::take(sums)) {
        *total = total.saturating_add(i128::from(sum));
    }
}

#[cfg(test)]
#[path = "group_film_tests.rs"]
mod tests;
