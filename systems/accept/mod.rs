//! The accept stage: one decision for every chain.

mod accept_always;
mod accept_lists;
mod count_visits;
mod decide;
mod take_coordinates;
mod take_paths;

pub use accept_always::accept_always;
pub use accept_lists::accept_lists;
pub use count_visits::count_visits;
pub use decide::decide;
pub use take_coordinates::take_coordinates;
pub use take_paths::take_paths;
