//! Where in a picture's frequencies errors are.

use super::log_axis::{labels, range};
use super::series::{legend, line};
use super::{FONT, PlotError, SIZE};
use crate::study::{BANDS, SceneStudy, WayStudy, band_name};
use plotters::prelude::*;

/// The spectrum of every way's error at the end, the mean over runs, against bands of radial frequency, as SVG: 1 everywhere for errors of
/// independent pixels; more on the left where chains leave patches. `None` where there is nothing to draw.
///
/// # Errors
/// Whatever keeps it from being drawn.
pub fn error_spectra(scene: &SceneStudy) -> Result<Option<String>, PlotError> {
    let spectra: Vec<(String, Vec<(f64, f64)>)> = scene.ways.iter().map(|way| (way.name.clone(), mean(way))).collect();
    let values = spectra.iter().flat_map(|(_, bands)| bands).map(|&(_, power)| power);
    let Some(up) = range(values.chain([0.5, 2.0])) else {
        return Ok(None);
    };
    if spectra.iter().all(|(_, bands)| bands.is_empty()) {
        return Ok(None);
    }
    let up_label = labels(&up);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .caption(format!("{}: where the error is", scene.name), (FONT, 18))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d(-0.3..BANDS as f64 - 0.7, up.log_scale())?;
        let name = |v: &f64| {
            let band = v.round();
            if (v - band).abs() > 1e-6 || band < 0.0 {
                return String::new();
            }
            band_name(band as usize).replace(" cycles per pixel", "")
        };
        chart
            .configure_mesh()
            .x_labels(BANDS)
            .x_desc("cycles per pixel")
            .y_desc("power per frequency, relative to even noise")
            .x_label_formatter(&name)
            .y_label_formatter(&up_label)
            .max_light_lines(5)
            .label_style((FONT, 12))
            .axis_desc_style((FONT, 15))
            .light_line_style(BLACK.mix(0.06))
            .bold_line_style(BLACK.mix(0.15))
            .draw()?;
        for (number, (name, bands)) in spectra.iter().enumerate() {
            line(&mut chart, (number, name), bands.clone())?;
        }
        legend(&mut chart)?;
        root.present()?;
    }
    Ok(Some(svg))
}

/// The mean over runs of the power in every band that has any.
fn mean(way: &WayStudy) -> Vec<(f64, f64)> {
    let last: Vec<_> = way.runs.iter().filter_map(|run| run.snapshots.last()).collect();
    (0..BANDS)
        .map(|band| {
            let sum: f64 = last.iter().map(|look| look.spectrum[band]).sum();
            (band as f64, sum / last.len().max(1) as f64)
        })
        .filter(|&(_, power)| power > 0.0)
        .collect()
}
