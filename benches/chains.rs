//! Chains in stages (`pssmlt`) against chains run depth first (`pssmlt-reference`), on the Cornell box and on two million
//! triangles: nanoseconds per mutation, by stage and by kind of mutation, from a thousand chains to a quarter of a million,
//! and what statistics, clock and schedule cost. Both techniques are in the same states, so the work is the same.
//!
//! `cargo bench --bench chains` prints tables; with `-- box`, `-- room` or `-- prices`, only that part. Rounds interleave
//! everything that is compared in one process: medians of ratios hold on a noisy machine, absolute times do not.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

#[path = "support/chains.rs"]
mod side_by_side;
mod support;

use bevy_ecs::schedule::{Schedules, SingleThreadedExecutor};
use chainlight::plan::{PlanOptions, Technique};
use chainlight::render::ChainRender;
use chainlight::scene::Scene;
use chainlight::systems::list::COUNT_VISITS;
use side_by_side::{Compared, GROUPS, GROWTH, ROUNDS, USUAL_CHAINS, burst, heading, ratio, rounds, stages};
use std::sync::Arc;
use support::{bumpy_room, shipped};

/// Pixels along each side of the film.
const SIZE: u32 = 64;
/// Rounds that look for differences of a percent or less.
const PRICE_ROUNDS: usize = 45;
const KINDS: [&str; 3] = ["large_step", "small_step", "identity"];

fn compared() -> Compared {
    Compared {
        techniques: [Technique::Pssmlt, Technique::PssmltReference],
        options: PlanOptions::default(),
        shortest: None,
    }
}

/// What is left out costs: steps as they are over steps without it, by interleaved rounds.
fn prices(scene: &Arc<Scene>) {
    let usual = || compared().start(scene, Technique::Pssmlt, USUAL_CHAINS, None);
    let without_clock = {
        let render = usual();
        render.run.for_each_tile(&mut |_, tile| {
            for (_, schedule) in tile.world_mut().resource_mut::<Schedules>().iter_mut() {
                schedule.set_executor(SingleThreadedExecutor::new());
            }
        });
        render
    };
    let without_visits = {
        let mut plan = usual().plan;
        plan.tile.systems.retain(|system| system.spec != COUNT_VISITS);
        let mut render = ChainRender::new(Arc::clone(scene), plan, 0, 1).expect("small films and one thread");
        burst(&mut render);
        render
    };
    let mut renders = [usual(), without_clock, without_visits, usual()];
    let figures = rounds(&mut renders, PRICE_ROUNDS);
    for (name, without) in [("the clock", 1), ("count_visits", 2), ("nothing (noise)", 3)] {
        println!(
            "  with {name:<16} {:.4} times the time without (median of {} pairs)",
            ratio(&figures[0], &figures[without]),
            PRICE_ROUNDS
        );
    }
}

/// Everything on one scene.
fn tables(name: &str, scene: &Arc<Scene>) {
    println!(
        "\n{name}: {} primitives, {SIZE} x {SIZE} pixels, {GROUPS} groups, one thread; ns per mutation",
        scene.geometry.primitive_count()
    );
    heading("mutation");
    let compared = compared();
    let mixture = compared.line("as usual", scene, USUAL_CHAINS, None, ROUNDS[0]);
    for kind in KINDS {
        compared.line(kind, scene, USUAL_CHAINS, Some(kind), ROUNDS[0]);
    }
    println!("  as usual, by stage:");
    stages(&mixture);
    heading("chains");
    for chains in GROWTH {
        compared.line(&chains.to_string(), scene, chains, None, ROUNDS[1]);
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // `cargo test --benches` runs this too, and wants no figures.
    if arguments.iter().any(|argument| argument == "--test") {
        return;
    }
    let parts = ["box", "room", "prices"];
    let asked = |part: &str| arguments.iter().any(|argument| argument == part);
    let wanted = |part| asked(part) || !parts.into_iter().any(asked);
    let box_scene = shipped("cornell-box", SIZE);
    if wanted("box") {
        tables("Cornell box", &box_scene);
    }
    if wanted("room") {
        tables("bumpy room", &bumpy_room(2_090_000, SIZE));
    }
    if wanted("prices") {
        println!("\nprices on the Cornell box:");
        prices(&box_scene);
    }
}
