//! What a study renders: references, and runs that are missing.

use super::load::{Loaded, settings};
use super::output::note;
use super::render::metadata;
use super::report::missed;
use super::study::{StudyArgs, Subject};
use crate::film::{PictureMetadata, write_exr};
use crate::plan::Registry;
use crate::render::{Budget, RenderError, Stop, drive, start};
use crate::study::{
    Reference, RunRecord, SceneStudy, Study, StudyError, WaySettings, WayStudy, checkpoints, run_once, split_run,
};
use indicatif::ProgressBar;
use miette::Result;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// How many times as long as a run a reference is made where nobody says.
const REFERENCE_RUNS: f64 = 32.0;
/// Its seed is so far from those of runs.
const REFERENCE_SEED: u64 = 1 << 48;

/// Renders what is missing of a study.
pub(super) struct Runner<'a> {
    pub(super) args: &'a StudyArgs,
    pub(super) registry: &'a Registry,
    /// The study's file.
    pub(super) path: &'a Path,
    pub(super) interrupt: &'a AtomicBool,
    pub(super) bar: &'a ProgressBar,
}

impl Runner<'_> {
    /// The reference of a scene, made now if it has to be; with it, the scene's place in the study. `None` if somebody interrupted it.
    pub(super) fn reference_of(&self, subject: &Subject, study: &mut Study) -> Result<Option<Reference>> {
        let known = study.scenes.iter().find(|scene| scene.name == subject.name);
        if let Some(known) = known {
            let reference = subject.reference(
                self.args
                    .reference
                    .as_deref()
                    .unwrap_or(Path::new(&known.reference.file)),
            )?;
            known.is_of(subject, &reference, self.path)?;
            return Ok(Some(reference));
        }
        let reference = match &self.args.reference {
            Some(file) => subject.reference(file)?,
            None => {
                let file = self.args.output.join(format!("{}-reference.exr", subject.name));
                if !self.make(subject, &file)? {
                    return Ok(None);
                }
                subject.reference(&file)?
            }
        };
        study
            .scenes
            .push(SceneStudy::of(subject, &study.settings.ways, &reference));
        study.write(self.path)?;
        Ok(Some(reference))
    }

    /// Makes a reference; whether nobody interrupted it.
    fn make(&self, subject: &Subject, file: &Path) -> Result<bool> {
        let seconds = self
            .args
            .make_reference
            .flatten()
            .unwrap_or_else(|| self.args.time.mul_f64(REFERENCE_RUNS));
        let options = [
            "--technique".to_owned(),
            self.args.reference_technique.name().to_owned(),
        ];
        let loaded = self.args.load(&subject.file, &options, self.registry)?;
        for warning in missed(&loaded.plan) {
            note(&format!("warning: the reference of {}: {warning}", subject.name));
        }
        self.bar
            .set_message(format!("{}: reference, {:.0} s", subject.name, seconds.as_secs_f64()));
        let (seed, threads) = (self.args.seed.wrapping_add(REFERENCE_SEED), self.args.threads.count());
        let started = start(
            Arc::clone(&loaded.scene),
            loaded.plan.clone(),
            seed,
            threads,
            self.interrupt,
            &|_| {},
        );
        let mut render = match started {
            Err(RenderError::Interrupted) => return Ok(false),
            started => started?,
        };
        let outcome = drive(&mut *render, Budget::Time(seconds), self.interrupt, &|_| {
            self.bar.tick()
        });
        if outcome.stop == Stop::Interrupted {
            return Ok(false);
        }
        let of = metadata(&subject.file, seed, &loaded, &*render);
        write_exr(file, &render.picture(), &of)?;
        Ok(true)
    }

    /// Takes the runs of a scene that are missing, way by way in turn; whether nobody interrupted it.
    pub(super) fn render(&self, subject: &Subject, reference: &Reference, study: &mut Study) -> Result<bool> {
        let due = checkpoints(study.settings.seconds);
        let threads = study.settings.threads;
        let Some(scene) = study.scenes.iter().position(|scene| scene.name == subject.name) else {
            return Ok(true);
        };
        let mut before = vec![vec![None; due.len()]; subject.ways.len()];
        for run in 0..u64::from(self.args.runs) {
            let seed = study.settings.seed.wrapping_add(run);
            for (number, loaded) in subject.ways.iter().enumerate() {
                let way = &study.scenes[scene].ways[number];
                self.bar
                    .set_message(format!("{}: {}, run {}", subject.name, way.name, run + 1));
                let has_seed = |run: &RunRecord| run.seed == seed;
                if way.runs.iter().any(has_seed) {
                    self.bar.inc(1);
                    continue;
                }
                let pictures = &mut before[number];
                let record = run_once(
                    &loaded.scene,
                    &loaded.plan,
                    (seed, threads),
                    &due,
                    reference,
                    pictures,
                    self.interrupt,
                )?;
                let Some((record, picture)) = record else {
                    return Ok(false);
                };
                if run == 0 {
                    let file = picture_file(&self.args.output, &subject.name, number);
                    write_exr(&file, &picture, &of_run(subject, loaded, seed, &record))?;
                }
                study.scenes[scene].ways[number].runs.push(record);
                study.write(self.path)?;
                self.bar.inc(1);
            }
        }
        Ok(true)
    }

    /// Splits the light of every way by one run more, where that is not done yet; whether nobody interrupted it.
    pub(super) fn split(&self, subject: &Subject, study: &mut Study) -> Result<bool> {
        let Some(scene) = study.scenes.iter().position(|scene| scene.name == subject.name) else {
            return Ok(true);
        };
        for (number, settings) in study.settings.ways.clone().iter().enumerate() {
            if study.scenes[scene].ways[number].layers.is_some() {
                continue;
            }
            self.bar
                .set_message(format!("{}: layers of {}", subject.name, settings.name));
            let mut options = settings.options.clone();
            options.push("--layers".to_owned());
            let loaded = self.args.load(&subject.file, &options, self.registry)?;
            let asked = (study.settings.seed, study.settings.threads, study.settings.seconds);
            match split_run(&loaded.scene, &loaded.plan, asked, self.interrupt)? {
                Some(run) => study.scenes[scene].ways[number].layers = Some(run),
                None => return Ok(false),
            }
            study.write(self.path)?;
        }
        Ok(true)
    }
}

/// The file of the first run's picture by way number `way`.
pub(super) fn picture_file(folder: &Path, scene: &str, way: usize) -> PathBuf {
    folder.join(format!("{scene}-way-{}.exr", way + 1))
}

/// How a run's picture was made.
fn of_run(subject: &Subject, loaded: &Loaded, seed: u64, record: &RunRecord) -> PictureMetadata {
    PictureMetadata {
        scene: subject.name.clone(),
        technique: loaded.plan.technique.name().to_owned(),
        settings: settings(loaded),
        seed,
        steps: record.snapshots.last().map_or(0, |look| look.steps),
        software: concat!("chainlight ", env!("CARGO_PKG_VERSION")).to_owned(),
        ..PictureMetadata::default()
    }
}

impl SceneStudy {
    fn of(subject: &Subject, ways: &[WaySettings], reference: &Reference) -> Self {
        let scene = &subject.ways[0].scene;
        let way = |(way, loaded): (&WaySettings, &Loaded)| WayStudy {
            name: way.name.clone(),
            technique: loaded.plan.technique.name().to_owned(),
            settings: settings(loaded),
            runs: Vec::new(),
            layers: None,
        };
        Self {
            name: subject.name.clone(),
            file: subject.file.display().to_string(),
            size: (scene.width, scene.height),
            reference: reference.record.clone(),
            ways: ways.iter().zip(&subject.ways).map(way).collect(),
        }
    }

    /// Says that the runs in the study at `path` are of this scene and of this reference.
    fn is_of(&self, subject: &Subject, reference: &Reference, path: &Path) -> Result<(), StudyError> {
        let other = |what: String| StudyError::Other {
            path: path.to_owned(),
            what,
        };
        if reference.record != self.reference {
            return Err(other(format!("reference of {}", self.name)));
        }
        if self.ways.len() != subject.ways.len() {
            return Err(other(format!("number of ways in {}: {}", self.name, self.ways.len())));
        }
        for (way, loaded) in self.ways.iter().zip(&subject.ways) {
            if way.settings != settings(loaded) {
                return Err(other(format!("{} in {}: {}", way.name, self.name, way.settings)));
            }
        }
        Ok(())
    }
}
