//! What techniques with one end and with both cost, on the Cornell boxes and on two million triangles: nanoseconds per sample
//! and system, and how much time each takes for the same error.
//!
//! `cargo bench --bench both_ends`. Rounds interleave the techniques in one process, so that ratios of medians hold on a noisy
//! machine. The time to the same error is that of a sample times the variance of block means that it leaves, against path
//! tracing's: below 1 is sooner. Both are estimates of one run, the variance within the interval shown.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

mod support;

use chainlight::plan::{Base, Place, Plan, PlanOptions, Technique};
use chainlight::render::{Rendering, start};
use chainlight::scene::Scene;
use chainlight::systems::list::{JOIN_LOOP, TRACE_LOOP};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};
use support::{bumpy_room, median, shipped};

const SIZE: u32 = 64;
const ROUNDS: usize = 15;

/// A technique, and over which base.
const CASES: [(&str, Technique, Option<Base>); 5] = [
    ("pt", Technique::Pt, None),
    ("lt", Technique::Lt, None),
    ("bdpt", Technique::Bdpt, None),
    ("pssmlt over pt", Technique::Pssmlt, Some(Base::Pt)),
    ("pssmlt over bdpt", Technique::Pssmlt, Some(Base::Bdpt)),
];

/// A render on one thread, and its rounds.
struct Case {
    name: &'static str,
    render: Box<dyn Rendering>,
    steps: u64,
    rounds: Vec<f64>,
}

impl Case {
    fn new(scene: &Arc<Scene>, (name, technique, base): (&'static str, Technique, Option<Base>)) -> Self {
        let options = PlanOptions {
            base: base.unwrap_or_default(),
            ..PlanOptions::default()
        };
        let plan = Plan::with(scene, technique, &options).expect("a plan without settings of its own");
        let never = AtomicBool::new(false);
        let render = start(Arc::clone(scene), plan, 0, 1, &never, &|_| {}).expect("a small film and one thread");
        // As many samples for every technique: eight a pixel.
        let steps = (8 * u64::from(SIZE * SIZE)).div_ceil(u64::from(render.chains()));
        Self {
            name,
            render,
            steps,
            rounds: Vec::new(),
        }
    }

    /// Runs a round; its nanoseconds per sample.
    fn round(&mut self) {
        let began = Instant::now();
        self.render.burst(self.steps, &|_| {});
        let samples = f64::from(self.render.chains()) * self.steps as f64;
        self.rounds.push(began.elapsed().as_nanos() as f64 / samples);
    }

    /// The variance of block means that one sample leaves, and its 95 % interval.
    fn variance(&self) -> Option<(f64, [f64; 2])> {
        let error = self.render.error()?;
        let samples = f64::from(self.render.chains()) * self.render.steps() as f64;
        let squared = |rms: f64| rms * rms * samples;
        Some((squared(error.rms), error.interval.map(squared)))
    }
}

fn table(name: &str, scene: &Arc<Scene>, systems: bool) {
    let mut cases = CASES.map(|case| Case::new(scene, case));
    for _ in 0..ROUNDS {
        cases.iter_mut().for_each(Case::round);
    }
    println!("\n{name}: {} primitives", scene.geometry.primitive_count());
    let baseline = median(cases[0].rounds.clone());
    let cost_of = |case: &Case| {
        case.variance()
            .map(|(variance, _)| variance * median(case.rounds.clone()))
    };
    let pt = cost_of(&cases[0]);
    for case in &cases {
        let time = median(case.rounds.clone());
        let per_chain = case.render.plan().tile.bytes() / u64::from(case.render.plan().tile.size);
        print!(
            "  {:<17} {time:7.0} ns per sample, {:.2} times pt's; {per_chain} B a chain",
            case.name,
            time / baseline
        );
        if let (Some((variance, interval)), Some(cost), Some(pt)) = (case.variance(), cost_of(case), pt) {
            let [low, high] = interval.map(|bound| bound / variance * cost / pt);
            print!(
                "; {:.3} times the time to the same error ({low:.3} to {high:.3})",
                cost / pt
            );
        }
        println!();
    }
    if !systems {
        return;
    }
    for case in cases
        .iter()
        .filter(|case| case.name != "pt" && case.name != "pssmlt over pt")
    {
        println!("  {}:", case.name);
        let samples = case.render.counters().decisions as f64;
        // The loops' own time is that of the systems in them.
        let costs = case.render.costs().into_iter();
        for cost in costs.filter(|cost| ![TRACE_LOOP, JOIN_LOOP].contains(&cost.spec)) {
            let indent = if matches!(cost.spec.place(), Place::Stage(_)) {
                ""
            } else {
                "  "
            };
            let name = format!("{indent}{}", cost.spec.name());
            println!("    {name:<26} {:7.1}", cost.nanoseconds as f64 / samples);
        }
    }
}

fn main() {
    let began = Instant::now();
    table("cornell box", &shipped("cornell-box", SIZE), true);
    table("glass in the cornell box", &shipped("cornell-glass", SIZE), false);
    table("a glass egg", &shipped("glass-egg", SIZE), false);
    table("two million triangles", &bumpy_room(2_090_000, SIZE), true);
    println!("\nin {:?}", Duration::from_secs(began.elapsed().as_secs()));
}
