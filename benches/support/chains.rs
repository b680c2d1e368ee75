//! Chains in stages against the same chains depth first: interleaved rounds of both in one process.

use super::support::median;
use chainlight::plan::{ChainSettings, Place, Plan, PlanOptions, Stage, Technique};
use chainlight::render::{ChainRender, Rendering};
use chainlight::scene::Scene;
use chainlight::systems::SystemCost;
use chainlight::systems::list::TRACE_LOOP;
use std::sync::Arc;
use std::time::Instant;

/// Independent groups of chains.
pub const GROUPS: u32 = 16;
/// Rounds that compare two techniques, and two of many chains.
pub const ROUNDS: [usize; 2] = [15, 7];
/// Mutations of a round, in all chains together; never less than one step.
const MUTATIONS_PER_ROUND: u64 = 1 << 15;
/// Chains of all groups, where it is not their number that is looked at.
pub const USUAL_CHAINS: u32 = 1 << 14;
/// Numbers of chains that are compared: 1k to 256k.
pub const GROWTH: [u32; 5] = [1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18];

/// What is compared: chains in stages, and depth first.
pub struct Compared {
    /// Both.
    pub techniques: [Technique; 2],
    /// The options of their plans, but for numbers of chains and what `only` says.
    pub options: PlanOptions,
    /// The fewest edges of their paths, where it is not what the options say.
    pub shortest: Option<u32>,
}

impl Compared {
    /// Chains at their first states, on one thread. `only` is the one mutation that is tried; the usual mixture if there is none.
    pub fn start(&self, scene: &Arc<Scene>, technique: Technique, chains: u32, only: Option<&str>) -> ChainRender {
        let mut options = self.options.clone();
        options.chains = ChainSettings {
            groups: GROUPS,
            chains: Some(chains / GROUPS),
            bootstrap: Some((4 * chains / GROUPS).max(4096)),
            ..ChainSettings::default()
        };
        if let Some(name) = only {
            options.mutations = options.mutations.only(name).expect("a mutation of this crate");
        }
        let mut plan = Plan::with(scene, technique, &options).expect("mutations of this crate");
        if let Some(shortest) = self.shortest {
            plan.tile.shortest = shortest;
        }
        let mut render = ChainRender::new(Arc::clone(scene), plan, 0, 1).expect("small films and one thread");
        // Tables, caches and branch predictors.
        burst(&mut render);
        render
    }

    /// A line: depth first, staged, and how many times as fast staging is.
    pub fn line(&self, name: &str, scene: &Arc<Scene>, chains: u32, only: Option<&str>, count: usize) -> ChainRender {
        let mut renders = self
            .techniques
            .map(|technique| self.start(scene, technique, chains, only));
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
}

/// The heading of [`Compared::line`]s, whose first column has this name.
pub fn heading(first: &str) {
    println!(
        "  {first:<14} {:>10} {:>10} {:>10} {:>10} {:>12}",
        "depth 1st", "staged", "times", "tile", "MiB, staged"
    );
}

/// Runs the mutations of a round. Returns nanoseconds per mutation.
pub fn burst(render: &mut ChainRender) -> f64 {
    let chains = u64::from(render.chains());
    let steps = (MUTATIONS_PER_ROUND / chains).max(1);
    let began = Instant::now();
    render.run.burst(steps, &|_| {});
    began.elapsed().as_nanos() as f64 / (chains * steps) as f64
}

/// Nanoseconds per mutation of each render, by interleaved rounds.
pub fn rounds(renders: &mut [ChainRender], count: usize) -> Vec<Vec<f64>> {
    let mut figures = vec![Vec::new(); renders.len()];
    for _ in 0..count {
        for (render, figures) in renders.iter_mut().zip(&mut figures) {
            figures.push(burst(render));
        }
    }
    figures
}

/// The median of `a` over `b`, round by round.
pub fn ratio(a: &[f64], b: &[f64]) -> f64 {
    median(a.iter().zip(b).map(|(a, b)| a / b).collect())
}

/// Nanoseconds per mutation by stage, and by system in the trace loop.
pub fn stages(render: &ChainRender) {
    let mutations = render.run.counters().decisions as f64;
    let costs = render.run.costs();
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
    let busy = render.run.busy_time().as_nanos() as f64 / mutations;
    println!(
        "    systems {systems:.1} of {busy:.1} ns: schedule and clock {:.2} %",
        100.0 * (busy - systems) / busy
    );
}
