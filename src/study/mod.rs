//! What accuracy costs in time: independent runs of several ways to render a scene, each looked at again and again while it runs, held
//! against a reference.
//!
//! - A [`Study`] is what was asked for and all that was measured, in one file; everything else is made from it.
//! - A [run](run_once) has a seed of its own and is looked at at times that double, so that one run gives a whole curve. Bootstraps count,
//!   looking does not.
//! - A [`Reference`] knows its own error. Errors against it are lowered by that, and where they come near it, curves end.
//! - A [`Summary`] is what the runs of one way have to say: medians and bands, times to errors, efficiency, slope, each with an interval.

mod choice;
mod estimates;
mod outlook;
mod pilot;
mod pooled;
mod prediction;
mod reference;
mod run;
mod spectrum;
mod study_file;
mod summary;

pub use choice::{Candidate, Choice, Rival, choose};
pub use estimates::Interval;
pub use outlook::{Foreseen, Outlook};
pub use pilot::{Pilot, PilotEnd, PilotLook, pilot};
pub use pooled::{ExpectedError, Pooled};
pub use prediction::{Forecast, Predicted, Prediction};
pub use reference::{Reference, ReferenceError, ReferenceRecord};
pub use run::{checkpoints, run_once, split_run};
pub use spectrum::{BANDS, Spectrum, band_name};
pub use study_file::{
    Errors, LayerRun, RunRecord, SceneStudy, Settings, Snapshot, StageSeconds, Stated, Study, StudyError, WaySettings,
    WayStudy,
};
pub use summary::{Measure, Point, Summary, TimeTo};
