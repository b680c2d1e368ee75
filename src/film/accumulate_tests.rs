//! What the film's sums hold.

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
        let magnitude = power_of_two((bits % 80) as i32 - 60) as f32 * (1.0 + (bits >> 8 & 0xffff) as f32 / 65536.0);
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
