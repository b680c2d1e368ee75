//! Chains that walk the space of paths, on cases that are known to be hard.

mod colours;
mod corridor;
mod depth_first;
mod film_edges;
mod measured_again;
mod mixed;
mod needle;
mod roulette;
mod same_seed;
mod scale;
mod two_rooms;

use crate::support::chains::Chains;
use chainlight::plan::{Direct, Technique};

/// Chains in path space that look for direct light too: `groups` groups of `chains`, each group with a bootstrap of `bootstrap`
/// samples.
fn paths(groups: u32, chains: u32, bootstrap: u32) -> Chains {
    let mut paths = Chains {
        technique: Technique::Mlt,
        ..Chains::new(groups, chains, bootstrap)
    };
    paths.options.direct = Some(Direct::Chains);
    paths
}
