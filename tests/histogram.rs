//! The machinery of chains apart from light: the example that brings states, systems and mutations of its own.

#[path = "../examples/histogram/mod.rs"]
mod example;

use crate::support::verdict::{ALPHA, Family, say};
use chainlight::stats::z_test::Estimate;
use example::{STEPS, Sampled, distance, interval, target, three_states};

const SEED: u64 = 1;
const RUNS: Family = Family { tests: 3 };

/// The last histogram: after a million steps of all chains.
fn last(histograms: Vec<Sampled>) -> Sampled {
    let last = histograms
        .into_iter()
        .next_back()
        .expect("a histogram for each number of steps");
    assert_eq!(last.total(), 1_000_000);
    last
}

/// The same visits, held against a wrong target.
fn against(sampled: &Sampled, expected: Vec<f64>) -> Sampled {
    Sampled {
        visits: sampled.visits.clone(),
        expected,
    }
}

/// The target's bins with those from `first` on scaled.
fn scaled_from(first: usize, factor: f64) -> Vec<f64> {
    let mut bins = target::bins(interval::BINS);
    bins[first..].iter_mut().for_each(|p| *p *= factor);
    let total: f64 = bins.iter().sum();
    bins.iter().map(|p| p / total).collect()
}

#[test]
fn every_mutation_samples_the_target_as_well_as_its_effective_samples_allow() {
    for (name, mutations) in interval::runs() {
        let sampled = last(interval::sample(mutations, SEED, STEPS).expect("the example's plan"));
        let (distance, bound) = (
            sampled.distance(),
            sampled.bound(RUNS.significance()).expect("shares vary"),
        );
        let (independent, worth) = (sampled.expected_distance(), sampled.worth().expect("shares vary").total);
        say(&format!(
            "{name}: distance {distance:.5}, at most {bound:.5}; worth {worth:.0} samples; of independent ones {independent:.5}"
        ));
        // Chains are never as good as independent samples, nor near nothing.
        assert!(distance > independent && (1e3..1e6).contains(&worth), "{name}");
        assert!(distance < bound, "{name}: {distance} is not below {bound}");
        // The step of another height, and for chains that mix slowly nothing but the floor.
        let wrong = if name == "near" {
            vec![1.0 / interval::BINS as f64; interval::BINS]
        } else {
            scaled_from(80, 1.25)
        };
        let wrong = against(&sampled, wrong);
        let bound = wrong.bound(RUNS.significance()).expect("shares vary");
        assert!(
            wrong.distance() > bound,
            "{name}: a wrong target goes unnoticed: {}",
            wrong.distance()
        );
    }
}

#[test]
fn groups_normalizations_estimate_the_integral() {
    let (_, mutations) = &interval::runs()[0];
    let run = interval::start(mutations, SEED).expect("the example's plan");
    let of_groups: Vec<f64> = run.starts().iter().map(|start| start.normalization.b).collect();
    let (b, integral) = (Estimate::of(&of_groups), target::integral(0.0, 1.0));
    let one = Family { tests: 1 };
    one.is("b", b, integral, 0.0, 0.06);
    one.is_not("b of a step half as high", b, integral - 0.08, 0.0);
}

/// Each chain is one draw: 100 of them, after the first steps, whose states are not stationary yet.
#[test]
fn a_chain_of_three_states_visits_them_as_its_matrix_says() {
    const FIRST: u64 = 100;
    let histograms = three_states::simulate(SEED, [FIRST, STEPS[1]]).expect("the example's plan");
    let states = Family { tests: 3 };
    let share = |state: usize| -> Vec<f64> {
        let chains = histograms[0].visits.iter().zip(&histograms[1].visits);
        chains
            .map(|(first, all)| (all[state] - first[state]) as f64 / (STEPS[1] - FIRST) as f64)
            .collect()
    };
    let expected = three_states::stationary();
    let balance = |state: usize| {
        (0..3)
            .map(|from| expected[from] * three_states::MATRIX[from][state])
            .sum::<f64>()
    };
    for (state, &probability) in expected.iter().enumerate() {
        assert!((balance(state) - probability).abs() < 1e-14, "stationary");
        let occupancy = Estimate::of(&share(state));
        states.is(&format!("state {state}"), occupancy, probability, 0.0, 0.01);
        states.is_not(
            &format!("state {state}, a hundredth off"),
            occupancy,
            1.02 * probability,
            0.0,
        );
    }
    let sampled = last(histograms);
    let bound = sampled.bound(ALPHA).expect("shares vary");
    assert!(
        sampled.distance() < bound && bound < 0.01,
        "{} {bound}",
        sampled.distance()
    );
}

/// Every proposal of the three states is taken, whatever the stationary distribution.
#[test]
fn what_is_as_likely_both_ways_under_a_constant_target_is_always_taken() {
    let mut run = three_states::start(SEED).expect("the example's plan");
    run.burst(50, &|_| ());
    let statistics = run.statistics();
    let taken: Vec<_> = (0..2).map(|mutation| statistics.of_length(mutation, 0)).collect();
    assert_eq!(
        (taken[0].proposed, taken[1].proposed, taken[1].accepted),
        (0, 5000, 5000)
    );
}

#[test]
fn integrals_are_those_of_the_function() {
    let cells = 200_000;
    for [a, b] in [[0.0, 1.0], [0.1, 0.25], [0.75, 0.85], [0.59, 0.6]] {
        let width = (b - a) / f64::from(cells);
        let sum: f64 = (0..cells)
            .map(|i| target::value(a + (f64::from(i) + 0.5) * width) * width)
            .sum();
        assert!((sum / target::integral(a, b) - 1.0).abs() < 1e-5, "{a} {b}");
    }
    assert!((target::bins(interval::BINS).iter().sum::<f64>() - 1.0).abs() < 1e-12);
}

/// Against every outcome of three draws of three classes, summed.
#[test]
fn expected_distances_are_exact() {
    let p = [0.5, 0.3, 0.2];
    let mut mean = 0.0;
    for draws in 0..27 {
        let drawn = [draws % 3, draws / 3 % 3, draws / 9];
        let shares = [0, 1, 2].map(|class| drawn.iter().filter(|&&c| c == class).count() as f64 / 3.0);
        let probability: f64 = drawn.iter().map(|&class| p[class]).product();
        mean += probability * distance::total_variation(&shares, &p);
    }
    assert!((distance::expected(&p, 3) - mean).abs() < 1e-12, "{mean}");
}

#[test]
fn charts_are_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let (name, mutations) = interval::runs().into_iter().next_back().expect("three runs");
    let path = |file| folder.path().join(file);
    let histograms = interval::sample(mutations, SEED, [2, 4]).expect("the example's plan");
    example::chart::densities(&path("a.svg"), name, &histograms).expect("a chart");
    let histograms = three_states::simulate(SEED, [2, 4]).expect("the example's plan");
    example::chart::occupancy(&path("b.svg"), &histograms).expect("a chart");
    for (file, bars) in [("a.svg", 200), ("b.svg", 6)] {
        let text = std::fs::read_to_string(path(file)).expect("a chart");
        assert!(
            text.matches("<rect").count() >= bars && text.contains("steps: distance"),
            "{file}"
        );
    }
}
