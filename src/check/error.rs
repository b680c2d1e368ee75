//! Why a mutation cannot be checked.

use crate::film::FilmError;
use crate::plan::ChainPlanError;

/// Why a mutation cannot be checked.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum CheckError {
    /// No such mutation; says which there are.
    #[error("{0}")]
    Unknown(String),
    /// No technique has chains whose states are of this kind.
    #[error("`{name}` moves between {space} states, and no technique has chains of such")]
    NoTechnique {
        /// The mutation.
        name: &'static str,
        /// Its state space.
        space: &'static str,
    },
    /// The scene gives the mutation nothing to do.
    #[error("`{name}` cannot be used in this scene: {reason}")]
    #[diagnostic(help("give a scene in which it can, with --scene"))]
    Inapplicable {
        /// The mutation.
        name: &'static str,
        /// Why.
        reason: &'static str,
    },
    /// Chains cannot be planned.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plan(#[from] ChainPlanError),
    /// A film cannot be made.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Film(#[from] FilmError),
    /// The operating system refused threads.
    #[error("cannot start {threads} threads: {source}")]
    #[diagnostic(help("ask for fewer with --threads"))]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// There is nothing to sample.
    #[error("no light reaches the film: of {samples} samples none has any")]
    #[diagnostic(help("check mutations in a scene with light that is easy to find"))]
    NoLight {
        /// Samples that were drawn.
        samples: u64,
    },
    /// Somebody stopped it.
    #[error("interrupted before all replicas were run")]
    Interrupted,
}
