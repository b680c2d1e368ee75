//! What accuracy costs in time: several ways to render a scene, each as long, against a long reference.
//!
//! `cargo run --release --example equal_time -- SCENE... [--seconds S] [--seeds N] [--size WxH] [--reference SPP] [--folder F]
//! [--way NAME=OPTIONS]...` runs `chainlight` for every scene, way and seed, for S seconds each, bootstraps included, and compares
//! the pictures with one of SPP samples per pixel of `bdpt`. It prints, for every way, relMSE and how many times as long the first
//! way would take to the same error: the ratio of both ways' errors, geometric means over seeds, with a 95 % interval from their
//! spread. References are kept in the folder, and made once. The first seed's pictures of every scene are put on a sheet beside
//! the reference.
//!
//! ```sh
//! cargo run --release --example equal_time -- scenes/door-ajar.ron scenes/glass-egg.ron
//! cargo run --release --example equal_time -- scenes/cornell-glass.ron --way "all=--technique mlt" \
//!     --way "without lens=--technique mlt --mutation lens:weight=0"
//! ```
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

use clap::Parser;
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
    for scene in &arguments.scenes {
        compare_on(scene, &ways, &arguments)?;
    }
    Ok(())
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

fn compare_on(scene: &Path, ways: &[Way], arguments: &Arguments) -> Result<()> {
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
    let mut errors: Vec<Vec<f64>> = Vec::new();
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
        let mut of_way = Vec::new();
        for seed in 1..=arguments.seeds {
            let output = file(&if seed == 1 {
                name.clone()
            } else {
                "other-seed".to_owned()
            });
            let seed = seed.to_string();
            render(
                scene,
                &[&options[..], &["--time", &time, "--seed", &seed]].concat(),
                &output,
                arguments,
            )?;
            let compared = run(&["compare", &text(&output), &text(&reference), "--json"])?;
            let error = compared["rel_mse"].as_f64();
            of_way.push(error.ok_or_else(|| miette!("no relMSE in {compared}"))?);
        }
        errors.push(of_way);
        pictures.push(file(&name).with_extension("png"));
    }
    pictures.push(reference.with_extension("png"));
    print_table(&stem, ways, &errors, arguments);
    sheet(&arguments.folder.join(format!("{stem}.png")), &pictures)
}

fn print_table(scene: &str, ways: &[Way], errors: &[Vec<f64>], arguments: &Arguments) {
    println!("{scene}, {} s, {} seeds", arguments.seconds, arguments.seeds);
    println!(
        "{:<24} {:>22}  {:>10} {:>22}",
        "way", "relMSE (standard dev.)", "ratio", "95 %"
    );
    for (way, of_way) in ways.iter().zip(errors) {
        let (mean, deviation) = spread(of_way);
        // Seeds are independent: so are the logarithms of errors.
        let logs = |errors: &[f64]| spread(&errors.iter().map(|&error| libm::log(error)).collect::<Vec<f64>>());
        let ((first, first_deviation), (this, this_deviation)) = (logs(&errors[0]), logs(of_way));
        let n = of_way.len() as f64;
        let error = ((first_deviation * first_deviation + this_deviation * this_deviation) / n).sqrt();
        let ratio = |sign: f64| libm::exp(first - this + sign * 1.96 * error);
        let interval = format!("{:.2} to {:.2}", ratio(-1.0), ratio(1.0));
        println!(
            "{:<24} {:>22}  {:>10.2} {interval:>22}",
            way.name,
            format!("{mean:.3e} ({deviation:.1e})"),
            ratio(0.0)
        );
    }
    println!();
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

/// Puts the pictures side by side.
fn sheet(to: &Path, pictures: &[PathBuf]) -> Result<()> {
    let images: Vec<image::RgbImage> = pictures
        .iter()
        .map(|path| Ok(image::open(path).into_diagnostic()?.to_rgb8()))
        .collect::<Result<_>>()?;
    const MARGIN: u32 = 6;
    let width: u32 = images.iter().map(|image| image.width() + MARGIN).sum();
    let height = images.iter().map(image::RgbImage::height).max().unwrap_or(0);
    let mut sheet = image::RgbImage::from_pixel(width + MARGIN, height + 2 * MARGIN, image::Rgb([24, 24, 26]));
    let mut x = i64::from(MARGIN);
    for image in &images {
        image::imageops::replace(&mut sheet, image, x, i64::from(MARGIN));
        x += i64::from(image.width() + MARGIN);
    }
    sheet.save(to).into_diagnostic()
}
