//! A check from mutation to report.

use super::CheckError;
use super::deal::deal;
use super::instrument::Instrumented;
use super::judge::{Judged, Unjudged, Verdict, judge};
use super::replicas::{BATCH, Subject};
use super::report::{Report, SHOWN, TestKind, TestOutcome, Tested};
use super::sheet::Sums;
use super::witness::witness;
use super::{density, stationary};
use crate::plan::{AnyMutation, Base, Direct, Plan, Registry, Support, Technique};
use crate::scene::Scene;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::time::Instant;

/// How a check is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Replicas of the target and flow tests; rounded up to whole batches.
    pub replicas: u64,
    /// Proposals that densities over a region are tested with, an eighth of which only say which cells can be judged; rounded
    /// up likewise. For the whole space it is as many as the
    /// replicas of other tests.
    pub density_replicas: u64,
    /// Numbers of steps after which states are looked at, ascending.
    pub steps: Vec<u64>,
    /// Whether the mutation is also tried among all those of its states, each with its own weight.
    pub among_all: bool,
    /// What primary-sample-space chains run over.
    pub base: Base,
    /// Who renders direct light beside chains of whole paths: what is left to the chains is looked at.
    pub direct: Direct,
    /// Samples among which the start of each replica is chosen, of states that are whole paths: the more there are, the more
    /// equally replicas count, and the smaller the biases that so many replicas see.
    pub candidates: u32,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Threads. Reports do not depend on it.
    pub threads: usize,
    /// The probability that any test fails when nothing is wrong.
    pub significance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            replicas: 1 << 17,
            density_replicas: 1 << 18,
            steps: vec![1, 2, 8],
            among_all: false,
            base: Base::default(),
            direct: Direct::Chains,
            candidates: 16,
            seed: 0,
            threads: 1,
            significance: 0.01,
        }
    }
}

impl Options {
    /// The same with twenty times the replicas: biases of a quarter the size show.
    #[must_use]
    pub fn thorough(self) -> Self {
        Self {
            replicas: 20 * self.replicas,
            density_replicas: 20 * self.density_replicas,
            ..self
        }
    }
}

/// Chunks that replicas are dealt in, at most.
const CHUNKS: u32 = 64;
/// Chains of a run have numbers of their own, so that runs are independent of each other.
const CHAINS_OF_RUN: u32 = 1 << 28;

/// Checks the mutation `name` of `registry` in `scene`.
///
/// # Errors
/// No such mutation, or a scene or settings with which it cannot be tried. Failed tests are no errors: see
/// [`Report::passed`].
pub fn run(registry: &Registry, name: &str, scene: &Arc<Scene>, options: &Options) -> Result<Report, CheckError> {
    run_watched(registry, name, scene, options, &AtomicBool::new(false), &|_| {})
}

/// [`run`], telling `progress` the share that is done, and giving up when `interrupt` is set.
///
/// # Errors
/// As [`run`], and if it was interrupted.
pub fn run_watched(
    registry: &Registry,
    name: &str,
    scene: &Arc<Scene>,
    options: &Options,
    interrupt: &AtomicBool,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Report, CheckError> {
    let start = Instant::now();
    let mutation = registry.get(name).map_err(CheckError::Unknown)?;
    let technique = technique_of(&**mutation)?;
    mutation
        .applies(&Plan::new(scene, technique, None).effects)
        .map_err(|reason| CheckError::Inapplicable {
            name: mutation.name(),
            reason,
        })?;
    let check = Check {
        registry,
        mutation,
        technique,
        scene,
        options,
        interrupt,
        progress,
        done: AtomicU32::new(0),
        runs: AtomicU32::new(0),
    };
    let mut runs = check.stationary()?;
    let (density, tested) = check.density()?;
    let (density_replicas, stray) = density
        .as_ref()
        .map_or((0, None), |run| (run.sums.replicas, check.stray(run)));
    runs.extend(density);
    let judged: Vec<Judged<'_>> = runs
        .iter()
        .map(|run| Judged {
            run: &run.name,
            families: &run.subject.families,
            sums: &run.sums,
            fourth_moment: run.fourth_moment,
        })
        .collect();
    let (mut verdicts, unjudged) = judge(&judged, options.significance);
    verdicts.extend(stray.map(|outcome| Verdict {
        chain: runs.last().and_then(|run| run.sums.first_stray).unwrap_or(0),
        run: runs.len() - 1,
        outcome,
    }));
    call_witnesses(&mut verdicts, &runs, options.seed)?;
    let first = &runs[0].sums;
    Ok(Report {
        mutation: mutation.name(),
        settings: mutation.settings(),
        seed: options.seed,
        significance: options.significance,
        replicas: first.replicas,
        steps: options.steps.clone(),
        density_replicas,
        density: tested.counted(&verdicts, unjudged),
        untested: unjudged.rare,
        proposals: first.proposed,
        failed_proposals: first.failed,
        tests: verdicts.into_iter().map(|verdict| verdict.outcome).collect(),
        seconds: start.elapsed().as_secs_f64(),
    })
}

impl Tested {
    /// The same, with how many of a region's cells were judged.
    fn counted(self, verdicts: &[Verdict], unjudged: Unjudged) -> Self {
        let Self::Region { .. } = self else { return self };
        let outcomes = verdicts.iter().map(|verdict| &verdict.outcome);
        let of_density = outcomes.filter(|outcome| outcome.kind == TestKind::Density);
        let (judged, sees) = of_density.fold((0, f64::INFINITY), |(judged, sees), outcome| {
            (judged + 1, sees.min(outcome.sees))
        });
        Self::Region {
            judged,
            cells: judged + unjudged.of_region,
            sees: if judged > 0 { Some(sees) } else { None },
        }
    }
}

/// The technique whose chains move between the mutation's states.
fn technique_of(mutation: &dyn AnyMutation) -> Result<Technique, CheckError> {
    let space = mutation.space();
    let of_space = [Technique::Pssmlt, Technique::Mlt]
        .into_iter()
        .find(|technique| technique.space() == Some(space));
    of_space.ok_or(CheckError::NoTechnique {
        name: mutation.name(),
        space: space.0,
    })
}

/// A run of replicas, done.
struct Run {
    name: String,
    subject: Subject,
    sums: Sums,
    /// See [`Judged`].
    fourth_moment: Option<f64>,
}

/// What a check is made of.
struct Check<'a> {
    registry: &'a Registry,
    mutation: &'a Arc<dyn AnyMutation>,
    technique: Technique,
    scene: &'a Arc<Scene>,
    options: &'a Options,
    interrupt: &'a AtomicBool,
    progress: &'a (dyn Fn(f64) + Sync),
    done: AtomicU32,
    runs: AtomicU32,
}

impl Check<'_> {
    /// The tests of target and flow: with the mutation alone, and where its choice depends on the state, mixed with one
    /// that is independent of it too; and among all mutations, if that is asked for.
    fn stationary(&self) -> Result<Vec<Run>, CheckError> {
        let mut registries = vec![("alone".to_owned(), self.alone()?)];
        if self.mutation.is_selective()
            && let Some(partner) = self.partner()
        {
            let mut mixed = self.alone()?;
            mixed
                .set(&format!("{}:weight=1", partner.name()))
                .map_err(CheckError::Unknown)?;
            registries.push((format!("mixed with {}", partner.name()), mixed));
        }
        if self.options.among_all {
            registries.push(("among all".to_owned(), self.registry.clone()));
        }
        let mut runs = Vec::new();
        for (name, registry) in registries {
            let subject = self.subject(registry, self.scene)?;
            let steps = &self.options.steps;
            let sums = self.deal(
                self.options.replicas,
                || subject.replicas(),
                |replicas, first, batches| stationary::run(replicas, first, batches, steps),
            )?;
            if sums.lit == 0 {
                return Err(CheckError::NoLight { samples: sums.replicas });
            }
            runs.push(Run {
                name,
                subject,
                sums,
                fourth_moment: None,
            });
        }
        Ok(runs)
    }

    /// The tests of the density, as far as the mutation's support allows.
    fn density(&self) -> Result<(Option<Run>, Tested), CheckError> {
        let mut fourth_moment = None;
        let (subject, sums, tested) = match self.mutation.support() {
            None => return Ok((None, Tested::NoSupport)),
            Some(Support::State) => {
                let subject = self.subject(self.alone()?, self.scene)?;
                let sums = self.deal(self.options.replicas, || subject.replicas(), density::run_state)?;
                (subject, sums, Tested::PointMass)
            }
            Some(Support::Space) => {
                let subject = self.subject(self.alone()?, self.scene)?;
                let sums = self.deal(self.options.replicas, || subject.replicas(), density::run_space)?;
                (subject, sums, Tested::Space)
            }
            Some(Support::Region(region)) => {
                let with = |instrumented| -> Result<Subject, CheckError> {
                    let mut registry = self.registry.clone();
                    registry.put(Arc::new(instrumented));
                    let registry = registry.only(self.mutation.name()).map_err(CheckError::Unknown)?;
                    self.subject(registry, self.scene)
                };
                let subject = with(Instrumented::weighed(self.mutation, &region))?;
                let drawn = with(Instrumented::drawn(self.mutation, &region))?;
                let sums = self.deal(
                    self.options.density_replicas,
                    || Ok((subject.replicas()?, drawn.replicas()?)),
                    density::run_region,
                )?;
                fourth_moment = Some(region.fourth_moment);
                (
                    subject,
                    sums,
                    Tested::Region {
                        judged: 0,
                        cells: 0,
                        sees: None,
                    },
                )
            }
        };
        let name = "alone".to_owned();
        let run = Run {
            name,
            subject,
            sums,
            fourth_moment,
        };
        Ok((Some(run), tested))
    }

    /// The test that proposals are where they can be: it needs no significance, since not one may be elsewhere.
    fn stray(&self, run: &Run) -> Option<TestOutcome> {
        let (replicas, strays) = (run.sums.replicas, run.sums.strays);
        let share = strays as f64 / replicas.max(1) as f64;
        let passed = strays == 0;
        (replicas > 0).then(|| TestOutcome {
            kind: TestKind::Support,
            run: run.name.clone(),
            steps: 1,
            name: format!(
                "{strays} of {replicas} proposals where `{}` says none is",
                self.mutation.name()
            ),
            mean: share,
            error: 0.0,
            z: if passed { 0.0 } else { f64::INFINITY },
            p: if passed { 1.0 } else { 0.0 },
            bias: share,
            // So many would be missed with a probability of 5 %.
            sees: 3.0 / replicas as f64,
            passed,
            witness: None,
        })
    }

    fn alone(&self) -> Result<Registry, CheckError> {
        self.registry.only(self.mutation.name()).map_err(CheckError::Unknown)
    }

    /// An independent mutation beside this one.
    fn partner(&self) -> Option<&Arc<dyn AnyMutation>> {
        let here = |m: &&Arc<dyn AnyMutation>| m.space() == self.mutation.space() && m.is_independent();
        self.registry
            .iter()
            .filter(here)
            .find(|m| m.name() != self.mutation.name())
    }

    fn subject(&self, registry: Registry, scene: &Arc<Scene>) -> Result<Subject, CheckError> {
        Subject::new(registry, self.mutation.name(), self.technique, self.options, scene)
    }

    /// Runs `replicas` replicas on all threads, in batches of chains that no other run has.
    fn deal<W>(
        &self,
        replicas: u64,
        build: impl Fn() -> Result<W, CheckError> + Sync,
        work: impl Fn(&mut W, u32, u32) -> Sums + Sync,
    ) -> Result<Sums, CheckError> {
        let base = self.runs.fetch_add(1, Ordering::Relaxed) * CHAINS_OF_RUN;
        let most = u64::from(CHAINS_OF_RUN / BATCH / 2);
        let batches = replicas.div_ceil(u64::from(BATCH)).clamp(1, most) as u32;
        let chunks = batches.min(CHUNKS);
        let per_chunk = batches.div_ceil(chunks);
        let runs = 2 + u32::from(self.mutation.is_selective()) + u32::from(self.options.among_all);
        let expected = CHUNKS * runs;
        let done = || {
            let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
            (self.progress)(f64::from(done) / f64::from(expected.max(done)));
        };
        let sums = deal(
            self.options.threads,
            chunks,
            self.interrupt,
            &done,
            build,
            |workplace, chunk| work(workplace, base + chunk * per_chunk * BATCH, per_chunk),
        )?;
        Ok(Sums::of(sums))
    }
}

/// Runs the replicas again that show the clearest failures of each kind.
fn call_witnesses(verdicts: &mut [Verdict], runs: &[Run], seed: u64) -> Result<(), CheckError> {
    for kind in TestKind::ALL {
        let mut failed: Vec<&mut Verdict> = verdicts
            .iter_mut()
            .filter(|verdict| verdict.outcome.kind == kind && !verdict.outcome.passed)
            .collect();
        failed.sort_by(|a, b| b.outcome.z.abs().total_cmp(&a.outcome.z.abs()));
        for verdict in failed.into_iter().take(SHOWN) {
            let subject = &runs[verdict.run].subject;
            verdict.outcome.witness = Some(witness(subject, verdict.chain, seed, verdict.outcome.steps)?);
        }
    }
    Ok(())
}
