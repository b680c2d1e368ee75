//! Chains that start from the same state go their own ways: every chain draws numbers of its own, whichever sample of the bootstrap it
//! was given.

use super::paths;
use crate::physics::enclosure::walls;
use crate::support::chains::{Chains, column};
use crate::support::scenes::as_written;
use crate::support::verdict::{ALPHA, Family, POWER, say};
use bevy_ecs::system::Res;
use chainlight::chain::{Class, KeyChain, ProposedTarget, StateClass, Target};
use chainlight::path::{ChainKey, ChainTable};
use chainlight::plan::{Phases, Place, Stage, SystemPlan};
use chainlight::sampling::StreamKey;
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use chainlight::system;
use chainlight::systems::list::{KEY_CHAINS, WEIGH_SAMPLES};
use chainlight::systems::tile::TilePlace;
use chainlight::table::{Rows, Write};
use std::sync::Arc;

/// Chains of a group, all of which get the same seed.
const CHAINS: u32 = 16;
const GROUPS: u32 = 512;
/// Renders of so many groups, each with a seed of its own.
const RUNS: u64 = 3;
/// Pixels along each side of the film, each a block of its own.
const SIDE: u32 = 8;
/// Enough for chains to forget where they start: what they still share then can only be what they draw.
const STEPS: u64 = 30;

/// A closed room as bright everywhere on the film: where chains are seen is uniform.
fn room() -> Arc<Scene> {
    as_written(&format!(
        "(version: 1, settings: (max_depth: 4),
          camera: Perspective(origin: (0.3, -0.4, 0.5), target: (-0.2, 0.1, -1), fov: 70),
          film: (width: {SIDE}, height: {SIDE}),
          materials: {{\"wall\": Diffuse(reflectance: (0.5, 0.5, 0.5))}},
          shapes: [{}])",
        walls()
    ))
}

/// Leaves the first sample of every group's bootstrap alone with light.
fn one_has_light(place: Res<TilePlace>, mut targets: Write<ProposedTarget, ChainTable>) {
    let targets = targets.rows();
    for chain in 0..place.chains {
        if !(place.first_chain + chain).is_multiple_of(CHAINS) {
            targets.put(chain as usize, 0.0);
        }
    }
}

/// The planted mistake: chains draw what the sample that they start from would draw.
fn share_keys(
    place: Res<TilePlace>,
    mut keys: Write<ChainKey, ChainTable>,
    mut key_chains: Write<KeyChain, ChainTable>,
) {
    let (keys, key_chains) = (keys.rows(), key_chains.rows());
    for chain in 0..place.chains {
        let global = place.first_chain + chain;
        let first = global - global % CHAINS;
        keys.put(chain as usize, StreamKey::new(place.seed, first, place.step).bits());
        key_chains.put(chain as usize, first);
    }
}

/// Where chains are seen after their steps, group by group: groups whose sample has light.
fn places(chains: &Chains, planted: bool) -> Vec<Vec<StateClass>> {
    let scene = room();
    let mut plan = chains.plan(&scene);
    let mut plant = |system, neighbour, after| {
        let systems = &mut plan.tile.systems;
        let place = systems.iter().position(|planned| planned.spec == neighbour);
        let place = place.expect("a system of every plan of chains") + usize::from(after);
        systems.insert(place, SystemPlan::new(system, "planted"));
    };
    let one = system!(Place::Stage(Stage::Evaluate), one_has_light).in_phases(Phases::BOOTSTRAP);
    plant(one, WEIGH_SAMPLES, false);
    if planted {
        let shared = system!(Place::Stage(Stage::Propose), share_keys).in_phases(Phases::STEP);
        plant(shared, KEY_CHAINS, true);
    }
    let mut render = chains.start_as(&scene, plan);
    let seeds = column::<Target>(&render);
    for group in seeds.chunks(CHAINS as usize) {
        assert!(group.iter().all(|seed| *seed == group[0]));
    }
    render.run.burst(STEPS, &|_| {});
    let classes = column::<Class>(&render);
    let groups = classes.chunks(CHAINS as usize).zip(render.run.starts());
    groups
        .filter(|(_, start)| start.distinct_seeds == 1)
        .map(|(classes, _)| classes.iter().map(|&class| StateClass(class)).collect())
        .collect()
}

/// The correlation between chains of one seed of where they are seen: across the film, and up it.
fn correlations(groups: &[Vec<StateClass>]) -> [Estimate; 2] {
    // That of the number of a pixel on a uniform film.
    let variance = (1.0 - 1.0 / f64::from(SIDE * SIDE)) / 12.0;
    [0, 1].map(|axis| {
        let of_group = |classes: &Vec<StateClass>| {
            let places = classes.iter().map(|class| {
                let (block, n) = (class.block(), f64::from(SIDE));
                (f64::from([block % SIDE, block / SIDE][axis]) + 0.5) / n - 0.5
            });
            // Over all pairs of different chains.
            let (sum, squares) = places.fold((0.0, 0.0), |(sum, squares), x| (sum + x, squares + x * x));
            let n = f64::from(CHAINS);
            (sum * sum - squares) / (n * (n - 1.0) * variance)
        };
        Estimate::of(&groups.iter().map(of_group).collect::<Vec<f64>>())
    })
}

#[test]
fn chains_of_one_seed_are_uncorrelated() {
    let path_space = paths(GROUPS, CHAINS, CHAINS).set("new_path:weight=4");
    let primary = Chains::new(GROUPS, CHAINS, CHAINS);
    let family = Family { tests: 4 };
    for (name, chains) in [("mlt", path_space), ("pssmlt", primary)] {
        let groups: Vec<_> = (1..=RUNS)
            .flat_map(|seed| places(&chains.seeded(seed), false))
            .collect();
        for (axis, found) in ["across", "up"].into_iter().zip(correlations(&groups)) {
            let z = found.against(0.0);
            let visible = z.smallest_visible_bias(ALPHA, family.tests, POWER);
            say(&format!(
                "{name}, {axis}: correlation {:.4} over {} groups, z {:.2}, sees {visible:.4}",
                found.mean,
                groups.len(),
                z.z
            ));
            assert!(z.passes(ALPHA, family.tests) && visible < 0.03, "{name}, {axis}: {z:?}");
        }
        for found in correlations(&places(&chains, true)) {
            family.is_not(&format!("{name}, one stream for all"), found, 0.0, 0.0);
        }
    }
}
