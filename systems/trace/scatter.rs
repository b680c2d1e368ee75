//! What the scatter systems share: reading the surface point that a path stands on, and writing where it goes on.

use super::super::tile::{Queues, TilePlace};
use crate::material::{Scattered, Transport};
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::SystemParam;
use glam::{Vec2, Vec3};

/// The columns that describe the surface point a path stands on.
#[derive(SystemParam)]
pub struct Scatterers<'w, 's> {
    lengths: Read<'w, 's, PathLength, ChainTable>,
    directions: Read<'w, 's, Direction, ChainTable>,
    surface: Surface<'w, 's>,
}

/// The surface point's columns in the vertex table.
#[derive(SystemParam)]
pub struct Surface<'w, 's> {
    positions: Read<'w, 's, VertexPosition, ProposalTable>,
    normals: Read<'w, 's, VertexNormal, ProposalTable>,
    shading_normals: Read<'w, 's, VertexShadingNormal, ProposalTable>,
    offsets: Read<'w, 's, VertexOffset, ProposalTable>,
    materials: Read<'w, 's, VertexMaterial, ProposalTable>,
    uvs: Read<'w, 's, VertexTexture, ProposalTable>,
    tangents: Read<'w, 's, VertexTangent, ProposalTable>,
}

/// [`Scatterers`] as slices.
pub struct ScattererColumns<'a> {
    lengths: &'a [PathLength],
    directions: &'a [Direction],
    surface: SurfaceColumns<'a>,
}

/// [`Surface`] as slices.
pub struct SurfaceColumns<'a> {
    positions: &'a [VertexPosition],
    normals: &'a [VertexNormal],
    shading_normals: &'a [VertexShadingNormal],
    offsets: &'a [VertexOffset],
    materials: &'a [VertexMaterial],
    uvs: &'a [VertexTexture],
    tangents: &'a [VertexTangent],
}

impl Surface<'_, '_> {
    /// The columns as slices.
    pub fn columns(&self) -> SurfaceColumns<'_> {
        SurfaceColumns {
            positions: self.positions.rows(),
            normals: self.normals.rows(),
            shading_normals: self.shading_normals.rows(),
            offsets: self.offsets.rows(),
            materials: self.materials.rows(),
            uvs: self.uvs.rows(),
            tangents: self.tangents.rows(),
        }
    }
}

impl Scatterers<'_, '_> {
    /// The columns as slices.
    pub fn columns(&self) -> ScattererColumns<'_> {
        ScattererColumns {
            lengths: self.lengths.rows(),
            directions: self.directions.rows(),
            surface: self.surface.columns(),
        }
    }
}

impl SurfaceColumns<'_> {
    /// Whether surface points have neither texture coordinates nor tangents.
    #[inline]
    #[must_use]
    pub const fn is_plain(&self) -> bool {
        self.uvs.is_empty() && self.tangents.is_empty()
    }

    /// The surface point of a vertex, where a path arrives in `direction`. `plain` says that [`is_plain`](Self::is_plain) is
    /// known to hold.
    #[inline(always)]
    pub fn at(&self, plain: bool, vertex: usize, direction: Vec3) -> Scatterer {
        Scatterer {
            position: self.positions.at(vertex),
            normal: self.normals.at(vertex),
            shading_normal: self.shading_normals.at(vertex),
            offset: self.offsets.at(vertex),
            material: self.materials.at(vertex),
            uv: if plain || self.uvs.is_empty() {
                Vec2::ZERO
            } else {
                self.uvs.at(vertex)
            },
            tangent: if plain || self.tangents.is_empty() {
                Vec3::ZERO
            } else {
                self.tangents.at(vertex)
            },
            direction,
        }
    }
}

impl ScattererColumns<'_> {
    /// Whether surface points have neither texture coordinates nor tangents.
    #[inline]
    #[must_use]
    pub const fn is_plain(&self) -> bool {
        self.surface.is_plain()
    }

    /// Depth, vertex number and surface point of a path's last vertex.
    #[inline(always)]
    pub fn at(&self, plain: bool, place: &TilePlace, path: usize) -> (u32, usize, Scatterer) {
        let depth = self.lengths.at(path);
        let vertex = place.vertex(path, depth);
        (depth, vertex, self.surface.at(plain, vertex, self.directions.at(path)))
    }
}

/// The columns that scattering writes.
#[derive(SystemParam)]
pub struct Outcomes<'w, 's> {
    lengths: Read<'w, 's, PathLength, ChainTable>,
    surface: Surface<'w, 's>,
    kinds: Write<'w, 's, VertexKind, ProposalTable>,
    ratios: Write<'w, 's, VertexRatio, ProposalTable>,
    densities: Write<'w, 's, VertexDensity, ProposalTable>,
    reverses: Write<'w, 's, VertexReverse, ProposalTable>,
    directions: Write<'w, 's, Direction, ChainTable>,
    throughputs: Write<'w, 's, Throughput, ChainTable>,
    scales: Write<'w, 's, RadianceScale, ChainTable>,
    scattered: Write<'w, 's, ScatteredList, ChainTable>,
}

impl Outcomes<'_, '_> {
    /// Scatters the listed paths, `count` of them: `sample` draws a direction for a surface point, a local incoming
    /// direction, a path, a depth, and what the path carries. A path that is absorbed, or whose direction leaks through the
    /// surface, ends.
    #[inline]
    pub fn scatter(
        &mut self,
        place: &TilePlace,
        queues: &mut Queues,
        count: usize,
        list: impl Fn(usize) -> u32,
        sample: impl Fn(&Scatterer, Vec3, usize, u32, Transport) -> Option<Scattered>,
    ) {
        let run = Run {
            place,
            lengths: self.lengths.rows(),
            surface: self.surface.columns(),
            kinds: self.kinds.rows(),
            ratios: self.ratios.rows(),
            densities: self.densities.rows(),
            reverses: self.reverses.rows(),
            directions: self.directions.rows(),
            throughputs: self.throughputs.rows(),
            scales: self.scales.rows(),
            scattered: self.scattered.rows(),
        };
        // Compiled twice: what a scene has none of is not asked about at every vertex.
        if place.is_camera_only() && run.surface.is_plain() && run.reverses.is_empty() {
            run.scatter(true, queues, count, list, sample);
        } else {
            run.scatter(false, queues, count, list, sample);
        }
    }
}

/// One run of a scatter system: its columns as slices.
struct Run<'a> {
    place: &'a TilePlace,
    lengths: &'a [PathLength],
    surface: SurfaceColumns<'a>,
    kinds: &'a mut [VertexKind],
    ratios: &'a mut [VertexRatio],
    densities: &'a mut [VertexDensity],
    reverses: &'a mut [VertexReverse],
    directions: &'a mut [Direction],
    throughputs: &'a mut [Throughput],
    scales: &'a mut [RadianceScale],
    scattered: &'a mut [ScatteredList],
}

impl Run<'_> {
    #[inline(always)]
    fn scatter(
        self,
        plain: bool,
        queues: &mut Queues,
        count: usize,
        list: impl Fn(usize) -> u32,
        sample: impl Fn(&Scatterer, Vec3, usize, u32, Transport) -> Option<Scattered>,
    ) {
        let Self {
            place,
            lengths,
            surface,
            kinds,
            ratios,
            densities,
            reverses,
            directions,
            throughputs,
            scales,
            scattered,
        } = self;
        for entry in 0..count {
            let path = list(entry) as usize;
            let depth = lengths.at(path);
            let vertex = place.vertex(path, depth);
            let scatterer = surface.at(plain, vertex, directions.at(path));
            let transport = if !plain && place.starts_at_light(path) {
                Transport::Importance
            } else {
                Transport::Radiance
            };
            let Some((direction, outcome)) =
                scatterer.scatter(transport, |wi| sample(&scatterer, wi, path, depth, transport))
            else {
                continue;
            };
            if outcome.discrete {
                kinds.put(vertex, VERTEX_DISCRETE);
            }
            ratios.put(vertex, outcome.ratio);
            densities.put(vertex, outcome.density);
            if !plain && !reverses.is_empty() {
                reverses.put(vertex, outcome.reverse);
            }
            directions.put(path, direction);
            if plain || !throughputs.is_empty() {
                throughputs.put(path, throughputs.at(path) * outcome.ratio);
            }
            // Of light that travels along the path, refraction takes none away.
            if !scales.is_empty() && transport == Transport::Radiance {
                scales.put(path, scales.at(path) * (outcome.relative_ior * outcome.relative_ior));
            }
            scattered.put(queues.scattered, path as u32);
            queues.scattered += 1;
        }
    }
}
