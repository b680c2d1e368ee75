//! The propose stage: what each chain tries next. A mutation is one file here.

mod assign_pixels;
mod choose_mutation;
pub mod drawing;
pub mod identity;
mod key_chains;
pub mod known;
pub mod large_step;
mod list_starts;
pub mod paths;
pub mod proposal;
pub mod small_step;
mod small_support;
mod start_camera_paths;
mod start_light_paths;
pub mod starts;

pub use assign_pixels::assign_pixels;
pub use choose_mutation::choose_mutation;
pub use identity::{Identity, draw_identities, propose_identities};
pub use key_chains::key_chains;
pub use large_step::{LargeStep, draw_large_steps, propose_large_steps};
pub use list_starts::list_starts;
pub use paths::*;
pub use small_step::{SmallStep, draw_small_steps, propose_small_steps};
pub use small_support::{draw_small_supports, propose_small_supports, weigh_small_supports};
pub use start_camera_paths::start_camera_paths;
pub use start_light_paths::start_light_paths;

use crate::plan::Registry;

/// The list of mutations: registering one is a line here, or in the program that brings its own.
#[must_use]
pub fn mutations() -> Registry {
    Registry::empty()
        .with(LargeStep::default())
        .with(SmallStep::default())
        .with(Identity::default())
        .with(NewPath::default())
        .with(Bidirectional::default())
        .with(LensPerturbation::default())
        .with(LensSubpath::default())
        .with(CausticPerturbation::default())
        .with(MultiChainPerturbation::default())
}
