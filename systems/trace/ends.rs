//! What joining subpaths needs of their vertices, kept as they are appended.

use super::super::tile::{StrategiesRef, TilePlace};
use crate::path::bidirectional::tail;
use crate::path::measure::Site;
use crate::path::*;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, SystemParam};
use glam::Vec3;

/// Columns that only techniques with both ends have.
#[derive(SystemParam)]
pub struct Ends<'w, 's> {
    strategies: Option<Res<'w, StrategiesRef>>,
    lights: Write<'w, 's, VertexLight, ProposalTable>,
    arrivals: Write<'w, 's, VertexArrival, ProposalTable>,
    forwards: Write<'w, 's, VertexForward, ProposalTable>,
    reverses: Read<'w, 's, VertexReverse, ProposalTable>,
    tails: Write<'w, 's, VertexTail, ProposalTable>,
}

/// [`Ends`] as slices.
pub struct EndColumns<'a> {
    strategies: bidirectional::Strategies,
    lights: &'a mut [VertexLight],
    arrivals: &'a mut [VertexArrival],
    forwards: &'a mut [VertexForward],
    reverses: &'a [VertexReverse],
    tails: &'a mut [VertexTail],
}

/// A vertex that is appended to a subpath, and whose kind, position and normal are known.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// The subpath.
    pub path: usize,
    /// The vertex's depth in it.
    pub depth: u32,
    /// The direction in which the subpath arrived.
    pub direction: Vec3,
    /// The light that it is on, or [`NOT_EMITTING`](crate::geometry::NOT_EMITTING).
    pub light: u32,
}

/// Kinds, positions, normals, and densities of directions, of all vertices.
pub type Known<'a> = (
    &'a [VertexKind],
    &'a [VertexPosition],
    &'a [VertexNormal],
    &'a [VertexDensity],
);

impl Ends<'_, '_> {
    /// The columns as slices; `None` for techniques that have only one end.
    pub fn columns(&mut self) -> Option<EndColumns<'_>> {
        let strategies = self.strategies.as_ref()?.0;
        Some(EndColumns {
            strategies,
            lights: self.lights.rows(),
            arrivals: self.arrivals.rows(),
            forwards: self.forwards.rows(),
            reverses: self.reverses.rows(),
            tails: self.tails.rows(),
        })
    }
}

impl EndColumns<'_> {
    /// Writes the columns of an appended vertex: the density with which it was drawn, and the odds of the strategies that would
    /// end the subpath two vertices before it or earlier, which are known now.
    #[inline]
    pub fn append(
        &mut self,
        scene: &Scene,
        place: &TilePlace,
        arrival: &Arrival,
        (kinds, positions, normals, densities): Known<'_>,
    ) {
        let Arrival {
            path,
            depth,
            direction,
            light,
        } = *arrival;
        let vertex = place.vertex(path, depth);
        self.lights.put(vertex, light);
        self.arrivals.put(vertex, direction);
        if self.forwards.is_empty() {
            return;
        }
        let at = |depth: u32| place.vertex(path, depth);
        let site = |depth: u32| Site {
            kind: kinds.at(at(depth)),
            position: positions.at(at(depth)),
            normal: normals.at(at(depth)),
        };
        let (here, before) = (site(depth), site(depth - 1));
        let from_light = place.starts_at_light(path);
        let mut forward = before.arriving_along(&here, densities.at(at(depth - 1)), direction);
        let start = at(0);
        if from_light && depth == 1 {
            // How strategy s = 1 would draw the light's end from here; what others do differently goes to this vertex.
            let lights = &scene.lights;
            let number = self.lights.at(start);
            if !lights.is_delta(number) {
                let sampled = lights.density(number, here.position, before.position, before.normal);
                let sampled = here.arriving_along(&before, sampled, direction);
                if sampled > 0.0 {
                    forward *= self.forwards.at(start) / sampled;
                    self.forwards.put(start, sampled);
                }
            }
        }
        self.forwards.put(vertex, forward);
        let mut odds = 0.0;
        if let Some(k) = depth.checked_sub(2) {
            let ray = self.arrivals.at(at(depth - 1));
            let reverse = before.arriving_along(&site(k), self.reverses.at(at(depth - 1)), ray);
            let first = from_light && !scene.lights.is_delta(self.lights.at(start));
            let connects = |depth: u32| kinds.at(at(depth)) != VERTEX_DISCRETE;
            let tail_before = self.tails.at(at(depth - 1));
            let heuristic = self.strategies.heuristic;
            odds = tail(
                heuristic,
                depth,
                reverse,
                self.forwards.at(at(k)),
                tail_before,
                first,
                connects,
            );
        }
        self.tails.put(vertex, odds);
    }
}
