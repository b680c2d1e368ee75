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
        let too_large = || FilmError::TooLarge {
            width,
            height,
            bytes: Self::bytes(width, height),
        };
        let pixels = u32::try_from(u64::from(width) * u64::from(height)).map_err(|_| too_large())?;
        if pixels == 0 {
            return Err(FilmError::Empty { width, height });
        }
        let unit = Unit::at_least(max_radiance);
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
}

/// A poisoned lock means that another thread panicked while it held it; the sums of a pixel are then at worst one splat
/// short, and that thread's panic is what gets reported.
fn lock(stripe: &Mutex<Stripe>) -> MutexGuard<'_, Stripe> {
    stripe.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::fixed::power_of_two;
    use proptest::prelude::*;

    /// A fixed sequence of well-mixed numbers (SplitMix64).
    fn mixed(n: usize) -> impl Iterator<Item = u64> {
        (1..=n as u64).map(|i| {
            let z = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        })
    }

    /// Splats over 50 x 50 pixels (three stripes), of magnitudes 2⁻⁶⁰ to 2²⁰ and either sign.
    fn splats(n: usize) -> Vec<Splat> {
        let value = |bits: u64| {
            let magnitude =
                power_of_two((bits % 80) as i32 - 60) as f32 * (1.0 + (bits >> 8 & 0xffff) as f32 / 65536.0);
            if bits & 0x80 == 0 { magnitude } else { -magnitude }
        };
        mixed(n)
            .map(|z| Splat {
                pixel: (z % 2500) as u32,
                value: Rgb::new(value(z >> 13), value(z >> 23), value(z >> 33)),
            })
            .collect()
    }

    fn sums(film: &Film) -> Vec<PixelSums> {
        let mut all = Vec::new();
        film.for_each_pixel(|p| all.push(*p));
        all
    }

    fn film() -> Film {
        Film::new(50, 50, 1.0).expect("a small film")
    }

    fn one_pixel(values: &[f32]) -> Film {
        let film = Film::new(1, 1, 1.0).expect("a small film");
        film.add_samples(
            &values
                .iter()
                .map(|&v| Splat {
                    pixel: 0,
                    value: Rgb::splat(v),
                })
                .collect::<Vec<_>>(),
        );
        film
    }

    #[test]
    fn sums_do_not_depend_on_order_batches_or_threads() {
        let splats = splats(40_000);
        let straight = film();
        straight.add_samples(&splats);

        let mut shuffled = splats.clone();
        let mut keys: Vec<u64> = mixed(splats.len()).collect();
        keys.reverse();
        let mut order: Vec<usize> = (0..splats.len()).collect();
        order.sort_by_key(|&i| keys[i]);
        for (slot, &i) in shuffled.iter_mut().zip(&order) {
            *slot = splats[i];
        }
        let backward = film();
        for batch in shuffled.chunks(7) {
            backward.add_samples(batch);
        }
        assert_eq!(sums(&straight), sums(&backward));

        for threads in [2, 5] {
            let shared = film();
            std::thread::scope(|scope| {
                for part in 0..threads {
                    let (shared, shuffled) = (&shared, &shuffled);
                    scope.spawn(move || {
                        for batch in shuffled.chunks(61).skip(part).step_by(threads) {
                            shared.add_samples(batch);
                        }
                    });
                }
            });
            assert_eq!(sums(&straight), sums(&shared), "{threads} threads");
            assert_eq!(straight.tally(), shared.tally());
        }
    }

    #[test]
    fn samples_count_and_splats_do_not() {
        let film = film();
        let black = Splat {
            pixel: 2499,
            value: Rgb::BLACK,
        };
        film.add_samples(&[black, black]);
        film.add_splats(&[
            black,
            Splat {
                pixel: 2499,
                value: Rgb::ONE,
            },
        ]);
        let last = sums(&film)[2499];
        assert_eq!((last.samples, last.sum), (2, [1_i128 << 64; 3]));
    }

    #[test]
    fn non_finite_values_never_enter_and_are_counted() {
        let film = film();
        for (i, odd) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().enumerate() {
            let mut channels = [1.0; 3];
            channels[i] = odd;
            let tally = film.add_samples(&[Splat {
                pixel: 3,
                value: channels.into(),
            }]);
            assert_eq!((tally.non_finite, tally.rejected()), (1, 1));
        }
        assert_eq!(film.rejected(), 3);
        assert!(sums(&film).iter().all(|p| *p == PixelSums::default()));
    }

    #[test]
    fn pixels_beyond_the_film_are_refused_and_counted() {
        let film = film();
        let beyond = [2500, 3071, 3072, u32::MAX].map(|pixel| Splat { pixel, value: Rgb::ONE });
        assert_eq!(film.add_samples(&beyond).outside, 4);
        assert_eq!(
            film.tally(),
            Tally {
                outside: 4,
                ..Tally::default()
            }
        );
        assert!(sums(&film).iter().all(|p| *p == PixelSums::default()));
    }

    #[test]
    fn values_beyond_the_range_are_pinned_and_counted() {
        let film = one_pixel(&[1e13, -1e13, 1e12]);
        assert_eq!(
            film.tally(),
            Tally {
                saturated: 2,
                ..Tally::default()
            }
        );
        assert_eq!(sums(&film)[0].sum, [(1e12_f32 as i128) << 64; 3]);
    }

    #[test]
    fn values_below_the_resolution_vanish_and_are_counted() {
        let film = one_pixel(&[power_of_two(-66) as f32, power_of_two(-65) as f32, 0.0]);
        assert_eq!(
            film.tally(),
            Tally {
                vanished: 1,
                ..Tally::default()
            }
        );
        assert_eq!(sums(&film)[0].sum, [1; 3]);
    }

    #[test]
    fn impossible_sizes_are_refused_in_words() {
        assert!(matches!(Film::new(0, 5, 1.0), Err(FilmError::Empty { .. })));
        let error = Film::new(u32::MAX, u32::MAX, 1.0).expect_err("too large");
        assert!(error.to_string().contains("4294967295 x 4294967295"), "{error}");
        assert_eq!(Film::bytes(1920, 1080), 1920 * 1080 * 128);
    }

    #[test]
    fn a_thread_that_panicked_over_the_film_does_not_stop_the_others() {
        let film = film();
        // Resumed, not raised: it unwinds without a word on the terminal.
        let unwind = |_: &PixelSums| std::panic::resume_unwind(Box::new("on purpose"));
        let panicked = std::thread::scope(|s| s.spawn(|| film.for_each_pixel(unwind)).join().is_err());
        assert!(panicked && film.stripes[0].is_poisoned());
        assert_eq!(
            film.add_samples(&[Splat {
                pixel: 0,
                value: Rgb::ONE
            }]),
            Tally::default()
        );
        assert_eq!(sums(&film)[0].samples, 1);
    }

    proptest! {
        /// Every value here is a whole number of steps of 2⁻⁶⁰ units, so plain integers hold the exact sums.
        #[test]
        fn sums_are_exact(values in prop::collection::vec(-16_777_216_i64..=16_777_216, 1..200), shift in 0_u32..36) {
            let step = power_of_two(shift as i32 - 60);
            let film = one_pixel(&values.iter().map(|&v| (v as f64 * step) as f32).collect::<Vec<_>>());
            let exact: i128 = values.iter().map(|&v| i128::from(v) << (shift + 4)).sum();
            let pixel = sums(&film)[0];
            prop_assert_eq!(pixel.sum, [exact; 3]);
            // Squares in steps of 2⁻¹²⁰, rounded to 2⁻¹⁰⁴ where they are finer.
            if shift >= 8 {
                let squares: u128 = values.iter().map(|&v| u128::from((v * v) as u64)).sum();
                let limbs = pixel.squares[0].limbs();
                let low = u128::from(limbs[0]) | u128::from(limbs[1]) << 64;
                prop_assert_eq!((low, limbs[2]), (squares << (2 * shift - 16), 0));
            }
        }
    }
}
