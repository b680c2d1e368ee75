//! Families of primary sample space: where the coordinates of states are, and a digest of all of them.

use super::family::{Cell, Family, NOWHERE, Side, cell, lengths};
use crate::path::{
    ChainTable, PrimaryChoice, PrimaryDepth, PrimaryFilm, PrimaryLight, PrimaryLobe, PrimaryRoulette, PrimaryScatter,
    PrimaryTable, ProposedDepth, ProposedFilm, ProposedPrimaryTable,
};
use crate::plan::{Extent, Subpaths, TableId, TilePlan};
use crate::render::TileWorld;
use crate::systems::tile::TilePlace;
use crate::table::Column;
use bytemuck::Zeroable;

/// Cells along a coordinate.
const SIDE: usize = 4;
/// Depths whose coordinates are looked at.
const DEPTHS: u32 = 2;
/// The film coordinates are also looked at inside parts of the film: so many to a side.
const PARTS_LOG2: u32 = 3;

/// The families of the coordinates that `plan` has; none for other state spaces.
pub(super) fn families(plan: &TilePlan) -> Vec<Family> {
    let has_film = plan.tables.iter().any(|table| table.has::<PrimaryFilm>());
    if !has_film {
        return Vec::new();
    }
    let mut families = vec![
        film_grid("film coordinates", 0),
        film_grid("film coordinates in an eighth", PARTS_LOG2),
        Family::new(lengths("last coordinates at depth"), false, |world, side, cells| {
            for (to, depth) in cells.iter_mut().zip(depths(world, side)) {
                *to = cell(depth as usize, lengths("").len());
            }
        }),
    ];
    let Some(table) = plan.tables.iter().find(|table| table.id == TableId::PRIMARY) else {
        return families;
    };
    let Extent::PerDepth { first, most, .. } = table.extent else {
        return families;
    };
    let ends = match plan.subpaths {
        Subpaths::Camera => [Some("camera"), None],
        Subpaths::Light => [None, Some("light")],
        Subpaths::Both => [Some("camera"), Some("light")],
    };
    for (from_light, end) in ends.into_iter().enumerate() {
        let Some(end) = end else { continue };
        for depth in first..=most.min(first + DEPTHS - 1) {
            let at = At {
                from_light: from_light == 1,
                depth,
            };
            let name = |what| format!("{what} coordinates at depth {depth} from the {end}");
            families.push(vertex_grid::<PrimaryScatter>(&name("scatter"), at));
            if table.has::<PrimaryLight>() {
                families.push(vertex_grid::<PrimaryLight>(&name("light"), at));
            }
        }
    }
    families
}

/// A vertex of every state: which end it is counted from, and its depth.
#[derive(Clone, Copy)]
struct At {
    from_light: bool,
    depth: u32,
}

/// Names of a square's cells.
fn grid(what: &str) -> Vec<String> {
    (0..SIDE * SIDE)
        .map(|cell| format!("{what}, cell ({}, {})", cell % SIDE, cell / SIDE))
        .collect()
}

/// The cell of a point whose coordinates' leading bits are `x` and `y`.
fn grid_cell(x: u32, y: u32) -> Cell {
    let place = |c: u32| (c >> (u32::BITS - SIDE.ilog2())) as usize;
    cell(place(y) * SIDE + place(x), SIDE * SIDE)
}

/// The depth of every subpath's last coordinates: those of all camera subpaths, then those from lights.
fn depths(world: &mut TileWorld, side: Side) -> Vec<u32> {
    let mut depths = vec![0; world.world().resource::<TilePlace>().capacity as usize];
    match side {
        Side::Current => world.read::<PrimaryDepth, ChainTable>(&mut depths),
        Side::Proposed => world.read::<ProposedDepth, ChainTable>(&mut depths),
    }
    depths
}

fn film(world: &mut TileWorld, side: Side, chains: usize) -> Vec<[u64; 2]> {
    let mut film = vec![[0; 2]; chains];
    match side {
        Side::Current => world.read::<PrimaryFilm, ChainTable>(&mut film),
        Side::Proposed => world.read::<ProposedFilm, ChainTable>(&mut film),
    }
    film
}

fn film_grid(what: &str, parts_log2: u32) -> Family {
    Family::new(grid(what), true, move |world, side, cells| {
        let count = cells.len();
        for (to, film) in cells.iter_mut().zip(film(world, side, count)) {
            let [x, y] = film.map(|c| ((c << parts_log2) >> 32) as u32);
            *to = grid_cell(x, y);
        }
    })
}

fn vertex_grid<C: Column<Value = [u32; 2]>>(name: &str, at: At) -> Family {
    Family::new(grid(name), true, move |world, side, cells| {
        let place = *world.world().resource::<TilePlace>();
        let path = if at.from_light { place.lights_from as usize } else { 0 };
        let first = place.coordinate(path, at.depth);
        let coordinates = vertices::<C>(world, side, first + cells.len());
        let depths = depths(world, side);
        let here = coordinates.iter().skip(first);
        for ((to, &[x, y]), own) in cells.iter_mut().zip(here).zip(depths.into_iter().skip(path)) {
            *to = if own >= at.depth { grid_cell(x, y) } else { NOWHERE };
        }
    })
}

/// The first `count` entries of a column of vertex coordinates.
fn vertices<C: Column<Value: Zeroable>>(world: &mut TileWorld, side: Side, count: usize) -> Vec<C::Value> {
    let mut values = vec![C::Value::zeroed(); count];
    match side {
        Side::Current => world.read::<C, PrimaryTable>(&mut values),
        Side::Proposed => world.read::<C, ProposedPrimaryTable>(&mut values),
    }
    values
}

/// A number for every chain's state that differs where any coordinate does, but for accidents of one in 2⁶⁴.
pub(super) fn digests(world: &mut TileWorld, side: Side, chains: usize) -> Vec<u64> {
    let place = *world.world().resource::<TilePlace>();
    let depths = depths(world, side);
    let deepest = depths.iter().max().copied().unwrap_or(0);
    let count = place.vertex(0, deepest + 1 - place.first_coordinate.min(deepest + 1));
    let film = film(world, side, chains);
    let choice = vertices::<PrimaryChoice>(world, side, count);
    let light = vertices::<PrimaryLight>(world, side, count);
    let scatter = vertices::<PrimaryScatter>(world, side, count);
    let roulette = vertices::<PrimaryRoulette>(world, side, count);
    let lobe = vertices::<PrimaryLobe>(world, side, count);
    let digest = |chain: usize| {
        let mut digest = Digest(0);
        film[chain].into_iter().for_each(|c| digest.add(c));
        for path in place.subpaths(chain) {
            digest.add(u64::from(depths[path]));
            for vertex in (place.first_coordinate..=depths[path]).map(|depth| place.coordinate(path, depth)) {
                digest.add(choice[vertex]);
                digest.add(u64::from(roulette[vertex]) << 32 | u64::from(lobe[vertex]));
                for [x, y] in [light[vertex], scatter[vertex]] {
                    digest.add(u64::from(x) << 32 | u64::from(y));
                }
            }
        }
        digest.0
    };
    (0..chains).map(digest).collect()
}

struct Digest(u64);

impl Digest {
    /// FNV-1a over whole words, and a rotation, without which high bits would never reach low ones.
    fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01B3).rotate_left(29);
    }
}
