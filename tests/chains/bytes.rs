//! The bytes of a picture of chains are a function of (scene, settings, seed, steps), and the settings that count are the
//! numbers of groups, chains and bootstrap samples: neither threads nor tiles nor bursts.

use crate::support::chains::{Chains, column, films};
use crate::support::render::picture_bytes;
use crate::support::scenes::shipped;
use crate::support::verdict::say;
use chainlight::path::PrimaryDepth;
use chainlight::plan::Technique;
use chainlight::render::{ChainRender, Rendering};
use chainlight::scene::Scene;
use chainlight::systems::tile::Depths;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::Arc;

const SIZE: u32 = 40;
const STEPS: u64 = 6;

/// SHA-256 of [`picture_bytes`] of the glass box by chains, as this renderer made it when the test was written. It must hold
/// in debug and in release, on every machine. Change it only with a change that is meant to change chains or their light.
const GOLDEN: &str = "711c8ad9714f304ba3c08d1682a73b77785dbd99f28bca328bcf0ddca57ef88b";

/// Three groups of 80 chains.
fn chains() -> Chains {
    Chains::new(3, 80, 400).set("identity:weight=0.05")
}

fn bytes(scene: &Arc<Scene>, chains: &Chains) -> Vec<u8> {
    picture_bytes(&chains.run(scene, STEPS).picture())
}

#[test]
fn golden_hash() {
    let hash = Sha256::digest(bytes(&shipped("cornell-glass.ron", SIZE), &chains()));
    let hex = hash.iter().fold(String::new(), |mut hex, byte| {
        let _ = write!(hex, "{byte:02x}");
        hex
    });
    assert_eq!(hex, GOLDEN);
}

#[test]
fn threads_and_tile_sizes_do_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let reference = bytes(&scene, &chains());
    for (threads, tile_size) in [(2, None), (1, Some(16)), (2, Some(48)), (3, Some(64)), (2, Some(4096))] {
        let mut chains = chains();
        chains.threads = threads;
        chains.options.tile_size = tile_size;
        assert!(
            bytes(&scene, &chains) == reference,
            "{threads} threads, tile {tile_size:?}"
        );
    }
}

#[test]
fn the_order_of_tiles_does_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let mut in_tiles = chains();
    in_tiles.threads = 2;
    in_tiles.options.tile_size = Some(16);
    let mut render = in_tiles.start(&scene);
    let tiles = render.tile_count();
    assert_eq!(tiles, 15);
    // A stride that shares no factor with the number of tiles visits each once, far from in order.
    let order: Vec<usize> = (0..tiles).map(|i| (i * 7 + 3) % tiles).collect();
    assert_eq!(order.iter().copied().collect::<BTreeSet<_>>().len(), tiles);
    render.run.burst_in_order(STEPS, &order, &|_| {});
    assert!(picture_bytes(&render.picture()) == bytes(&scene, &chains()));
}

#[test]
fn the_size_of_bursts_does_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let mut render = chains().start(&scene);
    for steps in [1, 3, 2] {
        render.burst(steps, &|_| {});
    }
    assert_eq!(render.steps(), STEPS);
    assert!(picture_bytes(&render.picture()) == bytes(&scene, &chains()));
}

#[test]
fn seeds_and_numbers_of_chains_show() {
    let scene = shipped("cornell-box.ron", SIZE);
    let all = [
        chains(),
        chains().seeded(0),
        chains().seeded(1 << 32),
        chains().seeded(u64::MAX),
        Chains::new(3, 79, 400),
        Chains::new(4, 60, 400),
        Chains::new(3, 80, 480),
        chains().set("small_step:largest=0.0157"),
    ];
    let pictures: Vec<_> = all.iter().map(|chains| bytes(&scene, chains)).collect();
    for (i, a) in pictures.iter().enumerate() {
        assert!(pictures[..i].iter().all(|b| a != b), "number {i}");
    }
}

/// How deep the tables of each tile are.
fn held(render: &ChainRender) -> Vec<u32> {
    let mut held = Vec::new();
    render
        .run
        .for_each_tile(&mut |_, tile| held.push(tile.world().resource::<Depths>().held()));
    held
}

#[test]
fn tables_that_grow_with_depth_do_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let run = |technique, tile_size| {
        let mut chains = Chains::new(2, 64, 64);
        chains.technique = technique;
        chains.options.tile_size = tile_size;
        let mut render = chains.start(&scene);
        let before = held(&render);
        render.run.burst(24, &|_| {});
        (before, render)
    };
    let (before, small) = run(Technique::Pssmlt, Some(16));
    let after = held(&small);
    say(&format!(
        "tables of tiles hold depths {before:?} before steps, {after:?} after"
    ));
    assert!(
        after.iter().any(|&depth| depth > 8),
        "paths are deeper than the first room"
    );
    assert!(before != after, "some tile grows while it steps");
    assert!(column::<PrimaryDepth>(&small).into_iter().any(|depth| depth > 8));
    // The depth-first chains' tables have room for every depth from the first.
    for (technique, tile_size) in [
        (Technique::Pssmlt, None),
        (Technique::Pssmlt, Some(32)),
        (Technique::PssmltReference, None),
    ] {
        let (_, other) = run(technique, tile_size);
        assert!(films(&other) == films(&small), "{technique}, tile {tile_size:?}");
    }
}
