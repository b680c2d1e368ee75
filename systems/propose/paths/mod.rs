//! Mutations of whole paths, and what they share.

mod bidirectional;
mod caustic;
mod film_jump;
mod lens;
mod lens_subpath;
mod multi_chain;
mod new_path;
pub mod range;
mod start_paths;
mod steering;
pub mod weighing;

pub use bidirectional::{Bidirectional, propose_bidirectional, weigh_bidirectional};
pub use caustic::{CausticPerturbation, propose_caustics, steer_caustics, weigh_caustics};
pub use lens::{LensPerturbation, propose_lens, steer_lens, weigh_lens};
pub use lens_subpath::{LensSubpath, propose_lens_subpaths, weigh_lens_subpaths};
pub use multi_chain::{MultiChainPerturbation, propose_multi_chain, steer_multi_chain, weigh_multi_chain};
pub use new_path::{NewPath, propose_new_paths, weigh_new_paths};
pub use start_paths::{end_vertex, make_room, start_paths};
