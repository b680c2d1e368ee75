//! `check`: tries to refute mutations.

use super::budget::ThreadArgs;
use super::interrupt;
use super::load::MutationArgs;
use super::output::{note, print};
use crate::check::{CheckError, Options, Report, built_in_scene, run_watched};
use crate::plan::{Base, Direct, Registry};
use crate::scene::{Scene, SceneOverrides, flatten, read_scene};
use crate::stats::normal::sidak;
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use miette::{IntoDiagnostic, Result, miette};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

/// Steps of a progress bar.
const BAR_STEPS: u64 = 1_000_000;
/// The probability that anything fails when nothing is wrong.
const SIGNIFICANCE: f64 = 0.01;

/// Arguments of `check`.
#[derive(Args, Clone, Debug)]
pub struct CheckArgs {
    /// The mutation [default: all of them]
    name: Option<String>,
    /// The scene to check it in: RON, or JSON by its extension [default: a small one that is built in]
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Twenty times the replicas: biases of a quarter the size show
    #[arg(long)]
    thorough: bool,
    /// Also try each mutation among all those of its states, with the weights that they have
    #[arg(long)]
    among_all: bool,
    /// What chains in primary sample space run over: pt or bdpt
    #[arg(long, value_name = "NAME", default_value_t)]
    base: Base,
    /// Who renders direct light beside chains of whole paths: `chains`, or so many samples per pixel for every 100 mutations per
    /// pixel, and chains walk among longer paths alone
    #[arg(long, value_name = "N", default_value_t = Direct::Chains)]
    direct: Direct,
    /// Seed of all random numbers: the same seed gives the same verdicts
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    mutations: MutationArgs,
    /// Print all tests as JSON on standard output
    #[arg(long)]
    json: bool,
}

/// What was found, as JSON.
#[derive(Serialize)]
struct Found<'a> {
    passed: bool,
    interrupted: bool,
    reports: &'a [Report],
    not_checked: &'a [NotChecked],
}

/// A mutation that was not checked.
#[derive(Serialize)]
struct NotChecked {
    mutation: String,
    reason: String,
}

/// Checks mutations of `registry`, and says what was found. The status is 1 if any failed.
///
/// # Errors
/// A mutation or a setting that there is not, a scene that cannot be loaded, or one without light.
pub fn run(args: &CheckArgs, registry: &Registry) -> Result<ExitCode> {
    let registry = args.mutations.apply(registry)?;
    let names: Vec<String> = match &args.name {
        Some(name) => vec![name.clone()],
        None => registry.iter().map(|mutation| mutation.name().to_owned()).collect(),
    };
    for name in &names {
        registry.get(name).map_err(CheckError::Unknown)?;
    }
    refuse_unused(args, &registry)?;
    let scene = scene(args)?;
    let options = Options {
        among_all: args.among_all,
        base: args.base,
        direct: args.direct,
        seed: args.seed,
        threads: args.threads.count(),
        significance: sidak(SIGNIFICANCE, names.len()),
        ..Options::default()
    };
    let options = if args.thorough { options.thorough() } else { options };
    let interrupt = interrupt::listen()?;
    let (mut reports, mut not_checked) = (Vec::new(), Vec::new());
    let mut interrupted = false;
    for name in &names {
        let bar = progress_bar(name);
        let progress = |share: f64| bar.set_position((share * BAR_STEPS as f64) as u64);
        let outcome = run_watched(&registry, name, &scene, &options, &interrupt, &progress);
        bar.finish_and_clear();
        let reason = match outcome {
            Ok(report) => {
                if !args.json {
                    print(&report.to_string())?;
                }
                reports.push(report);
                continue;
            }
            Err(CheckError::Interrupted) => {
                interrupted = true;
                "interrupted before it was finished".to_owned()
            }
            // Asked for by name, this is an error; among all mutations, one that has no use here is passed over.
            Err(error @ (CheckError::Inapplicable { .. } | CheckError::NoTechnique { .. })) if args.name.is_none() => {
                error.to_string()
            }
            Err(error) => return Err(error.into()),
        };
        note(&format!("{name}: NOT CHECKED: {reason}"));
        not_checked.push(NotChecked {
            mutation: name.clone(),
            reason,
        });
    }
    let passed = reports.iter().all(Report::passed);
    if args.json {
        let found = Found {
            passed,
            interrupted,
            reports: &reports,
            not_checked: &not_checked,
        };
        print(&serde_json::to_string_pretty(&found).into_diagnostic()?)?;
    }
    Ok(match (passed, interrupted) {
        (false, _) => ExitCode::FAILURE,
        (true, true) => ExitCode::from(interrupt::EXIT_STATUS),
        (true, false) => ExitCode::SUCCESS,
    })
}

/// Refuses settings of mutations that no check would look at: each mutation is tried alone.
fn refuse_unused(args: &CheckArgs, registry: &Registry) -> Result<()> {
    for text in &args.mutations.mutation {
        let (name, settings) = text.split_once(':').unwrap_or((text, ""));
        let name = name.trim();
        if settings
            .split(',')
            .any(|setting| setting.split('=').next().map(str::trim) == Some("weight"))
            && !args.among_all
        {
            return Err(miette!(
                help = "leave the weight out, which says how often renders try the mutation, or give --among-all",
                "--mutation {text}: a weight has no effect on checks, which try each mutation alone"
            ));
        }
        // Independent ones draw what chains start from.
        let draws = args.among_all || registry.get(name).is_ok_and(|mutation| mutation.is_independent());
        if let Some(checked) = args.name.as_deref().filter(|checked| *checked != name && !draws) {
            return Err(miette!(
                help = format!("check `{name}`, or leave its settings out"),
                "--mutation {text} has no effect on the check of `{checked}`"
            ));
        }
    }
    Ok(())
}

fn scene(args: &CheckArgs) -> Result<Arc<Scene>> {
    let Some(file) = &args.scene else {
        return built_in_scene();
    };
    let source = read_scene(file)?;
    let flattened = flatten(&source)?;
    for warning in &flattened.warnings {
        note(&format!("warning: {}", warning.plain()));
    }
    let scene = Scene::compile(&source.description, &flattened, SceneOverrides::default())?;
    Ok(Arc::new(scene))
}

/// A bar on a terminal; hidden, and so quiet, anywhere else.
fn progress_bar(name: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {elapsed} gone, {eta} left") {
        bar.set_style(style);
    }
    bar.set_message(name.to_owned());
    bar
}
