//! `compare`: how far a picture is from a reference.

use crate::film::{ExrPicture, read_exr};
use crate::stats::metrics::{Metrics, compare};
use clap::Args;
use miette::{IntoDiagnostic, Result};
use std::fmt::Write as _;
use std::io::Write as _;
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

/// Reads both pictures and prints what lies between them.
///
/// # Errors
/// Where a file cannot be read, the sizes differ, or nobody reads what is printed.
pub fn run(args: &CompareArgs) -> Result<()> {
    writeln!(std::io::stdout().lock(), "{}", report(args)?).into_diagnostic()
}

/// What the command prints.
fn report(args: &CompareArgs) -> Result<String> {
    let (image, reference) = (read_exr(&args.image)?, read_exr(&args.reference)?);
    let metrics = compare(image.view(), reference.view())?;
    if args.json {
        serde_json::to_string_pretty(&metrics).into_diagnostic()
    } else {
        Ok(table(&image, &metrics))
    }
}

fn table(image: &ExrPicture, m: &Metrics) -> String {
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
