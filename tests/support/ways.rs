//! The ways to trace rays.

use chainlight::geometry::{Instructions, Tracer};

/// All ways to trace on this machine. Those without a tree come first.
pub fn ways() -> Vec<(Tracer, Instructions)> {
    let here = || {
        Instructions::ALL
            .into_iter()
            .filter(|instructions| instructions.are_here())
    };
    let tracers = [
        Tracer::All,
        Tracer::OneByOne,
        Tracer::Interleaved(1),
        Tracer::Interleaved(7),
        Tracer::Interleaved(64),
    ];
    tracers
        .into_iter()
        .flat_map(|tracer| here().map(move |instructions| (tracer, instructions)))
        .collect()
}
