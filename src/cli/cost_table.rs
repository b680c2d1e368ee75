//! What pilots promise, as a table for people.

use super::cost::{MeasureReport, Report, TimeReport, WayReport};
use super::output::duration;
use std::fmt::Write;

/// The table of a scene.
pub(super) fn table(report: &Report) -> String {
    let mut out = format!(
        "{}, {} x {} pixels, {} threads, from pilots of {} each\n",
        report.scene,
        report.size.0,
        report.size.1,
        report.threads,
        duration(report.pilot_seconds)
    );
    let measures = report.ways.first().map_or(0, |way| way.predicted.len());
    for number in 0..measures {
        let of = |way: &WayReport| -> Option<String> { Some(row(way, way.predicted.get(number)?)) };
        let Some(first) = report.ways.first().and_then(|way| way.predicted.get(number)) else {
            continue;
        };
        // Writing to a String cannot fail.
        let _ = writeln!(out, "\ntime to {} (95 %)", first.measure);
        let _ = write!(out, "{:<16} {:>9}", "", "start-up");
        for TimeReport { error, .. } in &first.times {
            let _ = write!(out, " {:>34}", format!("{error}"));
        }
        out.push('\n');
        for row in report.ways.iter().filter_map(of) {
            let _ = writeln!(out, "{}", row.trim_end());
        }
    }
    out.push('\n');
    for missing in report.ways.iter().flat_map(|way| &way.missing) {
        let _ = writeln!(out, "warning: {missing}");
    }
    let _ = writeln!(out, "{}", report.assumes);
    out + &report.why
}

fn row(way: &WayReport, measure: &MeasureReport) -> String {
    let start = way.start_seconds.map_or_else(|| "no end".to_owned(), duration);
    let times = measure.times.iter().map(|time| match time.seconds {
        None => "no telling".to_owned(),
        Some(seconds) => {
            let [low, high] = seconds.bounds.map(duration);
            format!("{} ({low} to {high})", duration(seconds.value))
        }
    });
    let times: String = times.map(|time| format!(" {time:>34}")).collect();
    format!("{:<16} {start:>9}{times}", way.name)
}
