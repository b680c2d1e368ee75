//! The splat stage: what was booked goes to the film.

mod splat_samples;

pub use splat_samples::splat_samples;
