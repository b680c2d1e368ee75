//! `--target-error`: renders that stop on the upper bound of their error are as good as they say.

use super::inline;
use crate::support::verdict::say;
use chainlight::film::block_means_of;
use chainlight::plan::{ChainSettings, Plan, PlanOptions, Technique};
use chainlight::render::{Budget, Goal, Rendering, Stop, drive, error_blocks, start};
use chainlight::scene::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const SIZE: u32 = 12;
const RUNS: u64 = 120;

/// A matt room with a lamp above the picture: what chains see in it varies little, so that they get to their target soon.
const ROOM: &str = r#"(version: 1, settings: (max_depth: 4),
    camera: Perspective(origin: (0, 1, 5), target: (0, 0.8, 0), fov: 40), film: (width: 12, height: 12),
    materials: {"white": Diffuse(reflectance: (0.7, 0.7, 0.7)), "red": Diffuse(reflectance: (0.6, 0.1, 0.1))},
    shapes: [
        (shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -6)), material: "white"),
        (shape: Quad(corner: (-3, 0, -3), edge_u: (6, 0, 0), edge_v: (0, 6, 0)), material: "red"),
        (shape: Box(min: (-0.8, 0, -0.5), max: (0.4, 1.2, 0.5)), material: "white"),
        (shape: Sphere(center: (1, 4.5, 1), radius: 0.5), material: "white", emission: (30, 25, 20)),
    ])"#;

/// Block means of the truth: a render of 400 times the work of those that are judged, with other seeds.
fn truth(scene: &Arc<Scene>) -> Vec<f64> {
    let plan = Plan::new(scene, Technique::Pt, None);
    let mut render = chainlight::render::Render::new(Arc::clone(scene), plan, 1 << 40, 2).expect("a small film");
    render.burst(40_000, &|_| {});
    block_means_of(render.film.develop().view(), &error_blocks(scene)).expect("the same size")
}

/// The share of runs whose true error is below `target` when they stop, and the share whose error is below their own
/// estimate of it.
fn shares(technique: Technique, target: f64) -> (f64, f64) {
    let scene = inline(ROOM, SIZE);
    let truth = truth(&scene);
    let mean = truth.iter().sum::<f64>() / truth.len() as f64;
    let options = PlanOptions {
        chains: ChainSettings {
            chains: Some(64),
            ..ChainSettings::default()
        },
        ..PlanOptions::default()
    };
    let goal = Goal {
        budget: Budget::Steps(1 << 20),
        target_error: Some(target),
    };
    let (mut below_target, mut below_estimate) = (0, 0);
    for seed in 0..RUNS {
        let plan = Plan::with(&scene, technique, &options).expect("mutations that make a plan");
        let never = AtomicBool::new(false);
        let mut render = start(Arc::clone(&scene), plan, seed, 1, &never, &|_| {}).expect("a small film");
        let outcome = drive(&mut *render, goal, &never, &|_| {});
        assert_eq!(outcome.stop, Stop::TargetReached);
        let picture = render.picture();
        let means = block_means_of(picture.view(), &error_blocks(&scene)).expect("the same size");
        let squares: f64 = means.iter().zip(&truth).map(|(a, b)| (a - b) * (a - b)).sum();
        let error = (squares / means.len() as f64).sqrt() / mean;
        below_target += u32::from(error <= target);
        below_estimate += u32::from(error <= render.error().expect("light").rms);
    }
    (
        f64::from(below_target) / RUNS as f64,
        f64::from(below_estimate) / RUNS as f64,
    )
}

/// Of 120 runs, 108 or more are below the target. If only 85 % were, that many would be with a probability of 7 %. The
/// bound does it: the estimate itself is below the true error in many more.
fn holds(technique: Technique, target: f64) {
    let (target_share, estimate_share) = shares(technique, target);
    say(&format!(
        "{technique}: {:.1} % of runs below their target, {:.1} % below their own estimate",
        100.0 * target_share,
        100.0 * estimate_share
    ));
    assert!(target_share >= 0.9, "{technique}: {target_share}");
    assert!(
        estimate_share < 0.9,
        "{technique}: the estimate would do as well, {estimate_share}"
    );
}

#[test]
fn chains_that_aim_at_an_error_reach_it() {
    holds(Technique::Pssmlt, 0.12);
}

#[test]
fn paths_that_aim_at_an_error_reach_it() {
    holds(Technique::Pt, 0.12);
}
