//! Whether all techniques make the same picture of every shipped scene.
//!
//! `cargo run --release --example agreement -- [--runs N] [--samples N] [--size N] [--brighter F] [--scene NAME]...` renders
//! the scenes small, many times over, and prints a row for every pair of techniques: block means that differ significantly (of a
//! scene's whole family any does once in a hundred times where nothing is wrong), and the smallest bias of the picture's mean
//! that would be found with a probability of 0.95. Exits with 1 where any differ.
//!
//! Light so rare that a run meets it a few times at most makes means that are not normal: where path tracing alone differs,
//! more `--samples` tell whether it has seen all there is.
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

#[path = "agreement/mod.rs"]
mod agreement;

use agreement::{BlockMeans, Contender, Pictures, compare, runs, seen_by_light_tracing, statistics};
use chainlight::film::BlockGrid;
use chainlight::plan::Technique;
use chainlight::scene::{Scene, SceneOverrides, flatten, read_scene};
use clap::Parser;
use miette::{IntoDiagnostic, Result};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

const BLOCKS_PER_SIDE: u32 = 6;

/// Whether all techniques make the same picture of every shipped scene.
#[derive(Debug, Parser)]
struct Arguments {
    /// Runs of each technique.
    #[arg(long, default_value_t = 32)]
    runs: u64,
    /// Samples, or mutations, per pixel of each run of the slowest technique; quicker ones have some times as many.
    #[arg(long, default_value_t = 32)]
    samples: u64,
    /// Pixels along each side of the film.
    #[arg(long, default_value_t = 24)]
    size: u32,
    /// Makes the light of path tracing brighter by a factor: a planted error, to see it found.
    #[arg(long, default_value_t = 1.0)]
    brighter: f64,
    /// A scene by the name of its file without `.ron`; all of them if none is given.
    #[arg(long)]
    scene: Vec<String>,
}

fn main() -> Result<ExitCode> {
    let arguments = Arguments::parse();
    let mut differ = false;
    for path in scenes(&arguments.scene)? {
        differ |= !agree(&path, &arguments)?;
    }
    Ok(if differ { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// The shipped scenes with these names, or all.
fn scenes(names: &[String]) -> Result<Vec<PathBuf>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    if !names.is_empty() {
        return Ok(names
            .iter()
            .map(|name| folder.join(name).with_extension("ron"))
            .collect());
    }
    let entries = std::fs::read_dir(&folder).into_diagnostic()?;
    let paths = entries.map(|entry| Ok(entry.into_diagnostic()?.path()));
    let mut paths = paths.collect::<Result<Vec<_>>>()?;
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "ron"));
    paths.sort();
    Ok(paths)
}

/// Prints how every pair of techniques compares; whether all agree.
fn agree(path: &Path, arguments: &Arguments) -> Result<bool> {
    let source = read_scene(path)?;
    let flattened = flatten(&source)?;
    let overrides = SceneOverrides {
        size: Some((arguments.size, arguments.size)),
        max_depth: None,
    };
    let scene = Arc::new(Scene::compile(&source.description, &flattened, overrides)?);
    let seen = seen_by_light_tracing(&scene, BLOCKS_PER_SIDE)?;
    let all = vec![true; seen.len()];
    let grid = BlockGrid::new(scene.width, scene.height, BLOCKS_PER_SIDE);
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let visible = seen.iter().filter(|&&seen| seen).count();
    println!("{name}: light tracing sees {visible} of {} blocks", seen.len());
    let mut means: Vec<BlockMeans> = Vec::new();
    for (number, contender) in Contender::ALL.into_iter().enumerate() {
        let pictures = Pictures {
            runs: arguments.runs,
            samples: arguments.samples * contender.samples(),
            first_seed: 1_000_000 * (number as u64 + 1),
            blocks_per_side: BLOCKS_PER_SIDE,
        };
        let begin = Instant::now();
        let found = runs(&scene, contender.technique, &contender.options(), pictures)?;
        means.push(if contender.technique == Technique::Pt {
            found.scaled(arguments.brighter)
        } else {
            found
        });
        println!("  {:<17} {:.1} s", contender.to_string(), begin.elapsed().as_secs_f64());
    }
    let mut pairs = Vec::new();
    for (i, a) in Contender::ALL.into_iter().enumerate() {
        for (j, b) in Contender::ALL.into_iter().enumerate().skip(i + 1) {
            let lights = [a, b].iter().any(|c| c.technique == Technique::Lt);
            let counted = if lights { &seen } else { &all };
            if counted.contains(&true) {
                pairs.push((i, j, counted));
            }
        }
    }
    let tests = pairs.iter().map(|(.., counted)| statistics(counted)).sum();
    let mut agree = true;
    for (i, j, counted) in pairs {
        let verdict = compare(&means[i], &means[j], counted, tests);
        agree &= verdict.failures == 0;
        println!(
            "  {:<17} {:<17} {:>3} of {:>3} differ, largest |t| {:>5.2}, sees {:>6.2} %",
            Contender::ALL[i].to_string(),
            Contender::ALL[j].to_string(),
            verdict.failures,
            verdict.statistics,
            verdict.largest,
            100.0 * verdict.visible
        );
        if verdict.failures > 0 {
            let [a, b] = verdict.worst;
            let place = verdict.block.map_or("the picture".to_owned(), |block| grid.name(block));
            println!(
                "    {place}: {:.5} ± {:.5} and {:.5} ± {:.5}",
                a.mean, a.error, b.mean, b.error
            );
        }
    }
    Ok(agree)
}
