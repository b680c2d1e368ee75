//! `render`: from a scene to a picture.

use super::auto::{self, Asked, Chosen};
use super::budget::{BudgetArgs, Default, TargetArgs, ThreadArgs};
use super::load::{Loaded, SceneArgs, TechniqueChoice, settings};
use super::output::{count, duration, note, print};
use super::report::{Report, missed};
use super::target::check_writable;
use super::{interrupt, memory};
use crate::film::{ImageView, PictureMetadata, ToneMap, write_exr, write_file, write_png};
use crate::plan::Registry;
use crate::render::{Findings, LayerFinding, Progress, RenderError, Rendering, drive, resume, start};
use crate::scene::description::EXPOSURE;
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use miette::{IntoDiagnostic, Result, miette};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Samples per pixel where neither `--spp` nor `--time` is given.
pub const DEFAULT_SPP: f64 = 96.0;

/// Steps of a progress bar.
const BAR_STEPS: u64 = 1_000_000;

/// Arguments of `render`.
#[derive(Args, Clone, Debug)]
pub struct RenderArgs {
    #[command(flatten)]
    pub(super) scene: SceneArgs,
    /// The picture, an OpenEXR file; a PNG is written beside it [default: the scene's name in this folder]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    target: TargetArgs,
    /// Save the render to this file when it ends, to go on from with --resume
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Go on with a saved render as if it had never stopped; --spp then counts from its beginning
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// Stops by which the PNG is shown brighter than its automatic exposure, or darker below 0, instead of the scene's; the EXR
    /// file has the light itself
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true, value_parser = parse_exposure)]
    exposure: Option<f32>,
    /// Seed of all random numbers: the same seed gives the same bytes
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) seed: u64,
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
    if let Some(path) = &args.save {
        check_writable(path)?;
        if *path == output || *path == png {
            return Err(miette!(
                help = "give the saved render a name of its own",
                "{}: the picture is written there",
                path.display()
            ));
        }
    }
    let saved = args.resume.as_deref().map(read_saved).transpose()?;
    let interrupt = interrupt::listen()?;
    let (args, chosen) = match args.scene.technique {
        Some(TechniqueChoice::Auto) => match args.choose(registry, &interrupt)? {
            Some((args, chosen)) => (args, Some(chosen)),
            None => return Ok(nothing_written(&ProgressBar::hidden())),
        },
        _ => (args.clone(), None),
    };
    let loaded = args.scene.load(registry)?;
    let threads = args.threads.count();
    memory::check(&loaded, threads)?;
    let pixels = loaded.scene.pixel_count();
    let default = Default::Samples(DEFAULT_SPP);
    let goal = args.target.within(args.budget, &loaded.plan, pixels, default)?;
    for warning in missed(&loaded.plan) {
        note(&format!("warning: {warning}"));
    }
    let bar = progress_bar();
    let (scene, plan) = (Arc::clone(&loaded.scene), loaded.plan.clone());
    let begun = match &saved {
        Some((path, bytes)) => resume(scene, plan, args.seed, threads, bytes)
            .map_err(|error| miette::Report::from(error).wrap_err(format!("{}: cannot go on", path.display()))),
        None => start(scene, plan, args.seed, threads, &interrupt, &|share| {
            show_bootstrap(&bar, share)
        })
        .map_err(|error| match error {
            RenderError::Interrupted => Interrupted.into(),
            error => error.into(),
        }),
    };
    let mut render = match begun {
        Err(error) if error.is::<Interrupted>() => return Ok(nothing_written(&bar)),
        begun => begun?,
    };
    args.budget.check_resumed(goal.budget, render.steps())?;
    let outcome = drive(&mut *render, goal, &interrupt, &|p| show(&bar, &loaded, p));
    bar.finish_and_clear();
    if outcome.steps == 0 {
        return Ok(nothing_written(&bar));
    }
    let findings = render.as_chains().map(Findings::of);
    let mut picture = render.picture();
    if let (Some(chains), Some(findings)) = (render.as_chains(), &findings) {
        picture = chains.with_layers(picture, findings);
    }
    let layers = render.layers();
    picture = LayerFinding::add_to(&layers, picture);
    write_exr(
        &output,
        &picture,
        &metadata(&args.scene.scene, args.seed, &loaded, &*render),
    )?;
    let stops = args.exposure.unwrap_or(loaded.exposure);
    let tone = ToneMap::automatic(picture.view()).brighter(stops);
    write_png(&png, picture.view(), tone)?;
    for layer in &layers {
        let view = ImageView {
            rgb: &layer.rgb,
            ..picture.view()
        };
        write_png(&png.with_extension(format!("{}.png", layer.record.name)), view, tone)?;
    }
    if let Some(path) = &args.save {
        write_file(path, &render.save())?;
    }
    let report = Report::new(&args, &loaded, &*render, outcome, &picture, &output, findings)
        .shown(tone)
        .split(&layers)
        .chosen(chosen);
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

impl RenderArgs {
    /// What `--technique auto` comes to: these arguments with the technique that promises most, and with the time that is left. `None` if
    /// somebody interrupted it.
    fn choose(&self, registry: &Registry, interrupt: &AtomicBool) -> Result<Option<(Self, Chosen)>> {
        if self.resume.is_some() {
            return Err(miette!(
                help =
                    "give the technique that it was saved with: the picture's metadata name it, and so did the render",
                "--technique auto cannot go with --resume: a saved render goes on with its own technique"
            ));
        }
        let asked = Asked {
            time: self.budget.time(),
            target_error: self.target.error(),
            samples: self.budget.samples().unwrap_or(DEFAULT_SPP),
            seed: self.seed,
            threads: self.threads.count(),
        };
        let began = Instant::now();
        let Some(chosen) = auto::choose(&self.scene, asked, registry, interrupt)? else {
            return Ok(None);
        };
        let mut args = self.clone();
        args.scene.technique = Some(chosen.technique);
        args.budget = args.budget.after(began.elapsed());
        Ok(Some((args, chosen)))
    }
}

/// Somebody stopped it before there was anything to write.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("interrupted before the first step")]
struct Interrupted;

fn nothing_written(bar: &ProgressBar) -> ExitCode {
    bar.finish_and_clear();
    note("interrupted before the first sample: nothing was written");
    ExitCode::from(interrupt::EXIT_STATUS)
}

fn read_saved(path: &Path) -> Result<(PathBuf, Vec<u8>)> {
    let bytes = std::fs::read(path).map_err(|error| {
        miette!(
            help = "give the file that --save wrote",
            "{}: cannot be read: {error}",
            path.display()
        )
    })?;
    Ok((path.to_owned(), bytes))
}

/// How a picture of the scene in the file `scene` was made.
pub(super) fn metadata(scene: &Path, seed: u64, loaded: &Loaded, render: &dyn Rendering) -> PictureMetadata {
    let steps = render.steps();
    let mut metadata = PictureMetadata {
        scene: scene_name(scene),
        technique: loaded.plan.technique.name().to_owned(),
        settings: settings(loaded),
        seed,
        steps,
        software: concat!("chainlight ", env!("CARGO_PKG_VERSION")).to_owned(),
        ..PictureMetadata::default()
    };
    if let Some(chains) = &loaded.plan.chains {
        let mutations = chains.counts.mutations_per_pixel(steps, loaded.scene.pixel_count());
        metadata = metadata.with("mutations_per_pixel", mutations.to_string());
    }
    if let Some(direct) = render.direct() {
        metadata = metadata.with("direct_samples_per_pixel", direct.samples_per_pixel().to_string());
    }
    metadata
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

fn show_bootstrap(bar: &ProgressBar, share: f64) {
    bar.set_position((share * BAR_STEPS as f64) as u64);
    bar.set_message("bootstrap");
}

fn show(bar: &ProgressBar, loaded: &Loaded, progress: Progress) {
    bar.set_position((progress.fraction * BAR_STEPS as f64) as u64);
    let rate = progress.samples as f64 / bar.elapsed().as_secs_f64().max(1e-9);
    let mut message = match &loaded.plan.chains {
        Some(chains) => {
            let mutations = chains
                .counts
                .mutations_per_pixel(progress.steps, loaded.scene.pixel_count());
            format!("{mutations:.1} mutations per pixel, {} a second", count(rate))
        }
        None => format!("{} samples per pixel, {} a second", progress.steps, count(rate)),
    };
    if let Some(error) = progress.error {
        message += &format!(
            ", error {:.2} % (up to {:.2} %)",
            100.0 * error.rms,
            100.0 * error.upper
        );
    }
    if let Some((left, target)) = progress.to_target {
        message += &format!(", about {} to {} %", duration(left.as_secs_f64()), 100.0 * target);
    }
    if let Some(acceptance) = progress.acceptance {
        message += &format!(", {:.0} % taken", 100.0 * acceptance);
    }
    bar.set_message(message);
}

fn parse_exposure(text: &str) -> Result<f32, String> {
    let [least, most] = EXPOSURE;
    match text.parse::<f32>() {
        Ok(stops) if (least..=most).contains(&stops) => Ok(stops),
        _ => Err(format!(
            "expected stops from {least} to {most}, such as 2 for four times as bright"
        )),
    }
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
