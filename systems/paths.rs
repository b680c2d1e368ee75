//! What systems of whole paths share: reading and writing their vertices, whichever table those are in.

use crate::path::whole::WholeVertex;
use crate::path::{
    Scatterer, VertexArrival, VertexKind, VertexMaterial, VertexNormal, VertexOffset, VertexPosition,
    VertexShadingNormal, VertexTangent, VertexTexture,
};
use crate::table::{Read, Rows, Table, Write};
use bevy_ecs::system::SystemParam;
use glam::{Vec2, Vec3};

/// The columns of vertices in the table marked `T`.
#[derive(SystemParam)]
pub struct Vertices<'w, 's, T: Table> {
    kinds: Read<'w, 's, VertexKind, T>,
    positions: Read<'w, 's, VertexPosition, T>,
    normals: Read<'w, 's, VertexNormal, T>,
    offsets: Read<'w, 's, VertexOffset, T>,
    shading_normals: Read<'w, 's, VertexShadingNormal, T>,
    materials: Read<'w, 's, VertexMaterial, T>,
    arrivals: Read<'w, 's, VertexArrival, T>,
    textures: Read<'w, 's, VertexTexture, T>,
    tangents: Read<'w, 's, VertexTangent, T>,
}

/// [`Vertices`] as slices.
pub struct VertexColumns<'a> {
    kinds: &'a [VertexKind],
    positions: &'a [VertexPosition],
    normals: &'a [VertexNormal],
    offsets: &'a [VertexOffset],
    shading_normals: &'a [VertexShadingNormal],
    materials: &'a [VertexMaterial],
    arrivals: &'a [VertexArrival],
    textures: &'a [VertexTexture],
    tangents: &'a [VertexTangent],
}

impl<T: Table> Vertices<'_, '_, T> {
    /// The columns as slices.
    #[must_use]
    pub fn columns(&self) -> VertexColumns<'_> {
        VertexColumns {
            kinds: self.kinds.rows(),
            positions: self.positions.rows(),
            normals: self.normals.rows(),
            offsets: self.offsets.rows(),
            shading_normals: self.shading_normals.rows(),
            materials: self.materials.rows(),
            arrivals: self.arrivals.rows(),
            textures: self.textures.rows(),
            tangents: self.tangents.rows(),
        }
    }
}

impl VertexColumns<'_> {
    /// The kind of the vertex of this number.
    #[inline]
    #[must_use]
    pub fn kind(&self, vertex: usize) -> u32 {
        self.kinds.at(vertex)
    }

    /// Where it is.
    #[inline]
    #[must_use]
    pub fn position(&self, vertex: usize) -> Vec3 {
        self.positions.at(vertex)
    }

    /// Its material.
    #[inline]
    #[must_use]
    pub fn material(&self, vertex: usize) -> u32 {
        self.materials.at(vertex)
    }

    /// The vertex of this number. Its direction is that in which its own path, or subpath, arrives.
    #[inline]
    #[must_use]
    pub fn at(&self, vertex: usize) -> WholeVertex {
        WholeVertex {
            surface: Scatterer {
                position: self.positions.at(vertex),
                normal: self.normals.at(vertex),
                shading_normal: self.shading_normals.at(vertex),
                offset: self.offsets.at(vertex),
                material: self.materials.at(vertex),
                uv: if self.textures.is_empty() {
                    Vec2::ZERO
                } else {
                    self.textures.at(vertex)
                },
                tangent: if self.tangents.is_empty() {
                    Vec3::ZERO
                } else {
                    self.tangents.at(vertex)
                },
                direction: self.arrivals.at(vertex),
            },
            kind: self.kinds.at(vertex),
        }
    }
}

/// The same to write.
#[derive(SystemParam)]
pub struct VerticesMut<'w, 's, T: Table> {
    kinds: Write<'w, 's, VertexKind, T>,
    positions: Write<'w, 's, VertexPosition, T>,
    normals: Write<'w, 's, VertexNormal, T>,
    offsets: Write<'w, 's, VertexOffset, T>,
    shading_normals: Write<'w, 's, VertexShadingNormal, T>,
    materials: Write<'w, 's, VertexMaterial, T>,
    arrivals: Write<'w, 's, VertexArrival, T>,
    textures: Write<'w, 's, VertexTexture, T>,
    tangents: Write<'w, 's, VertexTangent, T>,
}

/// [`VerticesMut`] as slices.
pub struct VertexColumnsMut<'a> {
    kinds: &'a mut [VertexKind],
    positions: &'a mut [VertexPosition],
    normals: &'a mut [VertexNormal],
    offsets: &'a mut [VertexOffset],
    shading_normals: &'a mut [VertexShadingNormal],
    materials: &'a mut [VertexMaterial],
    arrivals: &'a mut [VertexArrival],
    textures: &'a mut [VertexTexture],
    tangents: &'a mut [VertexTangent],
}

impl<T: Table> VerticesMut<'_, '_, T> {
    /// The columns as slices.
    #[must_use]
    pub fn columns(&mut self) -> VertexColumnsMut<'_> {
        VertexColumnsMut {
            kinds: self.kinds.rows(),
            positions: self.positions.rows(),
            normals: self.normals.rows(),
            offsets: self.offsets.rows(),
            shading_normals: self.shading_normals.rows(),
            materials: self.materials.rows(),
            arrivals: self.arrivals.rows(),
            textures: self.textures.rows(),
            tangents: self.tangents.rows(),
        }
    }
}

impl VertexColumnsMut<'_> {
    /// The columns to read.
    #[inline]
    #[must_use]
    pub const fn shared(&self) -> VertexColumns<'_> {
        VertexColumns {
            kinds: self.kinds,
            positions: self.positions,
            normals: self.normals,
            offsets: self.offsets,
            shading_normals: self.shading_normals,
            materials: self.materials,
            arrivals: self.arrivals,
            textures: self.textures,
            tangents: self.tangents,
        }
    }

    /// The vertex of this number, see [`VertexColumns::at`].
    #[inline]
    #[must_use]
    pub fn at(&self, vertex: usize) -> WholeVertex {
        self.shared().at(vertex)
    }

    /// Writes the kind of the vertex of this number.
    #[inline]
    pub fn put_kind(&mut self, vertex: usize, kind: u32) {
        self.kinds.put(vertex, kind);
    }

    /// Writes the vertex of this number.
    #[inline]
    pub fn put(&mut self, vertex: usize, value: &WholeVertex) {
        let surface = &value.surface;
        self.kinds.put(vertex, value.kind);
        self.positions.put(vertex, surface.position);
        self.normals.put(vertex, surface.normal);
        self.offsets.put(vertex, surface.offset);
        self.shading_normals.put(vertex, surface.shading_normal);
        self.materials.put(vertex, surface.material);
        self.arrivals.put(vertex, surface.direction);
        if !self.textures.is_empty() {
            self.textures.put(vertex, surface.uv);
        }
        if !self.tangents.is_empty() {
            self.tangents.put(vertex, surface.tangent);
        }
    }
}
