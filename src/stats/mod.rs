//! Statistics: is it right, and how wrong is it.

pub mod agreement;
pub mod chi_square;
pub mod comparison;
pub mod components;
pub mod effective_samples;
pub mod error;
pub mod fisher;
pub mod flip;
pub mod group_means;
pub mod metrics;
pub mod normal;
pub mod stopping;
pub mod student;
pub mod z_test;

#[cfg(test)]
mod synthetic;
