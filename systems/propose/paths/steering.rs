//! How perturbations trace their subpaths: through the lobes of discrete vertices that the current path goes through, and, where it
//! scatters with a density, near to where it goes.

use super::super::super::chains::Keys;
use super::super::super::paths::{Vertices, VerticesMut};
use super::super::super::tile::{Queues, SceneRef, TilePlace};
use super::moves_paths::MovesPaths;
use crate::chain::ChosenMutation;
use crate::material::Transport;
use crate::path::whole::{PathEdges, PathTable};
use crate::path::{
    ChainTable, Direction, DrawList, PathLength, ProposalTable, ScatteredList, Scatterer, VERTEX_DISCRETE,
};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};

/// Subpaths that wait to be steered, and what that takes.
#[derive(SystemParam)]
pub struct Steering<'w, 's> {
    scene: Res<'w, SceneRef>,
    place: Res<'w, TilePlace>,
    queues: ResMut<'w, Queues>,
    list: Read<'w, 's, DrawList, ChainTable>,
    chosen: Read<'w, 's, ChosenMutation, ChainTable>,
    lengths: Read<'w, 's, PathLength, ChainTable>,
    edges: Read<'w, 's, PathEdges, ChainTable>,
    keys: Keys<'w, 's>,
    current: Vertices<'w, 's, PathTable>,
    vertices: VerticesMut<'w, 's, ProposalTable>,
    directions: Write<'w, 's, Direction, ChainTable>,
    scattered: Write<'w, 's, ScatteredList, ChainTable>,
}

impl Steering<'_, '_> {
    /// Steers every listed subpath whose chain tries `mutation`, number `number`. At a vertex where the current path is scattered into
    /// a discrete lobe, the subpath is too, or ends; elsewhere it goes [near](MovesPaths::near) to where the current path does.
    pub fn steer(&mut self, number: usize, mutation: &dyn MovesPaths) {
        let (scene, place) = (&*self.scene.0, &*self.place);
        let (list, chosen, lengths, edges) = (
            self.list.rows(),
            self.chosen.rows(),
            self.lengths.rows(),
            self.edges.rows(),
        );
        let (keys, current, mut vertices) = (self.keys.columns(), self.current.columns(), self.vertices.columns());
        let (directions, scattered) = (self.directions.rows(), self.scattered.rows());
        for path in (0..self.queues.draw).map(|entry| list.at(entry) as usize) {
            let chain = place.chain(path);
            if chosen.at(chain) as usize != number {
                continue;
            }
            let depth = lengths.at(path);
            let from_light = place.starts_at_light(path);
            let i = if from_light { edges.at(chain) - depth } else { depth };
            let old = current.at(place.path_vertex(chain, i as usize));
            let onward = current.at(place.path_vertex(chain, i as usize + 1)).surface.direction;
            let vertex = place.vertex(path, depth);
            let new = vertices.at(vertex);
            let surface = Scatterer {
                direction: directions.at(path),
                ..new.surface
            };
            let direction = if old.kind == VERTEX_DISCRETE {
                let transport = if from_light {
                    Transport::Importance
                } else {
                    Transport::Radiance
                };
                let lobe = old.lobe(onward);
                let materials = &scene.materials;
                let scatter = |wi| materials.discrete(surface.material, surface.uv, wi, lobe, transport);
                let Some((direction, _)) = surface.scatter(transport, scatter) else {
                    continue;
                };
                vertices.put_kind(vertex, VERTEX_DISCRETE);
                direction
            } else {
                if scene.materials.kind(surface.material).is_discrete() {
                    continue;
                }
                let outgoing = if from_light { -old.surface.direction } else { onward };
                mutation.near(outgoing, keys.at(chain), place.stream_depth(path, depth))
            };
            directions.put(path, direction);
            scattered.put(self.queues.scattered, path as u32);
            self.queues.scattered += 1;
        }
    }
}
