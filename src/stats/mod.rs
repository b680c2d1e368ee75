//! Statistics: is it right, and how wrong is it.

pub mod chi_square;
pub mod components;
pub mod error;
pub mod fisher;
pub mod group_means;
pub mod metrics;
pub mod normal;
pub mod student;
pub mod z_test;

#[cfg(test)]
mod synthetic;
