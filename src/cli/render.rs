//! `render`: from a scene to a picture.

use super::budget::{BudgetArgs, ThreadArgs};
use super::load::{SceneArgs, settings};
use super::output::{count, note, print};
use super::report::Report;
use super::target::check_writable;
use super::{interrupt, memory};
use crate::film::{PictureMetadata, ToneMap, write_exr, write_png};
use crate::plan::Registry;
use crate::render::{Budget, Progress, drive, start};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use miette::{IntoDiagnostic, Result, miette};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// Samples per pixel where neither `--spp` nor `--time` is given.
pub const DEFAULT_SPP: u64 = 96;

/// Steps of a progress bar.
const BAR_STEPS: u64 = 1_000_000;

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
    #[command(flatten)]
    threads: ThreadArgs,
    /// Print a report as JSON on standard output
    #[arg(long)]
    json: bool,
}

/// Renders.
///
/// # Errors
/// Whatever stands in the way, before rendering where it can be known then.
pub fn run(args: &RenderArgs, registry: &Registry) -> Result<ExitCode> {
    let output = args.output.clone().unwrap_or_else(|| default_output(&args.scene.scene));
    let png = output.with_extension("png");
    check_output(&output, &png)?;
    let loaded = args.scene.load(registry)?;
    let threads = args.threads.count();
    memory::check(&loaded, threads)?;
    let interrupt = interrupt::listen()?;
    let bar = progress_bar();
    let (scene, plan) = (Arc::clone(&loaded.scene), loaded.plan.clone());
    let mut render = start(scene, plan, args.seed, threads, &interrupt, &|_| {})?;
    let outcome = drive(
        &mut *render,
        args.budget.or(Budget::Steps(DEFAULT_SPP)),
        &interrupt,
        &|p| show(&bar, p),
    );
    bar.finish_and_clear();
    if outcome.steps == 0 {
        note("interrupted before the first sample: nothing was written");
        return Ok(ExitCode::from(interrupt::EXIT_STATUS));
    }
    let picture = render.picture();
    let metadata = PictureMetadata {
        scene: scene_name(&args.scene.scene),
        technique: loaded.plan.technique.name().to_owned(),
        settings: settings(&loaded),
        seed: args.seed,
        steps: outcome.steps,
        software: concat!("chainlight ", env!("CARGO_PKG_VERSION")).to_owned(),
        ..PictureMetadata::default()
    };
    write_exr(&output, &picture, &metadata)?;
    write_png(&png, picture.view(), ToneMap::automatic(picture.view()))?;
    let report = Report::new(
        &args.scene.scene,
        args.seed,
        &loaded,
        &*render,
        outcome,
        &picture,
        &output,
    );
    if args.json {
        print(&serde_json::to_string_pretty(&report).into_diagnostic()?)?;
    } else {
        print(&report.summary(&png))?;
    }
    report.warn();
    Ok(if report.interrupted {
        ExitCode::from(interrupt::EXIT_STATUS)
    } else {
        ExitCode::SUCCESS
    })
}

fn default_output(scene: &Path) -> PathBuf {
    let mut name = scene.file_stem().unwrap_or("picture".as_ref()).to_owned();
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
fn check_output(output: &Path, preview: &Path) -> Result<()> {
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
    check_writable(output)?;
    check_writable(preview)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_output_takes_the_scenes_name() {
        assert_eq!(default_output(Path::new("scenes/box.ron")), Path::new("box.exr"));
        assert_eq!(default_output(Path::new("a.b/c.d.json")), Path::new("c.d.exr"));
    }
}
