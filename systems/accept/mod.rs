//! The accept stage: one decision for every chain.

mod accept_always;

pub use accept_always::accept_always;
