//! The machinery of chains without any light: a function on an interval, sampled by chains whose states, systems and
//! mutations stand in this example, and a chain of three states run from its transition matrix.
//!
//! `cargo run --release --example histogram [FOLDER]` prints how far the histograms are from what they should be, and draws
//! them into the folder (`target/histogram` if none is given).
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

#[path = "histogram/mod.rs"]
mod histogram;

use histogram::{STEPS, Sampled, chart, interval, three_states};
use miette::{IntoDiagnostic, Result};
use std::path::PathBuf;

fn main() -> Result<()> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| PathBuf::from("target/histogram"), PathBuf::from);
    std::fs::create_dir_all(&folder).into_diagnostic()?;
    println!(
        "{:<13} {:>8} {:>10} {:>12} {:>14} {:>10}",
        "mutations", "steps", "distance", "independent", "worth samples", "99 % below"
    );
    for (name, mutations) in interval::runs() {
        let histograms = interval::sample(mutations, 1, STEPS)?;
        report(name, &histograms);
        chart::densities(&folder.join(format!("{name}.svg")), name, &histograms)?;
    }
    let histograms = three_states::simulate(1, STEPS)?;
    report("three states", &histograms);
    chart::occupancy(&folder.join("three-states.svg"), &histograms)?;
    println!("drawn into {}", folder.display());
    Ok(())
}

fn report(name: &str, histograms: &[Sampled]) {
    for sampled in histograms {
        println!(
            "{name:<13} {:>8} {:>10.5} {:>12.5} {:>14} {:>10}",
            sampled.total(),
            sampled.distance(),
            sampled.expected_distance(),
            sampled
                .worth()
                .map_or_else(|| "unknown".to_owned(), |worth| format!("{:.0}", worth.total)),
            sampled
                .bound(0.01)
                .map_or_else(|| "unknown".to_owned(), |bound| format!("{bound:.5}"))
        );
    }
}
