//! Vertices where rays ended.

use super::super::tile::{Counters, Queues, SceneRef, TilePlace, connectable};
use super::ends::{Arrival, EndColumns, Ends};
use crate::color::Rgb;
use crate::geometry::{Hit, HitInstance, HitPrimitive, HitUv, NO_HIT, NOT_EMITTING};
use crate::layer::VertexConnectionEnd;
use crate::path::mis::Heuristic;
use crate::path::whole::{STEERED, StopDepth, TO_JOINT, stop_depth};
use crate::path::*;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};
use glam::Vec3;

/// What the system reads.
#[derive(SystemParam)]
pub struct Hits<'w, 's> {
    paths: Read<'w, 's, RayChain, RayTable>,
    instances: Read<'w, 's, HitInstance, RayTable>,
    primitives: Read<'w, 's, HitPrimitive, RayTable>,
    uvs: Read<'w, 's, HitUv, RayTable>,
    directions: Read<'w, 's, Direction, ChainTable>,
    stops: Read<'w, 's, StopDepth, ChainTable>,
}

/// The vertex columns that it writes.
#[derive(SystemParam)]
pub struct Vertices<'w, 's> {
    kinds: Write<'w, 's, VertexKind, ProposalTable>,
    positions: Write<'w, 's, VertexPosition, ProposalTable>,
    normals: Write<'w, 's, VertexNormal, ProposalTable>,
    offsets: Write<'w, 's, VertexOffset, ProposalTable>,
    ratios: Write<'w, 's, VertexRatio, ProposalTable>,
    densities: Write<'w, 's, VertexDensity, ProposalTable>,
    emissions: Write<'w, 's, VertexEmission, ProposalTable>,
    connections: Write<'w, 's, VertexConnection, ProposalTable>,
    connection_ends: Write<'w, 's, VertexConnectionEnd, ProposalTable>,
    shading_normals: Write<'w, 's, VertexShadingNormal, ProposalTable>,
    materials: Write<'w, 's, VertexMaterial, ProposalTable>,
    instances: Write<'w, 's, VertexInstance, ProposalTable>,
    primitives: Write<'w, 's, VertexPrimitive, ProposalTable>,
    uvs: Write<'w, 's, VertexUv, ProposalTable>,
    textures: Write<'w, 's, VertexTexture, ProposalTable>,
    tangents: Write<'w, 's, VertexTangent, ProposalTable>,
}

/// The lists that it fills.
#[derive(SystemParam)]
pub struct Lists<'w, 's> {
    connect: Write<'w, 's, ConnectList, ChainTable>,
    scatter: Write<'w, 's, ScatterList, ScatterTable>,
    draw: Write<'w, 's, DrawList, ChainTable>,
}

/// Appends a vertex to every path whose ray met a surface, or, from the camera, a light at infinity. In techniques that find
/// light from the camera alone it has the light that it sends back along the path, weighted against sampling that light; in
/// those with both ends, what their joining will need. Lists the path for connection and scattering if it may grow further; one that
/// its mutation steers, for that mutation.
pub fn extend_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    mut counters: ResMut<Counters>,
    hits: Hits,
    mut lengths: Write<PathLength, ChainTable>,
    mut vertices: Vertices,
    mut ends: Ends,
    mut lists: Lists,
) {
    if !queues.starting {
        queues.draw = 0;
    }
    let run = Run {
        scene: &scene.0,
        place: &place,
        paths: hits.paths.rows(),
        directions: hits.directions.rows(),
        stops: hits.stops.rows(),
        hits: (hits.instances.rows(), hits.primitives.rows(), hits.uvs.rows()),
        lengths: lengths.rows(),
        kinds: vertices.kinds.rows(),
        positions: vertices.positions.rows(),
        normals: vertices.normals.rows(),
        offsets: vertices.offsets.rows(),
        ratios: vertices.ratios.rows(),
        densities: vertices.densities.rows(),
        emissions: vertices.emissions.rows(),
        connections: vertices.connections.rows(),
        connection_ends: vertices.connection_ends.rows(),
        shading_normals: vertices.shading_normals.rows(),
        materials: vertices.materials.rows(),
        names: (
            vertices.instances.rows(),
            vertices.primitives.rows(),
            vertices.uvs.rows(),
        ),
        textures: vertices.textures.rows(),
        tangents: vertices.tangents.rows(),
        connect: lists.connect.rows(),
        scatter: lists.scatter.rows(),
        draw: lists.draw.rows(),
        ends: ends.columns(),
    };
    // Compiled twice: what a scene has none of is not asked about at every vertex.
    if run.is_plain() {
        run.extend(true, &mut queues, &mut counters);
    } else {
        run.extend(false, &mut queues, &mut counters);
    }
    queues.rays = 0;
}

/// One run of the system: its columns as slices.
struct Run<'a> {
    scene: &'a Scene,
    place: &'a TilePlace,
    paths: &'a [RayChain],
    directions: &'a [Direction],
    stops: &'a [StopDepth],
    hits: (&'a [HitInstance], &'a [HitPrimitive], &'a [HitUv]),
    lengths: &'a mut [PathLength],
    kinds: &'a mut [VertexKind],
    positions: &'a mut [VertexPosition],
    normals: &'a mut [VertexNormal],
    offsets: &'a mut [VertexOffset],
    ratios: &'a mut [VertexRatio],
    densities: &'a mut [VertexDensity],
    emissions: &'a mut [VertexEmission],
    connections: &'a mut [VertexConnection],
    connection_ends: &'a mut [VertexConnectionEnd],
    shading_normals: &'a mut [VertexShadingNormal],
    materials: &'a mut [VertexMaterial],
    names: (&'a mut [VertexInstance], &'a mut [VertexPrimitive], &'a mut [VertexUv]),
    textures: &'a mut [VertexTexture],
    tangents: &'a mut [VertexTangent],
    connect: &'a mut [ConnectList],
    scatter: &'a mut [ScatterList],
    draw: &'a mut [DrawList],
    ends: Option<EndColumns<'a>>,
}

impl Run<'_> {
    /// Whether paths come from the camera alone and have neither textures nor tangents nor layers, no light is at infinity, and
    /// surfaces are alike from both sides.
    fn is_plain(&self) -> bool {
        let detailed = !self.textures.is_empty() || !self.tangents.is_empty() || !self.connection_ends.is_empty();
        let (lights, materials) = (&self.scene.lights, &self.scene.materials);
        let special = materials.have_sides() || lights.has_infinite();
        self.place.is_camera_only() && self.ends.is_none() && !special && !detailed
    }

    #[inline(always)]
    fn extend(self, plain: bool, queues: &mut Queues, counters: &mut Counters) {
        let Self {
            scene,
            place,
            paths,
            directions,
            stops,
            hits: (instances, primitives, uvs),
            lengths,
            kinds,
            positions,
            normals,
            offsets,
            ratios,
            densities,
            emissions,
            connections,
            connection_ends,
            shading_normals,
            materials,
            names,
            textures,
            tangents,
            connect,
            scatter,
            draw,
            mut ends,
        } = self;
        let longest = scene.max_depth.min(place.longest);
        for ray in 0..queues.rays {
            let path = paths.at(ray) as usize;
            let from_light = !plain && place.starts_at_light(path);
            let instance = instances.at(ray);
            let escaped = instance == NO_HIT;
            if escaped && (plain || from_light || !scene.lights.has_infinite()) {
                continue;
            }
            let direction = directions.at(path);
            let depth = lengths.at(path) + 1;
            let (previous, vertex) = (place.vertex(path, depth - 1), place.vertex(path, depth));
            lengths.put(path, depth);
            counters.vertices += 1;
            ratios.put(vertex, Rgb::BLACK);
            densities.put(vertex, 0.0);
            if !connections.is_empty() {
                connections.put(vertex, Rgb::BLACK);
            }
            if !plain && !connection_ends.is_empty() {
                connection_ends.put(vertex, 0);
            }
            if !plain && escaped {
                let sampled_before =
                    connectable(kinds.at(previous)).then(|| (positions.at(previous), densities.at(previous)));
                // The vertex has the direction in which its light travels, and no position.
                kinds.put(vertex, VERTEX_INFINITE);
                positions.put(vertex, positions.at(previous));
                normals.put(vertex, -direction);
                offsets.put(vertex, 0.0);
                if !emissions.is_empty() {
                    emissions.put(
                        vertex,
                        met_at_infinity(scene, direction, sampled_before, place.heuristic),
                    );
                }
                if !plain && let Some(ends) = &mut ends {
                    let arrival = Arrival {
                        path,
                        depth,
                        direction,
                        light: NOT_EMITTING,
                    };
                    ends.append(scene, place, &arrival, (kinds, positions, normals, densities));
                }
                continue;
            }
            let hit = Hit {
                instance,
                primitive: primitives.at(ray),
                uv: uvs.at(ray),
            };
            let point = scene.geometry.surface_point(hit);
            kinds.put(vertex, VERTEX_SURFACE);
            positions.put(vertex, point.position);
            normals.put(vertex, point.geometric_normal);
            offsets.put(vertex, point.offset);
            if !emissions.is_empty() {
                let mut emission = Rgb::BLACK;
                if point.light != NOT_EMITTING {
                    emission = scene.lights.radiance(point.light, point.geometric_normal, -direction);
                    if connectable(kinds.at(previous)) {
                        let from = positions.at(previous);
                        let sampled = scene
                            .lights
                            .density(point.light, from, point.position, point.geometric_normal);
                        emission = emission * place.heuristic.share(densities.at(previous), sampled);
                    }
                }
                emissions.put(vertex, emission);
            }
            if !plain && let Some(ends) = &mut ends {
                let arrival = Arrival {
                    path,
                    depth,
                    direction,
                    light: point.light,
                };
                ends.append(scene, place, &arrival, (kinds, positions, normals, densities));
            }
            if shading_normals.is_empty() {
                continue;
            }
            shading_normals.put(vertex, point.shading_normal);
            let mut material = point.material;
            if !plain {
                let front = point.geometric_normal.dot(direction) < 0.0;
                material = scene.materials.facing(material, front);
            }
            materials.put(vertex, material);
            if !names.0.is_empty() {
                names.0.put(vertex, hit.instance);
                names.1.put(vertex, hit.primitive);
                names.2.put(vertex, hit.uv);
            }
            if !(plain || textures.is_empty() && tangents.is_empty()) {
                let local = scene.geometry.texture_point(hit);
                if !textures.is_empty() {
                    textures.put(vertex, local.uv);
                }
                if !tangents.is_empty() {
                    tangents.put(vertex, local.tangent);
                }
            }

            if plain || stops.is_empty() {
                // The lens adds an edge to every light subpath.
                let last = longest - u32::from(from_light);
                if !draw.is_empty() && (depth < last || (from_light && depth == last)) {
                    draw.put(queues.draw, path as u32);
                    queues.draw += 1;
                }
                if depth >= last || place.sought.ends_behind(kinds.at(previous)) {
                    continue;
                }
            } else {
                let stop = stops.at(path);
                let ends_here = stop & TO_JOINT != 0 && !scene.materials.kind(material).has_discrete_lobe();
                if depth >= stop_depth(stop) || ends_here {
                    continue;
                }
                if stop & STEERED != 0 {
                    draw.put(queues.draw, path as u32);
                    queues.draw += 1;
                    continue;
                }
            }
            let kind = scene.materials.kind(material);
            if !kind.is_discrete() && !connections.is_empty() {
                connect.put(queues.connect, path as u32);
                queues.connect += 1;
            }
            if let Some(model) = scene.materials.model(kind) {
                scatter.put(place.vertex(queues.scatter[model], model as u32), path as u32);
                queues.scatter[model] += 1;
            }
        }
    }
}

/// Radiance from all lights at infinity along `-direction`, each weighted against sampling it from the vertex before, which
/// has this position and drew the direction with this density.
pub(super) fn met_at_infinity(
    scene: &Scene,
    direction: Vec3,
    sampled_before: Option<(Vec3, f32)>,
    heuristic: Heuristic,
) -> Rgb {
    let (lights, travel) = (&scene.lights, -direction);
    let mut sum = Rgb::BLACK;
    for light in lights.infinite() {
        let mut emission = lights.radiance(light, travel, travel);
        if let Some((from, density)) = sampled_before {
            let sampled = lights.density(light, from, from, travel);
            emission = emission * heuristic.share(density, sampled);
        }
        sum += emission;
    }
    sum
}
