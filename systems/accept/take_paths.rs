//! Paths of accepted proposals.

use super::super::paths::{Vertices, VerticesMut};
use super::super::tile::{Queues, TilePlace};
use crate::chain::AcceptedList;
use crate::path::whole::*;
use crate::path::{ChainTable, FilmPixel};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, SystemParam};

/// Proposed paths.
#[derive(SystemParam)]
pub struct Proposed<'w, 's> {
    edges: Read<'w, 's, ProposedEdges, ChainTable>,
    lights: Read<'w, 's, ProposedLight, ChainTable>,
    pixels: Read<'w, 's, FilmPixel, ChainTable>,
    film: Read<'w, 's, ProposedPathFilm, ChainTable>,
    filters: Read<'w, 's, ProposedFilter, ChainTable>,
    kept_lights: Read<'w, 's, ProposedKeptLight, ChainTable>,
    vertices: Vertices<'w, 's, ProposedPathTable>,
    shares: Read<'w, 's, PathShare, ProposedPathTable>,
    onwards: Read<'w, 's, PathOnward, ProposedPathTable>,
    backs: Read<'w, 's, PathBack, ProposedPathTable>,
}

/// Current paths.
#[derive(SystemParam)]
pub struct Current<'w, 's> {
    edges: Write<'w, 's, PathEdges, ChainTable>,
    lights: Write<'w, 's, PathLight, ChainTable>,
    pixels: Write<'w, 's, PathPixel, ChainTable>,
    film: Write<'w, 's, PathFilm, ChainTable>,
    filters: Write<'w, 's, PathFilter, ChainTable>,
    kept_lights: Write<'w, 's, PathKeptLight, ChainTable>,
    vertices: VerticesMut<'w, 's, PathTable>,
    shares: Write<'w, 's, PathShare, PathTable>,
    onwards: Write<'w, 's, PathOnward, PathTable>,
    backs: Write<'w, 's, PathBack, PathTable>,
}

/// Makes every accepted proposal's path the current one.
pub fn take_paths(
    place: Res<TilePlace>,
    queues: Res<Queues>,
    accepted: Read<AcceptedList, ChainTable>,
    proposed: Proposed,
    mut current: Current,
) {
    let accepted = accepted.rows();
    let (edges, lights, pixels) = (proposed.edges.rows(), proposed.lights.rows(), proposed.pixels.rows());
    let (film, filters, kept_lights) = (
        proposed.film.rows(),
        proposed.filters.rows(),
        proposed.kept_lights.rows(),
    );
    let (to_edges, to_lights, to_pixels) = (current.edges.rows(), current.lights.rows(), current.pixels.rows());
    let (to_film, to_filters, to_kept_lights) =
        (current.film.rows(), current.filters.rows(), current.kept_lights.rows());
    let vertices = proposed.vertices.columns();
    let (shares, onwards, backs) = (proposed.shares.rows(), proposed.onwards.rows(), proposed.backs.rows());
    let mut to_vertices = current.vertices.columns();
    let (to_shares, to_onwards, to_backs) = (current.shares.rows(), current.onwards.rows(), current.backs.rows());
    for chain in (0..queues.accepted).map(|entry| accepted.at(entry) as usize) {
        let length = edges.at(chain);
        to_edges.put(chain, length);
        to_lights.put(chain, lights.at(chain));
        to_pixels.put(chain, pixels.at(chain));
        to_film.put(chain, film.at(chain));
        to_filters.put(chain, filters.at(chain));
        to_kept_lights.put(chain, kept_lights.at(chain));
        for row in (0..=length as usize).map(|depth| place.path_vertex(chain, depth)) {
            to_vertices.put(row, &vertices.at(row));
            to_shares.put(row, shares.at(row));
            to_onwards.put(row, onwards.at(row));
            to_backs.put(row, backs.at(row));
        }
    }
}
