//! Chains in stages (`pssmlt`) against chains run depth first (`pssmlt-reference`), on the Cornell box and on two million
//! triangles: nanoseconds per mutation, by stage and by kind of mutation, from a thousand chains to a quarter of a million,
//! and what statistics, clock and schedule cost. Both techniques are in the same states, so the work is the same.
//!
//! `cargo bench --bench chains` prints tables; with `-- box`, `-- room` or `-- prices`, only that part. Rounds interleave
//! everything that is compared in one process: medians of ratios hold on a noisy machine, absolute times do not.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

mod support;

use bevy_ecs::schedule::{Schedules, SingleThreadedExecutor};
use chainlight::plan::{ChainSettings, Place, Plan, PlanOptions, Stage, Technique};
use chainlight::render::{ChainRender, Rendering};
use chainlight::scene::Scene;
use chainlight::systems::SystemCost;
use chainlight::systems::list::{COUNT_VISITS, TRACE_LOOP};
use std::sync::Arc;
use std::time::Instant;
use support::{bumpy_room, median, shipped};

/// Pixels along each side of the film.
const SIZE: u32 = 64;
const GROUPS: u32 = 16;
/// Rounds that compare two techniques, and two of many chains.
const ROUNDS: [usize; 2] = [15, 7];
/// Rounds that look for differences of a percent or less.
const PRICE_ROUNDS: usize = 45;
/// Mutations of a round, in all chains together; never less than one step.
const MUTATIONS_PER_ROUND: u64 = 1 << 15;
/// Chains of all groups, where it is not their number that is looked at.
const USUAL_CHAINS: u32 = 1 << 14;
/// Numbers of chains that are compared: 1k to 256k.
const GROWTH: [u32; 5] = [1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18];
const TECHNIQUES: [Technique; 2] = [Technique::Pssmlt, Technique::PssmltReference];
const KINDS: [&str; 3] = ["large_step", "small_step", "identity"];

/// Chains at their first states, on one thread. `only` is the one mutation that is tried; the usual mixture if there is none.
fn start(scene: &Arc<Scene>, technique: Technique, chains: u32, only: Option<&str>) -> ChainRender {
    let mut options = PlanOptions {
        chains: ChainSettings {
            groups: GROUPS,
            chains: Some(chains / GROUPS),
            bootstrap: Some((4 * chains / GROUPS).max(4096)),
            ..ChainSettings::default()
        },
        ..PlanOptions::default()
    };
    if let Some(name) = only {
        options.mutations = options.mutations.only(name).expect("a mutation of this crate");
    }
    let plan = Plan::with(scene, technique, &options).expect("mutations of this crate");
    let mut render = ChainRender::new(Arc::clone(scene), plan, 0, 1).expect("small films and one thread");
    // Tables, caches and branch predictors.
    burst(&mut render);
    render
}

/// Runs the mutations of a round. Returns nanoseconds per mutation.
fn burst(render: &mut ChainRender) -> f64 {
    let chains = u64::from(render.chains());
    let steps = (MUTATIONS_PER_ROUND / chains).max(1);
    let began = Instant::now();
    render.run.burst(steps, &|_| {});
    began.elapsed().as_nanos() as f64 / (chains * steps) as f64
}

/// Nanoseconds per mutation of each render, by interleaved rounds.
fn rounds(renders: &mut [ChainRender], count: usize) -> Vec<Vec<f64>> {
    let mut figures = vec![Vec::new(); renders.len()];
    for _ in 0..count {
        for (render, figures) in renders.iter_mut().zip(&mut figures) {
            figures.push(burst(render));
        }
    }
    figures
}

/// The median of `a` over `b`, round by round.
fn ratio(a: &[f64], b: &[f64]) -> f64 {
    median(a.iter().zip(b).map(|(a, b)| a / b).collect())
}

/// A line: depth first, staged, and how many times as fast staging is.
fn compare(name: &str, scene: &Arc<Scene>, chains: u32, only: Option<&str>, count: usize) -> ChainRender {
    let mut renders = TECHNIQUES.map(|technique| start(scene, technique, chains, only));
    let figures = rounds(&mut renders, count);
    let bytes: u64 = renders[0].plan.tile.bytes() / u64::from(renders[0].plan.tile.size) * u64::from(chains);
    println!(
        "  {name:<14} {:>10.0} {:>10.0} {:>10.3} {:>10} {:>12}",
        median(figures[1].clone()),
        median(figures[0].clone()),
        ratio(&figures[1], &figures[0]),
        renders[0].plan.tile.size,
        bytes >> 20,
    );
    let [staged, _] = renders;
    staged
}

fn heading(first: &str) {
    println!(
        "  {first:<14} {:>10} {:>10} {:>10} {:>10} {:>12}",
        "depth 1st", "staged", "times", "tile", "MiB, staged"
    );
}

/// Nanoseconds per mutation by stage, and by system in the trace loop.
fn stages(render: &ChainRender) {
    let mutations = render.run.counters().decisions as f64;
    let costs = render.costs();
    let per_mutation = |pick: &dyn Fn(&SystemCost) -> bool| {
        let picked = costs.iter().filter(|cost| cost.spec != TRACE_LOOP && pick(cost));
        picked.map(|cost| cost.nanoseconds as f64).sum::<f64>() / mutations
    };
    for stage in Stage::ALL {
        println!(
            "    {:<24} {:8.1}",
            stage.name(),
            per_mutation(&|cost| cost.spec.stage() == stage)
        );
        for cost in costs.iter().filter(|cost| cost.spec.stage() == stage && cost.runs > 0) {
            let marker = if matches!(cost.spec.place(), Place::Loop(_)) {
                "·"
            } else {
                " "
            };
            println!(
                "    {marker} {:<22} {:8.1}",
                cost.spec.name(),
                cost.nanoseconds as f64 / mutations
            );
        }
    }
    let systems = per_mutation(&|_| true);
    let busy = render.busy_time().as_nanos() as f64 / mutations;
    println!(
        "    systems {systems:.1} of {busy:.1} ns: schedule and clock {:.2} %",
        100.0 * (busy - systems) / busy
    );
}

/// What is left out costs: steps as they are over steps without it, by interleaved rounds.
fn prices(scene: &Arc<Scene>) {
    let usual = || start(scene, Technique::Pssmlt, USUAL_CHAINS, None);
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
    let mixture = compare("as usual", scene, USUAL_CHAINS, None, ROUNDS[0]);
    for kind in KINDS {
        compare(kind, scene, USUAL_CHAINS, Some(kind), ROUNDS[0]);
    }
    println!("  as usual, by stage:");
    stages(&mixture);
    heading("chains");
    for chains in GROWTH {
        compare(&chains.to_string(), scene, chains, None, ROUNDS[1]);
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
