//! How perturbations trace their subpaths: through the lobes of discrete vertices that the current path goes through, and, where it
//! scatters with a density, near to where it goes.

use super::super::super::chains::Keys;
use super::super::super::paths::{Vertices, VerticesMut};
use super::super::super::tile::{Queues, SceneRef, TilePlace};
use super::moves_paths::MovesPaths;
use crate::chain::ChosenMutation;
use crate::material::Transport;
use crate::path::whole::{PathEdges, PathTable, WholeVertex};
use crate::path::{
    ChainTable, Direction, DrawList, PathLength, ProposalTable, ScatteredList, Scatterer, VERTEX_DISCRETE,
};
use crate::sampling::StreamKey;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};
use glam::Vec3;

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
            let reached = Reached {
                surface: Scatterer {
                    direction: directions.at(path),
                    ..vertices.at(vertex).surface
                },
                key: keys.at(chain),
                depth: place.stream_depth(path, depth),
                from_light,
            };
            let Some(direction) = reached.goes_on(scene, mutation, &old, onward) else {
                continue;
            };
            if old.kind == VERTEX_DISCRETE {
                vertices.put_kind(vertex, VERTEX_DISCRETE);
            }
            directions.put(path, direction);
            scattered.put(self.queues.scattered, path as u32);
            self.queues.scattered += 1;
        }
    }
}

/// A vertex that a steered subpath has reached.
pub struct Reached {
    /// Its surface, with the direction in which the subpath arrives.
    pub surface: Scatterer,
    /// The key of the chain's draws.
    pub key: StreamKey,
    /// The depth that tells vertices apart in them.
    pub depth: u32,
    /// Whether the subpath comes from the light.
    pub from_light: bool,
}

impl Reached {
    /// The unit direction in which the subpath goes on, where the current path goes from its vertex `old` in the direction `onward`;
    /// through a discrete lobe, if that does. `None` where it ends.
    #[must_use]
    pub fn goes_on(&self, scene: &Scene, mutation: &dyn MovesPaths, old: &WholeVertex, onward: Vec3) -> Option<Vec3> {
        let Self {
            surface, from_light, ..
        } = self;
        if old.kind == VERTEX_DISCRETE {
            let transport = if *from_light {
                Transport::Importance
            } else {
                Transport::Radiance
            };
            let (lobe, materials) = (old.lobe(onward), &scene.materials);
            let scatter = |wi| materials.discrete(surface.material, surface.uv, wi, lobe, transport);
            return Some(surface.scatter(transport, scatter)?.0);
        }
        let goes_near = !scene.materials.kind(surface.material).is_discrete();
        let outgoing = if *from_light { -old.surface.direction } else { onward };
        goes_near.then(|| mutation.near(outgoing, self.key, self.depth))
    }
}
