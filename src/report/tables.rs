//! Tables of a page.

use super::markup::escaped;
use super::words::{interval, seconds};
use crate::study::{LayerRun, Measure, SceneStudy, Summary, WayStudy};
use std::fmt::Write;

/// What all runs say, of one measure.
pub(super) fn summaries(scene: &SceneStudy, measure: Measure) -> String {
    let mut rows = String::new();
    for way in &scene.ways {
        let summary = Summary::of(scene, way, measure);
        let Some(end) = summary.end() else { continue };
        let [low, middle, high] = end.quantiles;
        let two = |v: f64| format!("{v:.2}");
        let time = |error: f64| seconds(summary.times.iter().find(|time| time.error == error));
        // Writing to a String cannot fail.
        let _ = write!(
            rows,
            "<tr><th>{}</th><td>{}</td><td>{:.2}</td><td>{middle:.2e}</td><td>{low:.2e} to {high:.2e}</td><td>{}</td><td>{}</td>\
             <td>{}</td><td>{}</td><td>{}</td></tr>",
            escaped(&way.name),
            end.runs,
            end.seconds,
            interval(summary.slope, two),
            time(1e-1),
            time(1e-2),
            time(1e-3),
            summary
                .efficiency
                .map_or_else(|| "1".to_owned(), |of| interval(Some(of), two)),
        );
    }
    format!(
        "<table><caption>{} at the end of runs; intervals of 95 %, those of times where there are six runs or more</caption><tr><th></th><th>runs</th><th>s</th><th>median</th>\
         <th>10 % to 90 %</th><th>slope</th><th>s to 1e-1</th><th>s to 1e-2</th><th>s to 1e-3</th><th>efficiency</th></tr>{rows}</table>",
        escaped(measure.name())
    )
}

/// Bias apart from variance, and the error that renders state against that which they have.
pub(super) fn bias(scene: &SceneStudy) -> String {
    let mut rows = String::new();
    for way in &scene.ways {
        let summary = Summary::of(scene, way, Measure::RelMse);
        let squared = interval(summary.squared_bias, |v| format!("{v:.1e}"));
        let last: Vec<_> = way.runs.iter().filter_map(|run| run.snapshots.last()).collect();
        let mean = |values: Vec<f64>| (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64);
        let show = |value: Option<f64>| value.map_or_else(|| "not known".to_owned(), |value| format!("{value:.4}"));
        let brightness = mean(last.iter().filter_map(|look| look.errors.mean_ratio).collect());
        let stated = mean(last.iter().filter_map(|look| Some(look.stated?.rms)).collect());
        let _ = write!(
            rows,
            "<tr><th>{}</th><td>{squared}</td><td>{}</td><td>{}</td></tr>",
            escaped(&way.name),
            show(brightness),
            show(stated)
        );
    }
    format!(
        "<table><caption>Bias, at the end of runs</caption><tr><th></th><th>squared bias, relative (95 %)</th>\
         <th>brightness over that of the reference</th><th>relative error over blocks that renders state</th></tr>{rows}</table>"
    )
}

/// What every stage costs, as a share of the time in all of them.
pub(super) fn stages(scene: &SceneStudy) -> String {
    let mut names: Vec<&str> = Vec::new();
    for stage in scene.ways.iter().flat_map(|way| &way.runs).flat_map(|run| &run.stages) {
        if !names.contains(&stage.stage.as_str()) {
            names.push(&stage.stage);
        }
    }
    let seconds = |way: &WayStudy, name: &str| -> f64 {
        let stages = way.runs.iter().flat_map(|run| &run.stages);
        // Not a sum, which is -0 of nothing.
        stages
            .filter(|stage| stage.stage == name)
            .fold(0.0, |sum, stage| sum + stage.seconds)
    };
    let head: String = names.iter().map(|name| format!("<th>{}</th>", escaped(name))).collect();
    let mut rows = String::new();
    for way in &scene.ways {
        let all: f64 = names.iter().map(|name| seconds(way, name)).sum();
        let cell = |name: &&str| {
            let share = 100.0 * seconds(way, name) / all.max(1e-12);
            format!(
                "<td><span class=\"bar\" style=\"width:{:.0}px\"></span>{share:.1} %</td>",
                0.8 * share
            )
        };
        let start: f64 = way.runs.iter().map(|run| run.start_seconds).sum::<f64>() / way.runs.len().max(1) as f64;
        let cells: String = names.iter().map(cell).collect();
        let _ = write!(
            rows,
            "<tr><th>{}</th><td>{start:.2} s</td>{cells}</tr>",
            escaped(&way.name)
        );
    }
    format!(
        "<table><caption>What stages cost: seconds before the first step, and shares of the time of steps</caption>\
         <tr><th></th><th>start</th>{head}</tr>{rows}</table>"
    )
}

/// What every effect costs: of each layer its light, and in every way that was asked for it its error and its share of the time.
pub(super) fn layers(scene: &SceneStudy) -> String {
    let ways: Vec<(&WayStudy, &LayerRun)> = scene
        .ways
        .iter()
        .filter_map(|way| Some((way, way.layers.as_ref()?)))
        .collect();
    let Some((_, first)) = ways.first() else {
        return String::new();
    };
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let head: String = ways
        .iter()
        .map(|(way, _)| format!("<th colspan=\"4\">{}</th>", escaped(&way.name)))
        .collect();
    let columns = "<th>light</th><th>its error (95 %)</th><th>of the error</th><th>time</th>".repeat(ways.len());
    let mut rows = String::new();
    for layer in &first.layers {
        let cell = |(_, run): &(&WayStudy, &LayerRun)| {
            let Some(own) = run.layers.iter().find(|own| own.name == layer.name) else {
                return "<td colspan=\"4\"></td>".to_owned();
            };
            let error = own.error.map_or_else(
                || "not known".to_owned(),
                |error| {
                    let [low, high] = error.interval.map(|bound| 100.0 * bound);
                    format!("{:.1} % ({low:.1} to {high:.1})", 100.0 * error.rms)
                },
            );
            format!(
                "<td>{}</td><td>{error}</td><td>{}</td><td>{}</td>",
                percent(own.light_share),
                percent(own.error_share),
                percent(own.time_share)
            )
        };
        let cells: String = ways.iter().map(cell).collect();
        let _ = write!(
            rows,
            "<tr><th>{} <code>{}</code></th>{cells}</tr>",
            escaped(&layer.name),
            escaped(&layer.expression)
        );
    }
    format!(
        "<table class=\"effects\"><caption>What every effect costs in one run of {:.1} s: its share of the light, its error over block means \
         relative to its own light, its share of the picture's squared error, and of the time</caption>\
         <tr><th></th>{head}</tr><tr><th></th>{columns}</tr>{rows}</table>",
        first.seconds
    )
}
