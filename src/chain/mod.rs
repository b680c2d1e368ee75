//! Chains: the mathematics of Markov chain Monte Carlo, as pure functions over values.
//!
//! A chain stands at a state x and is offered a proposal y, drawn with the transition density T(x→y). [`metropolis`] says
//! with what probability it moves, so that it visits states in proportion to the target function f. Where chains start
//! is drawn by [`resample()`] from a bootstrap, whose mean weight is the [`Normalization`]. [`Kernel`] perturbs the
//! coordinates of primary sample space.

mod acceptance;
mod booking;
mod columns;
mod known;
mod normalization;
mod primary;
mod resample;
mod state;

pub use acceptance::{Decision, Reason, metropolis};
pub use booking::{Booking, decide_with};
pub use columns::*;
pub use known::KnownDraws;
pub use normalization::Normalization;
pub use primary::{Kernel, KernelError, LEAST_STEP, Steps, to_f32, to_f64};
pub use resample::{distinct, resample};
pub use state::{Signature, StateClass};
