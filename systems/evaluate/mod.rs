//! The evaluate stage: what proposals contribute.

mod evaluate_lists;
mod evaluate_paths;
mod evaluate_targets;
mod gather_contribution;
mod split_layers;
mod tally_independent;
mod weigh_choices;

pub use evaluate_lists::evaluate_lists;
pub use evaluate_paths::{Found, FoundColumns, FoundPath, evaluate_paths};
pub use evaluate_targets::evaluate_targets;
pub(super) use evaluate_targets::normalized;
pub(super) use gather_contribution::Brightest;
pub use gather_contribution::gather_contribution;
pub use split_layers::split_layers;
pub use tally_independent::tally_independent;
pub use weigh_choices::weigh_choices;
