//! Subpaths of chains never play roulette: how many vertices they are to have is decided before, and is part of what a proposal's
//! density says. Dark walls, where a path tracer would end nearly every path, have the light of every length.

use super::paths;
use crate::physics::enclosure::walls;
use crate::support::chains::Chains;
use crate::support::scenes::as_written;
use crate::support::verdict::Family;
use bevy_ecs::system::{Res, ResMut};
use chainlight::chain::StateClass;
use chainlight::path::whole::{CameraVertices, LightVertices};
use chainlight::path::{ActiveList, ChainTable, PathLength, ScatteredList};
use chainlight::plan::{Phases, Place, SystemPlan, Technique, TraceStep};
use chainlight::render::{Rendering, Start};
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use chainlight::system;
use chainlight::systems::list::{CONTINUE_PATHS, CONTINUE_TO_STOP};
use chainlight::systems::tile::{Queues, TilePlace};
use chainlight::table::{Read, Rows, Write};
use std::sync::Arc;

const DEPTH: u32 = 12;
const DARK: f64 = 0.05;

/// A closed room whose walls emit 1 and reflect the share [`DARK`]: every edge of every subpath meets one.
fn room() -> Arc<Scene> {
    as_written(&format!(
        "(version: 1, settings: (max_depth: {DEPTH}),
          camera: Perspective(origin: (0.3, -0.4, 0.5), target: (-0.2, 0.1, -1), fov: 100),
          film: (width: 4, height: 4),
          materials: {{\"wall\": Diffuse(reflectance: ({DARK}, {DARK}, {DARK}))}},
          shapes: [{}])",
        walls()
    ))
}

/// Chains with one mutation alone. New paths are of any length, each as likely as the others.
fn only(mutation: &str, groups: u32, chains: u32, bootstrap: u32) -> Chains {
    let mut all = paths(groups, chains, bootstrap).set("new_path:exponent=0");
    all.options.mutations = all.options.mutations.only(mutation).expect("a mutation");
    all
}

/// The planted mistake: every third subpath ends at every vertex, as roulette would end it.
fn play_roulette(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    scattered: Read<ScatteredList, ChainTable>,
    mut active: Write<ActiveList, ChainTable>,
) {
    let (scattered, active) = (scattered.rows(), active.rows());
    queues.active = 0;
    for path in (0..queues.scattered).map(|entry| scattered.at(entry)) {
        if !(u64::from(path) + place.step).is_multiple_of(3) {
            active.put(queues.active, path);
            queues.active += 1;
        }
    }
    queues.scattered = 0;
}

/// Subpaths that are not as long as they were to be, of all that were grown in `steps` steps.
fn shortened(chains: &Chains, planted: bool, steps: u64) -> (usize, usize) {
    let scene = room();
    let mut plan = chains.plan(&scene);
    if planted {
        let roulette = system!(Place::Loop(TraceStep::Continue), play_roulette).in_phases(Phases::STEP);
        let systems = &mut plan.tile.systems;
        let place = systems.iter().position(|planned| planned.spec == CONTINUE_TO_STOP);
        let place = place.expect("a system of every plan of paths");
        systems[place].spec = CONTINUE_TO_STOP.in_phases(Phases::BOOTSTRAP.and(Phases::SEED));
        systems.insert(place, SystemPlan::new(roulette, "planted"));
    }
    let mut render = chains.start_as(&scene, plan);
    let (mut short, mut grown) = (0, 0);
    for _ in 0..steps {
        render.run.burst(1, &|_| {});
        render.run.for_each_tile(&mut |chains, tile| {
            let lights_from = tile.world().resource::<TilePlace>().lights_from as usize;
            let lengths = tile.all::<PathLength, ChainTable>();
            let cameras = tile.all::<CameraVertices, ChainTable>();
            let lights = tile.all::<LightVertices, ChainTable>();
            let asked = cameras.into_iter().zip(lights).take(chains.len());
            for (chain, (t, s)) in asked.enumerate() {
                for (vertices, path) in [(t, chain), (s, lights_from + chain)] {
                    // A single vertex is where a subpath starts: nothing grows. Without any from the camera there is no proposal.
                    if vertices > 1 && t > 0 {
                        grown += 1;
                        short += usize::from(lengths[path] != vertices - 1);
                    }
                }
            }
        });
    }
    (short, grown)
}

#[test]
fn subpaths_in_dark_walls_are_as_long_as_their_mutations_ask_for() {
    for mutation in ["new_path", "bidirectional"] {
        let chains = only(mutation, 2, 128, 4096);
        let plan = chains.plan(&room());
        let has = |spec| plan.tile.systems.iter().any(|planned| planned.spec == spec);
        assert!(has(CONTINUE_TO_STOP) && !has(CONTINUE_PATHS), "{mutation}");
        let (short, grown) = shortened(&chains, false, 40);
        assert!(short == 0 && grown > 4000, "{mutation}: {short} of {grown}");
        let (short, _) = shortened(&chains, true, 40);
        assert!(short > 0, "{mutation}: roulette goes unnoticed");
    }
    // Paths that are followed until they end do play it.
    let independent = Chains {
        technique: Technique::Pssmlt,
        ..Chains::new(2, 128, 4096)
    };
    let plan = independent.plan(&room());
    assert!(plan.tile.systems.iter().any(|planned| planned.spec == CONTINUE_PATHS));
}

/// The light of every length, by the bootstraps of independent groups.
fn by_length() -> Vec<Estimate> {
    let render = only("new_path", 32, 256, 1 << 14).start(&room());
    let starts = render.run.starts();
    let of = |length: u32| {
        let light = |start: &Start| {
            let sum = start.class_weights[StateClass::BLOCKS + length as usize];
            // Targets count all three channels.
            sum / start.normalization.samples as f64 / 3.0
        };
        Estimate::of(&starts.iter().map(light).collect::<Vec<f64>>())
    };
    (1..=DEPTH).map(of).collect()
}

#[test]
fn paths_in_dark_walls_have_the_light_of_every_length() {
    let family = Family { tests: DEPTH as usize };
    for (estimate, k) in by_length().into_iter().zip(1..) {
        let expected = libm::pow(f64::from(DARK as f32), f64::from(k - 1));
        // A rounding of an f32 per edge.
        let slack = 2e-7 * expected * f64::from(k);
        family.is(&format!("{k} edges"), estimate, expected, slack, 0.1);
        family.is_not(&format!("{k} edges, 10 % off"), estimate, 1.1 * expected, slack);
    }
}

#[test]
fn chains_in_dark_walls_have_all_light() {
    let room = room();
    let mean = |seed| {
        let picture = paths(1, 256, 1 << 13).seeded(seed).run(&room, 60).picture();
        let sum: f64 = picture.rgb.iter().map(|rgb| f64::from(rgb.g)).sum();
        sum / picture.rgb.len() as f64
    };
    let estimate = Estimate::of(&(1..=16).map(mean).collect::<Vec<f64>>());
    let expected = (1..=DEPTH).fold(0.0, |sum, _| 1.0 + DARK * sum);
    let family = Family { tests: 1 };
    family.is("the picture", estimate, expected, 1e-5, 0.04);
    // Without any light that is reflected.
    family.is_not("the picture of first edges", estimate, 1.0, 0.0);
}
