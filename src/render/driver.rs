//! How long a render runs: bursts until a budget is spent or someone interrupts.

use super::Rendering;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// When a render ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// After this many steps of every chain: samples per pixel.
    Steps(u64),
    /// At the end of the step that runs when this much time has passed; at least one step.
    Time(Duration),
}

/// Why a render ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The budget was spent.
    Done,
    /// Somebody asked it to stop.
    Interrupted,
}

/// How far a render is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Share of the budget that is spent, in [0, 1].
    pub fraction: f64,
    /// Samples taken so far.
    pub samples: u64,
    /// Steps that all chains have finished.
    pub steps: u64,
}

/// How a render ended.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// Why.
    pub stop: Stop,
    /// Steps that every chain has taken.
    pub steps: u64,
    /// Wall time of the bursts.
    pub elapsed: Duration,
}

/// How long a burst should take: long enough to keep threads busy, short enough to stop soon.
const BURST: Duration = Duration::from_millis(250);

/// Runs bursts until the budget is spent or `interrupt` is set, which is looked at between bursts. `progress` is called
/// from rendering threads whenever a tile is done.
///
/// How many steps a burst has does not matter to the picture: all tiles stop at the same step, and that number of steps
/// reproduces it.
pub fn drive(
    render: &mut dyn Rendering,
    budget: Budget,
    interrupt: &AtomicBool,
    progress: &(impl Fn(Progress) + Sync),
) -> Outcome {
    let start = Instant::now();
    let samples = AtomicU64::new(u64::from(render.chains()) * render.steps());
    let mut burst = 1;
    let stop = loop {
        let left = match budget {
            Budget::Steps(steps) => steps.saturating_sub(render.steps()),
            Budget::Time(limit) if render.steps() > 0 && start.elapsed() >= limit => 0,
            Budget::Time(limit) => {
                steps_that_fit(limit.saturating_sub(start.elapsed()), render.steps(), start.elapsed())
            }
        };
        if left == 0 {
            break Stop::Done;
        }
        if interrupt.load(Ordering::Relaxed) {
            break Stop::Interrupted;
        }
        let steps = burst.min(left);
        let began = Instant::now();
        let finished = render.steps();
        let total = u64::from(render.chains());
        render.burst(steps, &|more| {
            let samples = samples.fetch_add(more, Ordering::Relaxed) + more;
            let fraction = match budget {
                Budget::Steps(steps) => samples as f64 / (steps as f64 * total as f64),
                Budget::Time(limit) => start.elapsed().as_secs_f64() / limit.as_secs_f64().max(1e-9),
            };
            progress(Progress {
                fraction: fraction.min(1.0),
                samples,
                steps: finished,
            });
        });
        let took = began.elapsed().as_secs_f64().max(1e-9);
        burst = ((steps as f64 * BURST.as_secs_f64() / took) as u64).clamp(1, 2 * steps);
    };
    Outcome {
        stop,
        steps: render.steps(),
        elapsed: start.elapsed(),
    }
}

/// Steps that are expected to fit into `left`, at least one, at the pace so far.
fn steps_that_fit(left: Duration, steps: u64, elapsed: Duration) -> u64 {
    let pace = steps as f64 / elapsed.as_secs_f64().max(1e-9);
    ((left.as_secs_f64() * pace) as u64).max(1)
}
