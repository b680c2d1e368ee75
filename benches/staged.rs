//! Staged path tracing against depth-first, on the Cornell box and on two million triangles: nanoseconds per path and
//! stage, what the schedule costs, bytes per chain. Both techniques draw the same paths, so the work is the same.
//!
//! `cargo bench --bench staged` prints criterion's figures, then a table from rounds that interleave both techniques in
//! one process; ratios of medians there hold on a noisy machine, absolute times do not.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

mod support;

use bevy_ecs::schedule::{Schedules, SingleThreadedExecutor};
use chainlight::plan::{Place, Plan, Stage, Technique};
use chainlight::render::{Render, Rendering};
use chainlight::scene::Scene;
use chainlight::systems::list::TRACE_LOOP;
use criterion::{BenchmarkId, Criterion, Throughput};
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};
use support::{bumpy_room, median, shipped};

const SIZE: u32 = 64;
const ROUNDS: usize = 15;
const STEPS_PER_ROUND: u64 = 8;

/// A render on one thread.
fn start(scene: &Arc<Scene>, technique: Technique, tile: Option<u32>) -> Render {
    Render::new(Arc::clone(scene), Plan::new(scene, technique, tile), 0, 1).expect("a small film and one thread")
}

/// Nanoseconds per path of one burst.
fn ns_per_path(render: &mut Render) -> f64 {
    let began = Instant::now();
    render.burst(STEPS_PER_ROUND, &|_| {});
    began.elapsed().as_nanos() as f64 / (f64::from(render.chains()) * STEPS_PER_ROUND as f64)
}

fn table(name: &str, scene: &Arc<Scene>) {
    let mut renders = [Technique::Pt, Technique::PtReference].map(|technique| start(scene, technique, None));
    let mut rounds = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        for (render, figures) in renders.iter_mut().zip(&mut rounds) {
            figures.push(ns_per_path(render));
        }
    }
    let [staged, depth_first] = rounds.map(median);
    let render = &renders[0];
    let paths = render.counters().decisions as f64;
    let busy = render.busy_time().as_nanos() as f64;
    let costs = render.costs();
    let systems: f64 = costs
        .iter()
        .filter(|c| c.spec != TRACE_LOOP)
        .map(|c| c.nanoseconds as f64)
        .sum();
    println!(
        "\n{name}: {} primitives, tile of {} chains",
        scene.geometry.primitive_count(),
        render.plan.tile.size
    );
    println!(
        "  depth first {depth_first:.0} ns per path, staged {staged:.0}: {:.2} times as fast",
        depth_first / staged
    );
    for stage in Stage::ALL {
        let here = costs.iter().filter(|c| c.spec.stage() == stage && c.spec != TRACE_LOOP);
        println!(
            "  {:<10} {:7.1} ns per path",
            stage.name(),
            here.map(|c| c.nanoseconds as f64).sum::<f64>() / paths
        );
    }
    for cost in costs.iter().filter(|c| matches!(c.spec.place(), Place::Loop(_))) {
        println!("    {:<20} {:7.1}", cost.spec.name(), cost.nanoseconds as f64 / paths);
    }
    println!(
        "  schedule and clock {:.2} % of the time",
        100.0 * (busy - systems) / busy
    );
    let touched = render.plan.tile.bytes() / u64::from(render.plan.tile.size);
    println!(
        "  {touched} B of tables per chain, for paths of up to {} edges",
        scene.max_depth
    );
}

/// What the executor that keeps times costs: steps under it against steps under bevy's own, interleaved.
fn price_of_the_clock(scene: &Arc<Scene>) {
    let mut timed = start(scene, Technique::Pt, None);
    let mut bare = start(scene, Technique::Pt, None);
    bare.for_each_world(&mut |_, tile| {
        for (_, schedule) in tile.world_mut().resource_mut::<Schedules>().iter_mut() {
            schedule.set_executor(SingleThreadedExecutor::new());
        }
    });
    let mut ratios = Vec::new();
    for _ in 0..4 * ROUNDS {
        let under_clock = ns_per_path(&mut timed);
        ratios.push(under_clock / ns_per_path(&mut bare));
    }
    println!(
        "\nwith the clock {:.4} times the time without (median of {} pairs)",
        median(ratios),
        4 * ROUNDS
    );
}

fn main() {
    let box_scene = shipped("cornell-box", SIZE);
    let room = bumpy_room(2_090_000, SIZE);
    let mut criterion = Criterion::default().configure_from_args().sample_size(10);
    for (name, scene) in [("cornell box", &box_scene), ("two million triangles", &room)] {
        let mut group = criterion.benchmark_group(name);
        group
            .warm_up_time(Duration::from_secs(1))
            .measurement_time(Duration::from_secs(3));
        group.throughput(Throughput::Elements(u64::from(SIZE * SIZE)));
        for technique in [Technique::Pt, Technique::PtReference] {
            let mut render = start(scene, technique, None);
            group.bench_function(BenchmarkId::from_parameter(technique), |bencher| {
                bencher.iter(|| black_box(&mut render).burst(1, &|_| {}));
            });
        }
        group.finish();
    }
    criterion.final_summary();
    table("cornell box", &box_scene);
    table("two million triangles", &room);
    price_of_the_clock(&box_scene);
}
