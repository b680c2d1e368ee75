//! Families of primary sample space: where the coordinates of states are, and a digest of all of them.

use super::family::{Cell, Family, NOWHERE, Side, cell, lengths};
use crate::path::{
    ChainTable, PrimaryChoice, PrimaryDepth, PrimaryFilm, PrimaryLight, PrimaryRoulette, PrimaryScatter, PrimaryTable,
    ProposedDepth, ProposedFilm, ProposedPrimaryTable,
};
use crate::plan::{Extent, TableId, TilePlan};
use crate::render::TileWorld;
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
            let count = cells.len();
            for (to, depth) in cells.iter_mut().zip(depths(world, side, count)) {
                *to = cell(depth as usize, lengths("").len());
            }
        }),
    ];
    let Some(table) = plan.tables.iter().find(|table| table.id == TableId::PRIMARY) else {
        return families;
    };
    let Extent::PerDepth { most, .. } = table.extent else {
        return families;
    };
    let capacity = plan.size as usize;
    for depth in 1..=most.min(DEPTHS) {
        families.push(vertex_grid::<PrimaryScatter>("scatter", depth, capacity));
        if table.has::<PrimaryLight>() {
            families.push(vertex_grid::<PrimaryLight>("light", depth, capacity));
        }
    }
    families
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

fn depths(world: &mut TileWorld, side: Side, chains: usize) -> Vec<u32> {
    let mut depths = vec![0; chains];
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

fn vertex_grid<C: Column<Value = [u32; 2]>>(what: &str, depth: u32, capacity: usize) -> Family {
    let name = format!("{what} coordinates at depth {depth}");
    Family::new(grid(&name), true, move |world, side, cells| {
        let first = (depth - 1) as usize * capacity;
        let coordinates = vertices::<C>(world, side, first + cells.len());
        let depths = depths(world, side, cells.len());
        let here = coordinates.iter().skip(first);
        for ((to, &[x, y]), own) in cells.iter_mut().zip(here).zip(depths) {
            *to = if own >= depth { grid_cell(x, y) } else { NOWHERE };
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
pub(super) fn digests(world: &mut TileWorld, side: Side, capacity: usize, chains: usize) -> Vec<u64> {
    let depths = depths(world, side, chains);
    let deepest = depths.iter().max().map_or(0, |&depth| depth as usize);
    let count = deepest * capacity;
    let film = film(world, side, chains);
    let choice = vertices::<PrimaryChoice>(world, side, count);
    let light = vertices::<PrimaryLight>(world, side, count);
    let scatter = vertices::<PrimaryScatter>(world, side, count);
    let roulette = vertices::<PrimaryRoulette>(world, side, count);
    let digest = |chain: usize| {
        let mut digest = Digest(u64::from(depths[chain]));
        film[chain].into_iter().for_each(|c| digest.add(c));
        for depth in 0..depths[chain] as usize {
            let vertex = depth * capacity + chain;
            digest.add(choice[vertex]);
            digest.add(u64::from(roulette[vertex]));
            for [x, y] in [light[vertex], scatter[vertex]] {
                digest.add(u64::from(x) << 32 | u64::from(y));
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
