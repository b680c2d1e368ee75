//! How long a render runs: bursts until a budget is spent or someone interrupts.

use super::Rendering;
use super::remaining::{LastLook, steps_to_target};
use crate::stats::error::PictureError;
use crate::stats::stopping::{self, Checkpoints};
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

/// When a render ends: with its budget, or before, once its error is small enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// What it may cost.
    pub budget: Budget,
    /// The relative error of the picture ([`Rendering::error`]) below whose upper confidence bound nothing more is done. It
    /// is looked at after a number of steps that doubles each time: a rule that looks again and again until it likes what
    /// it sees would stop too early, and so would one that looked at the estimate instead of the bound.
    pub target_error: Option<f64>,
}

impl From<Budget> for Goal {
    fn from(budget: Budget) -> Self {
        Self {
            budget,
            target_error: None,
        }
    }
}

/// Why a render ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The budget was spent.
    Done,
    /// The picture's error is below the target.
    TargetReached,
    /// Somebody asked it to stop.
    Interrupted,
}

/// How far a render is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Share of the budget that is spent, in [0, 1], or of the work that the target is expected to take, if that is more.
    pub fraction: f64,
    /// Samples taken so far.
    pub samples: u64,
    /// Steps that all chains have finished.
    pub steps: u64,
    /// The picture's relative error when it was last looked at.
    pub error: Option<PictureError>,
    /// The share of proposals taken when it was last looked at, for chains.
    pub acceptance: Option<f64>,
    /// With a target: the time that is expected to be left until it is reached, and the target. `None` until the error was looked at.
    pub to_target: Option<(Duration, f64)>,
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
    goal: impl Into<Goal>,
    interrupt: &AtomicBool,
    progress: &(impl Fn(Progress) + Sync),
) -> Outcome {
    let Goal { budget, target_error } = goal.into();
    let start = Instant::now();
    let checkpoints = Checkpoints::new(first_checkpoint(render));
    let mut checkpoint = checkpoints.next(render.steps());
    let mut error: Option<PictureError> = None;
    let mut acceptance = None;
    let mut look = None;
    let begun = render.steps();
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
        let steps = burst.min(left).min(checkpoint - render.steps());
        let began = Instant::now();
        let finished = render.steps();
        let total = u64::from(render.chains());
        let last_step = target_error
            .zip(look)
            .and_then(|(target, look)| Some((steps_to_target(look, target, &checkpoints)?, target)));
        render.burst(steps, &|more| {
            let samples = samples.fetch_add(more, Ordering::Relaxed) + more;
            let fraction = match budget {
                Budget::Steps(steps) => samples as f64 / (steps as f64 * total as f64),
                Budget::Time(limit) => start.elapsed().as_secs_f64() / limit.as_secs_f64().max(1e-9),
            };
            // Start-up is over when bursts begin: the pace is that of steps.
            let taken = samples as f64 / total as f64;
            let pace = start.elapsed().as_secs_f64() / (taken - begun as f64).max(f64::MIN_POSITIVE);
            let to_target = last_step.and_then(|(steps, target)| {
                let left = Duration::try_from_secs_f64((steps as f64 - taken).max(0.0) * pace);
                Some((left.ok()?, target))
            });
            let towards_target = last_step.map_or(0.0, |(steps, _)| taken / steps as f64);
            progress(Progress {
                to_target,
                fraction: fraction.max(towards_target).min(1.0),
                samples,
                steps: finished,
                error,
                acceptance,
            });
        });
        let took = began.elapsed().as_secs_f64().max(1e-9);
        burst = ((steps as f64 * BURST.as_secs_f64() / took) as u64).clamp(1, (2 * steps).max(burst));
        if render.steps() >= checkpoint {
            checkpoint = checkpoints.next(render.steps());
            (error, acceptance) = (render.error(), render.acceptance());
            look = error.map(|error| LastLook {
                steps: render.steps(),
                upper: error.upper,
            });
            if let (Some(target), Some(error)) = (target_error, error)
                && stopping::decide(&error, target)
            {
                break Stop::TargetReached;
            }
        }
    };
    Outcome {
        stop,
        steps: render.steps(),
        elapsed: start.elapsed(),
    }
}

/// The steps after which the error is first looked at: enough for a spread to show, and for a state per pixel.
fn first_checkpoint(render: &dyn Rendering) -> u64 {
    const STEPS: u64 = 16;
    let pixels = u64::from(render.scene().pixel_count());
    STEPS.max(pixels.div_ceil(u64::from(render.chains())))
}

/// Steps that are expected to fit into `left`, at least one, at the pace so far.
fn steps_that_fit(left: Duration, steps: u64, elapsed: Duration) -> u64 {
    let pace = steps as f64 / elapsed.as_secs_f64().max(1e-9);
    ((left.as_secs_f64() * pace) as u64).max(1)
}
