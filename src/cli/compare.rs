//! `compare`: how far a picture is from a reference.

use crate::film::{ExrPicture, ToneMap, read_exr};
use crate::stats::flip::mean_flip;
use crate::stats::metrics::{Metrics, compare};
use clap::Args;
use miette::{IntoDiagnostic, Result};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Compare a picture with a reference of the same size.
#[derive(Args, Clone, Debug)]
pub struct CompareArgs {
    /// The picture to judge, an OpenEXR file
    pub image: PathBuf,
    /// The reference, an OpenEXR file
    pub reference: PathBuf,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// What the command finds.
#[derive(Clone, Copy, Debug, Serialize)]
struct Comparison {
    #[serde(flatten)]
    metrics: Metrics,
    /// The mean of ꟻLIP, from 0, the same, to 1.
    flip: f64,
    /// Stops of the exposure at which both pictures are shown for it: the reference's automatic one.
    flip_exposure: f32,
}

/// Reads both pictures and prints what lies between them.
///
/// # Errors
/// Where a file cannot be read, or the sizes differ.
pub fn run(args: &CompareArgs) -> Result<()> {
    super::output::print(&report(args)?)
}

/// What the command prints.
fn report(args: &CompareArgs) -> Result<String> {
    let (image, reference) = (read_exr(&args.image)?, read_exr(&args.reference)?);
    let tone = ToneMap::automatic(reference.view());
    let comparison = Comparison {
        metrics: compare(image.view(), reference.view())?,
        flip: mean_flip(image.view(), reference.view(), tone)?,
        flip_exposure: tone.exposure,
    };
    if args.json {
        serde_json::to_string_pretty(&comparison).into_diagnostic()
    } else {
        Ok(table(&image, &comparison))
    }
}

fn table(image: &ExrPicture, comparison: &Comparison) -> String {
    let m = &comparison.metrics;
    let [red, green, blue] = m.channel_mean_ratio;
    let rows = [
        ("MSE", m.mse, "mean (a - r)^2"),
        ("relMSE", m.rel_mse, "mean (a - r)^2 / (r^2 + 0.01)"),
        (
            "relMSE, trimmed",
            m.rel_mse_trimmed,
            "the same without the worst 0.1 % of the pixels",
        ),
        ("MAPE", m.mape, "mean |a - r| / (|r| + 0.01)"),
        ("SMAPE", m.smape, "mean 2 |a - r| / (|a| + |r| + 0.01)"),
        (
            "FLIP",
            comparison.flip,
            "as displayed, at the reference's automatic exposure",
        ),
        ("mean ratio", m.mean_ratio, "mean a / mean r"),
        ("  red", red, ""),
        ("  green", green, ""),
        ("  blue", blue, ""),
        ("max |a - r|", m.max_abs_error, ""),
    ];
    let mut out = format!("{} x {} pixels; a: picture, r: reference\n", image.width, image.height);
    for (name, value, formula) in rows {
        let line = format!("{name:<16} {value:>13.6e}  {formula}");
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{}", line.trim_end());
    }
    let _ = write!(
        out,
        "compared         {:>13}  pixels; {} not finite, left out",
        m.compared, m.non_finite
    );
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::film::{Picture, PictureMetadata, write_exr};
    use std::path::Path;

    fn write(path: &Path, width: u32, value: f32) -> PathBuf {
        let black = vec![Rgb::BLACK; width as usize];
        let rgb = vec![Rgb::splat(value); width as usize];
        let picture = Picture::new(width, 1, rgb, black, vec![1.0; width as usize]);
        write_exr(path, &picture, &PictureMetadata::default()).expect("written");
        path.to_owned()
    }

    fn args(json: bool, widths: [u32; 2]) -> (tempfile::TempDir, CompareArgs) {
        let directory = tempfile::tempdir().expect("a directory");
        let image = write(&directory.path().join("a.exr"), widths[0], 1.5);
        let reference = write(&directory.path().join("r.exr"), widths[1], 1.0);
        (directory, CompareArgs { image, reference, json })
    }

    #[test]
    fn the_table_names_its_formulas() {
        let (_directory, args) = args(false, [2, 2]);
        insta::assert_snapshot!(report(&args).expect("compared"), @"
        2 x 1 pixels; a: picture, r: reference
        MSE                2.500000e-1  mean (a - r)^2
        relMSE             2.475248e-1  mean (a - r)^2 / (r^2 + 0.01)
        relMSE, trimmed    2.475248e-1  the same without the worst 0.1 % of the pixels
        MAPE               4.950495e-1  mean |a - r| / (|r| + 0.01)
        SMAPE              3.984064e-1  mean 2 |a - r| / (|a| + |r| + 0.01)
        FLIP               2.777626e-1  as displayed, at the reference's automatic exposure
        mean ratio          1.500000e0  mean a / mean r
          red               1.500000e0
          green             1.500000e0
          blue              1.500000e0
        max |a - r|        5.000000e-1
        compared                     2  pixels; 0 not finite, left out
        ");
    }

    #[test]
    fn json_holds_the_same_numbers() {
        let (_directory, args) = args(true, [2, 2]);
        let json: serde_json::Value = serde_json::from_str(&report(&args).expect("compared")).expect("JSON");
        assert_eq!(
            (json["mse"].as_f64(), json["mean_ratio"].as_f64()),
            (Some(0.25), Some(1.5))
        );
        assert_eq!(json["compared"].as_u64(), Some(2));
    }

    #[test]
    fn different_sizes_and_missing_files_are_errors() {
        let (_directory, mut args) = args(false, [2, 3]);
        assert!(run(&args).expect_err("sizes differ").to_string().contains("2 x 1"));
        args.reference = "nowhere.exr".into();
        assert!(run(&args).expect_err("missing").to_string().contains("nowhere.exr"));
    }
}
