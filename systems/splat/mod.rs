//! The splat stage: what was booked goes to the film.

mod list_layers;
mod sample_layers;
mod splat_lists;
mod splat_samples;
mod splat_states;
mod take_splats;

pub use list_layers::{splat_list_layers, splat_state_layers, take_layers};
pub use sample_layers::splat_sample_layers;
pub use splat_lists::splat_lists;
pub use splat_samples::splat_samples;
pub use splat_states::splat_states;
pub use take_splats::take_splats;
