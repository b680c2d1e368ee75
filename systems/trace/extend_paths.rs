//! Vertices where rays ended.

use super::super::tile::{Counters, Queues, SceneRef, TilePlace, connectable};
use crate::color::Rgb;
use crate::geometry::{Hit, HitInstance, HitPrimitive, HitUv, NO_HIT, NOT_EMITTING};
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};

/// What the system reads.
#[derive(SystemParam)]
pub struct Hits<'w, 's> {
    chains: Read<'w, 's, RayChain, RayTable>,
    instances: Read<'w, 's, HitInstance, RayTable>,
    primitives: Read<'w, 's, HitPrimitive, RayTable>,
    uvs: Read<'w, 's, HitUv, RayTable>,
    directions: Read<'w, 's, Direction, ChainTable>,
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

/// Appends a vertex to every chain whose ray met a surface, with the light that the surface sends back along the path,
/// weighted against sampling that light; lists the chain for connection and scattering if its path may grow further.
pub fn extend_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    mut counters: ResMut<Counters>,
    hits: Hits,
    mut lengths: Write<PathLength, ChainTable>,
    mut vertices: Vertices,
    mut lists: Lists,
) {
    let scene = &*scene.0;
    queues.draw = 0;
    let (chains, directions) = (hits.chains.rows(), hits.directions.rows());
    let (instances, primitives, uvs) = (hits.instances.rows(), hits.primitives.rows(), hits.uvs.rows());
    let lengths = lengths.rows();
    let (kinds, positions, normals) = (
        vertices.kinds.rows(),
        vertices.positions.rows(),
        vertices.normals.rows(),
    );
    let (offsets, ratios, densities) = (
        vertices.offsets.rows(),
        vertices.ratios.rows(),
        vertices.densities.rows(),
    );
    let (emissions, connections) = (vertices.emissions.rows(), vertices.connections.rows());
    let (shading_normals, materials) = (vertices.shading_normals.rows(), vertices.materials.rows());
    let names = (
        vertices.instances.rows(),
        vertices.primitives.rows(),
        vertices.uvs.rows(),
    );
    let (textures, tangents) = (vertices.textures.rows(), vertices.tangents.rows());
    let (connect, draw, scatter) = (lists.connect.rows(), lists.draw.rows(), lists.scatter.rows());
    for ray in 0..queues.rays {
        let instance = instances.at(ray);
        if instance == NO_HIT {
            continue;
        }
        let hit = Hit {
            instance,
            primitive: primitives.at(ray),
            uv: uvs.at(ray),
        };
        let point = scene.geometry.surface_point(hit);
        let chain = chains.at(ray) as usize;
        let direction = directions.at(chain);
        let depth = lengths.at(chain) + 1;
        let (previous, vertex) = (place.vertex(chain, depth - 1), place.vertex(chain, depth));
        lengths.put(chain, depth);
        counters.vertices += 1;

        let mut emission = Rgb::BLACK;
        if point.light != NOT_EMITTING {
            emission = scene.lights.radiance(point.light, point.geometric_normal, -direction);
            if connectable(kinds.at(previous)) {
                let from = positions.at(previous);
                let sampled = scene
                    .lights
                    .density(point.light, from, point.position, point.geometric_normal);
                emission = emission * mis::power_heuristic(densities.at(previous), sampled);
            }
        }
        kinds.put(vertex, VERTEX_SURFACE);
        positions.put(vertex, point.position);
        normals.put(vertex, point.geometric_normal);
        offsets.put(vertex, point.offset);
        ratios.put(vertex, Rgb::BLACK);
        densities.put(vertex, 0.0);
        emissions.put(vertex, emission);
        if !connections.is_empty() {
            connections.put(vertex, Rgb::BLACK);
        }
        if shading_normals.is_empty() {
            continue;
        }
        shading_normals.put(vertex, point.shading_normal);
        let front = point.geometric_normal.dot(direction) < 0.0;
        let material = scene.materials.facing(point.material, front);
        materials.put(vertex, material);
        names.0.put(vertex, hit.instance);
        names.1.put(vertex, hit.primitive);
        names.2.put(vertex, hit.uv);
        if !(textures.is_empty() && tangents.is_empty()) {
            let local = scene.geometry.texture_point(hit);
            if !textures.is_empty() {
                textures.put(vertex, local.uv);
            }
            if !tangents.is_empty() {
                tangents.put(vertex, local.tangent);
            }
        }

        if depth >= scene.max_depth {
            continue;
        }
        if !draw.is_empty() {
            draw.put(queues.draw, chain as u32);
            queues.draw += 1;
        }
        let kind = scene.materials.kind(material);
        if !kind.is_discrete() && !connections.is_empty() {
            connect.put(queues.connect, chain as u32);
            queues.connect += 1;
        }
        if let Some(model) = scene.materials.model(kind) {
            scatter.put(place.vertex(queues.scatter[model], model as u32), chain as u32);
            queues.scatter[model] += 1;
        }
    }
    queues.rays = 0;
}
