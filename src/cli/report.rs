//! What a render says of itself when it is done: as JSON, as a summary, as warnings.

use super::load::{Loaded, settings};
use super::output::{count, note};
use crate::film::{ImageView, Picture};
use crate::render::{Outcome, Rendering, Stop};
use serde::Serialize;
use std::path::Path;

/// What `--json` prints. Times stand here and not in the picture, whose bytes are those of its settings alone.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    scene: String,
    technique: &'static str,
    settings: String,
    seed: u64,
    steps: u64,
    /// Whether somebody stopped it before its budget was spent.
    pub(super) interrupted: bool,
    output: String,
    threads: usize,
    load_seconds: f64,
    render_seconds: f64,
    samples: u64,
    samples_per_second: f64,
    rays: u64,
    segments: u64,
    /// Mean over pixels and channels, W sr⁻¹ m⁻².
    mean: f64,
    /// Root of the mean squared standard error of pixels and channels; absent with a single sample.
    rms_error: Option<f64>,
    relative_rms_error: Option<f64>,
    non_finite: u64,
    first_non_finite: Option<(u32, u64)>,
    saturated: u64,
    vanished: u64,
    warnings: &'a [String],
}

impl<'a> Report<'a> {
    /// What there is to say of `picture`, rendered from the file `scene` with `seed` and written to `output`.
    pub(super) fn new(
        scene: &Path,
        seed: u64,
        loaded: &'a Loaded,
        render: &dyn Rendering,
        outcome: Outcome,
        picture: &Picture,
        output: &Path,
    ) -> Self {
        let counters = render.counters();
        let tally = render.tally();
        let mean = channel_mean(picture.view(), f64::from);
        let rms_error = (outcome.steps > 1).then(|| {
            channel_mean(
                ImageView {
                    rgb: &picture.error,
                    ..picture.view()
                },
                |e| f64::from(e) * f64::from(e),
            )
            .sqrt()
        });
        let seconds = outcome.elapsed.as_secs_f64();
        Self {
            scene: scene.display().to_string(),
            technique: loaded.plan.technique.name(),
            settings: settings(loaded),
            seed,
            steps: outcome.steps,
            interrupted: outcome.stop == Stop::Interrupted,
            output: output.display().to_string(),
            threads: render.threads(),
            load_seconds: loaded.load_time.as_secs_f64(),
            render_seconds: seconds,
            samples: counters.decisions,
            samples_per_second: counters.decisions as f64 / seconds.max(1e-9),
            rays: counters.rays,
            segments: counters.segments,
            mean,
            rms_error,
            relative_rms_error: rms_error.filter(|_| mean > 0.0).map(|error| error / mean),
            non_finite: counters.non_finite + tally.non_finite,
            first_non_finite: counters.first_non_finite,
            saturated: tally.saturated,
            vanished: tally.vanished,
            warnings: &loaded.warnings,
        }
    }

    /// The summary for people.
    pub(super) fn summary(&self, png: &Path) -> String {
        let Self {
            technique,
            steps,
            render_seconds,
            threads,
            ..
        } = self;
        let error = self
            .relative_rms_error
            .map(|e| format!(", relative RMS error {:.2} %", 100.0 * e))
            .unwrap_or_default();
        let interrupted = if self.interrupted { "interrupted; " } else { "" };
        format!(
            "{interrupted}{technique}: {steps} samples per pixel in {render_seconds:.1} s on {threads} threads, {} samples/s{error}\n\
         wrote {} and {}",
            count(self.samples_per_second),
            self.output,
            png.display()
        )
    }

    /// Says in words what numbers in the report would hide.
    pub(super) fn warn(&self) {
        if let (n @ 1.., Some((chain, step))) = (self.non_finite, self.first_non_finite) {
            note(&format!(
                "warning: {n} samples were not finite and count as black; the first: chain {chain}, step {step}"
            ));
        }
        if self.saturated > 0 {
            note(&format!(
                "warning: {} samples were too bright for the film and were cut: the picture is wrong",
                self.saturated
            ));
        }
    }
}

/// The mean of `f` over pixels and channels.
fn channel_mean(picture: ImageView<'_>, f: impl Fn(f32) -> f64) -> f64 {
    let channels = picture.rgb.iter().flat_map(|rgb| rgb.to_array());
    channels.map(f).sum::<f64>() / (3 * picture.rgb.len()).max(1) as f64
}
