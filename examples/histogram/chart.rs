//! Charts, as SVG.

use super::{Sampled, target};
use miette::{IntoDiagnostic, Result};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// Pixels of a chart of two panels.
const SIZE: (u32, u32) = (1200, 480);
const BARS: RGBColor = RGBColor(120, 160, 210);
const LINE: RGBColor = RGBColor(190, 40, 30);

type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Draws histograms of the interval against the target, side by side.
///
/// # Errors
/// A file that cannot be written.
pub fn densities(path: &Path, name: &str, histograms: &[Sampled]) -> Result<()> {
    draw(path, histograms, |panel, sampled| density(panel, name, sampled))
}

/// Draws occupancies of states against the stationary distribution, side by side.
///
/// # Errors
/// A file that cannot be written.
pub fn occupancy(path: &Path, histograms: &[Sampled]) -> Result<()> {
    draw(path, histograms, bars)
}

fn draw(path: &Path, histograms: &[Sampled], panel: impl Fn(&Panel<'_>, &Sampled) -> Result<()>) -> Result<()> {
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE).into_diagnostic()?;
    for (area, sampled) in root.split_evenly((1, histograms.len().max(1))).iter().zip(histograms) {
        panel(area, sampled)?;
    }
    root.present().into_diagnostic()
}

fn caption(name: &str, sampled: &Sampled) -> String {
    format!("{name}, {} steps: distance {:.4}", sampled.total(), sampled.distance())
}

fn density(panel: &Panel<'_>, name: &str, sampled: &Sampled) -> Result<()> {
    let bins = sampled.expected.len();
    let densities: Vec<f64> = sampled.shares().iter().map(|share| share * bins as f64).collect();
    let whole = target::integral(0.0, 1.0);
    let points = 1000;
    let line = (0..=points).map(|i| f64::from(i) / f64::from(points));
    let line: Vec<(f64, f64)> = line.map(|x| (x, target::value(x) / whole)).collect();
    let highest = line.iter().map(|point| point.1).chain(densities.iter().copied());
    let highest = highest.fold(0.0, f64::max);
    let mut chart = ChartBuilder::on(panel)
        .caption(caption(name, sampled), ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(32)
        .y_label_area_size(44)
        .build_cartesian_2d(0.0..1.0, 0.0..1.05 * highest)
        .into_diagnostic()?;
    let mut mesh = chart.configure_mesh();
    mesh.max_light_lines(1)
        .x_desc("x")
        .y_desc("density")
        .draw()
        .into_diagnostic()?;
    let edge = |bin: usize| bin as f64 / bins as f64;
    let bars = densities.iter().enumerate();
    let bars = bars.map(|(bin, &height)| Rectangle::new([(edge(bin), 0.0), (edge(bin + 1), height)], BARS.filled()));
    chart.draw_series(bars).into_diagnostic()?;
    let line = PathElement::new(line, LINE.stroke_width(2));
    chart.draw_series([line]).into_diagnostic()?;
    Ok(())
}

fn bars(panel: &Panel<'_>, sampled: &Sampled) -> Result<()> {
    let states = sampled.expected.len();
    let mut chart = ChartBuilder::on(panel)
        .caption(caption("three states", sampled), ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(32)
        .y_label_area_size(44)
        .build_cartesian_2d(-0.5..states as f64 - 0.5, 0.0..0.6)
        .into_diagnostic()?;
    let mut mesh = chart.configure_mesh();
    mesh.max_light_lines(1)
        .x_desc("state")
        .y_desc("share of steps")
        .draw()
        .into_diagnostic()?;
    for (state, (share, expected)) in sampled.shares().into_iter().zip(&sampled.expected).enumerate() {
        let (left, right) = (state as f64 - 0.3, state as f64 + 0.3);
        let bar = Rectangle::new([(left, 0.0), (right, share)], BARS.filled());
        chart.draw_series([bar]).into_diagnostic()?;
        let line = PathElement::new(vec![(left, *expected), (right, *expected)], LINE.stroke_width(3));
        chart.draw_series([line]).into_diagnostic()?;
    }
    Ok(())
}
