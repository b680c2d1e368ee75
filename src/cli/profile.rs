//! `profile`: what every stage costs.

use super::budget::{BudgetArgs, Default};
use super::load::SceneArgs;
use super::output::{count, print};
use super::target::check_writable;
use super::{interrupt, memory};
use crate::film::write_file;
use crate::plan::{Registry, Stage, SystemSpec, Traces};
use crate::render::{DirectLight, LayerRecord, Rendering, TileWorld, drive, start};
use crate::systems::list::TRACE_LOOP;
use crate::systems::tile::Counters;
use crate::systems::{Span, SystemCost};
use clap::Args;
use miette::{IntoDiagnostic, Result};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How long to render where neither `--spp` nor `--time` is given.
const DEFAULT_TIME: Duration = Duration::from_secs(5);

/// System runs kept per thread for `--trace`.
const TRACE_EVENTS: usize = 200_000;

/// Arguments of `profile`.
#[derive(Args, Clone, Debug)]
pub struct ProfileArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    budget: BudgetArgs,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Threads; times are summed over them
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: u16,
    /// Write single runs of systems as trace events, for Perfetto or chrome://tracing
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What a render cost. Times are summed over threads.
#[derive(Serialize)]
struct Report {
    technique: &'static str,
    threads: usize,
    wall_seconds: f64,
    steps: u64,
    /// Samples, or mutations, per pixel.
    per_pixel: f64,
    paths: u64,
    rays: u64,
    segments: u64,
    vertices: u64,
    ns_per_path: f64,
    stages: Vec<Cost>,
    systems: Vec<Cost>,
    /// Time in the schedule around the systems: the price of running them from one.
    schedule: Cost,
    /// The same of direct light, where it is rendered apart, with shares of the time of both.
    #[serde(skip_serializing_if = "Option::is_none")]
    direct: Option<Box<Report>>,
    /// What the layers cost that light was split into.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layers: Vec<LayerRecord>,
}

/// What a part of a render has counted, and what it cost.
struct Part {
    technique: &'static str,
    /// Steps of chains; whole samples of every pixel.
    steps: u64,
    counters: Counters,
    costs: Vec<SystemCost>,
    busy: Duration,
}

impl Part {
    fn of(render: &dyn Rendering) -> Self {
        Self {
            technique: render.plan().technique.name(),
            steps: render.steps(),
            counters: render.counters(),
            costs: render.costs(),
            busy: render.busy_time(),
        }
    }

    fn of_direct(direct: &DirectLight) -> Self {
        Self {
            technique: "direct light by pt",
            steps: direct.samples_per_pixel() as u64,
            counters: direct.counters(),
            costs: direct.costs(),
            busy: direct.busy_time(),
        }
    }
}

#[derive(Serialize)]
struct Cost {
    name: &'static str,
    stage: &'static str,
    runs: u64,
    seconds: f64,
    share: f64,
    ns_per_path: f64,
    /// Rays or segments that the system traced.
    rays: u64,
    ns_per_ray: Option<f64>,
}

/// Renders for a while and prints what it cost.
///
/// # Errors
/// A scene that cannot be loaded, or a trace file that cannot be written.
pub fn run(args: &ProfileArgs, registry: &Registry) -> Result<()> {
    if let Some(path) = &args.trace {
        check_writable(path)?;
    }
    let loaded = args.scene.load(registry)?;
    let threads = usize::from(args.threads);
    memory::check(&loaded, threads)?;
    let pixels = loaded.scene.pixel_count();
    let budget = args.budget.of(&loaded.plan, pixels, Default::Time(DEFAULT_TIME))?;
    let interrupt = interrupt::listen()?;
    let (scene, plan) = (Arc::clone(&loaded.scene), loaded.plan.clone());
    let mut render = start(scene, plan, args.seed, threads, &interrupt, &|_| {})?;
    if args.trace.is_some() {
        for_each_world(&*render, &mut |_, world| world.record_spans(TRACE_EVENTS));
    }
    let began = Instant::now();
    let outcome = drive(&mut *render, budget, &interrupt, &|_| {});
    if let Some(path) = &args.trace {
        write_file(path, &trace_events(&*render, began)?)?;
    }
    let report = report(&*render, outcome.elapsed);
    if args.json {
        print(&serde_json::to_string_pretty(&report).into_diagnostic()?)
    } else {
        print(&text(&report))
    }
}

/// Lets `look` see every world of all parts.
fn for_each_world(render: &dyn Rendering, look: &mut dyn FnMut(usize, &mut TileWorld)) {
    let mut worlds = 0;
    render.for_each_world(&mut |number, world| {
        worlds = worlds.max(number + 1);
        look(number, world);
    });
    if let Some(direct) = render.direct() {
        direct.for_each_world(&mut |number, world| look(worlds + number, world));
    }
}

fn report(render: &dyn Rendering, wall: Duration) -> Report {
    let direct = render.direct().map(Part::of_direct);
    let own = Part::of(render);
    let both = own.busy + direct.as_ref().map_or(Duration::ZERO, |part| part.busy);
    let of_part = |part: &Part| report_of(render, part, wall, both);
    let direct = direct.as_ref().map(|part| Box::new(of_part(part)));
    Report {
        direct,
        layers: render.layers().into_iter().map(|layer| layer.record).collect(),
        ..of_part(&own)
    }
}

/// The report of a part of a render, with shares of `all`, the time of all parts.
fn report_of(render: &dyn Rendering, part: &Part, wall: Duration, all: Duration) -> Report {
    let (costs, counters) = (&part.costs, part.counters);
    let paths = counters.decisions;
    let total = part.busy.as_nanos() as u64;
    let all = all.as_nanos() as f64;
    let cost = |name, stage: &'static str, runs, nanoseconds: u64, rays: u64| Cost {
        name,
        stage,
        runs,
        seconds: nanoseconds as f64 * 1e-9,
        share: nanoseconds as f64 / all.max(1.0),
        ns_per_path: nanoseconds as f64 / paths.max(1) as f64,
        rays,
        ns_per_ray: (rays > 0).then(|| nanoseconds as f64 / rays as f64),
    };
    let traced = |spec: SystemSpec| match spec.traces() {
        Traces::Rays => counters.rays,
        Traces::Segments => counters.segments,
        Traces::Both => counters.rays + counters.segments,
        Traces::Nothing => 0,
    };
    let is_loop = |spec| spec == TRACE_LOOP;
    let systems: Vec<Cost> = costs
        .iter()
        .filter(|c| !is_loop(c.spec))
        .map(|c| {
            cost(
                c.spec.name(),
                c.spec.stage().name(),
                c.runs,
                c.nanoseconds,
                traced(c.spec),
            )
        })
        .collect();
    let stages = Stage::ALL.map(|stage| {
        let here = || costs.iter().filter(|c| c.spec.stage() == stage && !is_loop(c.spec));
        let runs = here().map(|c| c.runs).sum();
        cost(
            stage.name(),
            stage.name(),
            runs,
            here().map(|c| c.nanoseconds).sum(),
            here().map(|c| traced(c.spec)).sum(),
        )
    });
    let in_systems: u64 = costs.iter().filter(|c| !is_loop(c.spec)).map(|c| c.nanoseconds).sum();
    Report {
        technique: part.technique,
        threads: render.threads(),
        wall_seconds: wall.as_secs_f64(),
        steps: part.steps,
        per_pixel: paths as f64 / f64::from(render.scene().pixel_count()),
        paths,
        rays: counters.rays,
        segments: counters.segments,
        vertices: counters.vertices,
        ns_per_path: total as f64 / paths.max(1) as f64,
        stages: stages.into(),
        systems,
        schedule: cost(
            "schedule",
            "schedule",
            counters.steps,
            total.saturating_sub(in_systems),
            0,
        ),
        direct: None,
        layers: Vec::new(),
    }
}

fn text(report: &Report) -> String {
    let Report {
        technique,
        threads,
        per_pixel,
        wall_seconds,
        ..
    } = report;
    let mut out = format!(
        "{technique}: {} paths ({per_pixel} per pixel), {} rays, {} segments in {wall_seconds:.2} s on {threads} threads; {:.0} ns per path\n\n\
         {:<10} {:<22} {:>9} {:>7} {:>9} {:>10} {:>10}\n",
        count(report.paths as f64),
        count(report.rays as f64),
        count(report.segments as f64),
        report.ns_per_path,
        "stage",
        "system",
        "seconds",
        "share",
        "ns/path",
        "rays",
        "ns/ray"
    );
    let mut row = |stage: &str, name: &str, cost: &Cost| {
        let rays = if cost.rays > 0 {
            count(cost.rays as f64)
        } else {
            String::new()
        };
        let per_ray = cost.ns_per_ray.map(|ns| format!("{ns:.0}")).unwrap_or_default();
        let _ = writeln!(
            out,
            "{stage:<10} {name:<22} {:>9.3} {:>5.1} % {:>9.1} {rays:>10} {per_ray:>10}",
            cost.seconds,
            100.0 * cost.share,
            cost.ns_per_path
        );
    };
    for stage in &report.stages {
        row(stage.name, "", stage);
        for system in report.systems.iter().filter(|system| system.stage == stage.name) {
            row("", system.name, system);
        }
    }
    row("schedule", "", &report.schedule);
    let mut out = out.trim_end().to_owned();
    if let Some(direct) = &report.direct {
        out += &format!("\n\n{}", text(direct));
    }
    if !report.layers.is_empty() {
        out += &format!("\n\n{}", super::layers::table(&report.layers, report.wall_seconds));
    }
    out
}

/// One complete event ("X") of the trace event format; times in microseconds.
#[derive(Serialize)]
struct TraceEvent {
    name: &'static str,
    cat: &'static str,
    ph: &'static str,
    ts: f64,
    dur: f64,
    pid: u32,
    tid: usize,
}

fn trace_events(render: &dyn Rendering, origin: Instant) -> Result<Vec<u8>> {
    let mut events = Vec::new();
    for_each_world(render, &mut |thread, world| {
        events.extend(world.profile().spans.iter().map(|span: &Span| TraceEvent {
            name: span.spec.name(),
            cat: span.spec.stage().name(),
            ph: "X",
            ts: span.start.saturating_duration_since(origin).as_nanos() as f64 * 1e-3,
            dur: span.nanoseconds as f64 * 1e-3,
            pid: 0,
            tid: thread,
        }));
    });
    serde_json::to_vec(&events).into_diagnostic()
}
