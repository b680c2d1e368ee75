//! Mutations of whole paths, one file each, and what they share.

mod bidirectional;
mod caustic;
pub mod film_jump;
mod lens;
mod lens_subpath;
pub mod moved;
pub mod moves_paths;
mod multi_chain;
mod new_path;
mod range;
mod start_paths;
pub mod steering;
pub mod view;

pub use bidirectional::Bidirectional;
pub use caustic::CausticPerturbation;
pub use lens::LensPerturbation;
pub use lens_subpath::LensSubpath;
pub use moves_paths::{MovesPaths, PathProposal, SteeredLight, Way};
pub use multi_chain::MultiChainPerturbation;
pub use new_path::NewPath;
pub use start_paths::{make_room, start_paths};
pub use view::PathView;
