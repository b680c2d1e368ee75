//! Metrics of stored pictures are those that others compute of them: NumPy, and the authors' package of FLIP
//! (`tests/oracle/metrics.py`).

use chainlight::film::{ToneMap, read_exr};
use chainlight::stats::flip::mean_flip;
use chainlight::stats::metrics::compare;
use serde::Deserialize;
use std::path::Path;

#[derive(Deserialize)]
struct Pair {
    image: String,
    reference: String,
    mse: f64,
    rel_mse: f64,
    rel_mse_trimmed: f64,
    mape: f64,
    smape: f64,
    mean_ratio: f64,
    channel_mean_ratio: [f64; 3],
    max_abs_error: f64,
    exposure: f32,
    flip: f64,
}

/// Sums of doubles in another order.
const ROUNDING: f64 = 1e-12;
/// The package computes in single precision.
const FLIP_ROUNDING: f64 = 2e-5;

#[test]
fn metrics_of_stored_pictures_are_those_that_others_compute() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/references");
    let text = std::fs::read_to_string(folder.join("metrics.json")).expect("the committed metrics");
    let pairs: Vec<Pair> = serde_json::from_str(&text).expect("metrics of pairs");
    assert_eq!(pairs.len(), 5);
    for pair in &pairs {
        let read = |name: &str| read_exr(&folder.join(format!("{name}.exr"))).expect("a committed reference");
        let (image, reference) = (read(&pair.image), read(&pair.reference));
        let own = compare(image.view(), reference.view()).expect("one size");
        let of_channels = own.channel_mean_ratio.into_iter().zip(pair.channel_mean_ratio);
        let all = [
            (own.mse, pair.mse),
            (own.rel_mse, pair.rel_mse),
            (own.rel_mse_trimmed, pair.rel_mse_trimmed),
            (own.mape, pair.mape),
            (own.smape, pair.smape),
            (own.mean_ratio, pair.mean_ratio),
            (own.max_abs_error, pair.max_abs_error),
        ];
        for (own, other) in all.into_iter().chain(of_channels) {
            assert!(
                (own - other).abs() <= ROUNDING * other.abs(),
                "{}: {own}, not {other}",
                pair.image
            );
        }
        let tone = ToneMap {
            exposure: pair.exposure,
        };
        let flip = mean_flip(image.view(), reference.view(), tone).expect("one size");
        assert!(
            (flip - pair.flip).abs() < FLIP_ROUNDING,
            "{}: {flip}, not {}",
            pair.image,
            pair.flip
        );
        assert!(
            own.rel_mse > 1e-9 && pair.flip > 1e-3,
            "{} is {}",
            pair.image,
            pair.reference
        );
    }
}
