//! Holds what `chainlight cost` predicts against what a study measured.
//!
//! `cargo run --release --example predictions -- FOLDER [--pilot SECONDS] [--seed N]` reads `study.json` in the folder that `chainlight
//! study` wrote, runs `chainlight cost` for each of its scenes with the same ways, size and threads, and prints, for every way and error
//! that the study's runs reached, the predicted time, the median of the true ones, and the factor between them: over all the median
//! factor, and how often the interval held the truth. Of the technique that `cost` would take it prints by which factor the study's best
//! has a lower relMSE without the worst 0.1 % of pixels at the end. Times are those of one machine: predict where the study ran.
//!
//! ```sh
//! cargo run --release -- study scenes/cornell-box.ron scenes/door-ajar.ron --size 64x48 --time 4 --runs 4 --make-reference=30 -o study
//! cargo run --release --example predictions -- study --pilot 1
//! ```
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

use chainlight::report::words;
use chainlight::study::{Measure, SceneStudy, Settings, Study, Summary};
use clap::Parser;
use miette::{Context, IntoDiagnostic, Result, ensure, miette};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Holds what `chainlight cost` predicts against what a study measured.
#[derive(Debug, Parser)]
struct Arguments {
    /// The study's folder.
    folder: PathBuf,
    /// Seconds of each pilot.
    #[arg(long, default_value = "1")]
    pilot: String,
    /// Seed of the pilots.
    #[arg(long, default_value = "0")]
    seed: String,
}

/// The errors that studies tell the times to.
const ERRORS: &str = "0.1,0.01,0.001";
/// Measures of both, and their places in what `cost` prints.
const MEASURES: [(Measure, usize); 2] = [(Measure::RelMseTrimmed, 0), (Measure::RelMse, 1)];
/// A choice this near to the best is as good as it.
const NEAR: f64 = 1.1;

/// A prediction beside the truth.
struct Held {
    /// True over predicted time.
    factor: f64,
    /// Whether the interval held it.
    inside: bool,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let path = arguments.folder.join("study.json");
    let study = Study::read(&path)?.ok_or_else(|| miette!("{}: there is no such study", path.display()))?;
    let mut held: [Vec<Held>; MEASURES.len()] = Default::default();
    let mut choices = Vec::new();
    println!("scene, way, measure, error: predicted s (95 %), true s (95 %), true / predicted");
    for scene in &study.scenes {
        let cost = cost(scene, &study.settings, &arguments)?;
        for ((measure, place), held) in MEASURES.into_iter().zip(&mut held) {
            compare(scene, &cost, measure, place, held);
        }
        choices.extend(chosen(scene, &cost));
    }
    for ((measure, _), held) in MEASURES.iter().zip(&held) {
        summarize(measure.name(), held);
    }
    let near = choices.iter().filter(|&&ratio| ratio <= NEAR).count();
    let best = choices.iter().filter(|&&ratio| ratio <= 1.0).count();
    println!(
        "choices: {} scenes, the best taken in {best}, the best or within {:.0} % of it in {near}",
        choices.len(),
        100.0 * (NEAR - 1.0)
    );
    Ok(())
}

/// What `chainlight cost` prints of a scene.
fn cost(scene: &SceneStudy, settings: &Settings, arguments: &Arguments) -> Result<Value> {
    let plain = |name: &str, options: &[String]| options == ["--technique", name];
    let (techniques, others): (Vec<_>, Vec<_>) = settings.ways.iter().partition(|way| plain(&way.name, &way.options));
    ensure!(
        !techniques.is_empty(),
        "the study has no technique with its defaults: `cost` needs one"
    );
    let techniques: Vec<&str> = techniques.iter().map(|way| way.name.as_str()).collect();
    let size = format!("{}x{}", scene.size.0, scene.size.1);
    let mut command = Command::new(program()?);
    command
        .args(["cost", &scene.file, "--json", "--errors", ERRORS, "--size", &size])
        .args([
            "--techniques",
            &techniques.join(","),
            "--threads",
            &settings.threads.to_string(),
        ])
        .args(["--pilot", &arguments.pilot, "--seed", &arguments.seed]);
    for way in others {
        command.args(["--way", &format!("{}={}", way.name, way.options.join(" "))]);
    }
    let output = command.output().into_diagnostic()?;
    ensure!(
        output.status.success(),
        "{}: {}",
        scene.name,
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).into_diagnostic()
}

/// The program, which is built beside this example's folder.
fn program() -> Result<PathBuf> {
    let example = std::env::current_exe().into_diagnostic()?;
    let folder = example.parent().and_then(Path::parent);
    let program = folder.map(|folder| folder.join("chainlight"));
    program
        .filter(|program| program.exists())
        .ok_or_else(|| miette!("build the program first, with the same profile"))
        .wrap_err("chainlight is not there")
}

/// Prints every prediction of a scene beside the truth, and keeps them.
fn compare(scene: &SceneStudy, cost: &Value, measure: Measure, place: usize, held: &mut Vec<Held>) {
    for (number, way) in scene.ways.iter().enumerate() {
        let summary = Summary::of(scene, way, measure);
        let Some(times) =
            predicted(cost, &way.name).and_then(|way| way["predicted"][place]["times"].as_array().cloned())
        else {
            continue;
        };
        for (time, truth) in times.iter().filter_map(|time| {
            let error = time["error"].as_f64()?;
            Some((time, summary.times.iter().find(|truth| truth.error == error)?))
        }) {
            let seconds = &time["seconds"];
            let [Some(value), Some(low), Some(high)] =
                [&seconds["value"], &seconds["bounds"][0], &seconds["bounds"][1]].map(Value::as_f64)
            else {
                continue;
            };
            let true_time = truth.seconds.value;
            // Times that no run reached, or that every run had at its first look, are not known.
            if !true_time.is_finite() || truth.at_most {
                continue;
            }
            let found = Held {
                factor: true_time / value,
                inside: low <= true_time && true_time <= high,
            };
            println!(
                "{}, {} ({number}), {}, {}: {value:.2} ({low:.2} to {high:.2}), {}, {:.2}{}",
                scene.name,
                way.name,
                measure.name(),
                truth.error,
                words::seconds(Some(truth)),
                found.factor,
                if found.inside { "" } else { " outside" }
            );
            held.push(found);
        }
    }
}

fn predicted<'a>(cost: &'a Value, name: &str) -> Option<&'a Value> {
    cost["ways"].as_array()?.iter().find(|way| way["name"] == name)
}

/// How many times the best way's error at the end the chosen one's is.
fn chosen(scene: &SceneStudy, cost: &Value) -> Option<f64> {
    let name = cost["choice"].as_str()?;
    let ends: Vec<(&str, f64)> = scene
        .ways
        .iter()
        .filter_map(|way| {
            let summary = Summary::of(scene, way, Measure::RelMseTrimmed);
            Some((way.name.as_str(), summary.points.last()?.quantiles[1]))
        })
        .collect();
    let (best, least) = ends.iter().min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let (_, own) = ends.iter().find(|(way, _)| *way == name)?;
    println!(
        "{}: takes {name}; the best is {best}, with {:.2} of its error",
        scene.name,
        least / own
    );
    Some(own / least)
}

fn summarize(name: &str, held: &[Held]) {
    if held.is_empty() {
        println!("{name}: no error that the study's runs reached was predicted");
        return;
    }
    let mut off: Vec<f64> = held.iter().map(|held| held.factor.max(1.0 / held.factor)).collect();
    off.sort_by(f64::total_cmp);
    let inside = held.iter().filter(|held| held.inside).count();
    println!(
        "{name}: {} predictions, off by a factor of {:.2} in the median, {:.2} in the worst tenth; {inside} intervals ({:.0} %) hold the truth",
        held.len(),
        off[off.len() / 2],
        off[off.len() * 9 / 10],
        100.0 * inside as f64 / held.len() as f64
    );
}
