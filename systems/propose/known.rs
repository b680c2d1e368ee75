//! The density of known draws about the current state, at proposals: what densities of small steps are tested against.
//!
//! A proposal has the coordinates that its path asks for. Those that the current state has too are drawn about its own, see
//! [`KnownDraws`]; deeper ones are uniform as they always are. So q is the product over the coordinates that both have.

use super::super::chains::MutationLists;
use super::super::tile::TilePlace;
use super::super::trace::draws::{CurrentCoordinates, ProposedCoordinates};
use crate::chain::{KnownDraws, MutationList, SupportDensity};
use crate::path::{ChainTable, FilmCoordinates, PrimaryDepth, PrimaryFilm, ProposedDepth, ProposedFilm};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, SystemParam};

/// The coordinates of states and proposals, and where q is written to.
#[derive(SystemParam)]
pub struct KnownDensities<'w, 's> {
    place: Res<'w, TilePlace>,
    lists: Res<'w, MutationLists>,
    list: Read<'w, 's, MutationList, ChainTable>,
    film: Read<'w, 's, PrimaryFilm, ChainTable>,
    proposed_film: Read<'w, 's, ProposedFilm, ChainTable>,
    current_depths: Read<'w, 's, PrimaryDepth, ChainTable>,
    depths: Read<'w, 's, ProposedDepth, ChainTable>,
    current: CurrentCoordinates<'w, 's>,
    proposed: ProposedCoordinates<'w, 's>,
    densities: Write<'w, 's, SupportDensity, ChainTable>,
}

impl KnownDensities<'_, '_> {
    /// Writes ln q of the proposals of mutation `number`.
    pub fn weigh(&mut self, number: usize, known: &KnownDraws) {
        let place = &*self.place;
        let (list, densities) = (self.list.rows(), self.densities.rows());
        let (film, proposed_film) = (self.film.rows(), self.proposed_film.rows());
        let (current_depths, depths) = (self.current_depths.rows(), self.depths.rows());
        let (current, proposed) = (self.current.columns(), self.proposed.columns());
        let set = current.set();
        for entry in self.lists.entries(number) {
            let chain = list.at(entry) as usize;
            let mut sum = FilmCoordinates(film.at(chain)).log_known(known, FilmCoordinates(proposed_film.at(chain)));
            for path in place.subpaths(chain) {
                let shared = current_depths.at(path).min(depths.at(path));
                for depth in place.first_coordinate..=shared {
                    let vertex = place.coordinate(path, depth);
                    let keyed = place.stream_depth(path, depth);
                    sum += current.at(vertex).log_known(known, proposed.at(vertex), keyed, set);
                }
            }
            densities.put(chain, sum);
        }
    }
}
