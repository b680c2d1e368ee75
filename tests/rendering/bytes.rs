//! The picture's bytes are a function of (scene, settings, seed, steps) and of nothing else.

use super::{shipped, start};
use crate::support::render::picture_bytes;
use crate::support::ways::ways;
use chainlight::film::{PictureMetadata, encode_exr};
use chainlight::plan::Technique;
use chainlight::render::{Budget, Rendering, Stop, drive};
use chainlight::scene::Scene;
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

const SIZE: u32 = 40;
const STEPS: u64 = 6;

/// SHA-256 of [`picture_bytes`] of the glass box, by the pictures that this renderer made when the test was written.
/// It must hold in debug and in release, on every machine. Change it only with a change that is meant to change light.
const GOLDEN: &str = "9b2ee0809ba61373e135ebd17c581ec6ecd269791726f7e127c26b9567bab66a";

fn bytes(scene: &Arc<Scene>, seed: u64, threads: usize, tile: Option<u32>) -> Vec<u8> {
    let mut render = start(scene, Technique::Pt, seed, threads, tile);
    render.burst(STEPS, &|_| {});
    picture_bytes(&render.film.develop())
}

fn hash(scene: &Arc<Scene>) -> String {
    let hash = Sha256::digest(bytes(scene, 1, 1, None));
    hash.iter().fold(String::new(), |mut hex, byte| {
        let _ = write!(hex, "{byte:02x}");
        hex
    })
}

#[test]
fn golden_hash() {
    assert_eq!(hash(&shipped("cornell-glass.ron", SIZE)), GOLDEN);
}

/// With a tree and without, rays one by one and interleaved, by all instructions that the machine has.
#[test]
fn no_way_to_trace_rays_shows() {
    for (tracer, instructions) in ways() {
        let mut scene = Scene::clone(&shipped("cornell-glass.ron", SIZE));
        scene.geometry.trace_with(tracer, instructions);
        assert_eq!(hash(&Arc::new(scene)), GOLDEN, "{tracer} {instructions}");
    }
}

#[test]
fn threads_and_tile_sizes_do_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let reference = bytes(&scene, 1, 1, None);
    for (threads, tile) in [
        (2, None),
        (1, Some(16)),
        (2, Some(112)),
        (2, Some(1024)),
        (3, Some(4096)),
    ] {
        assert!(
            bytes(&scene, 1, threads, tile) == reference,
            "{threads} threads, tile {tile:?}"
        );
    }
}

#[test]
fn the_order_of_tiles_does_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let mut render = start(&scene, Technique::Pt, 1, 2, Some(64));
    let tiles = render.tile_count();
    assert!(tiles > 20);
    // A stride that shares no factor with the number of tiles visits each once, far from in order.
    let order: Vec<usize> = (0..tiles).map(|i| (i * 7 + 3) % tiles).collect();
    assert_eq!(
        order.iter().copied().collect::<std::collections::BTreeSet<_>>().len(),
        tiles
    );
    render.burst_in_order(STEPS, &order, &|_| {});
    assert!(picture_bytes(&render.film.develop()) == bytes(&scene, 1, 1, None));
}

#[test]
fn the_size_of_bursts_does_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let mut render = start(&scene, Technique::Pt, 1, 2, None);
    for steps in [1, 3, 2] {
        render.burst(steps, &|_| {});
    }
    assert_eq!(render.steps(), STEPS);
    assert!(picture_bytes(&render.film.develop()) == bytes(&scene, 1, 1, None));
}

#[test]
fn a_time_budget_is_reproduced_by_the_steps_it_recorded() {
    let scene = shipped("cornell-box.ron", SIZE);
    let exr = |budget| {
        let mut render = start(&scene, Technique::Pt, 5, 2, None);
        let outcome = drive(&mut render, budget, &AtomicBool::new(false), &|_| {});
        assert_eq!(outcome.stop, Stop::Done);
        let metadata = PictureMetadata {
            steps: outcome.steps,
            ..PictureMetadata::default()
        };
        (
            outcome.steps,
            encode_exr(&render.film.develop(), &metadata).expect("a small picture"),
        )
    };
    let (steps, timed) = exr(Budget::Time(Duration::from_millis(300)));
    assert!(steps > 1, "{steps} steps in 0.3 s");
    let (again, counted) = exr(Budget::Steps(steps));
    assert_eq!(steps, again);
    assert!(timed == counted);
}

#[test]
fn an_interrupted_render_keeps_what_it_has() {
    let scene = shipped("cornell-box.ron", SIZE);
    let mut render = start(&scene, Technique::Pt, 5, 2, None);
    let interrupt = AtomicBool::new(false);
    let outcome = drive(&mut render, Budget::Steps(u64::MAX), &interrupt, &|_| {
        interrupt.store(true, std::sync::atomic::Ordering::Relaxed);
    });
    assert_eq!((outcome.stop, outcome.steps), (Stop::Interrupted, 1));
    assert!(render.film.develop().weight.iter().all(|&weight| weight == 1.0));
}

#[test]
fn different_seeds_differ() {
    let scene = shipped("cornell-box.ron", SIZE);
    let pictures: Vec<_> = [0, 1, 1 << 32, u64::MAX]
        .map(|seed| bytes(&scene, seed, 1, None))
        .into();
    for (i, a) in pictures.iter().enumerate() {
        assert!(pictures[..i].iter().all(|b| a != b));
    }
}
