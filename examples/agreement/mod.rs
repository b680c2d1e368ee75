//! Whether techniques make the same picture of a scene: independent runs of each, compared block by block.
//!
//! Runs differ in nothing but their seed, so that their spread is the error of their mean, and nothing is assumed of the noise
//! inside a run. Two techniques are compared by Student's t with Welch's degrees of freedom in every block and channel, and in
//! the mean over all blocks. Of a family of such tests, one in a hundred fails where nothing is wrong (Šidák).

mod contender;
mod family;
mod sight;

pub use contender::{Contender, Pictures, runs};
pub use family::{BlockMeans, compare, statistics};
pub use sight::seen_by_light_tracing;
