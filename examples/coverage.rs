//! Whether renders know their own error: how often the interval that they state has the error which they have.
//!
//! `cargo run --release --example coverage -- [--renders N] [--samples N] [--size N] [SCENE...]` renders every scene by every technique N times
//! over, with seeds of their own and the groups that renders have by default. The error that a render has is the root mean square over block
//! means of its distance from the mean of all others by the same technique, relative to that mean; its share of the noise, one part in N − 1,
//! is left in. (Whether techniques have the same mean is another question, which the example `agreement` answers.) For every technique it prints how often
//! the stated 95 % interval held that error, with a 95 % interval of its own (Clopper and Pearson 1934), how often errors were above it and below, and the ratio of
//! the error that was stated to the one there was, root mean squares both.
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

use chainlight::film::block_means_of;
use chainlight::plan::{Base, Plan, PlanOptions, Technique};
use chainlight::render::{Rendering, error_blocks, start};
use chainlight::scene::{Scene, SceneOverrides, flatten, read_scene};
use clap::Parser;
use miette::{IntoDiagnostic, Result, ensure, miette};
use statrs::distribution::{Beta, ContinuousCDF};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Whether renders know their own error.
#[derive(Debug, Parser)]
struct Arguments {
    /// Scene files; all that are shipped if none is given.
    scenes: Vec<PathBuf>,
    /// Renders of each technique.
    #[arg(long, default_value_t = 200)]
    renders: u64,
    /// Samples, or mutations, per pixel of each render of the slowest technique; quicker ones have some times as many.
    #[arg(long, default_value_t = 16)]
    samples: u64,
    /// Pixels along each side of the film.
    #[arg(long, default_value_t = 32)]
    size: u32,
}

/// Techniques, what their chains run over, and how many of their samples take about the time of one of bidirectional path tracing. Light
/// tracing is left out: what it does not see has no error.
const TECHNIQUES: [(Technique, Base, u64); 5] = [
    (Technique::Pt, Base::Pt, 4),
    (Technique::Bdpt, Base::Pt, 1),
    (Technique::Pssmlt, Base::Pt, 4),
    (Technique::Pssmlt, Base::Bdpt, 1),
    (Technique::Mlt, Base::Pt, 4),
];

/// What a render states, and its block means.
struct Rendered {
    rms: f64,
    interval: [f64; 2],
    means: Vec<f64>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    ensure!(arguments.renders >= 10, "a share of fewer than 10 renders says nothing");
    println!(
        "{:<24} {:<18} {:>24} {:>8} {:>8} {:>14}",
        "scene", "technique", "held (95 %)", "above", "below", "stated / had"
    );
    for path in scenes(&arguments.scenes)? {
        let source = read_scene(&path)?;
        let overrides = SceneOverrides {
            size: Some((arguments.size, arguments.size)),
            max_depth: None,
        };
        let scene = Arc::new(Scene::compile(&source.description, &flatten(&source)?, overrides)?);
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        for technique in TECHNIQUES {
            println!("{}", row(&name, &scene, technique, &arguments)?);
        }
    }
    Ok(())
}

fn scenes(asked: &[PathBuf]) -> Result<Vec<PathBuf>> {
    if !asked.is_empty() {
        return Ok(asked.to_vec());
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files = std::fs::read_dir(folder).into_diagnostic()?;
    let mut paths: Vec<PathBuf> = files.filter_map(|file| Some(file.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "ron"));
    paths.sort();
    Ok(paths)
}

fn row(
    name: &str,
    scene: &Arc<Scene>,
    (technique, base, factor): (Technique, Base, u64),
    arguments: &Arguments,
) -> Result<String> {
    let samples = arguments.samples * factor;
    let renders = side_by_side(arguments.renders, |seed| {
        render(scene, (technique, base), seed, samples)
    })?;
    let statistics = renders[0].means.len();
    let mut sums = vec![0.0; statistics];
    for render in &renders {
        sums.iter_mut().zip(&render.means).for_each(|(sum, mean)| *sum += mean);
    }
    let others = (renders.len() - 1) as f64;
    let (mut held, mut above, mut below) = (0_usize, 0_usize, 0_usize);
    let (mut stated, mut had) = (0.0, 0.0);
    for render in &renders {
        let truth = sums.iter().zip(&render.means).map(|(sum, own)| (sum - own) / others);
        let (mut squares, mut mean) = (0.0, 0.0);
        for (truth, own) in truth.zip(&render.means) {
            squares += (own - truth) * (own - truth);
            mean += truth;
        }
        let error = (squares * statistics as f64).sqrt() / mean;
        let [low, high] = render.interval;
        held += usize::from((low..=high).contains(&error));
        above += usize::from(error > high);
        below += usize::from(error < low);
        stated += render.rms * render.rms;
        had += error * error;
    }
    let percent = |count: f64| format!("{:.1} %", 100.0 * count);
    let [low, high] = interval(held, renders.len()).into_diagnostic()?;
    let share = |count: usize| percent(count as f64 / renders.len() as f64);
    Ok(format!(
        "{name:<24} {:<18} {:>24} {:>8} {:>8} {:>14.2}",
        if technique == Technique::Pssmlt {
            format!("{technique} over {base}")
        } else {
            technique.to_string()
        },
        format!("{} ({} to {})", share(held), percent(low), percent(high)),
        share(above),
        share(below),
        (stated / had).sqrt()
    ))
}

/// The renders of so many seeds, as many at a time as there are cores. (A thread of a pool that waits for another pool would begin more of
/// them meanwhile.)
fn side_by_side(seeds: u64, render: impl Fn(u64) -> Result<Rendered> + Sync) -> Result<Vec<Rendered>> {
    let next = AtomicU64::new(0);
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get);
    let mut all: Vec<(u64, Rendered)> = std::thread::scope(|scope| {
        let worker = || {
            let seeds = std::iter::from_fn(|| Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&seed| seed < seeds));
            seeds.map(|seed| Ok((seed, render(seed)?))).collect::<Result<Vec<_>>>()
        };
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(worker)).collect();
        let mut all = Vec::new();
        for worker in workers {
            all.extend(worker.join().map_err(|_| miette!("a render panicked"))??);
        }
        Ok::<_, miette::Report>(all)
    })?;
    all.sort_by_key(|(seed, _)| *seed);
    Ok(all.into_iter().map(|(_, render)| render).collect())
}

/// The interval of a probability of which `held` of `all` trials tell (Clopper and Pearson 1934).
fn interval(held: usize, all: usize) -> Result<[f64; 2], statrs::distribution::BetaError> {
    let (held, missed) = (held as f64, (all - held) as f64);
    let low = if held == 0.0 {
        0.0
    } else {
        Beta::new(held, missed + 1.0)?.inverse_cdf(0.025)
    };
    let high = if missed == 0.0 {
        1.0
    } else {
        Beta::new(held + 1.0, missed)?.inverse_cdf(0.975)
    };
    Ok([low, high])
}

fn render(scene: &Arc<Scene>, (technique, base): (Technique, Base), seed: u64, samples: u64) -> Result<Rendered> {
    let options = PlanOptions {
        base,
        ..PlanOptions::default()
    };
    let plan = Plan::with(scene, technique, &options)?;
    let steps = plan.chains.as_ref().map_or(samples, |chains| {
        chains.counts.steps_for(samples as f64, scene.pixel_count())
    });
    let mut render: Box<dyn Rendering> = start(Arc::clone(scene), plan, seed, 1, &AtomicBool::new(false), &|_| {})?;
    render.burst(steps, &|_| {});
    let means = block_means_of(render.picture().view(), &error_blocks(scene)).into_diagnostic()?;
    let error = render.error();
    Ok(Rendered {
        rms: error.map_or(0.0, |error| error.rms),
        interval: error.map_or([0.0; 2], |error| error.interval),
        means,
    })
}
