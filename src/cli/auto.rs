//! `render --technique auto`: the technique that promises most, by pilots.

use super::load::{Loaded, SceneArgs, TechniqueChoice};
use super::memory;
use super::output::{duration, note};
use super::pilots::{PilotTime, Tried, Way, progress_bar, try_all};
use super::verdict::{self, Goal};
use crate::plan::{Registry, Technique};
use miette::{Result, miette};
use serde::Serialize;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// What is chosen from, in the order in which it is tried: chains take time to start, and those of mlt as a rule are worth more.
const CANDIDATES: [Technique; 4] = [Technique::Pt, Technique::Mlt, Technique::Bdpt, Technique::Pssmlt];
/// The share of `--time` that pilots have together, and the one after which none is waited for that has not started: chains have to.
const SHARE_OF_TIME: f64 = 0.1;
const MOST_OF_TIME: f64 = 0.14;
/// The same where no time is given.
const PILOTS: PilotTime = PilotTime {
    each: Duration::from_secs(1),
    all: Duration::from_secs(20),
};
/// How long a render is taken to be where even that cannot be told.
const UNKNOWN_TIME: f64 = 10.0;

/// What a render is asked for, as far as the choice goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    pub(super) time: Option<Duration>,
    pub(super) target_error: Option<f64>,
    /// Samples per pixel.
    pub(super) samples: f64,
    pub(super) seed: u64,
    pub(super) threads: usize,
}

/// The technique that was taken.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Chosen {
    #[serde(skip)]
    pub(super) technique: TechniqueChoice,
    /// Which, and why.
    pub(super) why: String,
    /// Seconds that pilots took, which count in `--time`.
    pub(super) pilot_seconds: f64,
}

/// Tries techniques on the scene, and takes the one that promises most. `None` if somebody interrupted it.
///
/// # Errors
/// Options of some techniques alone, a scene that cannot be loaded, or a render that cannot start.
pub(super) fn choose(
    args: &SceneArgs,
    asked: Asked,
    registry: &Registry,
    interrupt: &AtomicBool,
) -> Result<Option<Chosen>> {
    refuse_options(args)?;
    let began = Instant::now();
    let ways = load(args, asked.threads, registry)?;
    let bar = progress_bar(ways.len());
    let pilots = asked.time.map_or(PILOTS, |time| PilotTime {
        each: time.mul_f64(SHARE_OF_TIME / ways.len() as f64),
        all: time.mul_f64(MOST_OF_TIME),
    });
    let tried = try_all(&ways, pilots, (asked.seed, asked.threads), interrupt, &bar)?;
    bar.finish_and_clear();
    let Some(tried) = tried else { return Ok(None) };
    let pilot_seconds = began.elapsed().as_secs_f64();
    let goal = match (asked.target_error, asked.time) {
        (Some(error), _) => Goal::Target(error),
        (None, Some(time)) => Goal::PixelErrorAfter((time.as_secs_f64() - pilot_seconds).max(0.1 * time.as_secs_f64())),
        (None, None) => Goal::PixelErrorAfter(seconds_of(&tried, asked.samples)),
    };
    let verdict = verdict::of(&tried, goal);
    let taken = verdict.taken.unwrap_or(0);
    let technique = CANDIDATES[taken];
    let why = match verdict.taken {
        Some(_) => verdict.sentence,
        None => format!("{technique}, for {}", verdict.sentence),
    };
    note(&format!("auto takes {why}; pilots took {}", duration(pilot_seconds)));
    Ok(Some(Chosen {
        technique: TechniqueChoice::One(technique),
        why,
        pilot_seconds,
    }))
}

/// How long so many samples per pixel take: of the first technique, since samples of others are other work.
fn seconds_of(tried: &[Tried], samples: f64) -> f64 {
    let first = tried.first().and_then(|way| way.pilot.as_ref());
    let seconds = first.and_then(|pilot| {
        let look = pilot.looks.last()?;
        Some(pilot.start_seconds + samples * look.seconds / look.steps as f64)
    });
    seconds.unwrap_or(UNKNOWN_TIME)
}

fn load(args: &SceneArgs, threads: usize, registry: &Registry) -> Result<Vec<Way>> {
    let mut ways: Vec<Way> = Vec::new();
    for technique in CANDIDATES {
        let loaded: Loaded = match ways.first() {
            None => {
                let first = SceneArgs {
                    technique: Some(TechniqueChoice::One(technique)),
                    ..args.clone()
                };
                first.load(registry)?
            }
            Some(first) => args.load_again(technique, &first.loaded, registry)?,
        };
        memory::check(&loaded, threads)?;
        ways.push(Way {
            name: technique.name().to_owned(),
            loaded,
        });
    }
    Ok(ways)
}

/// Refuses options that only some techniques take: which of them it will be is not known.
fn refuse_options(args: &SceneArgs) -> Result<()> {
    let SceneArgs {
        strategies,
        mutations,
        chains,
        ..
    } = args;
    let given = [
        chains.given(),
        strategies.base.map(|base| format!("--base {base}")),
        strategies.strategy.map(|(s, t)| format!("--strategy {s},{t}")),
        strategies.heuristic.map(|heuristic| format!("--heuristic {heuristic}")),
        strategies.direct.map(|direct| format!("--direct {direct}")),
        mutations.mutation.first().map(|text| format!("--mutation {text}")),
    ];
    match given.into_iter().flatten().next() {
        None => Ok(()),
        Some(option) => Err(miette!(
            help = "leave it out, or name a technique; `chainlight cost SCENE --way NAME=OPTIONS` tries techniques with options",
            "{option} cannot go with --technique auto: not every technique that it chooses from has that option"
        )),
    }
}
