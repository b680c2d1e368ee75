//! `pssmlt` against `pt` and against the references that another renderer made.
//!
//! Chains are correlated, so errors come from independent runs (seeds). A family of tests has significance 1 % in all, prints
//! the smallest relative bias of the image mean that it would see with 95 % power, must be able to see 2 %, and fails on a
//! planted 2 %. What chains know of the image mean is b alone, from bootstraps that sample the film at random: the few pixels
//! of the light are most of its variance (one sample's relative error is nine), so most of the time here goes into them.

use crate::support::chains::Chains;
use crate::support::reference::{SIZE, assert_same_light, disagreements, over_runs, reference, statistics};
use crate::support::scenes::box_filtered;
use chainlight::film::Picture;
use chainlight::plan::{Plan, Technique};
use chainlight::render::{Render, Rendering};
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use std::sync::Arc;

const RUNS: u64 = 40;
/// Samples per pixel of a run of `pt`.
const SAMPLES: u64 = 224;
/// Mutations per pixel of a run of `pssmlt`.
const MUTATIONS: f64 = 80.0;
/// Samples of a group's bootstrap.
const BOOTSTRAP: u32 = 16_000;

/// One estimate per statistic, from the pictures of independent runs.
fn estimates(scene: &Arc<Scene>, picture: impl Fn(&Arc<Scene>, u64) -> Picture) -> Vec<Estimate> {
    let of_run = |run| {
        let picture = picture(scene, run);
        statistics(|pixel| picture.rgb[pixel].to_array().map(f64::from))
    };
    over_runs(&(0..RUNS).map(of_run).collect::<Vec<_>>())
}

fn by_chains(scene: &Arc<Scene>, seed: u64, bootstrap: u32) -> Picture {
    let mut render = Chains::new(16, 64, bootstrap).seeded(seed).start(scene);
    render.run.burst(render.steps_for(MUTATIONS), &|_| {});
    render.picture()
}

fn by_samples(scene: &Arc<Scene>, seed: u64) -> Picture {
    let plan = Plan::new(scene, Technique::Pt, None);
    let mut render = Render::new(Arc::clone(scene), plan, seed, 1).expect("a small film and one thread");
    render.burst(SAMPLES, &|_| {});
    render.picture()
}

/// Holds that chains find the light of `name`, and that a reference that is 2 % off would be refused.
fn agree(name: &str) -> Vec<Estimate> {
    let scene = box_filtered(name, SIZE as u32, 1.0);
    let reference = reference(name);
    let chains = estimates(&scene, |scene, run| by_chains(scene, 1_000 + run, BOOTSTRAP));
    let samples = estimates(&scene, |scene, run| by_samples(scene, 2_000 + run));
    assert_same_light(
        &format!("{name}, pssmlt against the reference"),
        RUNS,
        &chains,
        &reference,
    );
    assert_same_light(&format!("{name}, pssmlt against pt"), RUNS, &chains, &samples);
    for brightness in [0.98, 1.02] {
        let planted = reference.iter().map(|e| Estimate {
            mean: e.mean * brightness,
            error: e.error * brightness,
        });
        let planted: Vec<Estimate> = planted.collect();
        assert!(
            disagreements(RUNS, &chains, &planted).0 > 0,
            "{name}: a reference {brightness} times as bright goes unnoticed"
        );
    }
    samples
}

#[test]
fn chains_find_the_light_of_the_cornell_box() {
    let name = "cornell-box.ron";
    let samples = agree(name);
    // Planted lights, through bootstrap and chains: 5 %, which a sixth of the samples sees as well as all of them see 2 %.
    let dimmed = box_filtered(name, SIZE as u32, 0.95);
    let planted = estimates(&dimmed, |scene, run| by_chains(scene, 3_000 + run, BOOTSTRAP / 6));
    for (other, light) in [("the reference", &reference(name)), ("pt", &samples)] {
        assert!(
            disagreements(RUNS, &planted, light).0 > 0,
            "lights of 95 % go unnoticed against {other}"
        );
    }
}

#[test]
fn chains_find_the_light_of_the_glass_box() {
    agree("cornell-glass.ron");
}
