//! Replays of chains whose states are whole paths, against the columns of whole renders.

use super::chains::{splat_bits, splats, visit};
use super::{SEED, look, plan_of, scene};
use chainlight::chain::{
    Acceptance, ChosenMutation, Class, ForwardDensity, ProposedClass, ProposedTarget, Rejections, ReverseDensity,
    Target,
};
use chainlight::path::{ChainTable, ProposedSplatCount, ProposedSplatTable, SplatCount, SplatTable};
use chainlight::plan::Technique;
use chainlight::render::{ChainRender, Rendering};
use chainlight::replay::{Replay, State};
use chainlight::systems::propose::mutations;
use std::sync::Arc;

/// Splats as pixels and bits of colours.
type Splats = Vec<(u32, [u32; 3])>;

const CHAINS: [u32; 5] = [0, 15, 40, 63, 119];
const STEPS: [u64; 6] = [0, 1, 2, 19, 40, 80];

/// What a chain's columns hold between two steps.
#[derive(Debug, PartialEq)]
struct Held {
    target: u32,
    class: u32,
    splats: Splats,
    rejections: u32,
}

/// What they hold of the step's proposal and decision. Of a proposal that is no path, the class and the splats are left over.
#[derive(Debug, PartialEq)]
struct Offered {
    mutation: usize,
    target: u32,
    found: Option<(u32, Splats)>,
    densities: Option<[u64; 2]>,
    acceptance: u64,
}

fn held(render: &ChainRender, chain: u32) -> Held {
    let (capacity, mut held) = (render.plan.tile.capacity() as usize, None);
    visit(render, chain, &mut |world, c| {
        let count = world.at::<SplatCount, ChainTable>(c).expect("a column");
        held = Some(Held {
            target: world.at::<Target, ChainTable>(c).expect("a column").to_bits(),
            class: world.at::<Class, ChainTable>(c).expect("a column"),
            splats: splats::<SplatTable>(world, count, c, capacity),
            rejections: world.at::<Rejections, ChainTable>(c).expect("a column"),
        });
    });
    held.expect("the chain was visited")
}

fn offered(render: &ChainRender, chain: u32) -> Offered {
    let (capacity, mut offered) = (render.plan.tile.capacity() as usize, None);
    visit(render, chain, &mut |world, c| {
        let target = world.at::<ProposedTarget, ChainTable>(c).expect("a column");
        let count = world.at::<ProposedSplatCount, ChainTable>(c).expect("a column");
        let class = world.at::<ProposedClass, ChainTable>(c).expect("a column");
        let forward = world.at::<ForwardDensity, ChainTable>(c).expect("a column");
        let reverse = world.at::<ReverseDensity, ChainTable>(c).expect("a column");
        offered = Some(Offered {
            mutation: world.at::<ChosenMutation, ChainTable>(c).expect("a column") as usize,
            target: target.to_bits(),
            found: (target > 0.0).then(|| (class, splats::<ProposedSplatTable>(world, count, c, capacity))),
            densities: (target > 0.0).then(|| [forward, reverse].map(f64::to_bits)),
            acceptance: world.at::<Acceptance, ChainTable>(c).expect("a column").to_bits(),
        });
    });
    offered.expect("the chain was visited")
}

fn shown_state(state: Option<&State>, width: u32) -> Held {
    let state = state.expect("chains have states");
    Held {
        target: state.target.to_bits(),
        class: state.class.number,
        splats: splat_bits(&state.splats, width),
        rejections: state.rejections,
    }
}

fn shown_offer(replay: &Replay, width: u32) -> Offered {
    let proposal = &replay.proposal;
    let target = proposal.target.expect("chains have targets");
    let class = proposal.class.as_ref().map(|class| class.number);
    let densities = proposal.densities.map(|d| [d.forward, d.reverse].map(f64::to_bits));
    Offered {
        mutation: replay.mutation.as_ref().expect("chains have mutations").number,
        target: target.to_bits(),
        found: (target > 0.0).then(|| (class.expect("a class"), splat_bits(&proposal.splats, width))),
        densities: (target > 0.0).then(|| densities.expect("densities")),
        acceptance: replay.decision.expect("chains decide").acceptance.to_bits(),
    }
}

#[test]
fn a_replay_of_paths_holds_what_the_render_held() {
    let scene = scene();
    // [turned down, taken], and which mutations were tried.
    let (mut decided, mut tried) = ([0; 2], vec![0; mutations().iter().count()]);
    for tile in [None, Some(16), Some(32)] {
        let plan = plan_of(Technique::Mlt, &scene, tile, true);
        let mut render = ChainRender::new(Arc::clone(&scene), plan.clone(), SEED, 2).expect("a small film");
        for step in STEPS {
            render.burst(step - render.run.steps(), &|_| ());
            let before = CHAINS.map(|chain| held(&render, chain));
            render.burst(1, &|_| ());
            for (chain, before) in CHAINS.into_iter().zip(before) {
                let replay = look(&scene, &plan, chain, step);
                let case = format!("tile {tile:?}, chain {chain}, step {step}");
                assert_eq!(shown_state(replay.before.as_ref(), scene.width), before, "{case}");
                assert_eq!(shown_offer(&replay, scene.width), offered(&render, chain), "{case}");
                let after = shown_state(replay.after.as_ref(), scene.width);
                assert_eq!(after, held(&render, chain), "{case}");
                let mutation = replay.mutation.as_ref().expect("chains have mutations");
                decided[usize::from(replay.decision.expect("chains decide").accepted)] += 1;
                tried[mutation.number] += 1;
            }
        }
    }
    let kinds = tried.iter().filter(|&&n| n > 0).count();
    assert!(decided.iter().all(|&n| n > 10) && kinds >= 4, "{decided:?} {tried:?}");
}
