//! What accuracy costs in time: several ways to render a scene, each as long, against a long reference.
//!
//! `cargo run --release --example equal_time -- SCENE... [--seconds S] [--seeds N] [--size WxH] [--reference SPP] [--folder F]
//! [--way NAME=OPTIONS]...` runs `chainlight` for every scene, way and seed, for S seconds each, bootstraps included, and compares
//! the pictures with one of SPP samples per pixel of `bdpt`. It prints, for every way, relMSE of all pixels, and without the worst
//! 0.1 %, which a few bright samples may decide, and how many times as long the first way would take to the same error: the ratio of
//! both ways' errors, geometric means over seeds, with a 95 % interval from their spread. Of chains, it prints how many independent
//! samples their states are worth, too. References are kept in the folder, and made once. The first seed's pictures of every scene are put on a sheet
//! (`equal-time.png`), a row for every scene, the reference last.
//!
//! ```sh
//! cargo run --release --example equal_time -- scenes/door-ajar.ron scenes/glass-egg.ron
//! cargo run --release --example equal_time -- scenes/cornell-glass.ron --way "all=--technique mlt" \
//!     --way "without lens=--technique mlt --mutation lens:weight=0"
//! ```
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

use chainlight::film::{ExrPicture, ToneMap, encode_png, read_exr};
use clap::Parser;
use image::RgbImage;
use image::imageops::{FilterType, replace, resize};
use miette::{Context, IntoDiagnostic, Result, ensure, miette};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Several ways to render a scene, each as long, against a long reference.
#[derive(Debug, Parser)]
struct Arguments {
    /// Scene files.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Seconds for each picture, bootstraps included.
    #[arg(long, default_value_t = 20.0)]
    seconds: f64,
    /// Pictures by each way, each with a seed of its own.
    #[arg(long, default_value_t = 8)]
    seeds: u64,
    /// Film size.
    #[arg(long, default_value = "160x120")]
    size: String,
    /// Samples per pixel of the reference.
    #[arg(long, default_value_t = 16384)]
    reference: u64,
    /// Where pictures go.
    #[arg(long, default_value = "target/equal-time")]
    folder: PathBuf,
    /// A way to render: a name, and options of `chainlight render`. The first is the one that others are compared with.
    #[arg(long, value_name = "NAME=OPTIONS")]
    way: Vec<String>,
}

/// The ways, if none is given.
const WAYS: [&str; 3] = [
    "bdpt=--technique bdpt",
    "pssmlt=--technique pssmlt --base bdpt",
    "mlt=--technique mlt",
];

/// What pictures are measured by.
struct Measure {
    name: &'static str,
    /// Where its value is: in what `chainlight compare` or, if `of_render` says so, `chainlight render` reports.
    at: &'static str,
    of_render: bool,
}

/// Errors, and what the states of chains are worth.
const MEASURES: [Measure; 3] = [
    Measure {
        name: "relMSE",
        at: "/rel_mse",
        of_render: false,
    },
    Measure {
        name: "without the worst 0.1 %",
        at: "/rel_mse_trimmed",
        of_render: false,
    },
    Measure {
        name: "independent samples",
        at: "/chains/effective_samples/total",
        of_render: true,
    },
];

impl Measure {
    /// Its value; none where it does not apply.
    fn value(&self, rendered: &Value, compared: &Value) -> Option<f64> {
        let report = if self.of_render { rendered } else { compared };
        report.pointer(self.at)?.as_f64()
    }
}

/// Values of all measures, for every way and seed.
type Measured = Vec<[Vec<Option<f64>>; MEASURES.len()]>;

/// A way to render.
struct Way {
    name: String,
    options: Vec<String>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    ensure!(arguments.seeds >= 2, "a spread takes two seeds");
    std::fs::create_dir_all(&arguments.folder).into_diagnostic()?;
    let given: Vec<&str> = arguments.way.iter().map(String::as_str).collect();
    let texts = if given.is_empty() { WAYS.to_vec() } else { given };
    let ways: Vec<Way> = texts.into_iter().map(way).collect::<Result<_>>()?;
    let compared = |scene: &PathBuf| compare_on(scene, &ways, &arguments);
    let rows: Vec<Vec<PathBuf>> = arguments.scenes.iter().map(compared).collect::<Result<_>>()?;
    sheet(&arguments.folder.join("equal-time.png"), &rows)
}

fn way(text: &str) -> Result<Way> {
    let (name, options) = text
        .split_once('=')
        .ok_or_else(|| miette!("--way {text}: expected NAME=OPTIONS, such as \"mlt=--technique mlt\""))?;
    Ok(Way {
        name: name.to_owned(),
        options: options.split_whitespace().map(str::to_owned).collect(),
    })
}

/// Compares all ways on a scene; the first seed's pictures, and the reference.
fn compare_on(scene: &Path, ways: &[Way], arguments: &Arguments) -> Result<Vec<PathBuf>> {
    let stem = scene
        .file_stem()
        .ok_or_else(|| miette!("{}: no file", scene.display()))?
        .to_string_lossy();
    let file = |name: &str| arguments.folder.join(format!("{stem}-{name}.exr"));
    let reference = file(&format!("reference-{}-{}", arguments.size, arguments.reference));
    if !reference.exists() {
        let samples = arguments.reference.to_string();
        // A seed that no other picture has.
        let options = ["--technique", "bdpt", "--seed", "1000000", "--spp", &samples];
        render(scene, &options, &reference, arguments)?;
    }
    let mut measured = Measured::new();
    let mut pictures = Vec::new();
    for way in ways {
        let options: Vec<&str> = way.options.iter().map(String::as_str).collect();
        let name = way.name.replace(' ', "-");
        // What a bootstrap takes is the same for every seed.
        let trial = render(
            scene,
            &[&options[..], &["--time", "0.01"]].concat(),
            &file("trial"),
            arguments,
        )?;
        let seconds = arguments.seconds - trial["bootstrap_seconds"].as_f64().unwrap_or(0.0);
        ensure!(seconds > 0.0, "{}: bootstraps alone take longer than that", way.name);
        let time = seconds.to_string();
        let mut of_way = MEASURES.map(|_| Vec::new());
        for seed in 1..=arguments.seeds {
            let output = file(&if seed == 1 {
                name.clone()
            } else {
                "other-seed".to_owned()
            });
            let seed = seed.to_string();
            let options = [&options[..], &["--time", &time, "--seed", &seed]].concat();
            let rendered = render(scene, &options, &output, arguments)?;
            let compared = run(&["compare", &text(&output), &text(&reference), "--json"])?;
            for (values, measure) in of_way.iter_mut().zip(MEASURES) {
                values.push(measure.value(&rendered, &compared));
            }
        }
        measured.push(of_way);
        pictures.push(file(&name));
    }
    pictures.push(reference);
    print_tables(&stem, ways, &measured, arguments);
    Ok(pictures)
}

fn print_tables(scene: &str, ways: &[Way], measured: &Measured, arguments: &Arguments) {
    println!("{scene}, {} s, {} seeds", arguments.seconds, arguments.seeds);
    for (number, measure) in MEASURES.iter().enumerate() {
        let of_ways: Option<Vec<Vec<f64>>> = measured
            .iter()
            .map(|of_way| of_way[number].iter().copied().collect())
            .collect();
        // Not of every way are there independent samples to tell.
        if let Some(of_ways) = of_ways {
            print_table(measure, ways, &of_ways);
        }
    }
    println!();
}

fn print_table(measure: &Measure, ways: &[Way], values: &[Vec<f64>]) {
    let title = format!("{} (standard dev.)", measure.name);
    println!("{:<24} {title:>40}  {:>10} {:>22}", "way", "ratio", "95 %");
    for (way, of_way) in ways.iter().zip(values) {
        let (mean, deviation) = spread(of_way);
        // Seeds are independent: so are the logarithms of errors.
        let logs = |errors: &[f64]| spread(&errors.iter().map(|&error| libm::log(error)).collect::<Vec<f64>>());
        let ((first, first_deviation), (this, this_deviation)) = (logs(&values[0]), logs(of_way));
        let n = of_way.len() as f64;
        let error = ((first_deviation * first_deviation + this_deviation * this_deviation) / n).sqrt();
        // The more samples, and the smaller errors, the better.
        let gain = if measure.of_render { this - first } else { first - this };
        let ratio = |sign: f64| libm::exp(gain + sign * 1.96 * error);
        let interval = format!("{:.2} to {:.2}", ratio(-1.0), ratio(1.0));
        println!(
            "{:<24} {:>40}  {:>10.2} {interval:>22}",
            way.name,
            format!("{mean:.3e} ({deviation:.1e})"),
            ratio(0.0)
        );
    }
}

/// Mean and standard deviation.
fn spread(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (mean, (squares / (n - 1.0)).sqrt())
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

fn render(scene: &Path, options: &[&str], output: &Path, arguments: &Arguments) -> Result<Value> {
    let (scene, output) = (text(scene), text(output));
    let common = ["render", &scene, "--size", &arguments.size, "-o", &output, "--json"];
    run(&[&common[..], options].concat())
}

/// Runs the program beside this one; what it reports.
fn run(arguments: &[&str]) -> Result<Value> {
    let here = std::env::current_exe().into_diagnostic()?;
    let program = here
        .parent()
        .and_then(Path::parent)
        .map(|folder| folder.join("chainlight"))
        .ok_or_else(|| miette!("examples are built beside the program"))?;
    let output = Command::new(&program)
        .args(arguments)
        .stderr(Stdio::piped())
        .output()
        .into_diagnostic()
        .wrap_err_with(|| format!("{}: build it with cargo build --release", program.display()))?;
    ensure!(
        output.status.success(),
        "chainlight {}: {}",
        arguments.join(" "),
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).into_diagnostic()
}

/// Puts pictures on a sheet: a row for every scene, as bright as its last picture needs it.
fn sheet(to: &Path, rows: &[Vec<PathBuf>]) -> Result<()> {
    const MARGIN: u32 = 6;
    const SCALE: u32 = 2;
    let rows: Vec<Vec<RgbImage>> = rows.iter().map(|row| developed(row)).collect::<Result<_>>()?;
    let across = |row: &Vec<RgbImage>| row.iter().map(|image| SCALE * image.width() + MARGIN).sum::<u32>();
    let down = |row: &Vec<RgbImage>| row.iter().map(|image| SCALE * image.height() + MARGIN).max();
    let width = rows.iter().map(across).max().unwrap_or(0) + MARGIN;
    let height = rows.iter().filter_map(down).sum::<u32>() + MARGIN;
    let mut sheet = RgbImage::from_pixel(width, height, image::Rgb([24, 24, 26]));
    let mut y = MARGIN;
    for row in &rows {
        let mut x = MARGIN;
        for image in row {
            let [w, h] = [image.width(), image.height()].map(|side| SCALE * side);
            let large = resize(image, w, h, FilterType::Nearest);
            replace(&mut sheet, &large, x.into(), y.into());
            x += w + MARGIN;
        }
        y += down(row).unwrap_or(0);
    }
    sheet.save(to).into_diagnostic()
}

fn developed(row: &[PathBuf]) -> Result<Vec<RgbImage>> {
    let pictures = row.iter().map(|path| Ok(read_exr(path)?));
    let pictures: Vec<ExrPicture> = pictures.collect::<Result<_>>()?;
    let last = pictures.last().ok_or_else(|| miette!("no pictures"))?;
    let tone = ToneMap::automatic(last.view());
    let images = pictures.iter().map(|picture| {
        let png = encode_png(picture.view(), tone).map_err(|error| miette!(error))?;
        Ok(image::load_from_memory(&png).into_diagnostic()?.to_rgb8())
    });
    images.collect()
}
