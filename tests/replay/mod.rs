//! Replays show what renders did, bit for bit.

mod chains;
mod command;
mod paths;
mod refusals;
mod samples;

use chainlight::plan::{ChainSettings, Plan, PlanOptions, Technique};
use chainlight::replay::{Moment, Replay, replay};
use chainlight::scene::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Pixels along each side of the film.
const SIZE: u32 = 24;
/// The seed of every render here.
const SEED: u64 = 11;

/// A scene with every kind of material, on a small film.
fn scene() -> Arc<Scene> {
    crate::support::scenes::shipped("cornell-glass.ron", SIZE)
}

/// A few small groups of chains of `pssmlt`, whose number no tile size divides.
fn plan(scene: &Scene, tile_size: Option<u32>, densities: bool) -> Plan {
    plan_of(Technique::Pssmlt, scene, tile_size, densities)
}

/// The same of any technique with chains.
fn plan_of(technique: Technique, scene: &Scene, tile_size: Option<u32>, densities: bool) -> Plan {
    let options = PlanOptions {
        tile_size,
        chains: ChainSettings {
            groups: 3,
            chains: Some(40),
            bootstrap: Some(800),
            densities,
        },
        ..PlanOptions::default()
    };
    Plan::with(scene, technique, &options).expect("the crate's mutations make a plan")
}

/// The replay of a moment.
fn look(scene: &Arc<Scene>, plan: &Plan, chain: u32, step: u64) -> Replay {
    let moment = Moment {
        seed: SEED,
        chain,
        step,
    };
    replay(scene, plan, moment, 1, &AtomicBool::new(false), &|_, _| ()).expect("the render has such a moment")
}

/// The light of a path, from what its vertices say: Σ (r₀ ⋯ r_d₋₁)(emission_d + connection_d).
fn summed(replay: &Replay) -> [f32; 3] {
    let (mut sum, mut throughput) = ([0.0; 3], [1.0; 3]);
    for pair in replay.proposal.vertices.windows(2) {
        for channel in 0..3 {
            throughput[channel] *= pair[0].ratio.to_array()[channel];
            sum[channel] += throughput[channel] * pair[1].emission.to_array()[channel];
            if let Some(connection) = pair[1].connection {
                sum[channel] += throughput[channel] * connection.to_array()[channel];
            }
        }
    }
    sum
}
