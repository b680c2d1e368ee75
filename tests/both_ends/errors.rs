//! The error that a render of both ends says it has.
//!
//! 200 small renders of a matt room: the interval of each render's error holds the error that it has in 90 to 99 % of them,
//! where 95 % are meant (a share of 200 runs near 0.95 has a standard error of 0.015). Films take turns, so that numbers of steps
//! that 16 does not divide, or fewer than 16, leave films unequal; pictures are unbiased all the same.

use super::agreement::{BlockMeans, Contender, Pictures};
use super::{assert_same_light, block_means};
use crate::support::scenes::inline;
use crate::support::verdict::say;
use chainlight::film::block_means_of;
use chainlight::plan::{Base, Plan, PlanOptions, Technique};
use chainlight::render::{Rendering, SplatRender, error_blocks};
use chainlight::scene::Scene;
use std::sync::{Arc, LazyLock};

const SIZE: u32 = 12;
const RUNS: u64 = 200;
const BDPT: Contender = Contender::of(Technique::Bdpt, Base::Pt);

/// A matt room with a lamp above the picture.
const ROOM: &str = r#"(version: 1, settings: (max_depth: 4),
    camera: Perspective(origin: (0, 1, 5), target: (0, 0.8, 0), fov: 40), film: (width: 12, height: 12),
    materials: {"white": Diffuse(reflectance: (0.7, 0.7, 0.7)), "red": Diffuse(reflectance: (0.6, 0.1, 0.1))},
    shapes: [
        (shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -6)), material: "white"),
        (shape: Quad(corner: (-3, 0, -3), edge_u: (6, 0, 0), edge_v: (0, 6, 0)), material: "red"),
        (shape: Box(min: (-0.8, 0, -0.5), max: (0.4, 1.2, 0.5)), material: "white"),
        (shape: Sphere(center: (1, 4.5, 1), radius: 0.5), material: "white", emission: (30, 25, 20)),
    ])"#;

static SCENE: LazyLock<Arc<Scene>> = LazyLock::new(|| inline(ROOM, SIZE));

/// Block means of the truth: renders of some hundred times the work of those that are judged, with other seeds, by path tracing,
/// whose error is known otherwise.
static TRUTH: LazyLock<BlockMeans> = LazyLock::new(|| {
    let pictures = Pictures {
        runs: 24,
        samples: 1000,
        first_seed: 1 << 40,
        blocks_per_side: SIZE,
    };
    block_means(
        &SCENE,
        Contender::of(Technique::Pt, Base::Pt),
        &PlanOptions::default(),
        pictures,
    )
});

fn true_means() -> Vec<f64> {
    let rows = &TRUTH.rows;
    let mean = |i: usize| rows.iter().map(|row| row[i]).sum::<f64>() / rows.len() as f64;
    (0..rows[0].len()).map(mean).collect()
}

/// The share of renders whose error lies in their interval, scaled by `width`, and that whose error is below the upper bound.
fn covered(steps: u64) -> [f64; 3] {
    let truth = true_means();
    let grid = error_blocks(&SCENE);
    let mut counts = [0_u32; 3];
    for seed in 0..RUNS {
        let plan = Plan::new(&SCENE, Technique::Bdpt, None);
        let mut render = SplatRender::new(Arc::clone(&SCENE), plan, seed, 1).expect("a small film");
        render.burst(steps, &|_| {});
        let means = block_means_of(render.picture().view(), &grid).expect("the same size");
        let mean = means.iter().sum::<f64>() / means.len() as f64;
        let squares: f64 = means.iter().zip(&truth).map(|(a, b)| (a - b) * (a - b)).sum();
        let error = (squares / means.len() as f64).sqrt() / mean;
        let stated = render.error().expect("light, and films");
        let [low, high] = stated.interval;
        counts[0] += u32::from((low..=high).contains(&error));
        counts[1] += u32::from(error <= stated.upper);
        // Half as much: a planted mistake.
        counts[2] += u32::from((0.5 * low..=0.5 * high).contains(&error));
    }
    counts.map(|count| f64::from(count) / RUNS as f64)
}

#[test]
fn intervals_hold_the_error_as_often_as_they_say() {
    for steps in [64, 17] {
        let [interval, upper, halved] = covered(steps);
        say(&format!(
            "{steps} steps: {:.1} % of errors in their interval, {:.1} % below their bound, {:.1} % in intervals halved",
            100.0 * interval,
            100.0 * upper,
            100.0 * halved
        ));
        assert!((0.90..=0.99).contains(&interval), "{steps}: {interval}");
        assert!(upper >= 0.90, "{steps}: {upper}");
        assert!(halved < 0.5, "{steps}: {halved}");
    }
}

#[test]
fn films_of_unequal_numbers_of_steps_make_unbiased_pictures() {
    const BLOCKS: u32 = 3;
    let counted = vec![true; (BLOCKS * BLOCKS) as usize];
    let of = |contender: Contender, samples, runs, first_seed| {
        let pictures = Pictures {
            runs,
            samples,
            first_seed,
            blocks_per_side: BLOCKS,
        };
        block_means(&SCENE, contender, &contender.options(), pictures)
    };
    let truth = of(Contender::of(Technique::Pt, Base::Pt), 400, 24, 1 << 41);
    let unequal = [1, 5, 17];
    let tests = unequal.len() * super::agreement::statistics(&counted);
    for steps in unequal {
        let means = of(BDPT, steps, 200, 1000 * steps);
        assert_same_light(&format!("{steps} steps"), &means, &truth, &counted, tests, 0.05);
    }
}
