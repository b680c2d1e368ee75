//! Stratified resampling: how often each entry is copied, and how that scatters.

use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::chain::resample;
use chainlight::stats::z_test::Estimate;

const REPETITIONS: usize = 100_000;
const WEIGHTS: [f64; 12] = [0.3, 0.0, 7.1, 0.05, 1.0, 2.2, f64::NAN, 0.7, 0.013, 3.3, -1.0, 0.9];
const COUNT: usize = 16;
/// Nine entries have weight; one test of the scatter.
const FAMILY: Family = Family { tests: 9 + 1 };

/// How many copies of each entry were drawn, in every repetition.
fn copies(weights: &[f64], case: usize) -> Vec<Vec<f64>> {
    let mut stream = stream(400 + case);
    let mut copies = vec![Vec::with_capacity(REPETITIONS); weights.len()];
    for _ in 0..REPETITIONS {
        let chosen = resample(weights, COUNT, || stream.next_f64()).expect("some have weight");
        for (i, copies) in copies.iter_mut().enumerate() {
            copies.push(chosen.iter().filter(|&&c| c as usize == i).count() as f64);
        }
    }
    copies
}

#[test]
fn entries_are_copied_in_proportion_to_their_weights() {
    let total: f64 = WEIGHTS.iter().filter(|&&w| w > 0.0).sum();
    let copies = copies(&WEIGHTS, 0);
    for (weight, copies) in WEIGHTS.iter().zip(&copies) {
        let mean = Estimate::of(copies);
        if *weight > 0.0 {
            let expected = COUNT as f64 * weight / total;
            FAMILY.is(&format!("copies at weight {weight}"), mean, expected, 0.0, 0.15);
        } else {
            assert_eq!((mean.mean, mean.error), (0.0, 0.0), "an entry of weight {weight}");
        }
    }
    // A twelfth less of the largest weight, and 3 % more of a middle one.
    let off = total - 0.6;
    FAMILY.is_not("largest", Estimate::of(&copies[2]), COUNT as f64 * 6.5 / off, 0.0);
    FAMILY.is_not(
        "middle",
        Estimate::of(&copies[5]),
        COUNT as f64 * 2.2 * 1.03 / total,
        0.0,
    );
}

/// Two equal entries in every stratum, and the number of odd ones drawn: its variance is that of independent draws, n/4.
/// One random number for all strata would choose the same one of each two, with a variance of n²/4.
#[test]
fn weights_in_step_with_the_strata_scatter_no_more_than_independent_draws() {
    let copies = copies(&[1.0; 2 * COUNT], 1);
    let squares: Vec<f64> = (0..REPETITIONS)
        .map(|r| copies.iter().skip(1).step_by(2).map(|c| c[r]).sum::<f64>())
        .map(|odd| (odd - 0.5 * COUNT as f64) * (odd - 0.5 * COUNT as f64))
        .collect();
    FAMILY.is(
        "variance of odd entries",
        Estimate::of(&squares),
        0.25 * COUNT as f64,
        0.0,
        0.03,
    );
}
