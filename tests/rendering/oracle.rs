//! `pt` and `pt-reference` against references that another renderer made, and against each other.
//!
//! Every test prints the smallest relative bias of the image mean that it would see with 95 % power, must be able to see
//! 2 %, and fails on a planted 2 %.

use super::{box_filtered, picture};
use crate::support::reference::{SIZE, assert_same_light, disagreements, over_runs, reference, statistics};
use chainlight::film::Picture;
use chainlight::plan::Technique;
use chainlight::scene::{ShapeKind, read_scene};
use chainlight::stats::z_test::Estimate;
use sha2::{Digest, Sha256};
use std::path::Path;

const RUNS: u64 = 48;
const STEPS: u64 = 160;

/// One estimate per statistic, from independent runs. `brightness` scales all lights: 1, or a planted bias.
fn estimates(scene: &str, technique: Technique, first_seed: u64, brightness: f32) -> Vec<Estimate> {
    let scene = box_filtered(scene, SIZE as u32, brightness);
    let runs: Vec<Vec<f64>> = (0..RUNS)
        .map(|run| {
            let picture: Picture = picture(&scene, technique, first_seed + run, STEPS);
            statistics(|pixel| picture.rgb[pixel].to_array().map(f64::from))
        })
        .collect();
    over_runs(&runs)
}

fn agree(scene: &str) {
    let reference = reference(scene);
    let staged = estimates(scene, Technique::Pt, 1_000, 1.0);
    let depth_first = estimates(scene, Technique::PtReference, 2_000, 1.0);
    assert_same_light(&format!("{scene}, pt against the reference"), RUNS, &staged, &reference);
    assert_same_light(
        &format!("{scene}, pt-reference against the reference"),
        RUNS,
        &depth_first,
        &reference,
    );
    assert_same_light(
        &format!("{scene}, pt against pt-reference"),
        RUNS,
        &staged,
        &depth_first,
    );
    for brightness in [0.98, 1.02] {
        let planted = estimates(scene, Technique::Pt, 3_000, brightness);
        let seen = |other: &[Estimate]| disagreements(RUNS, &planted, other).0 > 0;
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
