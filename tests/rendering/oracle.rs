//! `pt` and `pt-reference` against references that another renderer made, and against each other.
//!
//! Every test prints the smallest relative bias of the image mean that it would see with 95 % power, must be able to see
//! 2 %, and fails on a planted 2 %.

use super::{box_filtered, picture};
use crate::support::reference::{SIZE, assert_same_light, disagreements, over_runs, reference, statistics};
use crate::support::verdict::say;
use chainlight::film::Picture;
use chainlight::plan::Technique;
use chainlight::scene::{LightDescription, SceneDescription, ShapeKind, TextureDescription, read_scene};
use chainlight::stats::z_test::Estimate;
use sha2::{Digest, Sha256};
use std::path::Path;

const REFERENCES: [&str; 9] = [
    "cornell-box",
    "cornell-glass",
    "cornell-glossy",
    "cornell-index-one",
    "cornell-near-index-one",
    "cornell-window",
    "depth-of-field",
    "island",
    "veach-plates",
];
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

/// Holds that a technique finds the light of a scene, and that a reference whose brightness is off by `bias` would be refused.
fn finds(scene: &str, technique: Technique, bias: f64) {
    let reference = reference(scene);
    let found = estimates(scene, technique, 4_000, 1.0);
    let (failed, visible) = disagreements(RUNS, &found, &reference);
    let name = format!("{scene}, {} against the reference", technique.name());
    say(&format!(
        "{name}: smallest visible bias of the image mean {:.2} %",
        100.0 * visible
    ));
    assert_eq!(failed, 0, "{name}: {failed} of {} statistics differ", found.len());
    for brightness in [1.0 - bias, 1.0 + bias] {
        let planted = reference.iter().map(|e| Estimate {
            mean: e.mean * brightness,
            error: e.error * brightness,
        });
        let (seen, _) = disagreements(RUNS, &found, &planted.collect::<Vec<_>>());
        assert!(seen > 0, "{name}: {brightness} times as bright, it goes unnoticed");
    }
}

/// Rough conductors of both distributions, one of them anisotropic; plastic; a rough dielectric.
#[test]
fn glossy_things_in_the_cornell_box_are_right_to_the_noise() {
    finds("cornell-glossy.ron", Technique::Pt, 0.02);
}

#[test]
fn plates_of_rough_metal_are_right_to_the_noise() {
    finds("veach-plates.ron", Technique::Pt, 0.04);
}

/// Sun and sky, which are met and sampled.
#[test]
fn daylight_through_a_window_is_right_to_the_noise() {
    finds("cornell-window.ron", Technique::Pt, 0.02);
}

/// An orthographic camera, a directional light, a constant environment, a height field, disks, cylinders, a bitmap.
#[test]
fn an_island_under_parallel_rays_is_right_to_the_noise() {
    finds("island.ron", Technique::Pt, 0.02);
}

/// A thin lens, point and spot lights, tori, checkerboards on a plane and on a turned sphere, a sheet of two sides.
#[test]
fn what_a_lens_blurs_is_right_to_the_noise() {
    finds("depth-of-field.ron", Technique::Pt, 0.04);
}

/// Direct light crosses the block twice refracted, or, as Mitsuba has it, not at all.
#[test]
fn a_block_of_nothing_is_not_seen() {
    finds("cornell-index-one.ron", Technique::Bdpt, 0.02);
    finds("cornell-near-index-one.ron", Technique::Bdpt, 0.02);
}

/// A reference says nothing of a scene that has changed since: its hash is over the scene file and the files that it names,
/// textures by name, then lights, then shapes in order.
#[test]
fn the_references_are_of_the_scenes_as_they_are() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in REFERENCES {
        let path = root.join("scenes").join(name).with_extension("ron");
        let source = read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain()));
        let SceneDescription {
            textures,
            lights,
            shapes,
            ..
        } = &source.description;
        let textures = textures.values().filter_map(|texture| match texture {
            TextureDescription::Bitmap { file, .. } => Some(file),
            TextureDescription::Checkerboard { .. } => None,
        });
        let lights = lights.iter().filter_map(|light| match light {
            LightDescription::Environment { file, .. } => file.as_ref(),
            _ => None,
        });
        let shapes = shapes.iter().filter_map(|shape| match &shape.shape {
            ShapeKind::Obj { file, .. } => Some(file),
            ShapeKind::HeightField { file, .. } => file.as_ref(),
            _ => None,
        });
        let named = textures.chain(lights).chain(shapes);
        let files = std::iter::once(path).chain(named.map(|file| root.join("scenes").join(file)));
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
