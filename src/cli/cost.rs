//! `cost`: what accuracy will cost in time, and which technique to take, from short pilots and without a reference.

use super::budget::{ThreadArgs, parse_error, parse_seconds};
use super::cost_table::table;
use super::load::parse_size;
use super::output::{note, print};
use super::pilots::{PilotTime, Tried, load, progress_bar, try_all};
use super::ways::WayArgs;
use super::{interrupt, verdict};
use crate::plan::Registry;
use crate::study::{Foreseen, Prediction, WaySettings};
use clap::Args;
use miette::{IntoDiagnostic, Result, miette};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

/// Arguments of `cost`.
#[derive(Args, Clone, Debug)]
pub struct CostArgs {
    /// The scene file: RON, or JSON by its extension
    scene: PathBuf,
    #[command(flatten)]
    ways: WayArgs,
    /// Seconds of each pilot, start-up included; longer ones make predictions surer
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, default_value = "3")]
    pilot: Duration,
    /// Errors to predict the times to: as relMSE, and as the --target-error of `render`
    #[arg(long, value_name = "E,...", value_delimiter = ',', value_parser = parse_error, default_value = "0.1,0.03,0.01")]
    errors: Vec<f64>,
    /// Choose what will be the first to be stopped by this --target-error of `render`, instead of the first to have the least of
    /// --errors as its relMSE without the worst 0.1 % of pixels
    #[arg(long, value_name = "E", value_parser = parse_error)]
    target_error: Option<f64>,
    /// Film size in pixels instead of the scene's, such as 640x480
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<(u32, u32)>,
    /// Pilots have seeds that are far from this one
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What no pilot can tell.
const ASSUMES: &str = "assumed: a machine as busy as now, errors that go on falling as in the pilots, and no light that no pilot has found";

/// What `--json` prints.
#[derive(Serialize)]
pub(super) struct Report {
    pub(super) scene: String,
    /// Pixels in a row, and rows.
    pub(super) size: (u32, u32),
    pub(super) threads: usize,
    /// Seconds of each pilot, as asked for.
    pub(super) pilot_seconds: f64,
    pub(super) ways: Vec<WayReport>,
    /// What predictions assume.
    pub(super) assumes: &'static str,
    /// The name of the way that it would take.
    pub(super) choice: Option<String>,
    /// What the choice goes by.
    pub(super) goal: String,
    /// Which, and why.
    pub(super) why: String,
}

/// What is said of a way.
#[derive(Serialize)]
pub(super) struct WayReport {
    pub(super) name: String,
    technique: &'static str,
    settings: String,
    /// Light that it cannot find.
    pub(super) missing: Vec<String>,
    /// Seconds before its first step; absent if that was not to be waited for.
    pub(super) start_seconds: Option<f64>,
    /// Steps of the pilot.
    steps: Option<u64>,
    pub(super) predicted: Vec<MeasureReport>,
}

/// What is said of a way by one measure.
#[derive(Serialize)]
pub(super) struct MeasureReport {
    pub(super) measure: &'static str,
    /// Seconds of steps of the pilot and what its error was then, squared for block means.
    looks: Vec<[f64; 2]>,
    /// By how much errors fall slower than with the root of the time: e² ~ s^(growth − 1). Absent where nothing is known.
    pub(super) growth: Option<f64>,
    /// Seconds to each error, start-up included.
    pub(super) times: Vec<TimeReport>,
}

/// The time to an error.
#[derive(Serialize)]
pub(super) struct TimeReport {
    pub(super) error: f64,
    pub(super) seconds: Option<Prediction>,
}

/// Tries all ways and prints what they promise.
///
/// # Errors
/// A scene that cannot be loaded, or ways that do not fit.
pub fn run(args: &CostArgs, registry: &Registry) -> Result<ExitCode> {
    let ways: Vec<WaySettings> = args.ways.settings()?;
    let threads = args.threads.count();
    let ways = load(&args.scene, &ways, args.size, threads, registry)?;
    let [first, ..] = &ways[..] else {
        return Err(miette!(
            help = "name one, such as --techniques pt",
            "there is no technique to try"
        ));
    };
    let size = (first.loaded.scene.width, first.loaded.scene.height);
    let interrupt = interrupt::listen()?;
    let bar = progress_bar(ways.len());
    let time = PilotTime {
        each: args.pilot,
        all: Duration::MAX,
    };
    let tried = try_all(&ways, time, (args.seed, threads), &interrupt, &bar)?;
    bar.finish_and_clear();
    let Some(tried) = tried else {
        note("interrupted: of pilots that are not done, nothing can be told");
        return Ok(ExitCode::from(interrupt::EXIT_STATUS));
    };
    let mut errors = args.errors.clone();
    errors.sort_by(|a, b| b.total_cmp(a));
    errors.dedup();
    let goal = match args.target_error {
        Some(error) => verdict::Goal::Target(error),
        None => verdict::Goal::PixelError(errors.last().copied().unwrap_or(0.01)),
    };
    let verdict = verdict::of(&tried, goal);
    let report = Report {
        scene: args.scene.display().to_string(),
        size,
        threads,
        pilot_seconds: args.pilot.as_secs_f64(),
        ways: tried
            .iter()
            .map(|way| way_report(way, &errors, args.target_error))
            .collect(),
        assumes: ASSUMES,
        choice: verdict.taken.map(|taken| tried[taken].name.clone()),
        goal: goal.to_string(),
        why: verdict.sentence,
    };
    print(&if args.json {
        serde_json::to_string_pretty(&report).into_diagnostic()?
    } else {
        table(&report)
    })?;
    Ok(ExitCode::SUCCESS)
}

fn way_report(way: &Tried, errors: &[f64], target: Option<f64>) -> WayReport {
    let predicted = Foreseen::ALL.map(|foreseen| {
        let forecast = way.outlook.forecast(foreseen);
        let time = |&error: &f64| TimeReport {
            error,
            seconds: forecast.map(|forecast| forecast.seconds_to(foreseen.squared(error)).prediction()),
        };
        let more = target.filter(|target| foreseen == Foreseen::Blocks && !errors.contains(target));
        MeasureReport {
            measure: foreseen.name(),
            looks: way.outlook.looks(foreseen).to_vec(),
            growth: forecast.map(|forecast| forecast.growth),
            times: errors.iter().chain(&more).map(time).collect(),
        }
    });
    WayReport {
        name: way.name.clone(),
        technique: way.technique,
        settings: way.settings.clone(),
        missing: way.missing.clone(),
        start_seconds: way.pilot.as_ref().map(|pilot| pilot.start_seconds),
        steps: way.pilot.as_ref().and_then(|pilot| Some(pilot.looks.last()?.steps)),
        predicted: predicted.into(),
    }
}
