//! Random numbers for the tests of statistics.

use crate::sampling::{Purpose, Stream, StreamKey};
use std::f64::consts::TAU;

/// A source of random numbers.
pub(super) struct Source {
    stream: Stream,
    spare: Option<f64>,
}

impl Source {
    /// The source with this seed.
    pub(super) fn new(seed: u64) -> Self {
        Self {
            stream: StreamKey::new(seed, 0, 0).stream(Purpose::SCATTER, 0),
            spare: None,
        }
    }

    /// Uniform in [0, 1).
    pub(super) fn uniform(&mut self) -> f64 {
        self.stream.next_f64()
    }

    /// Standard normal (Box and Muller 1958).
    pub(super) fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let radius = (-2.0 * libm::log(1.0 - self.uniform())).sqrt();
        let angle = TAU * self.uniform();
        self.spare = Some(radius * libm::sin(angle));
        radius * libm::cos(angle)
    }

    /// One normal number of mean zero for each of the variances.
    pub(super) fn normals(&mut self, variances: &[f64]) -> Vec<f64> {
        variances.iter().map(|v| v.sqrt() * self.normal()).collect()
    }
}
