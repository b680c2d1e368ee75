//! All techniques make the same picture.
//!
//! Shipped scenes small, in independent runs of every technique, pairwise, block by block: the cases of a scene are one family
//! with a significance of 1 %. The example `agreement` does the same for all scenes at length. With a scene's own filter, light
//! that reaches the film beyond its edges counts; with the box filter none does. Light tracing is compared in those blocks alone
//! of which it finds all light ([`super::agreement::seen_by_light_tracing`]). Every comparison states the smallest bias of the
//! mean that it sees, and refuses one of twice its limit.

use super::agreement::{BlockMeans, Contender, Pictures, seen_by_light_tracing, statistics};
use super::{assert_same_light, block_means};
use crate::support::reference::{SIZE, disagreements, over_runs, reference};
use crate::support::scenes::{box_filtered, inline, shipped};
use crate::support::verdict::say;
use chainlight::plan::Technique;
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use std::sync::Arc;

pub(super) const PIXELS: u32 = SIZE as u32;
const BLOCKS_PER_SIDE: u32 = 3;
const RUNS: u64 = 20;

/// What is compared of a scene.
struct Case {
    name: &'static str,
    scene: Arc<Scene>,
    /// Samples per pixel of the slowest technique.
    samples: u64,
    /// The techniques, each with its part in the bias of the mean that a comparison sees: the sum over the two.
    contenders: Vec<(Contender, f64)>,
}

/// All techniques, with what is seen of each.
fn all(sees: [f64; 6]) -> Vec<(Contender, f64)> {
    Contender::ALL.into_iter().zip(sees).collect()
}

impl Case {
    fn means(&self, contender: Contender) -> BlockMeans {
        let pictures = Pictures {
            runs: RUNS,
            samples: self.samples * contender.samples(),
            first_seed: 77_000,
            blocks_per_side: BLOCKS_PER_SIDE,
        };
        block_means(&self.scene, contender, &contender.options(), pictures)
    }

    /// Every technique against every other.
    fn agree(&self) {
        let seen = seen_by_light_tracing(&self.scene, BLOCKS_PER_SIDE).expect("a plan");
        let all = vec![true; seen.len()];
        let means: Vec<BlockMeans> = self.contenders.iter().map(|(c, _)| self.means(*c)).collect();
        let pairs = (0..means.len()).flat_map(|i| (i + 1..means.len()).map(move |j| [i, j]));
        let counted = |pair: [usize; 2]| {
            let lights = pair.map(|k| self.contenders[k].0.technique == Technique::Lt);
            if lights.contains(&true) { &seen } else { &all }
        };
        let pairs: Vec<_> = pairs.filter(|&pair| counted(pair).contains(&true)).collect();
        let tests = pairs.iter().map(|&pair| statistics(counted(pair))).sum();
        for pair in pairs {
            let [(a, sees_a), (b, sees_b)] = pair.map(|k| self.contenders[k]);
            let case = format!("{}, {a} and {b}", self.name);
            let [of_a, of_b] = pair.map(|k| &means[k]);
            assert_same_light(&case, of_a, of_b, counted(pair), tests, sees_a + sees_b);
        }
    }
}

#[track_caller]
pub(super) fn agree(name: &'static str, scene: Arc<Scene>, samples: u64, contenders: Vec<(Contender, f64)>) {
    let case = Case {
        name,
        scene,
        samples,
        contenders,
    };
    case.agree();
}

#[test]
fn techniques_agree_on_the_cornell_box() {
    let scene = shipped("cornell-box.ron", PIXELS);
    agree("cornell-box", scene, 16, all([0.04, 0.01, 0.01, 0.10, 0.01, 0.10]));
}

#[test]
fn techniques_agree_on_the_cornell_box_with_the_box_filter() {
    let scene = box_filtered("cornell-box.ron", PIXELS, 1.0);
    agree(
        "cornell-box, box filter",
        scene,
        16,
        all([0.03, 0.01, 0.01, 0.10, 0.01, 0.10]),
    );
}

#[test]
fn techniques_agree_on_mirrors_and_glass() {
    let scene = shipped("cornell-glass.ron", PIXELS);
    agree("cornell-glass", scene, 16, all([0.06, 0.01, 0.03, 0.15, 0.03, 0.16]));
}

#[test]
fn techniques_agree_on_rough_metal_and_glass_and_smooth_meshes() {
    let scene = shipped("cornell-glossy.ron", PIXELS);
    agree("cornell-glossy", scene, 16, all([0.06, 0.01, 0.02, 0.15, 0.02, 0.14]));
}

/// Light paths from the sun hardly find the small part of the world that is in the picture: without light tracing.
#[test]
fn techniques_agree_under_an_open_sky_and_parallel_rays() {
    let scene = shipped("island.ron", PIXELS);
    let mut contenders = all([0.05, 0.0, 0.05, 0.10, 0.10, 0.10]);
    contenders.remove(1);
    agree("island", scene, 16, contenders);
}

/// A heap of boxes that fills the picture, seen by a camera under some light.
fn heap(camera: &str, lights: &str, lamp: &str) -> Arc<Scene> {
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: 6), camera: {camera},
            film: (width: 24, height: 24, filter: Gaussian(radius: 1.5, sigma: 0.5)),
            materials: {{"white": Diffuse(reflectance: (0.8, 0.7, 0.6)), "gold": RoughConductor(metal: "Au", alpha: 0.3)}},
            lights: [{lights}],
            shapes: [
                (shape: Quad(corner: (-2, 0, 2), edge_u: (4, 0, 0), edge_v: (0, 0, -4)), material: "white"),
                (shape: Box(min: (-0.9, 0, -0.6), max: (0.1, 1.1, 0.4)), material: "gold"),
                (shape: Box(min: (0.3, 0, -0.2), max: (1.0, 0.6, 0.5)), material: "white"),
                {lamp}
            ])"#
        ),
        PIXELS,
    )
}

/// What light tracing sees of light from infinity.
#[test]
fn light_from_infinity_looks_the_same_from_both_ends() {
    let scene = heap(
        "Orthographic(origin: (2, 4, 4), target: (0, 0.3, 0), height: 1.8)",
        "Environment(radiance: (0.3, 0.4, 0.6)), Directional(direction: (-0.7, -1, 0.2), irradiance: (3, 2.5, 2))",
        "",
    );
    agree("an open sky", scene, 16, all([0.03, 0.05, 0.03, 0.10, 0.05, 0.10]));
}

/// Where a light path is seen depends on the point of the lens.
#[test]
fn techniques_agree_behind_a_lens() {
    let scene = heap(
        "ThinLens(origin: (2, 4, 4), target: (0, 0.3, 0), fov: 18, aperture_radius: 0.3, focus_distance: 5)",
        "Spot(position: (2, 3, 1), target: (0, 0.5, 0), intensity: (9, 8, 7), cutoff: 30, beam: 20)",
        r#"(shape: Quad(corner: (-2, 2, -1), edge_u: (0.8, 0, 0.3), edge_v: (0, 0.4, 0.9)), material: "white",
            emission: (8, 9, 10)),"#,
    );
    agree("a lens", scene, 16, all([0.03, 0.05, 0.03, 0.10, 0.05, 0.10]));
}

/// Per channel the mean over the counted blocks, then those blocks: of means of blocks, number block · 3 + channel.
fn in_order(row: &[f64], counted: &[bool]) -> Vec<f64> {
    let of = |channel: usize| {
        let blocks: Vec<f64> = (0..counted.len())
            .filter(|&block| counted[block])
            .map(|block| row[3 * block + channel])
            .collect();
        let mean = blocks.iter().sum::<f64>() / blocks.len() as f64;
        std::iter::once(mean).chain(blocks)
    };
    (0..3).flat_map(of).collect()
}

/// The reference's estimates of the same: its statistics are those of all blocks.
fn reference_in_order(scene: &str, counted: &[bool]) -> Vec<Estimate> {
    let all = reference(scene);
    let per_channel = all.len() / 3;
    let of = |channel: usize| {
        let blocks = &all[channel * per_channel + 1..(channel + 1) * per_channel];
        let blocks: Vec<Estimate> = blocks
            .iter()
            .zip(counted)
            .filter(|(_, c)| **c)
            .map(|(e, _)| *e)
            .collect();
        let count = blocks.len() as f64;
        let mean = Estimate {
            mean: blocks.iter().map(|e| e.mean).sum::<f64>() / count,
            error: blocks.iter().map(|e| e.error * e.error).sum::<f64>().sqrt() / count,
        };
        std::iter::once(mean).chain(blocks)
    };
    (0..3).flat_map(of).collect()
}

/// Holds that techniques with both ends make the pictures of another renderer, as path tracing does
/// ([`crate::rendering`]).
#[test]
fn both_ends_are_right_to_the_noise() {
    const RUNS: u64 = 40;
    // The references' own blocks.
    const BLOCKS_PER_SIDE: u32 = 6;
    let [_, lt, bdpt, ..] = Contender::ALL;
    let cases = [
        ("cornell-glass.ron", lt, 0.02),
        ("cornell-glass.ron", bdpt, 0.02),
        ("cornell-glossy.ron", lt, 0.02),
        ("cornell-glossy.ron", bdpt, 0.02),
        ("depth-of-field.ron", bdpt, 0.05),
        ("island.ron", bdpt, 0.03),
    ];
    for (name, contender, sees) in cases {
        let scene = box_filtered(name, PIXELS, 1.0);
        let counted = if contender == lt {
            seen_by_light_tracing(&scene, BLOCKS_PER_SIDE).expect("a plan")
        } else {
            vec![true; (BLOCKS_PER_SIDE * BLOCKS_PER_SIDE) as usize]
        };
        assert!(counted.contains(&true), "{name}");
        let pictures = Pictures {
            runs: RUNS,
            samples: 24 * contender.samples(),
            first_seed: 5_000,
            blocks_per_side: BLOCKS_PER_SIDE,
        };
        let means = block_means(&scene, contender, &contender.options(), pictures);
        let rows: Vec<Vec<f64>> = means.rows.iter().map(|row| in_order(row, &counted)).collect();
        let (runs, truth) = (over_runs(&rows), reference_in_order(name, &counted));
        let (failed, visible) = disagreements(RUNS, &runs, &truth);
        let case = format!("{name}, {contender} against the reference");
        say(&format!(
            "{case}: {failed} differ, sees {:.2} % of the mean",
            100.0 * visible
        ));
        assert_eq!(failed, 0, "{case}");
        assert!(visible < sees, "{case}: would not see {sees}");
        let factor = 1.0 + 2.0 * sees;
        let brighter = runs.iter().map(|e| Estimate {
            mean: factor * e.mean,
            error: factor * e.error,
        });
        let noticed = disagreements(RUNS, &brighter.collect::<Vec<_>>(), &truth).0;
        assert!(noticed > 0, "{case}: light times {factor} goes unnoticed");
    }
}
