//! The harness that can refute a mutation.
//!
//! Samples of one chain are correlated, so no test of them says much. The harness uses **weighted starts** instead: it draws
//! x₀ from a known density p (a bootstrap's sample), with the weight w = f(x₀)/p(x₀), takes K steps, and keeps the end. Every
//! replica is a chain of its own, so all are independent, and each test function is judged by a z-test:
//!
//! - **target**: E[w h(x_K)] = E[w h(x₀)] = ∫ f h. The difference is taken replica by replica, and over the last decision
//!   by expectation.
//! - **decided**: given a state and its proposal, whether that is taken is a coin of probability a.
//! - **flow**: E[w a 1_A(x₀) 1_B(y)] = E[w a 1_B(x₀) 1_A(y)]: as much goes from A to B as comes back, since every mutation
//!   satisfies detailed balance by itself.
//! - **density**: proposals weighted by 1/T spread over the mutation's [`Support`](crate::plan::Support) as known draws do.
//!   A constant factor on T cancels in every acceptance, so only this test can see it. Over a region the weights of cells are
//!   judged where a bound on their fourth moment, and the known draws that pilot replicas have there, make sums near normal;
//!   reports say how many cells that leaves.
//!
//! Test functions h are indicators of classes of states (parts of the film, lengths, signatures, octaves of f) and of cells
//! of the coordinates that mutations move.
//!
//! All tests of a report share one significance (Sidak 1967): a mutation that is right fails with that probability. Each says
//! the smallest bias that it could have seen, and where one fails it names a replica that shows it.

mod coordinates;
mod deal;
mod density;
mod error;
mod family;
mod instrument;
mod judge;
mod path_families;
mod replicas;
mod report;
mod run;
mod scene;
mod sheet;
mod stationary;
mod tally;
mod witness;

pub use error::CheckError;
pub use report::{Failures, Report, State, TestKind, TestOutcome, Tested, Witness};
pub use run::{Options, run, run_watched};
pub use scene::built_in_scene;
