//! The film's sums: one deterministic accumulator that every tile and thread adds to.
//!
//! Floating-point addition is not associative, so a sum of floats remembers the order it was made in. The film adds
//! integers ([`super::fixed`]): the same samples give the same film whatever the order, the threads or the tiles.

use super::fixed::{SquareSum, Unit};
use super::tally::{FilmError, Tally};
use crate::color::Rgb;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Pixels per lock, as a power of two: 1024 pixels of 128 bytes.
const STRIPE_BITS: u32 = 10;

/// Light that reaches a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// Row-major index of the pixel.
    pub pixel: u32,
    /// Radiance times the weight it counts with.
    pub value: Rgb,
}

/// One pixel's sums: two cache lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C)]
pub(super) struct PixelSums {
    pub(super) sum: [i128; 3],
    pub(super) squares: [SquareSum; 3],
    pub(super) samples: u64,
}

type Stripe = Box<[PixelSums]>;

/// The accumulator: sums in fixed point, the same for any order of additions.
///
/// Light comes in by two ways. A **sample** is drawn for a pixel, black or not: the pixel's value is the mean over its
/// samples ([`Film::add_samples`], [`Film::develop`]). A **splat** comes from a light path or a chain that lands
/// anywhere: the pixels' values are their sums, times a factor known for the whole film ([`Film::add_splats`],
/// [`Film::develop_splats`]). A film holds one kind; a technique with both keeps two films and adds the pictures.
///
/// # Range and resolution
///
/// The unit is the power of two at or above the scene's largest emitted radiance.
///
/// | | sum | sum of squares |
/// |---|---|---|
/// | resolution | 2⁻⁶⁴ units | 2⁻¹⁰⁴ units² |
/// | range | ± 2⁶³ units | 2⁸⁸ units² |
///
/// - A value from 2⁻⁴⁰ units up is added exactly, every bit of it; below, it is rounded to the resolution, and below
///   2⁻⁶⁵ units it vanishes ([`Tally::vanished`]). Squares are exact from 2⁻²⁸ units, keep 24 bits at 2⁻⁴⁰ units and
///   vanish below 2⁻⁵².
/// - A value above 2⁴⁰ units is brought down to that ([`Tally::saturated`]): a picture with one is wrong, and says so.
/// - By Cauchy and Schwarz |S| ≤ √(n S₂), so the sum cannot overflow in a pixel with fewer than 2³⁸ splats unless the sum
///   of squares left its range first. That pins it at its largest value, for good and in any order, and the pixel's error
///   is then reported as infinite.
///
/// # Example
/// ```
/// use chainlight::{color::Rgb, film::{Film, Splat}};
///
/// let film = Film::new(2, 1, 10.0)?;
/// film.add_samples(&[Splat { pixel: 1, value: Rgb::ONE }, Splat { pixel: 1, value: Rgb::BLACK }]);
/// let picture = film.develop();
/// assert_eq!(picture.rgb, [Rgb::BLACK, Rgb::splat(0.5)]);
/// assert_eq!(picture.error[1], Rgb::splat(0.5));
/// # Ok::<(), chainlight::film::FilmError>(())
/// ```
#[derive(Debug)]
pub struct Film {
    width: u32,
    height: u32,
    unit: Unit,
    limit: f32,
    stripes: Box<[Mutex<Stripe>]>,
    non_finite: AtomicU64,
    outside: AtomicU64,
    saturated: AtomicU64,
    vanished: AtomicU64,
}

impl Film {
    /// An empty film of `width` by `height` pixels, for a scene whose brightest light emits `max_radiance`. That sets the
    /// unit: a wrong guess costs resolution or range, not correctness. What is not a positive finite number counts as 1.
    ///
    /// # Errors
    /// Where a side is zero, or there is no memory for 128 bytes a pixel.
    pub fn new(width: u32, height: u32, max_radiance: f32) -> Result<Self, FilmError> {
        Self::with_unit(width, height, Unit::at_least(max_radiance))
    }

    /// [`Film::new`] for a unit that is known.
    pub(super) fn with_unit(width: u32, height: u32, unit: Unit) -> Result<Self, FilmError> {
        let too_large = || FilmError::TooLarge {
            width,
            height,
            bytes: Self::bytes(width, height),
        };
        let pixels = u32::try_from(u64::from(width) * u64::from(height)).map_err(|_| too_large())?;
        if pixels == 0 {
            return Err(FilmError::Empty { width, height });
        }
        let mut stripes = Vec::new();
        for first in (0..pixels).step_by(1 << STRIPE_BITS) {
            let length = (pixels - first).min(1 << STRIPE_BITS) as usize;
            let mut stripe = Vec::new();
            stripe.try_reserve_exact(length).map_err(|_| too_large())?;
            stripe.resize(length, PixelSums::default());
            stripes.push(Mutex::new(stripe.into_boxed_slice()));
        }
        Ok(Self {
            width,
            height,
            unit,
            limit: unit.limit(),
            stripes: stripes.into_boxed_slice(),
            non_finite: AtomicU64::new(0),
            outside: AtomicU64::new(0),
            saturated: AtomicU64::new(0),
            vanished: AtomicU64::new(0),
        })
    }

    /// The memory a film of this size takes.
    #[must_use]
    pub const fn bytes(width: u32, height: u32) -> u64 {
        (width as u64 * height as u64).saturating_mul(size_of::<PixelSums>() as u64)
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

    pub(super) const fn unit(&self) -> Unit {
        self.unit
    }

    /// Adds samples: each counts as one sample of its pixel, black ones too. Several threads may call this at once;
    /// neighbours in the list that share a run of 1024 pixels share one lock. Returns what of this list was not taken as
    /// it was.
    pub fn add_samples(&self, samples: &[Splat]) -> Tally {
        self.add::<1>(samples)
    }

    /// Adds splats: light only, no sample is counted. Otherwise as [`Film::add_samples`].
    pub fn add_splats(&self, splats: &[Splat]) -> Tally {
        self.add::<0>(splats)
    }

    fn add<const COUNT: u64>(&self, splats: &[Splat]) -> Tally {
        let mut tally = Tally::default();
        let mut open: Option<(u32, MutexGuard<'_, Stripe>)> = None;
        for splat in splats {
            if !splat.value.is_finite() {
                tally.non_finite += 1;
                continue;
            }
            let stripe = splat.pixel >> STRIPE_BITS;
            if open.as_ref().is_none_or(|(locked, _)| *locked != stripe) {
                // The old lock goes before the next is taken: a thread never holds two.
                drop(open.take());
                open = self.stripes.get(stripe as usize).map(|s| (stripe, lock(s)));
            }
            let row = (splat.pixel & ((1 << STRIPE_BITS) - 1)) as usize;
            match open.as_mut().and_then(|(_, pixels)| pixels.get_mut(row)) {
                Some(pixel) => {
                    pixel.samples += COUNT;
                    self.add_value(pixel, splat.value, &mut tally);
                }
                None => tally.outside += 1,
            }
        }
        drop(open);
        self.book(&tally);
        tally
    }

    #[inline]
    fn add_value(&self, pixel: &mut PixelSums, value: Rgb, tally: &mut Tally) {
        if value.is_black() {
            return;
        }
        let (mut saturated, mut vanished) = (false, false);
        for (channel, mut v) in value.to_array().into_iter().enumerate() {
            if v.abs() > self.limit {
                v = self.limit.copysign(v);
                saturated = true;
            }
            let fixed = self.unit.fixed(v);
            vanished |= fixed.value == 0 && v != 0.0;
            pixel.sum[channel] = pixel.sum[channel].saturating_add(fixed.value);
            pixel.squares[channel].add(&fixed);
        }
        tally.saturated += u64::from(saturated);
        tally.vanished += u64::from(vanished);
    }

    fn book(&self, tally: &Tally) {
        if !tally.is_clean() {
            self.non_finite.fetch_add(tally.non_finite, Ordering::Relaxed);
            self.outside.fetch_add(tally.outside, Ordering::Relaxed);
            self.saturated.fetch_add(tally.saturated, Ordering::Relaxed);
            self.vanished.fetch_add(tally.vanished, Ordering::Relaxed);
        }
    }

    /// What the film could not take as it was, over all that was ever added.
    #[must_use]
    pub fn tally(&self) -> Tally {
        Tally {
            non_finite: self.non_finite.load(Ordering::Relaxed),
            outside: self.outside.load(Ordering::Relaxed),
            saturated: self.saturated.load(Ordering::Relaxed),
            vanished: self.vanished.load(Ordering::Relaxed),
        }
    }

    /// Puts other counts in place of the film's.
    pub(super) fn set_tally(&self, tally: &Tally) {
        self.non_finite.store(tally.non_finite, Ordering::Relaxed);
        self.outside.store(tally.outside, Ordering::Relaxed);
        self.saturated.store(tally.saturated, Ordering::Relaxed);
        self.vanished.store(tally.vanished, Ordering::Relaxed);
    }

    /// Splats and samples that were left out altogether.
    #[must_use]
    pub fn rejected(&self) -> u64 {
        self.tally().rejected()
    }

    /// Calls `f` on every pixel's sums, in order.
    pub(super) fn for_each_pixel(&self, mut f: impl FnMut(&PixelSums)) {
        for stripe in &self.stripes {
            lock(stripe).iter().for_each(&mut f);
        }
    }

    /// Puts what `next` gives in place of every pixel's sums, in order, until it fails.
    pub(super) fn try_set_pixels<E>(&self, mut next: impl FnMut() -> Result<PixelSums, E>) -> Result<(), E> {
        for stripe in &self.stripes {
            for pixel in lock(stripe).iter_mut() {
                *pixel = next()?;
            }
        }
        Ok(())
    }
}

/// A poisoned lock means that another thread panicked while it held it; the sums of a pixel are then at worst one splat
/// short, and that thread's panic is what gets reported.
fn lock(stripe: &Mutex<Stripe>) -> MutexGuard<'_, Stripe> {
    stripe.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
#[path = "accumulate_tests.rs"]
mod tests;
