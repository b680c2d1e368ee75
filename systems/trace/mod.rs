//! The trace stage: the one loop in which rays are traced, whoever asked for them.

mod connect_lights;
mod continue_paths;
mod continue_to_stop;
mod depth_first;
pub mod draws;
mod emit_rays;
pub mod ends;
mod extend_paths;
mod intersect_rays;
pub mod join;
mod mutate_depth_first;
mod paths_depth_first;
mod scatter;
mod scatter_models;
mod trace_loop;
mod transmit_segments;

pub use connect_lights::connect_lights;
pub use continue_paths::continue_paths;
pub use continue_to_stop::continue_to_stop;
pub use depth_first::trace_depth_first;
pub use emit_rays::emit_rays;
pub use extend_paths::extend_paths;
pub use intersect_rays::intersect_rays;
pub use join::{book_connections, join_loop, join_paths, offer_connections, transmit_connections};
pub use mutate_depth_first::mutate_depth_first;
pub use paths_depth_first::propose_paths_depth_first;
pub use scatter_models::*;
pub use trace_loop::trace_loop;
pub use transmit_segments::transmit_segments;
