//! A path as a proposal holds it: vertices, and what each adds to the path's light.

use super::number::number;
use crate::color::Rgb;
use crate::path::*;
use crate::render::TileWorld;
use crate::scene::Scene;
use crate::systems::tile::TilePlace;
use serde::Serialize;

/// A vertex of a path.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Vertex {
    /// Edges between it and the camera.
    pub depth: u32,
    /// What it is: `lens`, `light` (where a light subpath starts), `surface` (scatters with a density, or ends the path),
    /// `discrete` (scatters into one of a few directions) or `infinite` (a direction without a position).
    pub kind: &'static str,
    /// World-space position.
    pub position: [f32; 3],
    /// The surface that it is on; none for the lens.
    pub surface: Option<Surface>,
    /// f · |cos| / p of scattering, and of surviving roulette there. Black where the path is absorbed or as long as paths can
    /// be.
    #[serde(serialize_with = "number")]
    pub ratio: Rgb,
    /// Density of the direction sampled there, per solid angle; a probability if the vertex is discrete.
    #[serde(serialize_with = "number")]
    pub density: f32,
    /// Radiance emitted back along the path, weighted against sampling the light.
    #[serde(serialize_with = "number")]
    pub emission: Rgb,
    /// Light connected to, divided by its density and weighted against meeting it; none where the plan connects to none.
    #[serde(serialize_with = "number")]
    pub connection: Option<Rgb>,
    /// The product of the ratios before it.
    #[serde(serialize_with = "number")]
    pub throughput: Rgb,
    /// What it adds to the path's light: throughput times emission and connection.
    #[serde(serialize_with = "number")]
    pub light: Rgb,
}

/// The surface at a vertex. What a plan without scattering does not keep is not there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Surface {
    /// Unit geometric normal, world space.
    pub normal: [f32; 3],
    /// Unit shading normal, world space.
    pub shading_normal: Option<[f32; 3]>,
    /// Number of the shape, in the order of the scene.
    pub instance: Option<u32>,
    /// Name of the shape.
    pub shape: Option<String>,
    /// Number of the primitive inside the shape.
    pub primitive: Option<u32>,
    /// Coordinates on the primitive.
    pub uv: Option<[f64; 2]>,
    /// Name of the material.
    pub material: Option<String>,
}

/// The vertices of a subpath of the only chain in `world`, and the light that they add up to: the sum
/// of [`Vertex::light`] in the order and the arithmetic of the evaluate stage, before anything is made of values that are
/// not finite.
pub(super) fn vertices(world: &mut TileWorld, scene: &Scene, subpath: Option<usize>) -> (Vec<Vertex>, Rgb) {
    let nothing = || (Vec::new(), Rgb::BLACK);
    let Some(subpath) = subpath else { return nothing() };
    let length = world.at::<PathLength, ChainTable>(subpath);
    let Some(length) = length.filter(|&length| length != NO_SUBPATH) else {
        return nothing();
    };
    let place = *world.world().resource::<TilePlace>();
    let mut path: Vec<Vertex> = Vec::new();
    let (mut sum, mut throughput) = (Rgb::BLACK, Rgb::ONE);
    for depth in 0..=length {
        let index = place.vertex(subpath, depth);
        if let Some(previous) = path.last() {
            throughput *= previous.ratio;
        }
        let mut vertex = vertex(world, scene, depth, index);
        vertex.throughput = throughput;
        if depth > 0 {
            let met = throughput * vertex.emission;
            sum += met;
            vertex.light = met;
            if let Some(connection) = vertex.connection {
                let connected = throughput * connection;
                sum += connected;
                vertex.light += connected;
            }
        }
        path.push(vertex);
    }
    (path, sum)
}

/// The vertex of number `index`, without what depends on those before it.
fn vertex(world: &mut TileWorld, scene: &Scene, depth: u32, index: usize) -> Vertex {
    let on_surface = depth > 0;
    let light = |value: Option<Rgb>| value.filter(|_| on_surface);
    Vertex {
        depth,
        kind: match world.at::<VertexKind, ProposalTable>(index) {
            Some(VERTEX_DISCRETE) => "discrete",
            Some(VERTEX_LENS) => "lens",
            Some(VERTEX_LIGHT) => "light",
            Some(VERTEX_INFINITE) => "infinite",
            _ => "surface",
        },
        position: world
            .at::<VertexPosition, ProposalTable>(index)
            .unwrap_or_default()
            .to_array(),
        surface: on_surface.then(|| surface(world, scene, index)),
        ratio: world.at::<VertexRatio, ProposalTable>(index).unwrap_or(Rgb::BLACK),
        density: if on_surface {
            world.at::<VertexDensity, ProposalTable>(index).unwrap_or_default()
        } else {
            0.0
        },
        emission: light(world.at::<VertexEmission, ProposalTable>(index)).unwrap_or(Rgb::BLACK),
        connection: light(world.at::<VertexConnection, ProposalTable>(index)),
        throughput: Rgb::ONE,
        light: Rgb::BLACK,
    }
}

fn surface(world: &mut TileWorld, scene: &Scene, index: usize) -> Surface {
    let instance = world.at::<VertexInstance, ProposalTable>(index);
    let material = world.at::<VertexMaterial, ProposalTable>(index);
    Surface {
        normal: world
            .at::<VertexNormal, ProposalTable>(index)
            .unwrap_or_default()
            .to_array(),
        shading_normal: world
            .at::<VertexShadingNormal, ProposalTable>(index)
            .map(|normal| normal.to_array()),
        instance,
        shape: instance.and_then(|number| scene.instance_names.get(number as usize).cloned()),
        primitive: world.at::<VertexPrimitive, ProposalTable>(index),
        uv: world.at::<VertexUv, ProposalTable>(index).map(|uv| uv.to_array()),
        material: material
            .filter(|&number| (number as usize) < scene.materials.len())
            .map(|number| scene.materials.name(number).to_owned()),
    }
}
