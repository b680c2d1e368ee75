//! Joining subpaths: a loop of its own behind the trace loop, since a chain offers many segments, and the ray table has room
//! for some per chain.

mod book_connections;
mod join_layers;
mod join_loop;
mod join_paths;
mod offer_connections;
mod subpaths;
mod transmit_connections;

pub use book_connections::book_connections;
pub use join_loop::{JoinCursor, join_loop};
pub use join_paths::join_paths;
pub use offer_connections::offer_connections;
pub use transmit_connections::transmit_connections;
