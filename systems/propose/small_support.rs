//! Where small steps can lead: uniform draws over the support of [`SmallStep`]'s density, against which that is tested.
//!
//! A proposal has the coordinates that its path asks for. Those that the current state has too are drawn uniformly over
//! what a step can reach; deeper ones are uniform as they always are. So q is 1/V for each shared coordinate, where V is
//! [`Kernel::support_length`].

use super::super::chains::{Keys, MutationLists};
use super::super::tile::TilePlace;
use super::super::trace::draws::CurrentCoordinates;
use super::drawing::{Drawing, Drawn, shared_coordinates};
use super::proposal::Proposals;
use super::small_step::SmallStep;
use crate::chain::{MutationList, SupportDensity};
use crate::path::{ChainTable, FilmCoordinates, PrimaryDepth, PrimaryFilm, ProposedDepth};
use crate::plan::Registered;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::Res;

/// Draws where on the film small steps can lead, uniformly.
pub fn propose_small_supports(
    mutation: Res<Registered<SmallStep>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let kernel = mutation.settings.kernel();
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let current = FilmCoordinates(film.at(chain));
        proposals.start(chain, current.uniform_in_support(&kernel, keys.at(chain)), 0.0);
    }
}

/// Draws the coordinates of new vertices: uniformly over what a small step can reach where the current path has such a
/// vertex, afresh beyond it.
pub fn draw_small_supports(mutation: Res<Registered<SmallStep>>, mut drawing: Drawing) {
    let kernel = mutation.settings.kernel();
    drawing.draw(mutation.number, |current, waiting| {
        current.map_or_else(
            || Drawn::afresh(waiting),
            |from| Drawn::uniform(from.uniform_in_support(&kernel, waiting.key, waiting.depth)),
        )
    });
}

/// Writes the density of these draws at the proposal: 1 over the length that each shared coordinate can reach.
pub fn weigh_small_supports(
    mutation: Res<Registered<SmallStep>>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    current_depths: Read<PrimaryDepth, ChainTable>,
    depths: Read<ProposedDepth, ChainTable>,
    current: CurrentCoordinates,
    mut densities: Write<SupportDensity, ChainTable>,
) {
    let log_length = libm::log(mutation.settings.kernel().support_length());
    let set = current.columns().set();
    let (list, current_depths, depths, densities) =
        (list.rows(), current_depths.rows(), depths.rows(), densities.rows());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let count = shared_coordinates(&place, chain, set, current_depths, depths);
        densities.put(chain, -log_length * f64::from(count));
    }
}
