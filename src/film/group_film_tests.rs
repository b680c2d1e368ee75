//! What a group's sums hold.

use super::*;
use crate::color::Rgb;
use proptest::prelude::*;

fn film() -> GroupFilm {
    GroupFilm::new(5, 4).expect("a small film")
}

fn splat(pixel: u32, value: f32) -> Splat {
    Splat {
        pixel,
        value: Rgb::splat(value),
    }
}

/// The sum of one pixel that was given these values.
fn one_pixel(values: &[f32]) -> GroupFilm {
    let mut film = GroupFilm::new(1, 1).expect("one pixel");
    film.add(&values.iter().map(|&v| splat(0, v)).collect::<Vec<_>>());
    film
}

/// A film whose one pixel stands this many steps from zero.
fn standing_at(steps: i64) -> GroupFilm {
    GroupFilm {
        sums: vec![[steps; 3]],
        ..one_pixel(&[])
    }
}

/// A value in steps, by the library's own rounding.
fn steps_slowly(v: f32) -> i128 {
    (f64::from(v) / STEP).round_ties_even() as i128
}

#[test]
fn values_are_rounded_to_the_nearest_step_and_ties_to_even_over_every_exponent() {
    let lows = [0_u32, 1, 0x5a5a, 0x8000, 0xffff];
    let all = (0..=0xffff_u32).flat_map(|high| lows.map(|low| f32::from_bits(high << 16 | low)));
    for v in all.filter(|v| v.abs() <= LIMIT) {
        assert_eq!(wide_steps(v), steps_slowly(v), "{v:e}");
    }
    for (in_steps, rounded) in [
        (0.5, 0),
        (0.500_000_1, 1),
        (1.5, 2),
        (2.5, 2),
        (-0.5, 0),
        (-1.5, -2),
        (3.5, 4),
    ] {
        assert_eq!(steps((in_steps * STEP) as f32), rounded, "{in_steps}");
    }
}

#[test]
fn resolution_and_limits_are_those_documented() {
    let limit = 1_125_899_906_842_624.0;
    assert_eq!((STEP, LIMIT), (2.0_f64.recip() / (1_u64 << 39) as f64, limit));
    let exact = [
        1.0,
        0.1,
        1e-5,
        -3.25e-5,
        7.629_395e-6,
        1_048_576.0,
        999_999.9,
        1_048_576.1,
        -3e7,
        9e14,
        LIMIT,
    ];
    for v in exact {
        let film = one_pixel(&[v]);
        assert_eq!(
            (film.sum(0), film.tally()),
            ([f64::from(v); 3], Tally::default()),
            "{v}"
        );
    }
    let beyond = one_pixel(&[1.0e17, f32::MAX, LIMIT.next_up()]);
    assert_eq!(beyond.sum(0), [3.0 * f64::from(LIMIT); 3]);
    assert_eq!(beyond.tally().saturated, 3);
    assert_eq!(one_pixel(&[-1.0e17]).sum(0), [-f64::from(LIMIT); 3]);
    let tiny = one_pixel(&[0.5 * STEP as f32, -1e-30, 0.0, -0.0, STEP as f32]);
    assert_eq!((tiny.sum(0), tiny.tally().vanished), ([STEP; 3], 2));
}

#[test]
fn what_is_no_number_and_what_is_outside_is_counted_and_left_out() {
    let mut film = film();
    for (channel, odd) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().enumerate() {
        let mut value = [1.0; 3];
        value[channel] = odd;
        let splat = Splat {
            pixel: 3,
            value: value.into(),
        };
        assert_eq!(film.add(&[splat]).non_finite, 1);
    }
    assert_eq!(film.add(&[20, 21, u32::MAX].map(|pixel| splat(pixel, 1.0))).outside, 3);
    assert_eq!((film.tally().rejected(), film.tally().saturated), (6, 0));
    assert!(film.pixels().all(|pixel| film.total(pixel) == [0; 3]));
    assert_eq!(film.sum(20), [0.0; 3]);
}

#[test]
fn ten_million_small_splats_sum_without_drift() {
    let mut film = GroupFilm::new(1, 1).expect("one pixel");
    let batch = vec![splat(0, 1e-3); 100_000];
    for _ in 0..100 {
        film.add(&batch);
    }
    // 1e-3 as an f32 is a whole number of steps.
    assert_eq!(film.sum(0), [f64::from(1e-3_f32) * 1e7; 3]);
}

#[test]
fn sums_spill_beyond_their_range_and_not_before() {
    let top = SPILL_ABOVE as i64;
    for sign in [1, -1] {
        let mut film = standing_at(sign * (top - 1));
        let step = splat(0, sign as f32 * STEP as f32);
        film.add(&[step]);
        assert!(film.spilled.is_empty());
        film.add(&[step]);
        assert_eq!((film.sums[0], film.spilled.len()), ([0; 3], 1));
        assert_eq!(film.total(0), [i128::from(sign * (top + 1)); 3]);
        film.add(&[splat(0, -sign as f32 * 1e6)]);
        assert_eq!(
            film.total(0),
            [i128::from(sign) * (i128::from(top + 1) - steps_slowly(1e6)); 3]
        );
    }
}

#[test]
fn the_largest_values_never_overflow() {
    let mut film = GroupFilm::new(1, 1).expect("one pixel");
    let mut exact = 0;
    for round in 0..100 {
        let value = if round < 70 { f32::MAX } else { f32::MIN };
        film.add(&vec![splat(0, value); 1000]);
        exact += if round < 70 { 1000 << 90 } else { -1000 << 90 };
        assert_eq!(film.total(0), [exact; 3]);
    }
    assert_eq!(film.sum(0), [40_000.0 * f64::from(LIMIT); 3]);
}

#[test]
fn films_of_extreme_sums_merge_exactly() {
    let top = SPILL_ABOVE as i64;
    for (a, b) in [(top, top), (-top, -top), (top, -top), (top, 1), (-top, -1), (3, 4)] {
        let mut film = standing_at(a);
        film.merge(&standing_at(b)).expect("one size");
        let exact = i128::from(a) + i128::from(b);
        assert_eq!(film.total(0), [exact; 3]);
        let copy = film.clone();
        for doublings in 1..40 {
            let twice = film.clone();
            film.merge(&twice).expect("one size");
            assert_eq!(film.total(0), [exact << doublings; 3]);
            assert!(film.sums[0].iter().all(|s| s.unsigned_abs() <= SPILL_ABOVE));
        }
        assert_eq!(film == copy, exact == 0);
    }
}

#[test]
fn merging_counts_what_both_counted_and_refuses_other_sizes() {
    let (mut a, mut b) = (film(), film());
    a.add(&[splat(0, 1e19), splat(99, 1.0)]);
    b.add(&[splat(0, f32::NAN), splat(0, 1e-20), splat(0, 1e19)]);
    a.merge(&b).expect("one size");
    let counted = Tally {
        non_finite: 1,
        outside: 1,
        saturated: 2,
        vanished: 1,
    };
    assert_eq!(a.tally(), counted);
    let turned = GroupFilm::new(4, 5).expect("a small film");
    let before = a.clone();
    let error = a.merge(&turned).expect_err("another size");
    assert!(error.to_string().contains("5 x 4 pixels and 4 x 5"), "{error}");
    assert_eq!(a, before);
}

#[test]
fn impossible_sizes_are_refused_in_words() {
    assert!(matches!(GroupFilm::new(0, 5), Err(FilmError::Empty { .. })));
    let error = GroupFilm::new(u32::MAX, u32::MAX).expect_err("too large");
    assert!(error.to_string().contains("4294967295 x 4294967295"), "{error}");
    assert_eq!(GroupFilm::bytes(1920, 1080), 1920 * 1080 * 24);
}

#[test]
fn films_that_differ_anywhere_are_not_equal() {
    let film = film();
    let lit = |pixel, value| {
        let mut film = film.clone();
        film.add(&[splat(pixel, value)]);
        film
    };
    assert_eq!(lit(3, 1.0), lit(3, 1.0));
    for other in [film.clone(), lit(4, 1.0), lit(3, 1.000_001), lit(3, 1e9)] {
        assert_ne!(lit(3, 1.0), other);
    }
    assert_ne!(film, GroupFilm::new(4, 5).expect("a small film"));
}

/// Values of every size, of either sign, and some beyond the limits.
fn value() -> impl Strategy<Value = f32> {
    prop_oneof![
        8 => -4.0_f32..4.0,
        2 => -2e6_f32..2e6,
        2 => any::<f32>(),
        1 => Just(f32::MAX),
    ]
}

fn splats() -> impl Strategy<Value = Vec<Splat>> {
    let one = (0_u32..22, value(), value(), value());
    let splat = one.prop_map(|(pixel, r, g, b)| Splat {
        pixel,
        value: Rgb::new(r, g, b),
    });
    prop::collection::vec(splat, 0..300)
}

proptest! {
    #[test]
    fn order_does_not_show(
        (straight, shuffled) in splats().prop_flat_map(|s| (Just(s.clone()), Just(s).prop_shuffle())),
        batch in 1_usize..50,
    ) {
        let (mut a, mut b) = (film(), film());
        let tally = a.add(&straight);
        for part in shuffled.chunks(batch) {
            b.add(part);
        }
        prop_assert_eq!(&a, &b);
        prop_assert_eq!(tally, b.tally());
        // Nor does the way in which parts of it are merged.
        let mut whole = film();
        for part in shuffled.chunks(batch) {
            let mut film = film();
            film.add(part);
            whole.merge(&film).expect("one size");
        }
        prop_assert_eq!(a, whole);
    }

    #[test]
    fn sums_are_exact(splats in splats(), start in prop::sample::select(vec![0, SPILL_ABOVE as i64, -(SPILL_ABOVE as i64)])) {
        let mut film = film();
        film.sums.fill([start; 3]);
        film.add(&splats);
        let mut exact = [[i128::from(start); 3]; 20];
        for splat in splats.iter().filter(|s| s.pixel < 20 && s.value.is_finite()) {
            for (sum, v) in exact[splat.pixel as usize].iter_mut().zip(splat.value.to_array()) {
                *sum += steps_slowly(v.clamp(-LIMIT, LIMIT));
            }
        }
        for (pixel, exact) in (0..).zip(exact) {
            prop_assert_eq!(film.total(pixel), exact);
            prop_assert_eq!(film.sum(pixel), exact.map(|t| t as f64 * STEP));
        }
    }
}
