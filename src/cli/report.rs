//! What a render says of itself when it is done: as JSON, as a summary, as warnings.

use super::auto::Chosen;
use super::load::{Loaded, settings};
use super::output::{count, note};
use super::render::RenderArgs;
use crate::film::{ImageView, Picture, ToneMap};
use crate::plan::Plan;
use crate::render::{ChainRender, DirectLight, Findings, LayerFinding, LayerRecord, Outcome, Rendering, Stop, blank};
use crate::stats::error::PictureError;
use serde::Serialize;
use std::path::Path;

/// What `--json` prints. Times stand here and not in the picture, whose bytes are those of its settings alone.
#[derive(Serialize)]
pub(super) struct Report {
    scene: String,
    technique: &'static str,
    /// Where `--technique auto` took it: why, and what that took.
    #[serde(skip_serializing_if = "Option::is_none")]
    auto: Option<Chosen>,
    settings: String,
    seed: u64,
    steps: u64,
    /// Samples per pixel; mutations per pixel of techniques with chains. `--spp` with it gives the same bytes.
    samples_per_pixel: f64,
    /// Whether somebody stopped it before its budget was spent.
    pub(super) interrupted: bool,
    /// Whether it ended because its error was below the target.
    target_reached: bool,
    output: String,
    /// Stops: the PNG shows light times two to the power of it.
    png_exposure: f32,
    threads: usize,
    load_seconds: f64,
    /// Before the first step: bootstraps, and the first samples of direct light that is rendered apart.
    bootstrap_seconds: Option<f64>,
    render_seconds: f64,
    samples: u64,
    samples_per_second: f64,
    /// Samples of direct light per pixel, where it is rendered apart: they are not among the above, but in all that follows.
    direct_samples_per_pixel: Option<f64>,
    rays: u64,
    segments: u64,
    /// Mean over pixels and channels, W sr⁻¹ m⁻².
    mean: f64,
    /// The picture's relative error over block means, with its 95 % interval.
    error: Option<PictureError>,
    /// Root of the mean squared standard error of pixels and channels; absent with a single sample.
    rms_error: Option<f64>,
    relative_rms_error: Option<f64>,
    non_finite: u64,
    first_non_finite: Option<(u32, u64)>,
    saturated: u64,
    vanished: u64,
    chains: Option<Findings>,
    /// What the layers cost that light was split into.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layers: Vec<LayerRecord>,
    warnings: Vec<String>,
    /// Those of the warnings that are yet to be told.
    #[serde(skip)]
    untold: Vec<String>,
}

impl Report {
    /// What there is to say of `picture`, rendered as `args` say and written to `output`.
    pub(super) fn new(
        args: &RenderArgs,
        loaded: &Loaded,
        render: &dyn Rendering,
        outcome: Outcome,
        picture: &Picture,
        output: &Path,
        chains: Option<Findings>,
    ) -> Self {
        let counters = render.counters();
        let direct = render.direct();
        let of_direct = direct.map(DirectLight::counters).unwrap_or_default();
        let tally = render.tally();
        let mean = channel_mean(picture.view(), f64::from);
        let errors = ImageView {
            rgb: &picture.error,
            ..picture.view()
        };
        let rms_error = channel_mean(errors, |e| f64::from(e) * f64::from(e)).sqrt();
        let rms_error = rms_error.is_finite().then_some(rms_error);
        let seconds = outcome.elapsed.as_secs_f64();
        let mut warnings = loaded.warnings.clone();
        warnings.extend(missed(&loaded.plan));
        let mut untold: Vec<String> = chains.iter().flat_map(Findings::warnings).collect();
        untold.extend(blank(render, picture));
        warnings.extend_from_slice(&untold);
        let error = chains
            .as_ref()
            .map_or_else(|| render.error(), |findings| findings.error);
        let samples_per_pixel = render
            .as_chains()
            .map_or(outcome.steps as f64, ChainRender::mutations_per_pixel);
        Self {
            scene: args.scene.scene.display().to_string(),
            technique: loaded.plan.technique.name(),
            auto: None,
            settings: settings(loaded),
            seed: args.seed,
            steps: outcome.steps,
            samples_per_pixel,
            interrupted: outcome.stop == Stop::Interrupted,
            target_reached: outcome.stop == Stop::TargetReached,
            output: output.display().to_string(),
            png_exposure: 0.0,
            threads: render.threads(),
            load_seconds: loaded.load_time.as_secs_f64(),
            bootstrap_seconds: render.as_chains().map(|chains| chains.start_time().as_secs_f64()),
            render_seconds: seconds,
            samples: counters.decisions,
            samples_per_second: counters.decisions as f64 / seconds.max(1e-9),
            direct_samples_per_pixel: direct.map(DirectLight::samples_per_pixel),
            rays: counters.rays + of_direct.rays,
            segments: counters.segments + of_direct.segments,
            mean,
            error,
            rms_error,
            relative_rms_error: rms_error.filter(|_| mean > 0.0).map(|error| error / mean),
            non_finite: counters.non_finite + of_direct.non_finite + tally.non_finite,
            first_non_finite: counters.first_non_finite,
            saturated: tally.saturated,
            vanished: tally.vanished,
            chains,
            layers: Vec::new(),
            warnings,
            untold,
        }
    }

    /// With how the PNG shows it.
    pub(super) fn shown(self, tone: ToneMap) -> Self {
        Self {
            png_exposure: tone.exposure,
            ..self
        }
    }

    /// With what its layers cost.
    pub(super) fn split(self, layers: &[LayerFinding]) -> Self {
        let layers = layers.iter().map(|layer| layer.record.clone()).collect();
        Self { layers, ..self }
    }

    /// With how the technique was chosen, if it was.
    pub(super) fn chosen(self, auto: Option<Chosen>) -> Self {
        Self { auto, ..self }
    }

    /// The summary for people.
    pub(super) fn summary(&self, png: &Path) -> String {
        let Self {
            technique,
            samples_per_pixel,
            render_seconds,
            threads,
            ..
        } = self;
        let what = if self.chains.is_some() { "mutations" } else { "samples" };
        let interrupted = if self.interrupted { "interrupted; " } else { "" };
        let mut out = format!(
            "{interrupted}{technique}: {samples_per_pixel} {what} per pixel in {render_seconds:.1} s on {threads} threads, \
             {} {what} a second\n",
            count(self.samples_per_second)
        );
        if let Some(samples) = self.direct_samples_per_pixel {
            out += &format!("direct light apart: {samples} samples per pixel\n");
        }
        let error = self.error.map(|error| {
            let [low, high] = error.interval;
            let (error, low, high) = (100.0 * error.rms, 100.0 * low, 100.0 * high);
            format!("error {error:.2} % of the mean, over block means (95 %: {low:.2} to {high:.2} %)")
        });
        let pixels = self
            .relative_rms_error
            .map(|e| format!("{:.1} % over pixels", 100.0 * e));
        let errors: Vec<String> = error.into_iter().chain(pixels).collect();
        if !errors.is_empty() {
            out += &format!("{}\n", errors.join("; "));
        }
        if let Some(findings) = &self.chains {
            out += &super::findings::text(findings);
        }
        if !self.layers.is_empty() {
            let seconds = self.render_seconds + self.bootstrap_seconds.unwrap_or(0.0);
            out += &format!("{}\n", super::layers::table(&self.layers, seconds));
        }
        out += &format!("wrote {} and {}", self.output, png.display());
        out
    }

    /// Says in words what numbers in the report would hide.
    pub(super) fn warn(&self) {
        if self.non_finite > 0 {
            let first = self.first_non_finite;
            let first = first.map(|(chain, step)| format!("; the first: chain {chain}, step {step}"));
            note(&format!(
                "warning: {} samples were not finite and count as black{}",
                self.non_finite,
                first.unwrap_or_default()
            ));
        }
        if self.saturated > 0 {
            note(&format!(
                "warning: {} samples were too bright for the film and were cut: the picture is wrong",
                self.saturated
            ));
        }
        for warning in &self.untold {
            note(&format!("warning: {warning}"));
        }
    }
}

/// What the technique cannot find of what the camera sees, in words: known before rendering.
pub(super) fn missed(plan: &Plan) -> Vec<String> {
    let seen = plan.missing.iter().filter(|missing| missing.is_likely());
    seen.map(|missing| format!("{} cannot find {missing}", plan.technique))
        .collect()
}

/// The mean of `f` over pixels and channels.
fn channel_mean(picture: ImageView<'_>, f: impl Fn(f32) -> f64) -> f64 {
    let channels = picture.rgb.iter().flat_map(|rgb| rgb.to_array());
    channels.map(f).sum::<f64>() / (3 * picture.rgb.len()).max(1) as f64
}
