//! The bytes of a picture of both ends are a function of (scene, settings, seed, steps): neither threads nor tiles nor bursts
//! show, nor that a render was saved and taken up again.

use super::agreement::Contender;
use crate::support::render::picture_bytes;
use crate::support::scenes::shipped;
use chainlight::plan::{Base, ChainSettings, Plan, PlanOptions, Technique};
use chainlight::render::{ChainRender, Rendering, SplatRender, resume, start};
use chainlight::scene::Scene;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const SIZE: u32 = 40;
const STEPS: u64 = 6;
const SEED: u64 = 1;

/// SHA-256 of [`picture_bytes`] of the glass box by light tracing, bidirectional path tracing and chains over it, by the
/// pictures that this renderer made when the test was written. They must hold in debug and in release, on every machine.
/// Change them only with a change that is meant to change light, or the order in which numbers are drawn.
const GOLDEN: [(Contender, &str); 3] = [
    (
        Contender::of(Technique::Lt, Base::Pt),
        "fbb6b9ddd8a541e65e1c778303daa251e1b55ae64a8c2df18a8c8186c37b4f02",
    ),
    (
        Contender::of(Technique::Bdpt, Base::Pt),
        "8a2c2b9a8ef0a9382cb71304ccec6fd2f97bb09dd200d002f57da6000ce2f6e1",
    ),
    (
        Contender::of(Technique::Pssmlt, Base::Bdpt),
        "c097687b0acccb74956e004a6c13286758ce59135f21855f6f22bea50d5eeb2c",
    ),
];

/// Those that are looked at: chains of whole paths too, whose golden hash mutations would change too often.
fn all() -> [Contender; 4] {
    let [lt, bdpt, pssmlt] = GOLDEN.map(|(contender, _)| contender);
    [lt, bdpt, pssmlt, Contender::of(Technique::Mlt, Base::Pt)]
}

fn plan(scene: &Scene, contender: Contender, tile_size: Option<u32>) -> Plan {
    let options = PlanOptions {
        tile_size,
        base: contender.base,
        // Three groups of 80 chains.
        chains: ChainSettings {
            groups: 3,
            chains: Some(80),
            bootstrap: Some(400),
            ..ChainSettings::default()
        },
        ..PlanOptions::default()
    };
    Plan::with(scene, contender.technique, &options).expect("the mutations there are make a plan")
}

fn begin(scene: &Arc<Scene>, contender: Contender, seed: u64, threads: usize, tile: Option<u32>) -> Box<dyn Rendering> {
    let (plan, never) = (plan(scene, contender, tile), AtomicBool::new(false));
    start(Arc::clone(scene), plan, seed, threads, &never, &|_| {}).expect("a small film and few threads")
}

fn bytes(scene: &Arc<Scene>, contender: Contender, seed: u64, threads: usize, tile: Option<u32>) -> Vec<u8> {
    let mut render = begin(scene, contender, seed, threads, tile);
    render.burst(STEPS, &|_| {});
    picture_bytes(&render.picture())
}

#[test]
fn golden_hashes() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let found = GOLDEN.map(|(contender, _)| {
        let hash = Sha256::digest(bytes(&scene, contender, SEED, 1, None));
        let hex = hash.iter().fold(String::new(), |mut hex, byte| {
            let _ = write!(hex, "{byte:02x}");
            hex
        });
        (contender.to_string(), hex)
    });
    assert_eq!(
        found,
        GOLDEN.map(|(contender, golden)| (contender.to_string(), golden.to_owned()))
    );
}

#[test]
fn threads_and_tile_sizes_do_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    for contender in all() {
        let reference = bytes(&scene, contender, SEED, 1, None);
        for (threads, tile) in [(2, None), (1, Some(16)), (2, Some(112)), (3, Some(1024))] {
            assert!(
                bytes(&scene, contender, SEED, threads, tile) == reference,
                "{contender}, {threads} threads, tile {tile:?}"
            );
        }
    }
}

/// A stride that shares no factor with the number of tiles visits each once, far from in order.
fn far_from_in_order(tiles: usize) -> Vec<usize> {
    let order: Vec<usize> = (0..tiles).map(|i| (i * 7 + 3) % tiles).collect();
    assert_eq!(order.iter().copied().collect::<BTreeSet<_>>().len(), tiles);
    order
}

#[test]
fn the_order_of_tiles_does_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    for contender in all() {
        let (plan, scene) = (plan(&scene, contender, Some(16)), Arc::clone(&scene));
        let picture = if plan.chains.is_some() {
            let mut render = ChainRender::new(Arc::clone(&scene), plan, SEED, 2).expect("few chains");
            let order = far_from_in_order(render.tile_count());
            render.burst_in_order(STEPS, &order, &|_| {});
            render.picture()
        } else {
            let mut render = SplatRender::new(Arc::clone(&scene), plan, SEED, 2).expect("a small film");
            let order = far_from_in_order(render.tile_count());
            render.burst_in_order(STEPS, &order, &|_| {});
            render.picture()
        };
        assert!(
            picture_bytes(&picture) == bytes(&scene, contender, SEED, 1, None),
            "{contender}"
        );
    }
}

#[test]
fn bursts_and_interruptions_do_not_show() {
    let scene = shipped("cornell-glass.ron", SIZE);
    for contender in all() {
        let at_once = bytes(&scene, contender, SEED, 1, None);
        let mut render = begin(&scene, contender, SEED, 2, Some(112));
        render.burst(1, &|_| {});
        render.burst(3, &|_| {});
        let saved = render.save();
        render.burst(2, &|_| {});
        assert_eq!(render.steps(), STEPS);
        assert!(picture_bytes(&render.picture()) == at_once, "{contender} in bursts");
        // Taken up by another number of threads.
        let plan = plan(&scene, contender, Some(112));
        let mut resumed = resume(Arc::clone(&scene), plan, SEED, 1, &saved).expect("what was just saved");
        assert_eq!(resumed.steps(), 4);
        resumed.burst(2, &|_| {});
        assert!(picture_bytes(&resumed.picture()) == at_once, "{contender} taken up");
        assert!(resumed.save() == render.save(), "{contender} saved again");
    }
}

#[test]
fn seeds_show() {
    let scene = shipped("cornell-box.ron", SIZE);
    for contender in all() {
        let pictures = [0, 1, 1 << 32, u64::MAX].map(|seed| bytes(&scene, contender, seed, 1, None));
        for (i, a) in pictures.iter().enumerate() {
            assert!(pictures[..i].iter().all(|b| a != b), "{contender}");
        }
    }
}
