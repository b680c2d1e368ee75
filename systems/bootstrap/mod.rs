//! The bootstrap: independent proposals of every chain, drawn and evaluated by the same systems as steps, so that what is
//! resampled for seeds is exactly what is drawn again.

mod key_samples;
mod start_independent;
mod weigh_samples;

pub use key_samples::key_samples;
pub use start_independent::start_independent;
pub use weigh_samples::weigh_samples;
