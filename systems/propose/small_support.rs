//! Where small steps can lead: draws of known density over the support of [`SmallStep`]'s, against which that is tested.

use super::super::chains::{Keys, MutationLists};
use super::drawing::{Drawing, Drawn};
use super::known::KnownDensities;
use super::proposal::Proposals;
use super::small_step::SmallStep;
use crate::chain::{KnownDraws, MutationList};
use crate::path::{ChainTable, FilmCoordinates, PrimaryFilm};
use crate::plan::Registered;
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;

/// Draws where on the film small steps can lead, with a known density.
pub fn propose_small_supports(
    mutation: Res<Registered<SmallStep>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let known = KnownDraws::about(mutation.settings.kernel());
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let current = FilmCoordinates(film.at(chain));
        proposals.start(chain, current.known(&known, keys.at(chain)), 0.0);
    }
}

/// Draws the coordinates of new vertices: with a known density over what a small step can reach where the current path has
/// such a vertex, afresh beyond it.
pub fn draw_small_supports(mutation: Res<Registered<SmallStep>>, mut drawing: Drawing) {
    let known = KnownDraws::about(mutation.settings.kernel());
    drawing.draw(mutation.number, |current, waiting| {
        current.map_or_else(
            || Drawn::afresh(waiting),
            |from| Drawn::uniform(from.known(&known, waiting.key, waiting.depth)),
        )
    });
}

/// Writes the density of these draws at the proposal.
pub fn weigh_small_supports(mutation: Res<Registered<SmallStep>>, mut densities: KnownDensities) {
    let known = KnownDraws::about(mutation.settings.kernel());
    densities.weigh(mutation.number, &known);
}
