//! The splat stage: what was booked goes to the film.

mod splat_lists;
mod splat_samples;
mod splat_states;
mod take_splats;

pub use splat_lists::splat_lists;
pub use splat_samples::splat_samples;
pub use splat_states::splat_states;
pub use take_splats::take_splats;
