//! `Discrete` against its weights: five tests of a million choices.

use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::sampling::discrete::Discrete;

const SAMPLES: usize = 1_000_000;
const FAMILY: Family = Family { tests: 5 };

/// How often each entry is chosen.
fn counts(case: usize, weights: &[f64]) -> Vec<u64> {
    let distribution = Discrete::new(weights.iter().copied());
    let mut stream = stream(100 + case);
    let mut counts = vec![0; weights.len()];
    for _ in 0..SAMPLES {
        let chosen = distribution.sample(stream.next_f64()).expect("something has weight");
        counts[chosen] += 1;
    }
    counts
}

/// The probabilities that the distribution itself states.
fn stated(weights: &[f64]) -> Vec<f64> {
    let distribution = Discrete::new(weights.iter().copied());
    (0..weights.len())
        .map(|i| f64::from(distribution.probability(i)))
        .collect()
}

#[test]
fn choices_follow_their_stated_probabilities() {
    let ten: Vec<f64> = (1..=10).map(f64::from).collect();
    let mut gaps = vec![0.0; 50];
    for i in (3..47).step_by(4) {
        gaps[i] = 1.0 + (i % 3) as f64;
    }
    let many: Vec<f64> = (0..100_000).map(|i| f64::from(1 + i % 7)).collect();
    let extreme = [1e-30, 1e-5, 1.0, 0.0, 1e-4, 1e-3, 1e-30];
    let huge = [3e300, 1e300, 2e300];
    // What each could have seen: many entries share the samples, so each is seen less well.
    let cases: [(&str, &[f64], f64); 5] = [
        ("ten", &ten, 0.008),
        ("gaps", &gaps, 0.008),
        ("a hundred thousand", &many, 0.07),
        ("from 1e-30 to 1", &extreme, 0.008),
        ("near the end of the range", &huge, 0.008),
    ];
    assert_eq!(cases.len(), FAMILY.tests);
    for (i, (name, weights, sees)) in cases.into_iter().enumerate() {
        let stated = stated(weights);
        let total: f64 = weights.iter().sum();
        for (p, weight) in stated.iter().zip(weights) {
            assert!(
                (p - weight / total).abs() <= 1e-7 * (weight / total) + 1e-45,
                "{name}: {p}"
            );
        }
        FAMILY.follows(name, &counts(i, weights), &stated, sees);
    }
    let mut off = ten.clone();
    off[9] *= 1.03;
    FAMILY.refuses("one entry of ten off by 3 %", &counts(0, &ten), &stated(&off));
}

#[test]
fn one_entry_is_always_chosen() {
    for weight in [1e-300, 1.0, 1e300] {
        assert_eq!(counts(9, &[weight]), [SAMPLES as u64]);
        assert_eq!(stated(&[weight]), [1.0]);
    }
}

/// What is divided by must not be zero: a weight so small that its probability vanishes in `f32` is never chosen.
#[test]
fn what_is_chosen_has_a_probability() {
    let distribution = Discrete::new([1e-60, 1.0, 1e-60].into_iter());
    for u in [0.0, 0.5, 1.0 - f64::EPSILON] {
        let chosen = distribution.sample(u).expect("one has weight");
        assert!(distribution.probability(chosen) > 0.0, "{u} chooses {chosen}");
    }
}
