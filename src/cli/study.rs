//! `study`: what accuracy costs in time.

use super::budget::{ThreadArgs, parse_seconds};
use super::load::{Loaded, parse_size, settings};
use super::output::{note, print};
use super::study_runs::{Runner, picture_file};
use super::study_table::table;
use super::ways::{WayArgs, way_options};
use super::{interrupt, memory};
use crate::film::write_file;
use crate::plan::{Registry, Technique};
use crate::report::{Against, Shown, error_curves, error_spectra, page};
use crate::study::{Measure, Reference, ReferenceError, SceneStudy, Settings, Study, Summary, WaySettings};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use miette::{IntoDiagnostic, Result, WrapErr, miette};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// The study's file in its folder.
const FILE: &str = "study.json";

/// The page that shows it.
const PAGE: &str = "report.html";

/// Arguments of `study`.
#[derive(Args, Clone, Debug)]
pub struct StudyArgs {
    /// Scene files: RON, or JSON by its extension
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    ways: WayArgs,
    /// Seconds of each run, start-up included; the picture is looked at after this, half of it, a quarter, and so on to a 64th
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, default_value = "8")]
    pub(super) time: Duration,
    /// Runs of every way, each with a seed of its own
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub(super) runs: u32,
    /// What pictures of the scene are compared with, an OpenEXR file
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with = "make_reference",
        required_unless_present = "make_reference"
    )]
    pub(super) reference: Option<PathBuf>,
    /// Make the references first, for so many seconds each [default: 32 times as long as a run]
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, num_args = 0..=1, require_equals = true)]
    pub(super) make_reference: Option<Option<Duration>>,
    /// What references are made with
    #[arg(long, value_name = "NAME", default_value = "bdpt", requires = "make_reference")]
    pub(super) reference_technique: Technique,
    /// The folder of the study. One that is there already is gone on with
    #[arg(short, long, value_name = "FOLDER")]
    pub(super) output: PathBuf,
    /// Tell what every effect costs too: one run more of every way, which splits its light into layers by the paths that bring it
    #[arg(long)]
    layers: bool,
    /// Film size in pixels instead of the scenes', such as 160x120
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<(u32, u32)>,
    /// The first run's seed; others follow
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) seed: u64,
    #[command(flatten)]
    pub(super) threads: ThreadArgs,
    /// Print all summaries as JSON
    #[arg(long)]
    json: bool,
}

/// A scene of the study, ready to render in every way.
pub(super) struct Subject {
    pub(super) name: String,
    pub(super) file: PathBuf,
    pub(super) ways: Vec<Loaded>,
}

impl Subject {
    /// The picture in `file` as a reference of this scene.
    pub(super) fn reference(&self, file: &Path) -> Result<Reference, ReferenceError> {
        let first = &self.ways[0];
        Reference::read(file, &first.scene, &settings(first))
    }
}

/// Runs whatever of the study is not done yet, and prints what it says.
///
/// # Errors
/// Whatever stands in the way, before anything is rendered where it can be known then.
pub fn run(args: &StudyArgs, registry: &Registry) -> Result<ExitCode> {
    let settings = args.settings()?;
    if args.reference.is_some() && args.scenes.len() > 1 {
        return Err(miette!(
            help = "study one scene at a time, or make references with --make-reference",
            "--reference is of one scene, and there are {}",
            args.scenes.len()
        ));
    }
    let path = args.output.join(FILE);
    let mut study = match Study::read(&path)? {
        Some(study) => {
            study.is_of(&settings, &machine(), &path)?;
            study
        }
        None => Study::new(settings, machine()),
    };
    let subjects = args.subjects(registry, &study.settings.ways)?;
    if let (Some(file), [subject, ..]) = (&args.reference, &subjects[..]) {
        subject.reference(file)?;
    }
    std::fs::create_dir_all(&args.output)
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot make the folder {}", args.output.display()))?;
    let interrupt = interrupt::listen()?;
    let bar = progress_bar(u64::from(args.runs) * (subjects.len() * study.settings.ways.len()) as u64);
    let runner = Runner {
        args,
        registry,
        path: &path,
        interrupt: &interrupt,
        bar: &bar,
    };
    for subject in &subjects {
        let Some(reference) = runner.reference_of(subject, &mut study)? else {
            return Ok(interrupted(&bar));
        };
        let done = runner.render(subject, &reference, &mut study)?;
        if !done || (args.layers && !runner.split(subject, &mut study)?) {
            return Ok(interrupted(&bar));
        }
    }
    bar.finish_and_clear();
    let mut shown = Vec::new();
    for scene in &study.scenes {
        plot(scene, &args.output)?;
        shown.push(Shown::read(scene, |way| picture_file(&args.output, &scene.name, way))?);
    }
    write_file(&args.output.join(PAGE), page(&study, &shown)?.as_bytes())?;
    let asked = |scene: &&SceneStudy| subjects.iter().any(|subject| subject.name == scene.name);
    let scenes: Vec<&SceneStudy> = study.scenes.iter().filter(asked).collect();
    print(&if args.json {
        let all = |scene: &&SceneStudy| (scene.name.clone(), summaries(scene).into());
        let all: serde_json::Map<String, serde_json::Value> = scenes.iter().map(all).collect();
        serde_json::to_string_pretty(&all).into_diagnostic()?
    } else {
        scenes.into_iter().map(table).collect::<Vec<String>>().join("\n\n")
    })?;
    Ok(ExitCode::SUCCESS)
}

/// Draws what a scene's runs say into the study's folder.
fn plot(scene: &SceneStudy, folder: &Path) -> Result<()> {
    let write = |name: String, svg: Option<String>| match svg {
        Some(svg) => write_file(&folder.join(name), svg.as_bytes()),
        None => Ok(()),
    };
    for measure in Measure::ALL {
        for (against, more) in [(Against::Time, ""), (Against::Samples, "-samples")] {
            let name = format!("{}-{}{more}.svg", scene.name, measure.file_name());
            write(name, error_curves(scene, measure, against)?)?;
        }
    }
    write(format!("{}-spectrum.svg", scene.name), error_spectra(scene)?)?;
    Ok(())
}

/// All summaries of a scene, as JSON.
fn summaries(scene: &SceneStudy) -> Vec<serde_json::Value> {
    let all = scene
        .ways
        .iter()
        .flat_map(|way| Measure::ALL.map(|measure| (way, measure)));
    all.filter_map(|(way, measure)| serde_json::to_value(Summary::of(scene, way, measure)).ok())
        .collect()
}

/// The program, and what it runs on.
fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let model = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|info| {
        let line = info.lines().find_map(|line| line.strip_prefix("model name"))?;
        Some(line.trim_start_matches([' ', '\t', ':']).to_owned())
    });
    format!(
        "chainlight {} on {}, {cores} cores, {} {}",
        env!("CARGO_PKG_VERSION"),
        model.as_deref().unwrap_or("an unknown processor"),
        std::env::consts::OS,
        std::env::consts::ARCH
    )
}

fn progress_bar(runs: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(runs), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:32} {pos} of {len} runs  {msg}  {elapsed} gone, {eta} left") {
        bar.set_style(style);
    }
    bar
}

fn interrupted(bar: &ProgressBar) -> ExitCode {
    bar.finish_and_clear();
    note("interrupted: the runs that are done are kept, and the same command goes on with them");
    ExitCode::from(interrupt::EXIT_STATUS)
}

impl StudyArgs {
    fn settings(&self) -> Result<Settings> {
        let ways = self.ways.settings()?;
        Ok(Settings {
            seconds: self.time.as_secs_f64(),
            threads: self.threads.count(),
            seed: self.seed,
            size: self.size,
            ways,
        })
    }

    /// All scenes, each loaded once for every way.
    fn subjects(&self, registry: &Registry, ways: &[WaySettings]) -> Result<Vec<Subject>> {
        let mut subjects: Vec<Subject> = Vec::new();
        for file in &self.scenes {
            let name = file
                .file_stem()
                .unwrap_or(file.as_os_str())
                .to_string_lossy()
                .into_owned();
            if subjects.iter().any(|subject| subject.name == name) {
                return Err(miette!(
                    help = "give one of the files another name",
                    "there are two scenes named {name}"
                ));
            }
            let ways: Vec<Loaded> = ways
                .iter()
                .map(|way| {
                    self.load(file, &way.options, registry)
                        .wrap_err_with(|| format!("{}, {name}", way.name))
                })
                .collect::<Result<_>>()?;
            subjects.push(Subject {
                name,
                file: file.clone(),
                ways,
            });
        }
        Ok(subjects)
    }

    pub(super) fn load(&self, file: &Path, options: &[String], registry: &Registry) -> Result<Loaded> {
        let loaded = way_options(file, options, self.size)?.load(registry)?;
        memory::check(&loaded, self.threads.count())?;
        Ok(loaded)
    }
}
