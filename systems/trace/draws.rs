//! Where the systems of the trace loop get a path's numbers from: primary coordinates where the plan has them, keyed streams
//! elsewhere.

use super::super::tile::TilePlace;
use crate::chain::KeyChain;
use crate::material::ScatterDraw;
use crate::path::{
    ChainKey, ChainTable, CoordinateColumns, CoordinateColumnsMut, KeyedDraws, LightDraw, PathDraws, PrimaryChoice,
    PrimaryLight, PrimaryLobe, PrimaryRoulette, PrimaryScatter, PrimaryTable, ProposedPrimaryTable, VertexCoordinates,
};
use crate::sampling::StreamKey;
use crate::table::{Read, Rows, Table, Write};
use bevy_ecs::system::SystemParam;

/// The vertex coordinates of the table marked `T`, to read.
#[derive(SystemParam)]
pub struct Coordinates<'w, 's, T: Table> {
    choice: Read<'w, 's, PrimaryChoice, T>,
    light: Read<'w, 's, PrimaryLight, T>,
    scatter: Read<'w, 's, PrimaryScatter, T>,
    roulette: Read<'w, 's, PrimaryRoulette, T>,
    lobe: Read<'w, 's, PrimaryLobe, T>,
}

/// The coordinates of current states.
pub type CurrentCoordinates<'w, 's> = Coordinates<'w, 's, PrimaryTable>;
/// The coordinates of proposals.
pub type ProposedCoordinates<'w, 's> = Coordinates<'w, 's, ProposedPrimaryTable>;

impl<T: Table> Coordinates<'_, '_, T> {
    /// The columns as slices.
    #[must_use]
    pub fn columns(&self) -> CoordinateColumns<'_> {
        CoordinateColumns {
            choice: self.choice.rows(),
            light: self.light.rows(),
            scatter: self.scatter.rows(),
            roulette: self.roulette.rows(),
            lobe: self.lobe.rows(),
        }
    }
}

/// The vertex coordinates of the table marked `T`, to write.
#[derive(SystemParam)]
pub struct CoordinatesMut<'w, 's, T: Table> {
    choice: Write<'w, 's, PrimaryChoice, T>,
    light: Write<'w, 's, PrimaryLight, T>,
    scatter: Write<'w, 's, PrimaryScatter, T>,
    roulette: Write<'w, 's, PrimaryRoulette, T>,
    lobe: Write<'w, 's, PrimaryLobe, T>,
}

impl<T: Table> CoordinatesMut<'_, '_, T> {
    /// The columns as slices.
    #[must_use]
    pub fn columns(&mut self) -> CoordinateColumnsMut<'_> {
        CoordinateColumnsMut {
            choice: self.choice.rows(),
            light: self.light.rows(),
            scatter: self.scatter.rows(),
            roulette: self.roulette.rows(),
            lobe: self.lobe.rows(),
        }
    }
}

/// What a path's numbers are read from.
#[derive(SystemParam)]
pub struct Draws<'w, 's> {
    keys: Read<'w, 's, ChainKey, ChainTable>,
    key_chains: Read<'w, 's, KeyChain, ChainTable>,
    coordinates: ProposedCoordinates<'w, 's>,
}

/// [`Draws`] as slices.
pub struct DrawColumns<'a> {
    place: TilePlace,
    keys: &'a [ChainKey],
    key_chains: &'a [KeyChain],
    coordinates: CoordinateColumns<'a>,
}

impl Draws<'_, '_> {
    /// The columns as slices, for the tile at `place`.
    #[must_use]
    pub fn columns(&self, place: &TilePlace) -> DrawColumns<'_> {
        DrawColumns {
            place: *place,
            keys: self.keys.rows(),
            key_chains: self.key_chains.rows(),
            coordinates: self.coordinates.columns(),
        }
    }
}

impl DrawColumns<'_> {
    /// The numbers that connect the vertex at `depth` of subpath `path` to a light.
    #[inline(always)]
    #[must_use]
    pub fn light(&self, path: usize, depth: u32) -> LightDraw {
        if self.coordinates.scatter.is_empty() {
            self.keyed(path).light(self.place.stream_depth(path, depth))
        } else {
            self.coordinates_at(path, depth).light_draw()
        }
    }

    /// The numbers that scatter at the vertex at `depth` of subpath `path`, with one to choose a `lobe` if that is asked for.
    #[inline(always)]
    #[must_use]
    pub fn scatter(&self, path: usize, depth: u32, lobe: bool) -> ScatterDraw {
        if self.coordinates.scatter.is_empty() {
            let (mut keyed, depth) = (self.keyed(path), self.place.stream_depth(path, depth));
            ScatterDraw {
                direction: keyed.scatter(depth),
                lobe: if lobe { keyed.lobe(depth) } else { 0.0 },
            }
        } else {
            let coordinates = self.coordinates_at(path, depth);
            ScatterDraw {
                direction: coordinates.scatter_draw(),
                lobe: if lobe { coordinates.lobe_draw() } else { 0.0 },
            }
        }
    }

    /// The number that plays roulette after the vertex at `depth` of subpath `path`.
    #[inline(always)]
    #[must_use]
    pub fn roulette(&self, path: usize, depth: u32) -> f32 {
        if self.coordinates.scatter.is_empty() {
            self.keyed(path).roulette(self.place.stream_depth(path, depth))
        } else {
            self.coordinates_at(path, depth).roulette_draw()
        }
    }

    /// The numbers that choose the point of the lens where the camera subpath of `chain` starts.
    #[inline(always)]
    #[must_use]
    pub fn lens(&self, chain: usize) -> [f32; 2] {
        if self.coordinates.scatter.is_empty() {
            self.keyed(chain).lens()
        } else {
            self.coordinates_at(chain, 0).scatter_draw()
        }
    }

    /// The numbers that choose where and how the light subpath `path` starts: a light and a point on it, and a direction.
    #[inline(always)]
    #[must_use]
    pub fn emission(&self, path: usize) -> (LightDraw, [f32; 2]) {
        if self.coordinates.scatter.is_empty() {
            self.keyed(path).emission()
        } else {
            let coordinates = self.coordinates_at(path, 0);
            (coordinates.light_draw(), coordinates.scatter_draw())
        }
    }

    /// The number that chooses the pixel which light from the vertex at `depth` of the light subpath `path` counts for.
    #[inline(always)]
    #[must_use]
    pub fn splat(&self, path: usize, depth: u32) -> f32 {
        if self.coordinates.scatter.is_empty() {
            self.keyed(path).splat(depth)
        } else if depth == 0 {
            // Where a light subpath starts, its own numbers choose a point on the light. Those of the lens choose none.
            self.coordinates_at(self.place.chain(path), 0).splat_draw()
        } else {
            self.coordinates_at(path, depth).splat_draw()
        }
    }

    #[inline(always)]
    fn coordinates_at(&self, path: usize, depth: u32) -> VertexCoordinates {
        self.coordinates.at(self.place.coordinate(path, depth))
    }

    #[inline(always)]
    fn keyed(&self, path: usize) -> KeyedDraws {
        let chain = self.place.chain(path);
        let bits = self.keys.at(chain);
        KeyedDraws(if self.key_chains.is_empty() {
            self.place.key(chain, bits)
        } else {
            StreamKey::from_bits(bits, self.key_chains.at(chain))
        })
    }
}
