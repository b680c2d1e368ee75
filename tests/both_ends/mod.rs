//! Techniques that start paths at both ends: light tracing, bidirectional path tracing, and chains over it.
//!
//! The runs and comparisons are those of the example `agreement`, which holds all techniques against each other on every shipped
//! scene at length.

mod bytes;
mod densities;
mod strategies;
mod weights;

#[path = "../../examples/agreement/mod.rs"]
mod agreement;

use crate::support::verdict::say;
use agreement::{BlockMeans, Contender, Pictures, compare};
use chainlight::plan::PlanOptions;
use chainlight::scene::Scene;
use std::sync::Arc;

/// Runs of a technique that cannot fail on a test's scene.
#[track_caller]
fn block_means(scene: &Arc<Scene>, contender: Contender, options: &PlanOptions, pictures: Pictures) -> BlockMeans {
    agreement::runs(scene, contender.technique, options, pictures).expect("a small film and a plan")
}

/// Holds that two sets of runs show the same light in the counted blocks, as part of a family of `tests` tests, by a comparison
/// that sees the mean of those blocks off by the fraction `sees`, and that it refuses light that is off by twice as much.
#[track_caller]
fn assert_same_light(case: &str, a: &BlockMeans, b: &BlockMeans, counted: &[bool], tests: usize, sees: f64) {
    let verdict = compare(a, b, counted, tests);
    say(&format!(
        "{case}: {} of {} differ, largest |t| {:.2}, sees {:.2} % of the mean",
        verdict.failures,
        verdict.statistics,
        verdict.largest,
        100.0 * verdict.visible
    ));
    assert_eq!(verdict.failures, 0, "{case}: {verdict:?}");
    assert!(verdict.visible < sees, "{case}: would not see {sees}, {verdict:?}");
    for factor in [1.0 + 2.0 * sees, 1.0 - 2.0 * sees] {
        let planted = compare(&a.scaled(factor), b, counted, tests);
        assert!(planted.failures > 0, "{case}: light times {factor} goes unnoticed");
    }
}
