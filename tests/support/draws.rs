//! Random numbers for tests: one independent stream per case, the same in every run.

use chainlight::sampling::{Purpose, Stream, StreamKey};

/// The seed of every test that does not test seeds.
const SEED: u64 = 0x5EED_CA5E;

/// The stream of case `case`. Cases of different files may share a stream: what they draw from it is not compared.
pub fn stream(case: usize) -> Stream {
    StreamKey::new(SEED, case as u32, 0).stream(Purpose::SCATTER, 0)
}
