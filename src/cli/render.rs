//! `render`: from a scene to a picture.

use super::load::{Loaded, SceneArgs, settings};
use super::output::{count, note, print};
use crate::film::{ImageView, Picture, PictureMetadata, ToneMap, write_exr, write_png};
use crate::render::{Budget, Outcome, Progress, Render, Stop, drive};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use miette::{IntoDiagnostic, Result, WrapErr, miette};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Samples per pixel where neither `--spp` nor `--time` is given.
pub const DEFAULT_SPP: u64 = 64;

/// Steps of a progress bar.
const BAR_STEPS: u64 = 1000;

/// Arguments of `render`.
#[derive(Args, Clone, Debug)]
pub struct RenderArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// The picture, an OpenEXR file; a PNG is written beside it [default: the scene's name in this folder]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    budget: BudgetArgs,
    /// Seed of all random numbers: the same seed gives the same bytes
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Threads; 0 takes one per core. The picture does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Print a report as JSON on standard output
    #[arg(long)]
    json: bool,
}

/// How long to render.
#[derive(Args, Clone, Copy, Debug)]
pub struct BudgetArgs {
    /// Samples per pixel [default: 64]
    #[arg(long, value_name = "N", conflicts_with = "time", value_parser = clap::value_parser!(u64).range(1..=u64::from(u32::MAX)))]
    spp: Option<u64>,
    /// Seconds to render; the number of samples reached is recorded, and with it --spp gives the same bytes
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    time: Option<Duration>,
}

impl BudgetArgs {
    /// The budget, `default` where none was given.
    #[must_use]
    pub fn or(self, default: Budget) -> Budget {
        self.time
            .map(Budget::Time)
            .or(self.spp.map(Budget::Steps))
            .unwrap_or(default)
    }
}

/// What `--json` prints. Times stand here and not in the picture, whose bytes are those of its settings alone.
#[derive(Serialize)]
struct Report<'a> {
    scene: String,
    technique: &'static str,
    settings: String,
    seed: u64,
    steps: u64,
    interrupted: bool,
    output: String,
    threads: usize,
    load_seconds: f64,
    render_seconds: f64,
    samples: u64,
    samples_per_second: f64,
    rays: u64,
    segments: u64,
    /// Mean over pixels and channels, W sr⁻¹ m⁻².
    mean: f64,
    /// Root of the mean squared standard error of pixels and channels; absent with a single sample.
    rms_error: Option<f64>,
    relative_rms_error: Option<f64>,
    non_finite: u64,
    first_non_finite: Option<(u32, u64)>,
    saturated: u64,
    vanished: u64,
    warnings: &'a [String],
}

/// Renders.
///
/// # Errors
/// Whatever stands in the way, before rendering where it can be known then.
pub fn run(args: &RenderArgs) -> Result<ExitCode> {
    let output = args.output.clone().unwrap_or_else(|| default_output(&args.scene.scene));
    check_output(&output)?;
    let loaded = args.scene.load()?;
    let interrupt = on_interrupt()?;
    let mut render = Render::new(Arc::clone(&loaded.scene), loaded.plan.clone(), args.seed, args.threads)?;
    let bar = progress_bar();
    let outcome = drive(
        &mut render,
        args.budget.or(Budget::Steps(DEFAULT_SPP)),
        &interrupt,
        &|p| show(&bar, p),
    );
    bar.finish_and_clear();
    if outcome.steps == 0 {
        note("interrupted before the first sample: nothing was written");
        return Ok(ExitCode::from(INTERRUPTED));
    }
    let picture = render.film.develop();
    let metadata = PictureMetadata {
        scene: scene_name(&args.scene.scene),
        technique: loaded.plan.technique.name().to_owned(),
        settings: settings(&loaded),
        seed: args.seed,
        steps: outcome.steps,
        software: concat!("chainlight ", env!("CARGO_PKG_VERSION")).to_owned(),
    };
    write_exr(&output, &picture, &metadata)?;
    let png = output.with_extension("png");
    write_png(&png, picture.view(), ToneMap::automatic(picture.view()))?;
    let report = report(args, &loaded, &render, outcome, &picture, &output);
    if args.json {
        print(&serde_json::to_string_pretty(&report).into_diagnostic()?)?;
    } else {
        print(&summary(&report, &png))?;
    }
    warn(&report);
    Ok(if report.interrupted {
        ExitCode::from(INTERRUPTED)
    } else {
        ExitCode::SUCCESS
    })
}

/// The exit status of a program that was interrupted: 128 + SIGINT.
const INTERRUPTED: u8 = 130;

fn default_output(scene: &Path) -> PathBuf {
    let mut name = scene.file_stem().unwrap_or(scene.as_os_str()).to_owned();
    name.push(".exr");
    name.into()
}

/// The scene as a picture's metadata names it: its file name, so that the folder it was rendered from does not show.
fn scene_name(scene: &Path) -> String {
    scene
        .file_name()
        .unwrap_or(scene.as_os_str())
        .to_string_lossy()
        .into_owned()
}

/// Says before rendering what would go wrong after it.
fn check_output(output: &Path) -> Result<()> {
    if output
        .extension()
        .is_none_or(|extension| !extension.eq_ignore_ascii_case("exr"))
    {
        return Err(miette!(
            help = "pictures are OpenEXR files with a PNG beside them: give a name such as picture.exr",
            "{}: the output's name does not end in .exr",
            output.display()
        ));
    }
    let folder = output
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(miette!(
            help = "make the folder first, or give another name with --output",
            "{}: there is no such folder to write {} to",
            folder.display(),
            output.display()
        ));
    }
    if output.is_dir() {
        return Err(miette!(
            help = "give a file's name with --output",
            "{} is a folder",
            output.display()
        ));
    }
    Ok(())
}

/// A flag that the first Ctrl-C sets; the second ends the program at once.
fn on_interrupt() -> Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&flag);
    ctrlc::set_handler(move || {
        if handler.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(INTERRUPTED));
        }
        note("\nstopping after this step; once more to stop at once and write nothing");
    })
    .into_diagnostic()
    .wrap_err("cannot listen for Ctrl-C")?;
    Ok(flag)
}

/// A bar on a terminal; hidden, and so quiet, anywhere else.
fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {elapsed} gone, {eta} left");
    if let Ok(style) = style {
        bar.set_style(style);
    }
    bar
}

fn show(bar: &ProgressBar, progress: Progress) {
    bar.set_position((progress.fraction * BAR_STEPS as f64) as u64);
    let rate = progress.samples as f64 / bar.elapsed().as_secs_f64().max(1e-9);
    bar.set_message(format!(
        "{} samples per pixel, {} samples/s",
        progress.steps,
        count(rate)
    ));
}

fn report<'a>(
    args: &RenderArgs,
    loaded: &'a Loaded,
    render: &Render,
    outcome: Outcome,
    picture: &Picture,
    output: &Path,
) -> Report<'a> {
    let counters = render.counters();
    let tally = render.film.tally();
    let mean = mean(picture.view(), f64::from);
    let rms_error = (outcome.steps > 1).then(|| {
        self::mean(
            ImageView {
                rgb: &picture.error,
                ..picture.view()
            },
            |e| f64::from(e) * f64::from(e),
        )
        .sqrt()
    });
    let seconds = outcome.elapsed.as_secs_f64();
    Report {
        scene: args.scene.scene.display().to_string(),
        technique: loaded.plan.technique.name(),
        settings: settings(loaded),
        seed: args.seed,
        steps: outcome.steps,
        interrupted: outcome.stop == Stop::Interrupted,
        output: output.display().to_string(),
        threads: render.threads(),
        load_seconds: loaded.load_time.as_secs_f64(),
        render_seconds: seconds,
        samples: counters.decisions,
        samples_per_second: counters.decisions as f64 / seconds.max(1e-9),
        rays: counters.rays,
        segments: counters.segments,
        mean,
        rms_error,
        relative_rms_error: rms_error.filter(|_| mean > 0.0).map(|error| error / mean),
        non_finite: counters.non_finite + tally.non_finite,
        first_non_finite: counters.first_non_finite,
        saturated: tally.saturated,
        vanished: tally.vanished,
        warnings: &loaded.warnings,
    }
}

/// The mean of `f` over pixels and channels.
fn mean(picture: ImageView<'_>, f: impl Fn(f32) -> f64) -> f64 {
    let channels = picture.rgb.iter().flat_map(|rgb| rgb.to_array());
    channels.map(f).sum::<f64>() / (3 * picture.rgb.len()).max(1) as f64
}

fn summary(report: &Report<'_>, png: &Path) -> String {
    let Report {
        technique,
        steps,
        render_seconds,
        threads,
        ..
    } = report;
    let error = report
        .relative_rms_error
        .map(|e| format!(", relative RMS error {:.2} %", 100.0 * e))
        .unwrap_or_default();
    let interrupted = if report.interrupted { "interrupted; " } else { "" };
    format!(
        "{interrupted}{technique}: {steps} samples per pixel in {render_seconds:.1} s on {threads} threads, {} samples/s{error}\n\
         wrote {} and {}",
        count(report.samples_per_second),
        report.output,
        png.display()
    )
}

/// Says in words what numbers in the report would hide.
fn warn(report: &Report<'_>) {
    if let (n @ 1.., Some((chain, step))) = (report.non_finite, report.first_non_finite) {
        note(&format!(
            "warning: {n} samples were not finite and count as black; the first: chain {chain}, step {step}"
        ));
    }
    if report.saturated > 0 {
        note(&format!(
            "warning: {} samples were too bright for the film and were cut: the picture is wrong",
            report.saturated
        ));
    }
}

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text
        .parse()
        .map_err(|_| "expected a number of seconds, such as 30 or 0.5".to_owned())?;
    let longest = 3.2e7;
    if !(seconds > 0.0 && seconds <= longest) {
        return Err(format!(
            "expected a number of seconds above 0 and up to {longest:e} (a year)"
        ));
    }
    Ok(Duration::from_secs_f64(seconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_positive_and_finite() {
        assert_eq!(parse_seconds("0.5"), Ok(Duration::from_millis(500)));
        for bad in ["0", "-1", "nan", "inf", "1e300", "soon", ""] {
            assert!(parse_seconds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn the_output_takes_the_scenes_name() {
        assert_eq!(default_output(Path::new("scenes/box.ron")), Path::new("box.exr"));
        assert_eq!(default_output(Path::new("a.b/c.d.json")), Path::new("c.d.exr"));
    }
}
