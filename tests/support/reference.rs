//! The committed references, and the test that two estimates show the same light.
//!
//! The references are Mitsuba 3 renders of the shipped scenes (`tests/oracle/make_references.py`) with the variance of
//! each pixel's mean. Independent runs (seeds) give a mean and a standard error per statistic, so nothing is assumed of the
//! noise inside a run. Statistics are the image mean and the means of 6 x 6 blocks of 4 x 4 pixels, per channel; a family of
//! tests has significance 1 % in all, corrected by Šidák.

use super::verdict::say;
use chainlight::stats::normal::{sidak, upper_quantile};
use chainlight::stats::z_test::Estimate;
use exr::prelude::read_first_flat_layer_from_file;
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::path::Path;

/// Pixels along each side of the references.
pub const SIZE: usize = 24;
const BLOCK: usize = 4;
const ALPHA: f64 = 0.01;
const POWER: f64 = 0.95;

/// Statistics of a picture: per channel the image mean, then the block means.
pub fn statistics(rgb: impl Fn(usize) -> [f64; 3]) -> Vec<f64> {
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

/// One estimate per statistic, from the statistics of independent runs.
pub fn over_runs(runs: &[Vec<f64>]) -> Vec<Estimate> {
    (0..runs[0].len())
        .map(|i| Estimate::of(&runs.iter().map(|run| run[i]).collect::<Vec<_>>()))
        .collect()
}

/// Layers of a reference, pixel by pixel: the light, and the variance of each pixel's mean.
fn layers(scene: &str) -> [Vec<[f64; 3]>; 2] {
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
    ["", "variance."].map(|layer| {
        let [r, g, b] = ["R", "G", "B"].map(|c| channel(format!("{layer}{c}")));
        (0..SIZE * SIZE).map(|pixel| [r[pixel], g[pixel], b[pixel]]).collect()
    })
}

/// The reference's light, pixel by pixel.
pub fn reference_picture(scene: &str) -> Vec<[f64; 3]> {
    let [light, _] = layers(scene);
    light
}

/// The reference's statistics: means from its picture, errors from its variances.
pub fn reference(scene: &str) -> Vec<Estimate> {
    let [light, variance] = layers(scene);
    let means = statistics(|pixel| light[pixel]);
    let variances = statistics(|pixel| variance[pixel]);
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
/// Errors come from `runs` runs, so the statistic is Student's.
pub fn disagreements(runs: u64, a: &[Estimate], b: &[Estimate]) -> (usize, f64) {
    let student = StudentsT::new(0.0, 1.0, (runs - 1) as f64).expect("degrees of freedom");
    let threshold = student.inverse_cdf(1.0 - 0.5 * sidak(ALPHA, a.len()));
    let tests = || a.iter().zip(b).map(|(a, b)| a.against_estimate(*b));
    let failed = tests()
        .filter(|test| test.z.is_nan() || test.z.abs() > threshold)
        .count();
    let means = tests().zip(b).step_by(a.len() / 3);
    let visible = means.map(|(test, b)| test.error * (threshold + upper_quantile(1.0 - POWER)) / b.mean);
    (failed, visible.fold(0.0, f64::max))
}

/// Holds that two estimates agree, by a test that would see the image mean off by 2 %.
#[track_caller]
pub fn assert_same_light(name: &str, runs: u64, a: &[Estimate], b: &[Estimate]) {
    let (failed, visible) = disagreements(runs, a, b);
    say(&format!(
        "{name}: smallest visible bias of the image mean {:.2} %",
        100.0 * visible
    ));
    assert_eq!(failed, 0, "{name}: {failed} of {} statistics differ", a.len());
    assert!(
        visible.is_finite() && visible < 0.02,
        "{name}: a bias of 2 % would not be seen"
    );
}
