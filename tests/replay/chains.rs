//! Replays of chains against the columns of whole renders.

use super::{SEED, look, plan, scene, summed};
use chainlight::chain::{
    Acceptance, ChosenMutation, Class, ForwardDensity, ProposedClass, ProposedTarget, Rejections, ReverseDensity,
    Target,
};
use chainlight::path::*;
use chainlight::plan::Plan;
use chainlight::render::{ChainRender, Rendering, TileWorld};
use chainlight::replay::{Coordinates, Replay, SplatAt, State};
use chainlight::table::Table;
use std::sync::Arc;

/// First and last of groups and of tiles, and some between.
const CHAINS: [u32; 6] = [0, 15, 39, 40, 63, 119];
const STEPS: [u64; 4] = [0, 1, 2, 37];

/// What a chain's columns hold between two steps.
#[derive(Debug, PartialEq)]
struct Held {
    target: u32,
    class: u32,
    film: [u64; 2],
    coordinates: Vec<VertexCoordinates>,
    splats: Vec<(u32, [u32; 3])>,
    rejections: u32,
}

/// What they hold of the step's proposal and decision.
#[derive(Debug, PartialEq)]
struct Offered {
    mutation: usize,
    film: [u64; 2],
    coordinates: Vec<VertexCoordinates>,
    length: u32,
    light: [u32; 3],
    target: u32,
    class: u32,
    splats: Vec<(u32, [u32; 3])>,
    acceptance: u64,
}

fn coordinates<T: Table>(world: &mut TileWorld, depth: u32, chain: usize, capacity: usize) -> Vec<VertexCoordinates> {
    let mut at = |d: u32| {
        let index = d as usize * capacity + chain;
        VertexCoordinates {
            choice: world.at::<PrimaryChoice, T>(index).expect("a column"),
            light: world.at::<PrimaryLight, T>(index).expect("a column"),
            scatter: world.at::<PrimaryScatter, T>(index).expect("a column"),
            roulette: world.at::<PrimaryRoulette, T>(index).expect("a column"),
            lobe: world.at::<PrimaryLobe, T>(index).unwrap_or_default(),
        }
    };
    (0..depth).map(&mut at).collect()
}

pub fn splats<T: Table>(world: &mut TileWorld, count: u32, chain: usize, capacity: usize) -> Vec<(u32, [u32; 3])> {
    let mut at = |k: u32| {
        let index = k as usize * capacity + chain;
        let color = world.at::<SplatColor, T>(index).expect("a column");
        let pixel = world.at::<SplatPixel, T>(index).expect("a column");
        (pixel, color.to_array().map(f32::to_bits))
    };
    (0..count).map(&mut at).collect()
}

/// Lets `look` see the world of `chain`, with the chain's number in it.
pub fn visit(render: &ChainRender, chain: u32, look: &mut dyn FnMut(&mut TileWorld, usize)) {
    let mut found = 0;
    render.run.for_each_tile(&mut |range, world| {
        if range.contains(&chain) {
            look(world, (chain - range.start) as usize);
            found += 1;
        }
    });
    assert_eq!(found, 1);
}

fn held(render: &ChainRender, chain: u32) -> Held {
    let (capacity, mut held) = (render.plan.tile.size as usize, None);
    visit(render, chain, &mut |world, c| {
        let depth = world.at::<PrimaryDepth, ChainTable>(c).expect("a column");
        let count = world.at::<SplatCount, ChainTable>(c).expect("a column");
        held = Some(Held {
            target: world.at::<Target, ChainTable>(c).expect("a column").to_bits(),
            class: world.at::<Class, ChainTable>(c).expect("a column"),
            film: world.at::<PrimaryFilm, ChainTable>(c).expect("a column"),
            coordinates: coordinates::<PrimaryTable>(world, depth, c, capacity),
            splats: splats::<SplatTable>(world, count, c, capacity),
            rejections: world.at::<Rejections, ChainTable>(c).expect("a column"),
        });
    });
    held.expect("the chain was visited")
}

fn offered(render: &ChainRender, chain: u32) -> Offered {
    let (capacity, mut offered) = (render.plan.tile.size as usize, None);
    visit(render, chain, &mut |world, c| {
        let depth = world.at::<ProposedDepth, ChainTable>(c).expect("a column");
        let count = world.at::<ProposedSplatCount, ChainTable>(c).expect("a column");
        let light = world.at::<Contribution, ChainTable>(c).expect("a column");
        offered = Some(Offered {
            mutation: world.at::<ChosenMutation, ChainTable>(c).expect("a column") as usize,
            film: world.at::<ProposedFilm, ChainTable>(c).expect("a column"),
            coordinates: coordinates::<ProposedPrimaryTable>(world, depth, c, capacity),
            length: world.at::<PathLength, ChainTable>(c).expect("a column"),
            light: light.to_array().map(f32::to_bits),
            target: world.at::<ProposedTarget, ChainTable>(c).expect("a column").to_bits(),
            class: world.at::<ProposedClass, ChainTable>(c).expect("a column"),
            splats: splats::<ProposedSplatTable>(world, count, c, capacity),
            acceptance: world.at::<Acceptance, ChainTable>(c).expect("a column").to_bits(),
        });
        let densities = [
            world.at::<ForwardDensity, ChainTable>(c),
            world.at::<ReverseDensity, ChainTable>(c),
        ];
        assert!(densities.iter().all(Option::is_some));
    });
    offered.expect("the chain was visited")
}

fn bits(coordinates: &[Coordinates]) -> Vec<VertexCoordinates> {
    coordinates.iter().map(|vertex| vertex.bits).collect()
}

pub fn splat_bits(splats: &[SplatAt], width: u32) -> Vec<(u32, [u32; 3])> {
    let bits = |s: &SplatAt| (s.pixel[1] * width + s.pixel[0], s.color.to_array().map(f32::to_bits));
    splats.iter().map(bits).collect()
}

fn shown_state(state: Option<&State>, width: u32) -> Held {
    let state = state.expect("chains have states");
    Held {
        target: state.target.to_bits(),
        class: state.class.number,
        film: state.film.as_ref().and_then(|film| film.bits).expect("a start").0,
        coordinates: bits(&state.coordinates),
        splats: splat_bits(&state.splats, width),
        rejections: state.rejections,
    }
}

fn shown_offer(replay: &Replay, width: u32) -> Offered {
    let proposal = &replay.proposal;
    Offered {
        mutation: replay.mutation.as_ref().expect("chains have mutations").number,
        film: proposal.film.as_ref().and_then(|film| film.bits).expect("a start").0,
        coordinates: bits(&proposal.coordinates),
        length: proposal.vertices.len() as u32 - 1,
        light: proposal.contribution.expect("light").to_array().map(f32::to_bits),
        target: proposal.target.expect("chains have targets").to_bits(),
        class: proposal.class.as_ref().expect("chains have classes").number,
        splats: splat_bits(&proposal.splats, width),
        acceptance: replay.decision.expect("chains decide").acceptance.to_bits(),
    }
}

fn render(plan: &Plan) -> ChainRender {
    ChainRender::new(scene(), plan.clone(), SEED, 2).expect("a small film and few threads")
}

#[test]
fn a_replay_holds_what_the_render_held_before_during_and_after_the_step() {
    let scene = scene();
    // [turned down, taken], and which mutations were tried.
    let (mut decided, mut tried) = ([0; 2], [0; 2]);
    for tile in [None, Some(16), Some(32)] {
        let plan = plan(&scene, tile, false);
        let mut render = render(&plan);
        for step in STEPS {
            render.burst(step - render.run.steps(), &|_| ());
            let before = CHAINS.map(|chain| held(&render, chain));
            render.burst(1, &|_| ());
            for (chain, before) in CHAINS.into_iter().zip(before) {
                let replay = look(&scene, &plan, chain, step);
                let case = format!("tile {tile:?}, chain {chain}, step {step}");
                assert_eq!(shown_state(replay.before.as_ref(), scene.width), before, "{case}");
                assert_eq!(shown_offer(&replay, scene.width), offered(&render, chain), "{case}");
                assert_eq!(
                    shown_state(replay.after.as_ref(), scene.width),
                    held(&render, chain),
                    "{case}"
                );
                let mutation = replay.mutation.as_ref().expect("chains have mutations");
                decided[usize::from(replay.decision.expect("chains decide").accepted)] += 1;
                tried[mutation.number] += 1;
            }
        }
    }
    assert!(decided.iter().chain(&tried).all(|&n| n > 3), "{decided:?} {tried:?}");
}

#[test]
fn the_tile_size_of_the_plan_does_not_show() {
    let scene = scene();
    let json = |tile| {
        let replay = look(&scene, &plan(&scene, tile, false), 57, 9);
        serde_json::to_string(&replay).expect("JSON")
    };
    let whole = json(None);
    assert_eq!(whole, json(Some(16)));
    assert_eq!(whole, json(Some(32)));
}

#[test]
fn the_vertices_add_up_to_the_proposals_light_and_target() {
    let (scene, mut lit) = (scene(), 0);
    let plan = plan(&scene, None, false);
    for step in 0..60 {
        let replay = look(&scene, &plan, 21, step);
        let (sum, light) = (summed(&replay), replay.proposal.contribution.expect("light").to_array());
        assert_eq!(sum.map(f32::to_bits), light.map(f32::to_bits), "step {step}");
        let target = replay.proposal.target.expect("chains have targets");
        assert_eq!(target.to_bits(), (sum[0] + sum[1] + sum[2]).to_bits(), "step {step}");
        lit += usize::from(target > 0.0);
    }
    assert!(lit > 20, "{lit} proposals have light");
}

/// One step's state after is the next one's before; a decision says what its number says.
#[test]
fn steps_join_and_decisions_follow_from_their_numbers() {
    let scene = scene();
    let plan = plan(&scene, None, false);
    let mut last: Option<State> = None;
    for step in 0..60 {
        let replay = look(&scene, &plan, 90, step);
        if let Some(last) = last {
            assert_eq!(replay.before.as_ref(), Some(&last), "step {step}");
        }
        let decision = replay.decision.expect("chains decide");
        let expected = decision
            .uniform
            .map_or(decision.acceptance == 1.0, |u| u < decision.acceptance);
        assert_eq!(decision.accepted, expected, "step {step}: {decision:?}");
        if decision.accepted {
            let (after, proposal) = (replay.after.as_ref().expect("a state"), &replay.proposal);
            assert_eq!(
                (Some(after.target), &after.coordinates),
                (proposal.target, &proposal.coordinates)
            );
        }
        last = replay.after;
    }
}

/// The densities are the same whether the render keeps them whole or the replay puts them together.
#[test]
fn densities_are_whole_whatever_the_plan_keeps() {
    let scene = scene();
    for step in 0..30 {
        let [lean, whole] = [false, true].map(|densities| {
            let replay = look(&scene, &plan(&scene, None, densities), 5, step);
            (
                replay.proposal.densities.expect("chains have densities"),
                replay.decision,
            )
        });
        assert_eq!(lean, whole, "step {step}");
        let (densities, _) = lean;
        assert_eq!(densities.forward, densities.reverse, "both mutations are symmetric");
        assert_eq!(densities.forward, densities.choice[0] + densities.common);
    }
}

#[test]
fn a_group_is_told_with_its_bootstrap() {
    let scene = scene();
    let plan = plan(&scene, None, false);
    let render = render(&plan);
    for chain in [3, 41, 119] {
        let group = look(&scene, &plan, chain, 0).group.expect("chains have groups");
        let start = &render.run.starts()[group.number as usize];
        assert_eq!(
            (group.number, group.first_chain, group.chains),
            (chain / 40, chain / 40 * 40, 40)
        );
        assert_eq!(group.b.to_bits(), start.normalization.b.to_bits());
        assert_eq!(group.samples, start.normalization.samples);
        let sample = group.started_from.expect("there is light");
        assert!((group.first_chain..group.first_chain + 40).contains(&sample.chain) && sample.round < 20);
    }
}

/// Long before the first state: no sample has light, and the replay says so.
#[test]
fn chains_without_light_are_shown_too() {
    let text = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
        film: (width: 8, height: 8), materials: {"m": Diffuse(reflectance: (1, 1, 1))},
        shapes: [(shape: Sphere(radius: 1), material: "m")])"#;
    let dark = crate::support::scenes::inline(text, 8);
    let replay = look(&Arc::clone(&dark), &plan(&dark, None, false), 50, 3);
    let group = replay.group.expect("chains have groups");
    assert_eq!((group.b, group.started_from), (0.0, None));
    assert!(!replay.decision.expect("chains decide").accepted);
    assert_eq!(replay.after.expect("a state").target, 0.0);
    assert!(replay.proposal.vertices.is_empty());
}
