//! Needles: states that are far brighter than all others, so that chains that got there are turned down again and again. No proposal is
//! ever forced, however long that goes on; and how long it does is known: a chain at x takes an independent proposal y with the
//! probability min(1, W(y) / W(x)), W = f / T, so in the mean with b / W(x) where W(x) is the largest there is. Waits are geometric.

use super::paths;
use crate::physics::enclosure::walls;
use crate::support::chains::{Chains, column};
use crate::support::scenes::as_written;
use crate::support::verdict::{ALPHA, Family, say};
use bevy_ecs::system::Res;
use chainlight::chain::{
    ChosenMutation, ForwardDensity, LongestRejections, ProposedTarget, Rejections, ReverseDensity, Target,
};
use chainlight::path::ChainTable;
use chainlight::plan::{Phases, Place, Stage, SystemPlan};
use chainlight::render::{ChainRender, Findings};
use chainlight::scene::Scene;
use chainlight::stats::z_test::{Estimate, z_threshold};
use chainlight::system;
use chainlight::systems::list::DECIDE;
use chainlight::systems::tile::TilePlace;
use chainlight::table::{Read, Rows, Write};
use std::sync::Arc;

const GROUPS: u32 = 16;
const STEPS: u64 = 20;
const FAMILY: Family = Family { tests: 3 };

/// A closed room that emits and reflects alike everywhere: W is bounded by a few times its mean.
fn room() -> Arc<Scene> {
    as_written(&format!(
        "(version: 1, settings: (max_depth: 4),
          camera: Perspective(origin: (0.3, -0.4, 0.5), target: (-0.2, 0.1, -1), fov: 70),
          film: (width: 8, height: 8),
          materials: {{\"wall\": Diffuse(reflectance: (0.5, 0.5, 0.5))}},
          shapes: [{}])",
        walls()
    ))
}

/// Makes a needle of the state of every chain whose last proposal was an independent one that brings light, since that tells its
/// density: W there becomes `times` b. Which chains those are.
fn make_needles(render: &ChainRender, times: f64) -> Vec<bool> {
    // Tiles come in any order.
    let mut needles = vec![false; render.run.counts().total() as usize];
    let b: f64 = render.run.normalizations().iter().sum::<f64>() / f64::from(GROUPS);
    let mutations = &render.run.chains().mutations;
    let is_independent = |number: u32| ["new_path", "large_step"].contains(&mutations[number as usize].mutation.name());
    render.run.for_each_tile(&mut |chains, tile| {
        let count = chains.len();
        let (forward, reverse) = (
            tile.all::<ForwardDensity, ChainTable>(),
            tile.all::<ReverseDensity, ChainTable>(),
        );
        let chosen = tile.all::<ChosenMutation, ChainTable>();
        let proposed = tile.all::<ProposedTarget, ChainTable>();
        let mut targets = tile.all::<Target, ChainTable>();
        let rejections = tile.all::<Rejections, ChainTable>();
        for chain in 0..count {
            let took = rejections[chain] == 0;
            let tells = is_independent(chosen[chain]) && proposed[chain] > 0.0;
            needles[chains.start as usize + chain] = tells;
            if tells {
                // Densities are kept as logarithms.
                let density = if took { forward[chain] } else { reverse[chain] };
                targets[chain] = (times * b * libm::exp(density)) as f32;
            }
        }
        tile.write::<Target, ChainTable>(&targets[..count]);
        tile.write::<Rejections, ChainTable>(&vec![0; count]);
        tile.write::<LongestRejections, ChainTable>(&vec![0; count]);
    });
    needles
}

/// The planted mistake: whatever comes after ten rejections is taken.
fn force_the_eleventh(
    place: Res<TilePlace>,
    rejections: Read<Rejections, ChainTable>,
    mut targets: Write<Target, ChainTable>,
) {
    let (rejections, targets) = (rejections.rows(), targets.rows());
    for chain in (0..place.chains as usize).filter(|&chain| rejections.at(chain) >= 10) {
        targets.put(chain, f32::MIN_POSITIVE);
    }
}

fn only(mut chains: Chains, mutation: &str) -> Chains {
    chains.options.mutations = chains.options.mutations.only(mutation).expect("a mutation");
    chains
}

/// Chains of the two techniques, with nothing but independent proposals.
fn independent(chains: u32) -> [(&'static str, Chains); 2] {
    [
        ("mlt", only(paths(GROUPS, chains, 1 << 14), "new_path")),
        ("pssmlt", only(Chains::new(GROUPS, chains, 1 << 14), "large_step")),
    ]
}

/// Chains after some steps from needles, and which of them were on one.
fn after(chains: &Chains, times: f64, steps: u64, forced: bool) -> (ChainRender, Vec<bool>) {
    let scene = room();
    let mut plan = chains.plan(&scene);
    if forced {
        let force = system!(Place::Stage(Stage::Accept), force_the_eleventh).in_phases(Phases::STEP);
        let systems = &mut plan.tile.systems;
        let decide = systems.iter().position(|planned| planned.spec == DECIDE);
        let decide = decide.expect("chains decide");
        systems.insert(decide, SystemPlan::new(force, "planted"));
    }
    let mut render = chains.start_as(&scene, plan);
    render.run.burst(1, &|_| {});
    let needles = make_needles(&render, times);
    render.run.burst(steps, &|_| {});
    (render, needles)
}

/// The share of needles that their chains have not left in `steps` steps.
fn stayed((render, needles): &(ChainRender, Vec<bool>), steps: u64) -> Estimate {
    let (rejections, longest) = (column::<Rejections>(render), column::<LongestRejections>(render));
    let chains = rejections.iter().zip(&longest).zip(needles);
    let stays = chains
        .filter(|(_, needle)| **needle)
        .map(|((&rejections, &longest), _)| {
            assert_eq!(u64::from(rejections) == steps, u64::from(longest) == steps);
            f64::from(u8::from(u64::from(rejections) == steps))
        });
    Estimate::of(&stays.collect::<Vec<f64>>())
}

#[test]
fn chains_wait_on_a_needle_as_long_as_its_brightness_says() {
    let expected = libm::pow(1.0 - 1.0 / 20.0, STEPS as f64);
    // b, which needles are multiples of, is known to half a percent: twenty steps of it.
    let slack = 0.005 * expected;
    for (name, chains) in independent(512) {
        let share = stayed(&after(&chains, 20.0, STEPS, false), STEPS);
        FAMILY.is(&format!("{name}, 20 times b"), share, expected, slack, 0.13);
        let forced = stayed(&after(&chains, 20.0, STEPS, true), STEPS);
        FAMILY.is_not(&format!("{name}, forced"), forced, expected, slack);
    }
}

#[test]
fn no_proposal_is_forced_however_many_were_turned_down() {
    const LONG: u64 = 600;
    for (name, chains) in independent(32) {
        let render = after(&chains, 1e12, LONG, false);
        assert_eq!(stayed(&render, LONG).mean, 1.0, "{name}");
        // The longest run is told.
        assert_eq!(u64::from(Findings::of(&render.0).longest_rejections), LONG, "{name}");
    }
}

#[test]
fn new_paths_among_other_mutations_bound_the_wait() {
    // One proposal in two is a new path: with the others, chains get away no later than with those alone.
    let chains = only(paths(GROUPS, 512, 1 << 14), "new_path").set("bidirectional:weight=1");
    let share = stayed(&after(&chains, 20.0, STEPS, false), STEPS);
    let bound = libm::pow(1.0 - 0.5 / 20.0, STEPS as f64);
    let most = share.mean + z_threshold(ALPHA, FAMILY.tests) * share.error;
    say(&format!(
        "one new path in two proposals: {:.4} stay, at most {bound:.4}",
        share.mean
    ));
    assert!(most < 1.02 * bound, "{share:?}, at most {bound}");
}
