//! What tests of different concerns share: draws, cells to count in, verdicts, scenes, references, and small renders.

pub mod cells;
pub mod chains;
pub mod draws;
pub mod materials;
pub mod reference;
pub mod render;
pub mod rough;
pub mod scenes;
pub mod verdict;
pub mod ways;
