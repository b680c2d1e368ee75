//! Primary coordinates of accepted proposals.

use super::super::tile::{Queues, TilePlace};
use super::super::trace::draws::{CoordinatesMut, ProposedCoordinates};
use crate::chain::AcceptedList;
use crate::path::{ChainTable, PrimaryDepth, PrimaryFilm, PrimaryTable, ProposedDepth, ProposedFilm};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::Res;

/// Makes the coordinates of every accepted proposal those of the current state, down to where its path ended.
pub fn take_coordinates(
    place: Res<TilePlace>,
    queues: Res<Queues>,
    accepted: Read<AcceptedList, ChainTable>,
    film: Read<ProposedFilm, ChainTable>,
    proposed_depths: Read<ProposedDepth, ChainTable>,
    proposed: ProposedCoordinates,
    mut current_film: Write<PrimaryFilm, ChainTable>,
    mut depths: Write<PrimaryDepth, ChainTable>,
    mut current: CoordinatesMut<PrimaryTable>,
) {
    let (accepted, film, proposed_depths) = (accepted.rows(), film.rows(), proposed_depths.rows());
    let (current_film, depths) = (current_film.rows(), depths.rows());
    let (proposed, mut current) = (proposed.columns(), current.columns());
    for entry in 0..queues.accepted {
        let chain = accepted.at(entry) as usize;
        current_film.put(chain, film.at(chain));
        for path in place.subpaths(chain) {
            let depth = proposed_depths.at(path);
            depths.put(path, depth);
            for vertex in (place.first_coordinate..depth + 1).map(|d| place.coordinate(path, d)) {
                current.put(vertex, proposed.at(vertex));
            }
        }
    }
}
