//! One step of one chain, alone, looked at closely: the state before, what was proposed and how likely that was, the
//! decision and what it rests on, the state after.
//!
//! It shows what the render did, bit for bit: random numbers are keyed by seed, chain and step, so the chain needs no others
//! beside it, but for the bootstrap of its group, which found the sample that it starts from. That bootstrap and all steps
//! before are run again.

mod number;
mod path;
mod proposal;
mod state;

pub use number::{Number, number};
pub use path::{Surface, Vertex};
pub use proposal::{Chosen, Densities, Proposal, Verdict};
pub use state::{Classes, Coordinates, FilmStart, SplatAt, State};

use crate::plan::{Plan, Technique};
use crate::render::{LoneChain, LoneStart, RenderError};
use crate::scene::Scene;
use serde::Serialize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// One step of one chain, or one sample of one pixel.
#[derive(Clone, Debug, Serialize)]
pub struct Replay {
    /// The technique.
    pub technique: &'static str,
    /// The seed of all random numbers.
    pub seed: u64,
    /// Number of the chain; of the pixel, where samples are independent.
    pub chain: u32,
    /// Number of the step; of the sample.
    pub step: u64,
    /// The chain's group, and how it started; none where samples are independent, as for all that follows but the proposal.
    pub group: Option<Group>,
    /// The state before the step.
    pub before: Option<State>,
    /// The mutation that was tried.
    pub mutation: Option<Chosen>,
    /// What was proposed.
    pub proposal: Proposal,
    /// The decision.
    pub decision: Option<Verdict>,
    /// The state after the step.
    pub after: Option<State>,
}

/// A group of chains, and how one of them started.
#[derive(Clone, Debug, Serialize)]
pub struct Group {
    /// Number of the group.
    pub number: u32,
    /// Global number of its first chain.
    pub first_chain: u32,
    /// Its chains.
    pub chains: u32,
    /// Its normalization b.
    pub b: f64,
    /// The standard error of b.
    #[serde(serialize_with = "number")]
    pub b_error: f64,
    /// Samples of its bootstrap.
    pub samples: u64,
    /// The sample that the chain started from; none where no sample has any light.
    pub started_from: Option<Sample>,
}

/// A sample of a bootstrap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Sample {
    /// The chain that drew it, by its global number.
    pub chain: u32,
    /// In which round.
    pub round: u64,
}

/// Which step of which chain of a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    /// The render's seed.
    pub seed: u64,
    /// Global number of the chain; of the pixel, where samples are independent.
    pub chain: u32,
    /// The step, counted from 0; the sample.
    pub step: u64,
}

/// Which part of a replay is under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The bootstrap of the chain's group.
    Bootstrap,
    /// The steps before the one that is asked for.
    Steps,
}

/// Why there is nothing to show.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReplayError {
    /// No such chain, no threads, or an interruption.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Render(#[from] RenderError),
    /// The technique leaves no path behind.
    #[error("techniques that run depth first leave no path behind to look at")]
    #[diagnostic(help("replay pt, or pssmlt: with the same seed they draw the same paths, bit for bit"))]
    NoTables,
    /// Steps are counted in 63 bits; the highest bit marks the bootstrap's random numbers.
    #[error("there is no step {step}: steps are 0 to {}", LAST_STEP)]
    #[diagnostic(help("give the number of a step that the render has taken"))]
    NoSuchStep {
        /// The step that was asked for.
        step: u64,
    },
}

/// The last step that random numbers can be keyed by.
const LAST_STEP: u64 = (1 << 63) - 1;

/// Steps between two looks at the interruption.
const STEPS_AT_ONCE: u64 = 256;

/// Replays a moment of the render of `scene` by `plan`: bootstraps the chain's group on `threads` threads, steps the chain
/// until then, and looks at the step. Independent samples need neither. `progress` hears which part is under way and what
/// share of it is done; once `interrupt` is set, the replay gives up.
///
/// # Errors
/// A chain or step that there is not, a technique without tables, or an interruption.
pub fn replay(
    scene: &Arc<Scene>,
    plan: &Plan,
    moment: Moment,
    threads: usize,
    interrupt: &AtomicBool,
    progress: &(dyn Fn(Part, f64) + Sync),
) -> Result<Replay, ReplayError> {
    let Moment { seed, chain, step } = moment;
    if matches!(
        plan.technique,
        Technique::PtReference | Technique::PssmltReference | Technique::MltReference
    ) {
        return Err(ReplayError::NoTables);
    }
    if step > LAST_STEP {
        return Err(ReplayError::NoSuchStep { step });
    }
    let bootstrap = |share| progress(Part::Bootstrap, share);
    let mut lone = LoneChain::new(scene, plan, seed, chain, threads, interrupt, &bootstrap)?;
    if lone.start().is_some() {
        for earlier in 0..step {
            if earlier % STEPS_AT_ONCE == 0 {
                if interrupt.load(Ordering::Relaxed) {
                    return Err(RenderError::Interrupted.into());
                }
                progress(Part::Steps, earlier as f64 / step as f64);
            }
            lone.step(earlier);
        }
        progress(Part::Steps, 1.0);
    }
    let before = state::current(&mut lone.world, scene, &lone.blocks);
    lone.step(step);
    let after = state::current(&mut lone.world, scene, &lone.blocks);
    let mutation = before
        .as_ref()
        .and_then(|before| proposal::chosen(&mut lone, plan, before));
    let proposal = proposal::proposal(&mut lone, scene, plan, mutation.as_ref());
    let decision = before
        .as_ref()
        .zip(after.as_ref())
        .and_then(|(before, after)| proposal::verdict(&mut lone, before, after));
    Ok(Replay {
        technique: plan.technique.name(),
        seed,
        chain,
        step,
        group: lone.start().map(group),
        before,
        mutation,
        proposal,
        decision,
        after,
    })
}

fn group(start: &LoneStart) -> Group {
    let first_chain = start.group * start.chains_per_group;
    let normalization = start.start.normalization;
    Group {
        number: start.group,
        first_chain,
        chains: start.chains_per_group,
        b: normalization.b,
        b_error: normalization.standard_error,
        samples: normalization.samples,
        started_from: start.sample.map(|(chain, round)| Sample {
            chain: first_chain + chain,
            round,
        }),
    }
}
