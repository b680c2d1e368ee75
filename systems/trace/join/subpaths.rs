//! Reading a chain's subpaths from their columns.

use super::super::super::tile::TilePlace;
use super::super::scatter::{Surface, SurfaceColumns};
use crate::color::Rgb;
use crate::path::bidirectional::EndVertex;
use crate::path::*;
use crate::table::{Read, Rows};
use bevy_ecs::system::SystemParam;
use glam::{Vec2, Vec3};

/// The columns of subpaths.
#[derive(SystemParam)]
pub struct SubpathTables<'w, 's> {
    lengths: Read<'w, 's, PathLength, ChainTable>,
    surface: Surface<'w, 's>,
    kinds: Read<'w, 's, VertexKind, ProposalTable>,
    ratios: Read<'w, 's, VertexRatio, ProposalTable>,
    lights: Read<'w, 's, VertexLight, ProposalTable>,
    arrivals: Read<'w, 's, VertexArrival, ProposalTable>,
    forwards: Read<'w, 's, VertexForward, ProposalTable>,
    tails: Read<'w, 's, VertexTail, ProposalTable>,
}

/// [`SubpathTables`] as slices.
pub struct SubpathColumns<'a> {
    lengths: &'a [PathLength],
    surface: SurfaceColumns<'a>,
    kinds: &'a [VertexKind],
    ratios: &'a [VertexRatio],
    lights: &'a [VertexLight],
    arrivals: &'a [VertexArrival],
    forwards: &'a [VertexForward],
    tails: &'a [VertexTail],
}

impl SubpathTables<'_, '_> {
    /// The columns as slices.
    pub fn columns(&self) -> SubpathColumns<'_> {
        SubpathColumns {
            lengths: self.lengths.rows(),
            surface: self.surface.columns(),
            kinds: self.kinds.rows(),
            ratios: self.ratios.rows(),
            lights: self.lights.rows(),
            arrivals: self.arrivals.rows(),
            forwards: self.forwards.rows(),
            tails: self.tails.rows(),
        }
    }
}

impl SubpathColumns<'_> {
    /// Puts the vertices of a subpath into `vertices`.
    pub fn read(&self, place: &TilePlace, path: usize, vertices: &mut Vec<EndVertex>) {
        vertices.clear();
        let length = self.lengths.at(path);
        if length == NO_SUBPATH {
            return;
        }
        let mut throughput = Rgb::ONE;
        for depth in 0..=length {
            let vertex = place.vertex(path, depth);
            let arrival = if depth == 0 {
                Vec3::ZERO
            } else {
                self.arrivals.at(vertex)
            };
            let weighs = !self.forwards.is_empty();
            vertices.push(EndVertex {
                surface: self.surface.at(false, vertex, arrival),
                kind: self.kinds.at(vertex),
                light: self.lights.at(vertex),
                forward: if weighs { self.forwards.at(vertex) } else { 0.0 },
                tail: if weighs { self.tails.at(vertex) } else { 0.0 },
                throughput,
            });
            throughput *= self.ratios.at(vertex);
        }
    }
}

/// The lens, where no camera subpath starts on it.
pub fn lens(position: Vec3, kind: u32, normal: Vec3) -> EndVertex {
    EndVertex {
        surface: Scatterer {
            position,
            normal,
            shading_normal: normal,
            offset: 0.0,
            material: 0,
            uv: Vec2::ZERO,
            tangent: Vec3::ZERO,
            direction: Vec3::ZERO,
        },
        kind,
        light: crate::geometry::NOT_EMITTING,
        forward: 0.0,
        tail: 0.0,
        throughput: Rgb::ONE,
    }
}
