//! What a study says, as a table for people.

use crate::report::words::{interval, seconds};
use crate::study::{Measure, SceneStudy, Summary};
use std::fmt::Write;

/// The measures of the table.
const MEASURES: [Measure; 2] = [Measure::RelMse, Measure::RelMseTrimmed];

/// The table of a scene.
pub fn table(scene: &SceneStudy) -> String {
    let reference = &scene.reference;
    let own = match reference.own_rel_mse {
        Some(own) => format!("its own relMSE is {own:.2e}, and taken off"),
        None => "its own error is not known".to_owned(),
    };
    let mut out = format!(
        "{}, {} x {} pixels, against {}: {own}\n",
        scene.name, scene.size.0, scene.size.1, reference.file
    );
    for measure in MEASURES {
        let summaries: Vec<Summary> = scene.ways.iter().map(|way| Summary::of(scene, way, measure)).collect();
        // Writing to a String cannot fail.
        let _ = writeln!(out, "\n{}", measure.name());
        let _ = writeln!(
            out,
            "{:<16} {:>5} {:>7} {:>9} {:>21} {:>22} {:>14} {:>14} {:>14} {:>22}",
            "",
            "runs",
            "s",
            "median",
            "10 % to 90 %",
            "slope (95 %)",
            "s to 1e-1",
            "s to 1e-2",
            "s to 1e-3",
            "efficiency (95 %)"
        );
        for summary in &summaries {
            let _ = writeln!(out, "{}", row(summary).trim_end());
        }
    }
    let _ = write!(out, "\nsquared bias, relative, at the end, from pairs of runs (95 %)");
    for way in &scene.ways {
        let bias = Summary::of(scene, way, Measure::RelMse).squared_bias;
        let _ = write!(out, "\n{:<16} {}", way.name, interval(bias, |v| format!("{v:.1e}")));
    }
    out
}

fn row(summary: &Summary) -> String {
    let Some(end) = summary.end() else {
        return format!("{:<16} nothing was looked at", summary.way);
    };
    let [low, middle, high] = end.quantiles;
    let time = |error: f64| summary.times.iter().find(|time| time.error == error);
    format!(
        "{:<16} {:>5} {:>7.2} {middle:>9.2e} {:>21} {:>22} {:>14} {:>14} {:>14} {:>22}",
        summary.way,
        end.runs,
        end.seconds,
        format!("{low:.2e} to {high:.2e}"),
        interval(summary.slope, |v| format!("{v:.2}")),
        seconds(time(1e-1)),
        seconds(time(1e-2)),
        seconds(time(1e-3)),
        match summary.efficiency {
            None => String::new(),
            some => interval(some, |v| format!("{v:.2}")),
        }
    )
}
