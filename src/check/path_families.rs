//! Families of whole paths: where they are seen, what they end on, and the quantities that densities of mutations are made of. A
//! factor that is forgotten, or counted twice, moves states between the cells of its own size.

use super::family::{Cell, Family, NOWHERE, Side, cell};
use crate::path::whole::{
    PathEdges, PathFilm, PathLight, PathShare, PathTable, ProposedEdges, ProposedLight, ProposedPathFilm,
    ProposedPathTable, camera_vertices,
};
use crate::path::{ChainTable, VERTEX_DISCRETE, VERTEX_INFINITE, VertexKind, VertexPosition};
use crate::plan::TilePlan;
use crate::render::TileWorld;
use crate::scene::Scene;
use crate::systems::tile::{SceneRef, TilePlace};
use crate::table::Column;
use glam::Vec2;

/// Octaves of a share, from 1 down.
const SHARE_OCTAVES: usize = 12;
/// Octaves of a length, from that of the scene's diameter down.
const LENGTH_OCTAVES: usize = 12;
/// Cells along a side of the film.
const SIDE: usize = 8;
/// Lights that are told apart.
const LIGHTS: usize = 16;

/// The families of whole paths; none for other state spaces.
pub(super) fn families(plan: &TilePlan, scene: &Scene) -> Vec<Family> {
    if !plan.tables.iter().any(|table| table.has::<PathShare>()) {
        return Vec::new();
    }
    vec![
        seen(scene),
        lights(),
        shares("the strategy that joins the first edge it can", |path| {
            Some(path.camera_vertices())
        }),
        shares("the strategy that the lens sees", |_| Some(1)),
        joined_edges(),
    ]
}

/// Paths of all chains, as far as families ask.
struct Paths {
    place: TilePlace,
    edges: Vec<u32>,
    kinds: Vec<u32>,
}

/// One of them.
struct Path<'a> {
    paths: &'a Paths,
    chain: usize,
}

impl Paths {
    fn look(world: &mut TileWorld, side: Side, chains: usize) -> Self {
        let mut edges = vec![0; chains];
        match side {
            Side::Current => world.read::<PathEdges, ChainTable>(&mut edges),
            Side::Proposed => world.read::<ProposedEdges, ChainTable>(&mut edges),
        }
        Self {
            place: *world.world().resource::<TilePlace>(),
            edges,
            kinds: vertices::<VertexKind>(world, side),
        }
    }
}

impl Path<'_> {
    fn row(&self, i: usize) -> usize {
        self.paths.place.path_vertex(self.chain, i)
    }

    fn camera_vertices(&self) -> usize {
        let k = self.paths.edges[self.chain] as usize;
        camera_vertices(k, |i| self.paths.kinds.get(self.row(i)) == Some(&VERTEX_DISCRETE))
    }
}

/// A column of all vertices.
fn vertices<C: Column>(world: &mut TileWorld, side: Side) -> Vec<C::Value> {
    match side {
        Side::Current => world.all::<C, PathTable>(),
        Side::Proposed => world.all::<C, ProposedPathTable>(),
    }
}

/// The octave of a number below 1, counted downwards.
fn octave(value: f64, octaves: usize) -> Cell {
    if value > 0.0 && value.is_finite() {
        let exponent = ((value.to_bits() >> 52) & 0x7ff) as i64 - 1023;
        cell((-1 - exponent).max(0) as usize, octaves)
    } else {
        cell(octaves, octaves)
    }
}

fn octaves(what: &str, unit: &str, octaves: usize) -> Vec<String> {
    let name = |octave: usize| match octave {
        _ if octave + 1 == octaves => format!("{what} below 2^-{octave}{unit}"),
        _ => format!("{what} in [2^-{}, 2^-{octave}){unit}", octave + 1),
    };
    (0..octaves).map(name).collect()
}

/// The share of a strategy in the density of paths.
fn shares(what: &str, t: impl Fn(&Path<'_>) -> Option<usize> + Send + Sync + 'static) -> Family {
    let names = octaves(&format!("share of {what}"), "", SHARE_OCTAVES);
    Family::new(names, false, move |world, side, cells| {
        let shares = vertices::<PathShare>(world, side);
        let paths = Paths::look(world, side, cells.len());
        for (chain, to) in cells.iter_mut().enumerate() {
            let path = Path { paths: &paths, chain };
            let has_path = paths.edges[chain] > 0;
            let share = t(&path).filter(|_| has_path).and_then(|t| shares.get(path.row(t - 1)));
            *to = share.map_or(NOWHERE, |&share| octave(share, SHARE_OCTAVES));
        }
    })
}

/// The length of the first edge that can be joined.
fn joined_edges() -> Family {
    let names = octaves(
        "length of the first edge that can be joined",
        " of the scene's diameter",
        LENGTH_OCTAVES,
    );
    Family::new(names, false, move |world, side, cells| {
        let radius = f64::from(world.world().resource::<SceneRef>().0.bounding_sphere().radius);
        let positions = vertices::<VertexPosition>(world, side);
        let paths = Paths::look(world, side, cells.len());
        for (chain, to) in cells.iter_mut().enumerate() {
            let path = Path { paths: &paths, chain };
            let t = path.camera_vertices();
            *to = NOWHERE;
            // Of a path that ends where the camera's subpath does there is no such edge, and none whose end is nowhere has a length.
            if t <= paths.edges[chain] as usize
                && [t - 1, t]
                    .iter()
                    .all(|&i| paths.kinds.get(path.row(i)) != Some(&VERTEX_INFINITE))
                && let (Some(x), Some(y)) = (positions.get(path.row(t - 1)), positions.get(path.row(t)))
            {
                let length = x.as_dvec3().distance(y.as_dvec3());
                *to = octave(0.5 * length / radius, LENGTH_OCTAVES);
            }
        }
    })
}

/// The light that paths end on.
fn lights() -> Family {
    let names = (0..LIGHTS).map(|light| {
        let more = if light + 1 == LIGHTS { " or beyond" } else { "" };
        format!("light {light}{more}")
    });
    Family::new(names.collect(), false, |world, side, cells| {
        let mut lights = vec![0; cells.len()];
        match side {
            Side::Current => world.read::<PathLight, ChainTable>(&mut lights),
            Side::Proposed => world.read::<ProposedLight, ChainTable>(&mut lights),
        }
        for (to, light) in cells.iter_mut().zip(lights) {
            *to = cell(light as usize, LIGHTS);
        }
    })
}

/// The place on the film through which paths are seen: finer than the blocks that all states are told apart by, and that of the
/// path, not the pixel that it counts for.
fn seen(scene: &Scene) -> Family {
    let size = Vec2::new(scene.width as f32, scene.height as f32);
    let names = (0..SIDE * SIDE).map(|at| format!("place on the film, cell ({}, {})", at % SIDE, at / SIDE));
    Family::new(names.collect(), false, move |world, side, cells| {
        let mut film = vec![Vec2::ZERO; cells.len()];
        match side {
            Side::Current => world.read::<PathFilm, ChainTable>(&mut film),
            Side::Proposed => world.read::<ProposedPathFilm, ChainTable>(&mut film),
        }
        for (to, place) in cells.iter_mut().zip(film) {
            let at = (place / size * SIDE as f32).clamp(Vec2::ZERO, Vec2::splat(SIDE as f32 - 1.0));
            *to = cell(at.y as usize * SIDE + at.x as usize, SIDE * SIDE);
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octaves_count_downwards_from_one() {
        let cells = [1.0, 0.75, 0.5, 0.49, 0.25, 0.2, 1e-300, 0.0, f64::NAN].map(|value| octave(value, 4));
        assert_eq!(cells, [0, 0, 0, 1, 1, 2, 3, 3, 3]);
        assert_eq!(
            octaves("x", "", 3),
            ["x in [2^-1, 2^-0)", "x in [2^-2, 2^-1)", "x below 2^-2"]
        );
    }
}
