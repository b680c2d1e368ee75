//! The page of a study: one file, without a network.

use super::curves::{Against, error_curves};
use super::markup::{data_address, escaped};
use super::spectra::error_spectra;
use super::tables::{bias, layers, stages, summaries};
use super::{PlotError, Shown};
use crate::study::{Measure, SceneStudy, Study};
use std::fmt::Write;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// What errors are.
const NOTES: &str = "<p class=\"hint\">With a the picture and r the reference, over pixels and channels: MSE = mean (a \u{2212} r)\u{b2}; relMSE = mean \
    (a \u{2212} r)\u{b2} / (r\u{b2} + 0.01), also without the 0.1 % of the pixels where it is largest; SMAPE = mean 2 |a \u{2212} r| / (|a| + |r| + 0.01); \
    FLIP is the mean of the differences that an eye sees when the pictures take each other's place. Errors that the reference has itself are taken off. \
    Bands are from the 10 % to the 90 % quantile of runs; efficiency is 1 / (error \u{d7} time) over that of the first way.</p>\n";

/// The page of a study, with the pictures of its scenes in the same order.
///
/// # Errors
/// A plot that cannot be drawn.
pub fn page(study: &Study, shown: &[Shown]) -> Result<String, PlotError> {
    let names: Vec<&str> = study.scenes.iter().map(|scene| scene.name.as_str()).collect();
    let title = format!("What accuracy costs: {}", names.join(", "));
    let mut body = format!("<h1>{}</h1>\n{}", escaped(&title), settings(study));
    for (scene, shown) in study.scenes.iter().zip(shown) {
        body += &of_scene(scene, shown)?;
    }
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n\
         <body>\n{body}\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        escaped(&title)
    ))
}

fn settings(study: &Study) -> String {
    let asked = &study.settings;
    let mut out = format!(
        "<p>{}. Runs of {} s on {} threads, from seed {}.</p>\n<ul>",
        escaped(&study.machine),
        asked.seconds,
        asked.threads,
        asked.seed
    );
    for way in &asked.ways {
        // Writing to a String cannot fail.
        let _ = write!(
            out,
            "<li>{}: <code>{}</code></li>",
            escaped(&way.name),
            escaped(&way.options.join(" "))
        );
    }
    out + "</ul>\n" + NOTES
}

fn of_scene(scene: &SceneStudy, shown: &Shown) -> Result<String, PlotError> {
    let reference = &scene.reference;
    let own = reference.own_rel_mse.map_or_else(
        || "unknown".to_owned(),
        |own| format!("{own:.2e}, taken off all errors"),
    );
    let mut out = format!(
        "<section>\n<h2>{}</h2>\n<p>{} x {} pixels of <code>{}</code>. Reference: <code>{}</code>{}; its own relMSE is {own}.</p>\n",
        escaped(&scene.name),
        scene.size.0,
        scene.size.1,
        escaped(&scene.file),
        escaped(&reference.file),
        reference
            .made_by
            .as_deref()
            .map_or_else(String::new, |made| format!(" ({})", escaped(made))),
    );
    out += &viewer(shown);
    out += "<div class=\"plots\">\n";
    let plots = [
        error_curves(scene, Measure::RelMse, Against::Time)?,
        error_curves(scene, Measure::RelMseTrimmed, Against::Time)?,
        error_curves(scene, Measure::Flip, Against::Time)?,
        error_curves(scene, Measure::RelMse, Against::Samples)?,
        error_spectra(scene)?,
    ];
    for svg in plots.iter().flatten() {
        let _ = writeln!(
            out,
            "<img class=\"plot\" alt=\"plot\" src=\"{}\">",
            data_address("image/svg+xml", svg.as_bytes())
        );
    }
    out += "</div>\n";
    out += &summaries(scene, Measure::RelMse);
    out += &summaries(scene, Measure::RelMseTrimmed);
    out += &bias(scene);
    out += &stages(scene);
    out += &layers(scene);
    Ok(out + "\n</section>\n")
}

/// Pictures that take each other's place where one clicks, all at the same zoom.
fn viewer(shown: &Shown) -> String {
    let (width, height) = shown.size();
    let layers = shown.layers();
    let mut buttons = String::new();
    let mut pictures = String::new();
    for (number, (name, png)) in layers.iter().enumerate() {
        let on = if number == 0 { " on" } else { "" };
        let name = escaped(name);
        let _ = write!(
            buttons,
            "<button type=\"button\" class=\"pick{on}\" data-layer=\"{number}\">{name}</button>"
        );
        let _ = write!(
            pictures,
            "<img class=\"layer{on}\" alt=\"{name}\" draggable=\"false\" src=\"{}\">",
            data_address("image/png", png)
        );
    }
    format!(
        "<div class=\"viewer\"><div class=\"buttons\">{buttons}<button type=\"button\" class=\"whole\">zoom out</button></div>\n\
         <div class=\"stage\" style=\"aspect-ratio:{width}/{height}\"><div class=\"moved\">{pictures}</div></div>\n\
         <p class=\"hint\">First run of every way, in equal time. Click: the next picture. Wheel: zoom. Drag: move.</p></div>\n"
    )
}
