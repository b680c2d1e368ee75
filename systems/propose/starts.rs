//! Where subpaths start, whichever end that is.

use super::super::tile::Queues;
use crate::color::Rgb;
use crate::path::*;
use crate::table::{Rows, Write};
use bevy_ecs::system::SystemParam;
use glam::Vec3;

/// The columns that a start is written to.
#[derive(SystemParam)]
pub struct Starts<'w, 's> {
    directions: Write<'w, 's, Direction, ChainTable>,
    lengths: Write<'w, 's, PathLength, ChainTable>,
    throughputs: Write<'w, 's, Throughput, ChainTable>,
    scales: Write<'w, 's, RadianceScale, ChainTable>,
    active: Write<'w, 's, ActiveList, ChainTable>,
    kinds: Write<'w, 's, VertexKind, ProposalTable>,
    positions: Write<'w, 's, VertexPosition, ProposalTable>,
    normals: Write<'w, 's, VertexNormal, ProposalTable>,
    offsets: Write<'w, 's, VertexOffset, ProposalTable>,
    ratios: Write<'w, 's, VertexRatio, ProposalTable>,
    densities: Write<'w, 's, VertexDensity, ProposalTable>,
    lights: Write<'w, 's, VertexLight, ProposalTable>,
    forwards: Write<'w, 's, VertexForward, ProposalTable>,
    tails: Write<'w, 's, VertexTail, ProposalTable>,
}

/// [`Starts`] as slices.
pub struct StartColumns<'a> {
    directions: &'a mut [Direction],
    lengths: &'a mut [PathLength],
    throughputs: &'a mut [Throughput],
    scales: &'a mut [RadianceScale],
    active: &'a mut [ActiveList],
    kinds: &'a mut [VertexKind],
    positions: &'a mut [VertexPosition],
    normals: &'a mut [VertexNormal],
    offsets: &'a mut [VertexOffset],
    ratios: &'a mut [VertexRatio],
    densities: &'a mut [VertexDensity],
    lights: &'a mut [VertexLight],
    forwards: &'a mut [VertexForward],
    tails: &'a mut [VertexTail],
}

/// The first vertex of a subpath, and the way out of it.
#[derive(Clone, Copy, Debug)]
pub struct FirstVertex {
    /// Its kind.
    pub kind: u32,
    /// Where the first ray starts, but for the offset.
    pub position: Vec3,
    /// Unit normal; at infinity the direction of travel; zero for a point without one.
    pub normal: Vec3,
    /// How far the ray starts off the surface.
    pub offset: f32,
    /// The unit direction out.
    pub direction: Vec3,
    /// f/p of starting.
    pub ratio: Rgb,
    /// Density of the direction.
    pub density: f32,
    /// The light, or [`NOT_EMITTING`](crate::geometry::NOT_EMITTING).
    pub light: u32,
    /// Density of the vertex, see [`measure`](crate::path::measure).
    pub forward: f64,
}

impl Starts<'_, '_> {
    /// The columns as slices.
    pub fn columns(&mut self) -> StartColumns<'_> {
        StartColumns {
            directions: self.directions.rows(),
            lengths: self.lengths.rows(),
            throughputs: self.throughputs.rows(),
            scales: self.scales.rows(),
            active: self.active.rows(),
            kinds: self.kinds.rows(),
            positions: self.positions.rows(),
            normals: self.normals.rows(),
            offsets: self.offsets.rows(),
            ratios: self.ratios.rows(),
            densities: self.densities.rows(),
            lights: self.lights.rows(),
            forwards: self.forwards.rows(),
            tails: self.tails.rows(),
        }
    }
}

impl StartColumns<'_> {
    /// Whether densities are wanted.
    #[inline]
    #[must_use]
    pub const fn weighs(&self) -> bool {
        !self.forwards.is_empty()
    }

    /// Says that a subpath has no vertex.
    #[inline]
    pub fn without(&mut self, path: usize) {
        self.lengths.put(path, NO_SUBPATH);
    }

    /// Starts a subpath; it waits for its first ray if it `goes_on`.
    #[inline(always)]
    pub fn begin(&mut self, queues: &mut Queues, path: usize, first: &FirstVertex, goes_on: bool) {
        self.directions.put(path, first.direction);
        self.lengths.put(path, 0);
        if !self.throughputs.is_empty() {
            self.throughputs.put(path, Rgb::ONE);
        }
        if !self.scales.is_empty() {
            self.scales.put(path, 1.0);
        }
        // Vertex 0 of a subpath has the subpath's own number.
        self.kinds.put(path, first.kind);
        self.positions.put(path, first.position);
        self.normals.put(path, first.normal);
        self.offsets.put(path, first.offset);
        self.ratios.put(path, first.ratio);
        if !self.lights.is_empty() {
            self.densities.put(path, first.density);
            self.lights.put(path, first.light);
        }
        if !self.forwards.is_empty() {
            self.forwards.put(path, first.forward);
            self.tails.put(path, 0.0);
        }
        if goes_on {
            self.active.put(queues.active, path as u32);
            queues.active += 1;
        }
    }
}
