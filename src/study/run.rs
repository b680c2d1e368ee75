//! One run of a study.

use super::Reference;
use super::study_file::{LayerRun, RunRecord, Snapshot, StageSeconds, Stated};
use crate::color::Rgb;
use crate::film::Picture;
use crate::plan::{Plan, Stage};
use crate::render::{Budget, ChainRender, DirectLight, RenderError, Rendering, Stop, drive, start};
use crate::scene::Scene;
use crate::systems::SystemCost;
use crate::systems::list::TRACE_LOOP;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// How often the time of a curve's last point is halved.
const HALVINGS: u32 = 6;

/// The times at which a run of so many seconds is looked at: doubling, the last one at its end.
#[must_use]
pub fn checkpoints(seconds: f64) -> Vec<f64> {
    (0..=HALVINGS)
        .rev()
        .map(|halvings| seconds / f64::from(1_u32 << halvings))
        .collect()
}

/// Renders once, with the seed `seed`, and looks at the picture at every one of the `due` times. Looking takes no time of the run's.
/// `before` has the pictures of the run before, by due time, and is left with those of this one. The last picture comes with the record.
///
/// A time that comes before the first step is passed over, and so is one that the step before has outlasted, but for the last. `None` if
/// somebody interrupted it.
///
/// # Errors
/// A render that cannot start.
pub fn run_once(
    scene: &Arc<Scene>,
    plan: &Plan,
    (seed, threads): (u64, usize),
    due: &[f64],
    reference: &Reference,
    before: &mut [Option<Vec<Rgb>>],
    interrupt: &AtomicBool,
) -> Result<Option<(RunRecord, Picture)>, RenderError> {
    let began = Instant::now();
    let started = start(Arc::clone(scene), plan.clone(), seed, threads, interrupt, &|_| {});
    let mut render = match started {
        Err(RenderError::Interrupted) => return Ok(None),
        started => started?,
    };
    let start_seconds = began.elapsed().as_secs_f64();
    let mut spent = start_seconds;
    let mut snapshots = Vec::with_capacity(due.len());
    let mut last = Picture::default();
    for (index, &due_at) in due.iter().enumerate() {
        let is_last = index + 1 == due.len();
        if spent >= due_at && !is_last {
            before[index] = None;
            continue;
        }
        let left = Duration::from_secs_f64((due_at - spent).max(0.0));
        let outcome = drive(&mut *render, Budget::Time(left), interrupt, &|_| {});
        if outcome.stop == Stop::Interrupted {
            return Ok(None);
        }
        spent += outcome.elapsed.as_secs_f64();
        let picture = render.picture();
        let Some((errors, spectrum)) = reference.errors_of(picture.view()) else {
            continue;
        };
        let shared = before[index]
            .as_deref()
            .map(|other| reference.shared_error(&picture.rgb, other));
        snapshots.push(Snapshot {
            due: due_at,
            seconds: spent,
            steps: render.steps(),
            per_pixel: render
                .as_chains()
                .map_or(render.steps() as f64, ChainRender::mutations_per_pixel),
            errors,
            shared,
            stated: render.error().map(|error| Stated {
                rms: error.rms,
                upper: error.upper,
            }),
            spectrum,
        });
        before[index] = Some(picture.rgb.clone());
        last = picture;
    }
    let record = RunRecord {
        seed,
        start_seconds,
        snapshots,
        stages: stages(&*render),
    };
    Ok(Some((record, last)))
}

/// Renders once with a plan that splits light, for so many seconds, with a seed on so many threads. `None` if somebody interrupted it.
///
/// # Errors
/// A render that cannot start.
pub fn split_run(
    scene: &Arc<Scene>,
    plan: &Plan,
    (seed, threads, seconds): (u64, usize, f64),
    interrupt: &AtomicBool,
) -> Result<Option<LayerRun>, RenderError> {
    let began = Instant::now();
    let started = start(Arc::clone(scene), plan.clone(), seed, threads, interrupt, &|_| {});
    let mut render = match started {
        Err(RenderError::Interrupted) => return Ok(None),
        started => started?,
    };
    let left = Duration::from_secs_f64((seconds - began.elapsed().as_secs_f64()).max(0.0));
    let outcome = drive(&mut *render, Budget::Time(left), interrupt, &|_| {});
    Ok((outcome.stop != Stop::Interrupted).then(|| LayerRun {
        seconds: began.elapsed().as_secs_f64(),
        layers: render.layers().into_iter().map(|layer| layer.record).collect(),
    }))
}

/// What every stage has cost so far, direct light that is rendered apart beside them.
fn stages(render: &dyn Rendering) -> Vec<StageSeconds> {
    let seconds = |costs: &[SystemCost], stage: Stage| {
        let of_stage = costs
            .iter()
            .filter(|cost| cost.spec.stage() == stage && cost.spec != TRACE_LOOP);
        of_stage.map(|cost| cost.nanoseconds).sum::<u64>() as f64 * 1e-9
    };
    let costs = render.costs();
    let named = |stage: String, seconds: f64| StageSeconds { stage, seconds };
    let mut stages: Vec<StageSeconds> = Stage::ALL
        .iter()
        .map(|&stage| named(stage.name().to_owned(), seconds(&costs, stage)))
        .collect();
    if let Some(direct) = render.direct().map(DirectLight::busy_time) {
        stages.push(named("direct light".to_owned(), direct.as_secs_f64()));
    }
    stages
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_double_up_to_the_end() {
        assert_eq!(checkpoints(8.0), [0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0]);
    }
}
