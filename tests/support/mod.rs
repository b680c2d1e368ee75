//! What tests of different concerns share: draws, cells to count in, verdicts, and small renders.

pub mod cells;
pub mod draws;
pub mod render;
pub mod verdict;
