//! The columns of primary sample space: the uniform numbers that a path is made of (Kelemen, Szirmay-Kalos, Antal and
//! Csonka 2002).
//!
//! Coordinates are integers that stand for u in [0, 1), see [`crate::chain::Kernel`]. Those of the film are chain columns;
//! those of the vertex at depth d of subpath p have number (d − first) · capacity + p in two tables of the same columns: one
//! for current states, one for proposals. `first` is 1 where nothing but vertices that scatter needs coordinates, and 0 where
//! subpaths start by them: at a lens with an aperture, or at a light
//! ([`TilePlace::coordinate`](crate::systems::tile::TilePlace::coordinate)). Where a path ended, its coordinates end: deeper
//! ones are uniform whatever the state, so they are drawn afresh when a proposal gets there. The two
//! subpaths of a chain end each at a depth of their own.

use super::draws::{CoordinateSet, VertexCoordinates};
use crate::columns;
use crate::table::{Rows, Table};
use bevy_ecs::component::Component;
use bevy_ecs::query::Without;

/// Marks the rows of the table of current primary coordinates.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct PrimaryTable;

impl Table for PrimaryTable {
    type Apart = Without<ProposedPrimaryTable>;
}

/// Marks the rows of the table of proposed primary coordinates.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct ProposedPrimaryTable;

impl Table for ProposedPrimaryTable {
    type Apart = Without<PrimaryTable>;
}

columns! {
    /// Where on the film the current state starts, in units of 2⁻⁶⁴ of its width and height.
    pub PrimaryFilm: [u64; 2];
    /// Where the proposal starts.
    pub ProposedFilm: [u64; 2];
    /// The depth of the last vertex of a subpath that has primary coordinates in the current state.
    pub PrimaryDepth: u32;
    /// The depth of the last vertex of a subpath that has primary coordinates in the proposal.
    pub ProposedDepth: u32;
    /// Chooses a light for the vertex, or for a subpath to start at, in units of 2⁻⁶⁴.
    pub PrimaryChoice: u64;
    /// Chooses a point on the light, in units of 2⁻³².
    pub PrimaryLight: [u32; 2];
    /// Chooses where the vertex scatters to, or light is sent from where a subpath starts, or the point of the lens, in units
    /// of 2⁻³².
    pub PrimaryScatter: [u32; 2];
    /// Plays roulette after the vertex, in units of 2⁻³².
    pub PrimaryRoulette: u32;
    /// Chooses between lobes at the vertex, in units of 2⁻³².
    pub PrimaryLobe: u32;
    /// Subpaths whose new vertex needs primary coordinates.
    pub DrawList: u32;
}

/// The coordinates of vertices, as slices. Those of lights, roulette and lobes are empty where the plan has none.
#[derive(Clone, Copy)]
pub struct CoordinateColumns<'a> {
    /// Choices of lights.
    pub choice: &'a [PrimaryChoice],
    /// Points on lights.
    pub light: &'a [PrimaryLight],
    /// Scattering.
    pub scatter: &'a [PrimaryScatter],
    /// Roulette.
    pub roulette: &'a [PrimaryRoulette],
    /// Lobes.
    pub lobe: &'a [PrimaryLobe],
}

impl CoordinateColumns<'_> {
    /// Which coordinates there are.
    #[must_use]
    pub const fn set(&self) -> CoordinateSet {
        CoordinateSet {
            lights: !self.choice.is_empty(),
            lobes: !self.lobe.is_empty(),
        }
    }

    /// The coordinates number `index`.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, index: usize) -> VertexCoordinates {
        let lights = !self.choice.is_empty();
        VertexCoordinates {
            choice: if lights { self.choice.at(index) } else { 0 },
            light: if lights { self.light.at(index) } else { [0; 2] },
            scatter: self.scatter.at(index),
            roulette: if self.roulette.is_empty() {
                0
            } else {
                self.roulette.at(index)
            },
            lobe: if self.lobe.is_empty() { 0 } else { self.lobe.at(index) },
        }
    }
}

/// The coordinates of vertices, as slices to write to.
pub struct CoordinateColumnsMut<'a> {
    /// Choices of lights.
    pub choice: &'a mut [PrimaryChoice],
    /// Points on lights.
    pub light: &'a mut [PrimaryLight],
    /// Scattering.
    pub scatter: &'a mut [PrimaryScatter],
    /// Roulette.
    pub roulette: &'a mut [PrimaryRoulette],
    /// Lobes.
    pub lobe: &'a mut [PrimaryLobe],
}

impl CoordinateColumnsMut<'_> {
    /// The same slices, to read.
    #[must_use]
    pub const fn shared(&self) -> CoordinateColumns<'_> {
        CoordinateColumns {
            choice: self.choice,
            light: self.light,
            scatter: self.scatter,
            roulette: self.roulette,
            lobe: self.lobe,
        }
    }

    /// Sets the coordinates number `index`.
    #[inline(always)]
    pub fn put(&mut self, index: usize, coordinates: VertexCoordinates) {
        if !self.choice.is_empty() {
            self.choice.put(index, coordinates.choice);
            self.light.put(index, coordinates.light);
        }
        self.scatter.put(index, coordinates.scatter);
        if !self.roulette.is_empty() {
            self.roulette.put(index, coordinates.roulette);
        }
        if !self.lobe.is_empty() {
            self.lobe.put(index, coordinates.lobe);
        }
    }
}
