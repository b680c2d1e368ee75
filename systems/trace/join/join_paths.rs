//! The one edge that completes a proposed path.

use super::super::super::paths::VerticesMut;
use super::super::super::propose::end_vertex;
use super::super::super::tile::{Queues, SceneRef, TilePlace};
use super::super::draws::Draws;
use crate::geometry::{RayOrigin, SegmentTarget};
use crate::light::Endpoint;
use crate::path::whole::{CameraVertices, KeptFromLight, LightVertices, WholeVertex};
use crate::path::*;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};
use glam::Vec3;

/// What mutations asked for, and what became of it.
#[derive(SystemParam)]
pub struct Made<'w, 's> {
    camera_made: Read<'w, 's, CameraVertices, ChainTable>,
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
    made: Made,
    mut lengths: Write<PathLength, ChainTable>,
    mut proposed: Write<whole::ProposedEdges, ChainTable>,
    mut lights: Write<VertexLight, ProposalTable>,
    mut vertices: VerticesMut<ProposalTable>,
    mut segments: Segments,
) {
    let scene = &*scene.0;
    let draws = draws.columns(&place);
    let (camera_made, light_made, light_kept) =
        (made.camera_made.rows(), made.light_made.rows(), made.light_kept.rows());
    let (lengths, proposed, lights) = (lengths.rows(), proposed.rows(), lights.rows());
    let mut vertices = vertices.columns();
    let (chains, origins, targets) = (segments.chains.rows(), segments.origins.rows(), segments.targets.rows());
    queues.segments = 0;
    for chain in 0..place.chains as usize {
        proposed.put(chain, 0);
        let (t, s) = (camera_made.at(chain), light_made.at(chain));
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
            let Some(sample) = scene.lights.sample(x.surface.position, draw.choice, draw.point) else {
                continue;
            };
            let end = match scene.lights.endpoint(sample.light) {
                Endpoint::Infinite => end_vertex(VERTEX_INFINITE, sample.position, sample.normal, 0.0),
                Endpoint::Point => end_vertex(VERTEX_LIGHT, sample.position, sample.normal, 0.0),
                Endpoint::Surface => {
                    let offset = (sample.target - sample.position).dot(sample.normal);
                    end_vertex(VERTEX_LIGHT, sample.position, sample.normal, offset)
                }
            };
            lengths.put(light_path, 0);
            lights.put(light_path, sample.light);
            vertices.put(light_path, &end);
        } else if lengths.at(light_path) != s - 1 {
            continue;
        }
        let y = vertices.at(place.vertex(light_path, s - 1));
        let Some((origin, target)) = ends(scene, &x, &y, t == 1) else {
            continue;
        };
        proposed.put(chain, edges);
        chains.put(queues.segments, chain as u32);
        origins.put(queues.segments, origin);
        targets.put(queues.segments, target);
        queues.segments += 1;
    }
}

/// Where the segment from `x`, the last vertex of the camera subpath, to `y`, the last of the light subpath, starts and ends.
fn ends(scene: &Scene, x: &WholeVertex, y: &WholeVertex, from_lens: bool) -> Option<(Vec3, Vec3)> {
    if from_lens {
        if y.kind == VERTEX_INFINITE {
            return None;
        }
        let view = scene.camera.project(x.surface.position, y.surface.position)?;
        return Some((y.surface.leaving(-view.direction), view.origin));
    }
    let direction = joining(scene, x, y)?;
    let origin = x.surface.leaving(direction);
    if y.kind == VERTEX_INFINITE {
        return Some((origin, scene.lights.beyond(x.surface.position, direction)));
    }
    Some((origin, y.surface.leaving(-direction)))
}

/// The unit direction of the edge from `x` to `y`; `None` where both are in one place.
#[must_use]
pub fn joining(scene: &Scene, x: &WholeVertex, y: &WholeVertex) -> Option<Vec3> {
    if y.kind == VERTEX_INFINITE {
        return Some(-y.surface.normal);
    }
    if matches!(x.kind, VERTEX_LENS | VERTEX_INFINITE) {
        return Some(scene.camera.project(x.surface.position, y.surface.position)?.direction);
    }
    let span = y.surface.position.as_dvec3() - x.surface.position.as_dvec3();
    let squared = span.length_squared();
    (squared > 0.0).then(|| (span / squared.sqrt()).as_vec3())
}
