//! Pilots of several ways to render a scene, and what they say: what `cost` tells, and `render --technique auto` goes by.

use super::load::{Loaded, TechniqueChoice, settings};
use super::memory;
use super::report::missed;
use super::ways::way_options;
use crate::plan::{Missing, Plan, Registry};
use crate::study::{Outlook, Pilot, PilotEnd, Pooled, WaySettings, pilot};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use miette::{Result, WrapErr};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Pilots' seeds are so far from those of renders and of references.
const PILOT_SEED: u64 = 1 << 47;

/// A way to render the scene, ready to.
pub(super) struct Way {
    pub(super) name: String,
    pub(super) loaded: Loaded,
}

/// A way that was tried.
pub(super) struct Tried {
    pub(super) name: String,
    pub(super) technique: &'static str,
    /// Settings that shape the picture, as its metadata has them.
    pub(super) settings: String,
    /// Light that it cannot find, in words.
    pub(super) missing: Vec<String>,
    /// How much of the picture that is; 1 where it may be anywhere.
    pub(super) misses: f64,
    /// `None` if it did not start in time.
    pub(super) pilot: Option<Pilot>,
    /// What that says.
    pub(super) outlook: Outlook,
}

/// Loads the scene in `file` for every way: once, where ways do not ask for another size or depth.
///
/// # Errors
/// A scene or options that do not fit, or too little memory.
pub(super) fn load(
    file: &Path,
    ways: &[WaySettings],
    size: Option<(u32, u32)>,
    threads: usize,
    registry: &Registry,
) -> Result<Vec<Way>> {
    let mut loaded: Vec<Way> = Vec::new();
    let mut first = None;
    for way in ways {
        let options = way_options(file, &way.options, size).wrap_err_with(|| way.name.clone())?;
        let asked = (options.size, options.max_depth);
        let again = match (options.technique, loaded.first()) {
            (Some(TechniqueChoice::One(technique)), Some(other)) if first == Some(asked) => {
                options.load_again(technique, &other.loaded, registry)
            }
            _ => options.load(registry),
        };
        let again = again.wrap_err_with(|| way.name.clone())?;
        memory::check(&again, threads)?;
        first.get_or_insert(asked);
        loaded.push(Way {
            name: way.name.clone(),
            loaded: again,
        });
    }
    Ok(loaded)
}

/// How long pilots are.
#[derive(Clone, Copy, Debug)]
pub(super) struct PilotTime {
    /// Seconds of each, start-up included.
    pub(super) each: Duration,
    /// How long all may take: one that has not started then is given up.
    pub(super) all: Duration,
}

/// Tries every way. `None` if somebody interrupted it.
///
/// # Errors
/// A render that cannot start.
pub(super) fn try_all(
    ways: &[Way],
    time: PilotTime,
    (seed, threads): (u64, usize),
    interrupt: &AtomicBool,
    bar: &ProgressBar,
) -> Result<Option<Vec<Tried>>> {
    let began = Instant::now();
    let mut tried = Vec::new();
    for way in ways {
        bar.set_message(format!("pilot of {}", way.name));
        let plan = &way.loaded.plan;
        let end = pilot(
            (&way.loaded.scene, plan),
            (seed.wrapping_add(PILOT_SEED), threads),
            time.each.as_secs_f64(),
            time.all.saturating_sub(began.elapsed()),
            interrupt,
            &|| bar.tick(),
        )?;
        bar.inc(1);
        tried.push(Tried {
            name: way.name.clone(),
            technique: plan.technique.name(),
            settings: settings(&way.loaded),
            missing: missed(plan),
            misses: misses(plan),
            pilot: match end {
                PilotEnd::Done(pilot) => Some(pilot),
                PilotEnd::Late => None,
                PilotEnd::Interrupted => return Ok(None),
            },
            outlook: Outlook::default(),
        });
    }
    judge(&mut tried);
    Ok(Some(tried))
}

/// Makes outlooks of pilots: relative to the pictures of those that miss least light, pooled.
fn judge(tried: &mut [Tried]) {
    let least = tried.iter().map(|way| way.misses).fold(f64::INFINITY, f64::min);
    let fit = tried.iter().filter(|way| way.misses <= least);
    let pictures: Vec<_> = fit.filter_map(|way| Some(&way.pilot.as_ref()?.picture)).collect();
    let pooled = Pooled::of(&pictures);
    let Some(pooled) = pooled else { return };
    for way in tried {
        if let Some(pilot) = &way.pilot {
            way.outlook = Outlook::of(pilot, &pooled);
        }
    }
}

/// The share of the picture that a plan's technique cannot find; 1 where it may be anywhere.
fn misses(plan: &Plan) -> f64 {
    let seen = plan.missing.iter().filter(|missing| missing.is_likely());
    seen.map(|Missing { share, .. }| share.unwrap_or(1.0)).sum()
}

/// A bar of pilots on a terminal; hidden anywhere else.
pub(super) fn progress_bar(pilots: usize) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(pilots as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:32} {pos} of {len} pilots  {msg}  {elapsed} gone") {
        bar.set_style(style);
    }
    bar
}
