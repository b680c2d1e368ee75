//! Mutations of whole paths, and what they share.

mod bidirectional;
mod new_path;
pub mod range;
mod start_paths;
pub mod weighing;

pub use bidirectional::{Bidirectional, propose_bidirectional, weigh_bidirectional};
pub use new_path::{NewPath, propose_new_paths, weigh_new_paths};
pub use start_paths::{end_vertex, make_room, start_paths};
