//! The one edge that completes a proposed path.

use super::super::super::paths::VerticesMut;
use super::super::super::tile::{Queues, SceneRef, TilePlace};
use super::super::draws::Draws;
use crate::geometry::{RayOrigin, SegmentTarget};
use crate::path::whole::{CameraVertices, KeptFromLight, LightVertices, StopDepth, TO_JOINT, WholeVertex, segment};
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};

/// What mutations asked for, and what became of it.
#[derive(SystemParam)]
pub struct Made<'w, 's> {
    camera_made: Write<'w, 's, CameraVertices, ChainTable>,
    stops: Read<'w, 's, StopDepth, ChainTable>,
    light_made: Read<'w, 's, LightVertices, ChainTable>,
    light_kept: Read<'w, 's, KeptFromLight, ChainTable>,
}

/// Segments that join.
#[derive(SystemParam)]
pub struct Segments<'w, 's> {
    chains: Write<'w, 's, RayChain, RayTable>,
    origins: Write<'w, 's, RayOrigin, RayTable>,
    targets: Write<'w, 's, SegmentTarget, RayTable>,
}

/// Writes the segment between the two subpaths of every proposal, in the order of chains; chooses a light where the subpath from
/// the light is to be nothing else. A chain whose subpaths have not become what its mutation asked for has no proposal:
/// [`CameraVertices`] says 0 then.
pub fn join_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    draws: Draws,
    mut made: Made,
    mut lengths: Write<PathLength, ChainTable>,
    mut proposed: Write<whole::ProposedEdges, ChainTable>,
    mut lights: Write<VertexLight, ProposalTable>,
    mut vertices: VerticesMut<ProposalTable>,
    mut segments: Segments,
) {
    let scene = &*scene.0;
    let draws = draws.columns(&place);
    let (camera_made, stops) = (made.camera_made.rows(), made.stops.rows());
    let (light_made, light_kept) = (made.light_made.rows(), made.light_kept.rows());
    let (lengths, proposed, lights) = (lengths.rows(), proposed.rows(), lights.rows());
    let mut vertices = vertices.columns();
    let (chains, origins, targets) = (segments.chains.rows(), segments.origins.rows(), segments.targets.rows());
    queues.segments = 0;
    for chain in 0..place.chains as usize {
        proposed.put(chain, 0);
        let (mut t, s) = (camera_made.at(chain), light_made.at(chain));
        if t > 0 && stops.at(chain) & TO_JOINT != 0 {
            t = lengths.at(chain) + 1;
            // Its last vertex has to be one that it stopped at.
            let stopped = t > 1 && vertices.at(place.vertex(chain, t - 1)).kind != VERTEX_DISCRETE;
            t = if stopped { t } else { 0 };
            camera_made.put(chain, t);
        }
        if t == 0 || lengths.at(chain) != t - 1 {
            continue;
        }
        let light_path = place.lights_from as usize + chain;
        let edges = s + t - 1;
        if s == 0 {
            proposed.put(chain, edges);
            continue;
        }
        let x = vertices.at(place.vertex(chain, t - 1));
        if t > 1 && x.kind == VERTEX_INFINITE {
            continue;
        }
        if s == 1 && light_kept.at(chain) == 0 && t > 1 {
            let draw = draws.light(chain, t - 1);
            let Some((light, end)) = WholeVertex::sampled_light(scene, x.surface.position, draw) else {
                continue;
            };
            lengths.put(light_path, 0);
            lights.put(light_path, light);
            vertices.put(light_path, &end);
        } else if lengths.at(light_path) != s - 1 {
            continue;
        }
        let y = vertices.at(place.vertex(light_path, s - 1));
        let Some((origin, target)) = segment(scene, &x, &y, t == 1) else {
            continue;
        };
        proposed.put(chain, edges);
        chains.put(queues.segments, chain as u32);
        origins.put(queues.segments, origin);
        targets.put(queues.segments, target);
        queues.segments += 1;
    }
}
