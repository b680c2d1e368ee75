//! A pilot: a short render that is looked at while it runs, for what it says of a long one.

use crate::color::Rgb;
use crate::film::Picture;
use crate::plan::Plan;
use crate::render::{Budget, RenderError, Rendering, Stop, drive, start};
use crate::scene::Scene;
use crate::stats::error::PictureError;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How often the time of the last look is halved.
const HALVINGS: u32 = 3;
/// The share of a pilot that is left to steps at least, however long it took to start: of a start alone nothing can be told.
const SHARE_OF_STEPS: f64 = 0.5;
/// Steps at least. Pixels know nothing of their error from one sample, and nearly nothing from two.
const FEWEST_STEPS: u64 = 4;

/// A look at a pilot.
#[derive(Clone, Debug)]
pub struct PilotLook {
    /// Seconds of steps: start-up is not among them.
    pub seconds: f64,
    /// Steps taken.
    pub steps: u64,
    /// Standard errors of pixels.
    pub error: Vec<Rgb>,
    /// The relative error over block means.
    pub blocks: Option<PictureError>,
}

/// What a short render was like.
#[derive(Clone, Debug)]
pub struct Pilot {
    /// Seconds before the first step: worlds built, bootstraps, the first direct light.
    pub start_seconds: f64,
    /// Looks, the earliest first; their times double. There is one at least.
    pub looks: Vec<PilotLook>,
    /// The picture at the last look.
    pub picture: Picture,
}

impl Pilot {
    /// Seconds that it took, looking left out.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.start_seconds + self.looks.last().map_or(0.0, |look| look.seconds)
    }
}

/// How a pilot ended.
#[derive(Clone, Debug)]
pub enum PilotEnd {
    /// It was looked at to its end.
    Done(Pilot),
    /// It had not started when its time was up.
    Late,
    /// Somebody interrupted it.
    Interrupted,
}

/// Renders for `seconds`, start-up included, with the seed `seed`, and looks at the picture after an eighth, a quarter and half of the
/// steps' time, and at its end. Steps have half of the time at least, so a slow start makes a pilot longer; one that has not ended
/// after `patience` ends the pilot. `progress` hears now and then.
///
/// # Errors
/// A render that cannot start.
pub fn pilot(
    (scene, plan): (&Arc<Scene>, &Plan),
    (seed, threads): (u64, usize),
    seconds: f64,
    patience: Duration,
    interrupt: &AtomicBool,
    progress: &(dyn Fn() + Sync),
) -> Result<PilotEnd, RenderError> {
    let began = Instant::now();
    let give_up = AtomicBool::new(interrupt.load(Ordering::Relaxed));
    let started = start(Arc::clone(scene), plan.clone(), seed, threads, &give_up, &|_| {
        progress();
        if interrupt.load(Ordering::Relaxed) || began.elapsed() > patience {
            give_up.store(true, Ordering::Relaxed);
        }
    });
    let mut render = match started {
        Err(RenderError::Interrupted) if interrupt.load(Ordering::Relaxed) => return Ok(PilotEnd::Interrupted),
        Err(RenderError::Interrupted) => return Ok(PilotEnd::Late),
        started => started?,
    };
    let start_seconds = began.elapsed().as_secs_f64();
    let of_steps = (seconds - start_seconds).max(seconds * SHARE_OF_STEPS);
    let mut looks: Vec<PilotLook> = Vec::new();
    let mut spent = 0.0;
    let mut picture = Picture::default();
    for halvings in (0..=HALVINGS).rev() {
        let due = of_steps / f64::from(1_u32 << halvings);
        if spent >= due && halvings > 0 {
            continue;
        }
        if spent < due {
            spent += drive_for(
                &mut *render,
                Budget::Time(Duration::from_secs_f64(due - spent)),
                interrupt,
                progress,
            );
        }
        if halvings == 0 && render.steps() < FEWEST_STEPS {
            spent += drive_for(&mut *render, Budget::Steps(FEWEST_STEPS), interrupt, progress);
        }
        if interrupt.load(Ordering::Relaxed) {
            return Ok(PilotEnd::Interrupted);
        }
        picture = render.picture();
        looks.push(PilotLook {
            seconds: spent,
            steps: render.steps(),
            error: picture.error.clone(),
            blocks: render.error(),
        });
    }
    Ok(PilotEnd::Done(Pilot {
        start_seconds,
        looks,
        picture,
    }))
}

/// Drives a render, and tells the seconds that took.
fn drive_for(render: &mut dyn Rendering, budget: Budget, interrupt: &AtomicBool, progress: &(dyn Fn() + Sync)) -> f64 {
    let outcome = drive(render, budget, interrupt, &|_| progress());
    debug_assert!(outcome.stop != Stop::TargetReached);
    outcome.elapsed.as_secs_f64()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{PlanOptions, Technique};
    use crate::scene::{Format, SceneOverrides, flatten, parse_scene};
    use std::path::Path;

    const SCENE: &str = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
        film: (width: 16, height: 16), materials: { "m": Diffuse(reflectance: (0.5, 0.5, 0.5)) },
        shapes: [(shape: Sphere(center: (0, 0, 0), radius: 1), material: "m"),
                 (shape: Sphere(center: (0, 4, 0), radius: 1), material: "m", emission: (1, 1, 1))])"#;

    fn ready(technique: Technique) -> (Arc<Scene>, Plan) {
        let source = parse_scene("spheres.ron", SCENE, Format::Ron, Path::new(".")).expect("a valid scene");
        let flattened = flatten(&source).expect("a valid scene");
        let scene = Scene::compile(&source.description, &flattened, SceneOverrides::default()).expect("a valid scene");
        let plan = Plan::with(&scene, technique, &PlanOptions::default()).expect("a plan");
        (Arc::new(scene), plan)
    }

    fn end(technique: Technique, patience: Duration, interrupt: bool) -> PilotEnd {
        let (scene, plan) = ready(technique);
        let interrupt = AtomicBool::new(interrupt);
        pilot((&scene, &plan), (1, 1), 0.05, patience, &interrupt, &|| {}).expect("it starts")
    }

    #[test]
    fn looks_are_at_times_that_double_and_know_errors() {
        for technique in [Technique::Pt, Technique::Bdpt, Technique::Pssmlt] {
            let PilotEnd::Done(pilot) = end(technique, Duration::MAX, false) else {
                panic!("{technique} did not end")
            };
            let rises = |pair: &[PilotLook]| pair[0].seconds < pair[1].seconds && pair[0].steps <= pair[1].steps;
            assert!(
                !pilot.looks.is_empty() && pilot.looks.windows(2).all(rises),
                "{technique}"
            );
            let last = pilot.looks.last().expect("a look");
            // Steps have half of the time, however long it took to start.
            assert!(last.seconds >= 0.025 && last.steps >= FEWEST_STEPS, "{technique}");
            assert!(last.error.iter().all(|error| error.is_finite()), "{technique}");
            assert_eq!((last.error.len(), pilot.picture.rgb.len()), (256, 256));
        }
    }

    #[test]
    fn a_start_that_takes_too_long_is_given_up_and_so_is_an_interrupted_pilot() {
        assert!(matches!(end(Technique::Pssmlt, Duration::ZERO, false), PilotEnd::Late));
        assert!(matches!(
            end(Technique::Pssmlt, Duration::MAX, true),
            PilotEnd::Interrupted
        ));
        assert!(matches!(end(Technique::Pt, Duration::MAX, true), PilotEnd::Interrupted));
    }
}
