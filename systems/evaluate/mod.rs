//! The evaluate stage: what proposals contribute.

mod gather_contribution;

pub use gather_contribution::gather_contribution;
