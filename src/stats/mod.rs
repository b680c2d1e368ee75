//! Statistics: is it right, and how wrong is it.

pub mod chi_square;
pub mod metrics;
pub mod normal;
pub mod z_test;
