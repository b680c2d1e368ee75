//! Error against time, or against samples.

use super::log_axis::{labels, range};
use super::series::{legend, line};
use super::{FONT, PlotError, SIZE, color};
use crate::study::{Measure, Point, SceneStudy, Summary};
use plotters::prelude::*;

/// What errors are drawn against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// Seconds, start-up included.
    Time,
    /// Samples, or mutations, per pixel.
    Samples,
}

impl Against {
    const fn of(self, point: &Point) -> f64 {
        match self {
            Self::Time => point.seconds,
            Self::Samples => point.per_pixel,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Time => "seconds, start-up included",
            Self::Samples => "samples, or mutations, per pixel",
        }
    }
}

/// The medians of all ways in a scene with bands from the 10 % to the 90 % quantile, both axes logarithmic, as SVG. Curves end where they
/// come near the reference's own error. `None` where there is nothing to draw.
///
/// # Errors
/// Whatever keeps it from being drawn.
pub fn error_curves(scene: &SceneStudy, measure: Measure, against: Against) -> Result<Option<String>, PlotError> {
    let curves: Vec<(String, Vec<Point>)> = scene
        .ways
        .iter()
        .map(|way| {
            let points = Summary::of(scene, way, measure).points;
            (
                way.name.clone(),
                points.into_iter().filter(|point| !point.is_reference).collect(),
            )
        })
        .collect();
    let all = || curves.iter().flat_map(|(_, points)| points);
    let across = range(all().map(|point| against.of(point)));
    let up = range(all().flat_map(|point| point.quantiles));
    let (Some(across), Some(up)) = (across, up) else {
        return Ok(None);
    };
    let (across_label, up_label) = (labels(&across), labels(&up));
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .caption(format!("{}: {}", scene.name, measure.name()), (FONT, 18))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d(across.log_scale(), up.clone().log_scale())?;
        chart
            .configure_mesh()
            .x_desc(against.words())
            .y_desc(measure.name())
            .x_label_formatter(&across_label)
            .y_label_formatter(&up_label)
            .max_light_lines(5)
            .label_style((FONT, 14))
            .axis_desc_style((FONT, 15))
            .light_line_style(BLACK.mix(0.06))
            .bold_line_style(BLACK.mix(0.15))
            .draw()?;
        for (number, (name, points)) in curves.iter().enumerate() {
            let lowest = up.start;
            let at = |quantile: usize| move |point: &Point| (against.of(point), point.quantiles[quantile].max(lowest));
            let mut band: Vec<(f64, f64)> = points.iter().map(at(2)).collect();
            band.extend(points.iter().rev().map(at(0)));
            chart.draw_series([Polygon::new(band, color(number).mix(0.18))])?;
            line(&mut chart, (number, name), points.iter().map(at(1)).collect())?;
        }
        legend(&mut chart)?;
        root.present()?;
    }
    Ok(Some(svg))
}
