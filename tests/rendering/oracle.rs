//! `pt` and `pt-reference` against references that another renderer made, and against each other.
//!
//! The references are Mitsuba 3 renders of the shipped scenes (`tests/oracle/make_references.py`) with the variance of
//! each pixel's mean. Here independent runs (seeds) give a mean and a standard error per statistic, so nothing is
//! assumed of the noise inside a run. Statistics are the image mean and the means of 6 x 6 blocks of 4 x 4 pixels, per
//! channel; a family of tests has significance 1 % in all, corrected by Šidák. Every test prints the smallest relative
//! bias of the image mean that it would see with 95 % power, must be able to see 2 %, and fails on a planted 2 %.

use super::{box_filtered, picture};
use chainlight::film::Picture;
use chainlight::plan::Technique;
use chainlight::scene::{ShapeKind, read_scene};
use chainlight::stats::normal::{sidak, upper_quantile};
use chainlight::stats::z_test::Estimate;
use exr::prelude::read_first_flat_layer_from_file;
use sha2::{Digest, Sha256};
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::path::Path;

const SIZE: usize = 24;
const BLOCK: usize = 4;
const RUNS: u64 = 48;
const STEPS: u64 = 160;
const ALPHA: f64 = 0.01;
const POWER: f64 = 0.95;

/// Statistics of a picture: per channel the image mean, then the block means.
fn statistics(rgb: impl Fn(usize) -> [f64; 3]) -> Vec<f64> {
    let blocks = SIZE / BLOCK;
    (0..3)
        .flat_map(|channel| {
            let mut sums = vec![0.0; blocks * blocks];
            for pixel in 0..SIZE * SIZE {
                let (x, y) = (pixel % SIZE, pixel / SIZE);
                sums[(y / BLOCK) * blocks + x / BLOCK] += rgb(pixel)[channel] / (BLOCK * BLOCK) as f64;
            }
            let mean = sums.iter().sum::<f64>() / sums.len() as f64;
            std::iter::once(mean).chain(sums)
        })
        .collect()
}

/// One estimate per statistic, from independent runs. `brightness` scales all lights: 1, or a planted bias.
fn estimates(scene: &str, technique: Technique, first_seed: u64, brightness: f32) -> Vec<Estimate> {
    let scene = box_filtered(scene, SIZE as u32, brightness);
    let runs: Vec<Vec<f64>> = (0..RUNS)
        .map(|run| {
            let picture: Picture = picture(&scene, technique, first_seed + run, STEPS);
            statistics(|pixel| picture.rgb[pixel].to_array().map(f64::from))
        })
        .collect();
    (0..runs[0].len())
        .map(|i| Estimate::of(&runs.iter().map(|run| run[i]).collect::<Vec<_>>()))
        .collect()
}

/// The reference's statistics: means from its picture, errors from its variances.
fn reference(scene: &str) -> Vec<Estimate> {
    let name = scene.replace(".ron", ".exr");
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/references")
        .join(name);
    let image = read_first_flat_layer_from_file(path).expect("the committed reference");
    let size = image.layer_data.size;
    assert_eq!((size.width(), size.height()), (SIZE, SIZE));
    let channel = |name: String| -> Vec<f64> {
        let found = image
            .layer_data
            .channel_data
            .list
            .iter()
            .find(|channel| channel.name == *name.as_str());
        found
            .expect("a channel of the reference")
            .sample_data
            .values_as_f32()
            .map(f64::from)
            .collect()
    };
    let [rgb, variance] = ["", "variance."].map(|layer| ["R", "G", "B"].map(|c| channel(format!("{layer}{c}"))));
    let means = statistics(|pixel| [0, 1, 2].map(|c| rgb[c][pixel]));
    let variances = statistics(|pixel| [0, 1, 2].map(|c| variance[c][pixel]));
    let per_channel = means.len() / 3;
    let samples = |i: usize| {
        (if i.is_multiple_of(per_channel) {
            SIZE * SIZE
        } else {
            BLOCK * BLOCK
        }) as f64
    };
    let pairs = means.into_iter().zip(variances).enumerate();
    pairs
        .map(|(i, (mean, variance))| Estimate {
            mean,
            error: (variance / samples(i)).sqrt(),
        })
        .collect()
}

/// The number of statistics that differ significantly, and the smallest relative bias of the image mean to be seen.
/// Errors come from [`RUNS`] runs, so the statistic is Student's.
fn disagreements(a: &[Estimate], b: &[Estimate]) -> (usize, f64) {
    let student = StudentsT::new(0.0, 1.0, (RUNS - 1) as f64).expect("degrees of freedom");
    let threshold = student.inverse_cdf(1.0 - 0.5 * sidak(ALPHA, a.len()));
    let tests = || a.iter().zip(b).map(|(a, b)| a.against_estimate(*b));
    let failed = tests()
        .filter(|test| test.z.is_nan() || test.z.abs() > threshold)
        .count();
    let means = tests().zip(b).step_by(a.len() / 3);
    let visible = means.map(|(test, b)| test.error * (threshold + upper_quantile(1.0 - POWER)) / b.mean);
    (failed, visible.fold(0.0, f64::max))
}

fn assert_same_light(name: &str, a: &[Estimate], b: &[Estimate]) {
    let (failed, visible) = disagreements(a, b);
    println!(
        "{name}: smallest visible bias of the image mean {:.2} %",
        100.0 * visible
    );
    assert_eq!(failed, 0, "{name}: {failed} of {} statistics differ", a.len());
    assert!(
        visible.is_finite() && visible < 0.02,
        "{name}: a bias of 2 % would not be seen"
    );
}

fn agree(scene: &str) {
    let reference = reference(scene);
    let staged = estimates(scene, Technique::Pt, 1_000, 1.0);
    let depth_first = estimates(scene, Technique::PtReference, 2_000, 1.0);
    assert_same_light(&format!("{scene}, pt against the reference"), &staged, &reference);
    assert_same_light(
        &format!("{scene}, pt-reference against the reference"),
        &depth_first,
        &reference,
    );
    assert_same_light(&format!("{scene}, pt against pt-reference"), &staged, &depth_first);
    for brightness in [0.98, 1.02] {
        let planted = estimates(scene, Technique::Pt, 3_000, brightness);
        let seen = |other: &[Estimate]| disagreements(&planted, other).0 > 0;
        assert!(
            seen(&reference) && seen(&depth_first),
            "{scene}: lights of {brightness} were not seen"
        );
    }
}

#[test]
fn the_cornell_box_is_right_to_the_noise() {
    agree("cornell-box.ron");
}

#[test]
fn the_glass_box_is_right_to_the_noise() {
    agree("cornell-glass.ron");
}

/// A reference says nothing of a scene that has changed since: its hash is over the scene file and its meshes in order.
#[test]
fn the_references_are_of_the_scenes_as_they_are() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["cornell-box", "cornell-glass"] {
        let path = root.join("scenes").join(name).with_extension("ron");
        let source = read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain()));
        let mut files = vec![path];
        files.extend(source.description.shapes.iter().filter_map(|shape| match &shape.shape {
            ShapeKind::Obj { file, .. } => Some(root.join("scenes").join(file)),
            _ => None,
        }));
        let mut digest = Sha256::new();
        for file in files {
            digest.update(std::fs::read(file).expect("a shipped file"));
        }
        let hex: String = digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        let described = root.join("tests/references").join(name).with_extension("json");
        let described = std::fs::read(described).expect("a committed file");
        let described: serde_json::Value = serde_json::from_slice(&described).expect("JSON");
        assert_eq!(
            described["scene_sha256"], hex,
            "{name}: run tests/oracle/make_references.py"
        );
    }
}
