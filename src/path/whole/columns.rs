//! Columns of whole paths: states of chains that walk the space of paths, and what a proposal keeps of them.
//!
//! Vertex d of the path of chain c has number [`TilePlace::path_vertex`](crate::systems::tile::TilePlace::path_vertex)(c, d): two
//! vertices to a row, since tables have room for two subpaths a chain, and a path is one.

use crate::columns;
use crate::path::ProposalTable;
use crate::table::Table;
use bevy_ecs::component::Component;
use bevy_ecs::query::Without;
use glam::{Vec2, Vec3};

/// Marks the rows of the table of current paths' vertices.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct PathTable;

impl Table for PathTable {
    type Apart = (Without<ProposedPathTable>, Without<ProposalTable>);
}

/// Marks the rows of the table of the vertices of proposed paths that bring light.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct ProposedPathTable;

impl Table for ProposedPathTable {
    type Apart = Without<ProposalTable>;
}

/// Set in [`StopDepth`] where a subpath ends at the first vertex that it does not go through by a discrete lobe, if that comes before.
pub const TO_JOINT: u32 = 1 << 30;

/// Set in [`StopDepth`] where a subpath's directions are not drawn by its materials, but by its mutation.
pub const STEERED: u32 = 1 << 31;

columns! {
    /// Edges of the current path.
    pub PathEdges: u32;
    /// Edges of the proposed path; 0 where there is none.
    pub ProposedEdges: u32;
    /// The light that the current path ends on.
    pub PathLight: u32;
    /// The light that the proposed path ends on.
    pub ProposedLight: u32;
    /// The pixel that the current path counts for, row by row.
    pub PathPixel: u32;
    /// The place on the film, in pixels, through which the current path goes.
    pub PathFilm: Vec2;
    /// That of the proposed path.
    pub ProposedPathFilm: Vec2;
    /// The sum of all pixels' filters at [`PathFilm`].
    pub PathFilter: f32;
    /// That of the proposed path.
    pub ProposedFilter: f32;
    /// [`Measured::kept_light`](super::Measured::kept_light) of the current path.
    pub PathKeptLight: f64;
    /// That of the proposed path.
    pub ProposedKeptLight: f64;

    /// Vertices from the camera that the proposal keeps of the current path, t₀.
    pub KeptFromCamera: u32;
    /// Vertices from the light that it keeps, s₀.
    pub KeptFromLight: u32;
    /// Vertices that its camera subpath is to have, t; 0 where the mutation proposes nothing.
    pub CameraVertices: u32;
    /// Vertices that its light subpath is to have, s.
    pub LightVertices: u32;
    /// Depth at which a subpath is to end, [`STEERED`] where its mutation says in which directions it goes, and [`TO_JOINT`].
    pub StopDepth: u32;

    /// Where the first ray of a light subpath starts that its mutation steers and that comes from infinity.
    pub SteeredOrigin: Vec3;

    /// The share of the strategy with d + 1 vertices from the camera in a path's density, at its vertex d.
    pub PathShare: f64;
    /// Density of going on towards the light at a path's vertex, see [`Passage::onward`](super::Passage::onward).
    pub PathOnward: f32;
    /// Density of going on towards the camera.
    pub PathBack: f32;
}

/// The depth at which a subpath is to end, of a [`StopDepth`].
#[inline]
#[must_use]
pub const fn stop_depth(stop: u32) -> u32 {
    stop & !(STEERED | TO_JOINT)
}
