//! The file of a study.

use super::ReferenceRecord;
use super::spectrum::Spectrum;
use crate::film::{WriteError, write_file};
use crate::render::LayerRecord;
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The form of the file; another number is another form.
const VERSION: u32 = 1;

/// A study: what was asked for, and all that was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// The form of the file.
    version: u32,
    /// What was asked for.
    pub settings: Settings,
    /// What ran it: the program and its version, the kind of machine, its cores.
    pub machine: String,
    /// Scene by scene.
    pub scenes: Vec<SceneStudy>,
}

/// What was asked for: studies that differ in any of it are not continued.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// Seconds of each run, start-up included.
    pub seconds: f64,
    /// Threads of each run.
    pub threads: usize,
    /// The first run's seed; others follow.
    pub seed: u64,
    /// Film size instead of the scenes'.
    pub size: Option<(u32, u32)>,
    /// Ways to render; the first is what others are compared with.
    pub ways: Vec<WaySettings>,
}

/// A way to render.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WaySettings {
    /// Its name in tables and plots.
    pub name: String,
    /// Options of `render`.
    pub options: Vec<String>,
}

/// A scene of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneStudy {
    /// The file's name without its folder and extension.
    pub name: String,
    /// The file.
    pub file: String,
    /// Pixels in a row, and rows.
    pub size: (u32, u32),
    /// What pictures are compared with.
    pub reference: ReferenceRecord,
    /// By way, in the order of the settings.
    pub ways: Vec<WayStudy>,
}

/// A way to render a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WayStudy {
    /// The way's name.
    pub name: String,
    /// The technique.
    pub technique: String,
    /// All settings that shape the picture, as its metadata has them.
    pub settings: String,
    /// Runs, by seed.
    pub runs: Vec<RunRecord>,
    /// What the scene's effects cost, where it was asked for: of one run more, which splits its light.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layers: Option<LayerRun>,
}

/// A run that splits its light into layers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LayerRun {
    /// Seconds that it took, start-up included.
    pub seconds: f64,
    /// Layer by layer.
    pub layers: Vec<LayerRecord>,
}

/// An independent run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunRecord {
    /// Its seed.
    pub seed: u64,
    /// Seconds before the first step: worlds built, bootstraps.
    pub start_seconds: f64,
    /// Looks at it, the earliest first.
    pub snapshots: Vec<Snapshot>,
    /// Seconds of every stage, summed over threads, of the whole run.
    pub stages: Vec<StageSeconds>,
}

/// What a stage cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StageSeconds {
    /// The stage.
    pub stage: String,
    /// Seconds, summed over threads.
    pub seconds: f64,
}

/// A look at a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// The time at which it was due, in seconds.
    pub due: f64,
    /// The time that the run had taken, in seconds: a step more, at times.
    pub seconds: f64,
    /// Steps taken.
    pub steps: u64,
    /// Samples, or mutations, per pixel.
    pub per_pixel: f64,
    /// How far the picture is from the reference.
    pub errors: Errors,
    /// Mean over pixels and channels of (a − r)(b − r) / (r² + 0.01), with b the picture of the run before at the same time: what both
    /// are wrong by together, bias and the reference's own error. Its mean over pairs of runs is the relative squared bias without the
    /// noise that a mean picture of few runs would have. Absent where there is no run before it.
    pub shared: Option<f64>,
    /// The error that the render states itself, relative to the picture's mean, over block means.
    pub stated: Option<Stated>,
    /// Where in the picture's frequencies the error is.
    pub spectrum: Spectrum,
}

/// How far a picture is from the reference. See [`Metrics`](crate::stats::metrics::Metrics) and [`flip`](crate::stats::flip).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Errors {
    /// Mean squared error.
    pub mse: f64,
    /// Relative mean squared error.
    pub rel_mse: f64,
    /// The same without the worst 0.1 % of pixels.
    pub rel_mse_trimmed: f64,
    /// Symmetric mean absolute relative error.
    pub smape: f64,
    /// Mean of ꟻLIP at the reference's exposure.
    pub flip: f64,
    /// Mean of the picture over that of the reference; absent of a black one.
    pub mean_ratio: Option<f64>,
}

/// An error that a render states.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stated {
    /// Its estimate.
    pub rms: f64,
    /// What the error is below with a probability of 0.95.
    pub upper: f64,
}

/// Why a study's file cannot be used.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum StudyError {
    /// It cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    #[diagnostic(help("check that it may be read, or give another folder"))]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// It is no study.
    #[error("{}: not a study: {reason}", path.display())]
    #[diagnostic(help("give another folder, or move the file away to start anew"))]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// It is another study.
    #[error("{}: a study with another {what}", path.display())]
    #[diagnostic(help("ask for the same again to go on with it, or give another folder for a new one"))]
    Other {
        /// The file.
        path: PathBuf,
        /// What differs.
        what: String,
    },
}

impl Study {
    /// A study of which nothing is measured yet.
    #[must_use]
    pub const fn new(settings: Settings, machine: String) -> Self {
        Self {
            version: VERSION,
            settings,
            machine,
            scenes: Vec::new(),
        }
    }

    /// The study in the file at `path`; none, if there is no such file.
    ///
    /// # Errors
    /// A file that cannot be read, or is no study.
    pub fn read(path: &Path) -> Result<Option<Self>, StudyError> {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(source) => {
                return Err(StudyError::Io {
                    path: path.to_owned(),
                    source,
                });
            }
        };
        let format = |reason: String| StudyError::Format {
            path: path.to_owned(),
            reason,
        };
        let study: Self = serde_json::from_slice(&bytes).map_err(|error| format(error.to_string()))?;
        if study.version != VERSION {
            return Err(format(format!("its form is number {}, not {VERSION}", study.version)));
        }
        Ok(Some(study))
    }

    /// Writes the study to `path`, whole or not at all.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        let bytes = serde_json::to_vec_pretty(self).map_err(|error| WriteError::Encode {
            path: path.to_owned(),
            format: "a study",
            reason: error.to_string(),
        })?;
        write_file(path, &bytes)
    }

    /// Says that the study at `path` can be continued as one with these settings, on this machine: times of two are not one curve.
    ///
    /// # Errors
    /// What differs.
    pub fn is_of(&self, settings: &Settings, machine: &str, path: &Path) -> Result<(), StudyError> {
        let (had, asked) = (&self.settings, settings);
        let differs = [
            ("--time", had.seconds != asked.seconds),
            ("number of threads", had.threads != asked.threads),
            ("--seed", had.seed != asked.seed),
            ("--size", had.size != asked.size),
            ("choice of ways", had.ways != asked.ways),
            ("machine or version", self.machine != machine),
        ];
        match differs.into_iter().find(|(_, differs)| *differs) {
            None => Ok(()),
            Some((what, _)) => Err(StudyError::Other {
                path: path.to_owned(),
                what: what.to_owned(),
            }),
        }
    }
}
