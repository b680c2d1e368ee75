//! What perturbations share that begin on the film: another place there, near the current one, and the ray through it.

use super::super::super::chains::{Keys, MutationLists};
use super::super::super::tile::{SceneRef, TilePlace};
use super::range::{PathRange, Ranges};
use super::weighing::Way;
use crate::chain::MutationList;
use crate::path::whole::*;
use crate::path::{ChainTable, Direction, VERTEX_DISCRETE, VertexKind, VertexPosition, pixel_of};
use crate::sampling::Purpose;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, SystemParam};

/// The distances on the film, in pixels, from `smallest` to the radius of a disc that covers this share of the film.
#[must_use]
pub fn film_sizes(scene: &Scene, smallest: f32, covered: f32) -> Sizes {
    let area = f64::from(covered) * f64::from(scene.width) * f64::from(scene.height);
    Sizes {
        smallest: f64::from(smallest),
        // On films of a few pixels too there is a range.
        largest: libm::sqrt(area / std::f64::consts::PI).max(2.0 * f64::from(smallest)),
    }
}

/// Says what is wrong with the settings of [`film_sizes`].
///
/// # Errors
/// The setting, what was expected, and what it is.
pub fn check_film_sizes(smallest: f32, covered: f32) -> Result<(), String> {
    if !(smallest > 0.0 && smallest <= 1e3) {
        return Err(format!(
            "`smallest` is a number of pixels above 0, up to 1000, not {smallest}"
        ));
    }
    if !(covered > 0.0 && covered <= 1.0) {
        return Err(format!(
            "`covered` is a share of the film, above 0, up to 1, not {covered}"
        ));
    }
    Ok(())
}

/// Current paths, and what is written of proposals that begin on the film.
#[derive(SystemParam)]
pub struct FilmJumps<'w, 's> {
    scene: Res<'w, SceneRef>,
    place: Res<'w, TilePlace>,
    lists: Res<'w, MutationLists>,
    list: Read<'w, 's, MutationList, ChainTable>,
    keys: Keys<'w, 's>,
    edges: Read<'w, 's, PathEdges, ChainTable>,
    film: Read<'w, 's, PathFilm, ChainTable>,
    kinds: Read<'w, 's, VertexKind, PathTable>,
    positions: Read<'w, 's, VertexPosition, PathTable>,
    ranges: Ranges<'w, 's>,
    directions: Write<'w, 's, Direction, ChainTable>,
    proposed_film: Write<'w, 's, ProposedPathFilm, ChainTable>,
}

impl FilmJumps<'_, '_> {
    /// Proposes, for every chain that tries mutation number `number`, the path that begins through a place on the film as far from
    /// the current one as a size says, and is joined to what the current path's first two neighbours that can be joined are.
    pub fn propose(&mut self, number: usize, sizes: Sizes) {
        let (scene, place) = (&*self.scene.0, &*self.place);
        let (list, keys, edges, film) = (
            self.list.rows(),
            self.keys.columns(),
            self.edges.rows(),
            self.film.rows(),
        );
        let (kinds, positions) = (self.kinds.rows(), self.positions.rows());
        let (directions, proposed_film) = (self.directions.rows(), self.proposed_film.rows());
        for chain in self.lists.entries(number).map(|entry| list.at(entry) as usize) {
            let k = edges.at(chain);
            let mut stream = keys.at(chain).stream(Purpose::PERTURB_LENS, 0);
            let moved = jump(film.at(chain), sizes.sample(stream.next_f64()), stream.next_f64());
            if k == 0 || pixel_of(scene, moved, 0.5).is_none() {
                self.ranges.none(chain);
                continue;
            }
            let is_discrete = |i| kinds.at(place.path_vertex(chain, i)) == VERTEX_DISCRETE;
            let t = camera_vertices(k as usize, is_discrete) as u32;
            let lens = positions.at(place.path_vertex(chain, 0));
            directions.put(chain, scene.camera.ray_from(lens, moved).direction);
            proposed_film.put(chain, moved);
            let s = k + 1 - t;
            let range = PathRange {
                kept: [1, s],
                made: [t, s],
                steered: [true, false],
            };
            self.ranges.put(place, chain, range);
        }
    }
}

/// T / r of these proposals. The place on the film, and every direction that is drawn about another, has a density that is the same
/// both ways. They stand in for the densities of bidirectional path tracing, as does the certainty of discrete lobes.
#[must_use]
pub fn film_jump_density(way: &Way<'_>) -> f64 {
    let t = way.made;
    let steered: f64 = (1..t - 1).map(|i| way.to.onward(i)).product();
    let kept_light = if way.kept[1] == 1 { way.to.kept_light } else { 1.0 };
    way.to.share(t) * kept_light / (steered * f64::from(way.to.filter))
}
