//! From a description to shapes in world space.

use super::description::MaterialDescription;
use super::error::SceneWarning;
use super::mesh::Mesh;
use crate::color::Rgb;
use glam::Vec3;

/// A scene's shapes in world space, and the materials that they refer to.
#[derive(Clone, Debug)]
pub struct Flattened {
    /// One per shape of the description, in its order.
    pub instances: Vec<Instance>,
    /// Name and description of every material: those of the scene file in the order of their names, then those that
    /// meshes bring along, in the order of their first use, named `file:material`.
    pub materials: Vec<(String, MaterialDescription)>,
    /// What renders, but probably not as meant.
    pub warnings: Vec<SceneWarning>,
}

/// A shape in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Its name in the description, or `shapes[3]` where it has none.
    pub name: String,
    /// Its geometry.
    pub geometry: Geometry,
    /// What it emits.
    pub emission: Emission,
}

/// The geometry of an instance. World space, scene units.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// Triangles. Quads and boxes are meshes too: 2 and 12 triangles.
    Mesh(Mesh),
    /// A sphere; its geometric normal points outward.
    Sphere {
        /// Its centre.
        center: Vec3,
        /// Its radius, positive.
        radius: f32,
        /// An index into [`Flattened::materials`].
        material: u32,
    },
}

/// Radiance in W sr⁻¹ m⁻², emitted on the side of the geometric normal alone, equally in all directions.
#[derive(Clone, Debug, PartialEq)]
pub enum Emission {
    /// No light.
    None,
    /// The same everywhere, and not black.
    Uniform(Rgb),
    /// One radiance per triangle, in the mesh's order; black for those that do not emit, at least one is not black.
    PerTriangle(Vec<Rgb>),
}

impl Emission {
    /// The radiance that a triangle emits; any index will do for a sphere.
    #[must_use]
    pub fn of(&self, triangle: usize) -> Rgb {
        match self {
            Self::None => Rgb::BLACK,
            Self::Uniform(radiance) => *radiance,
            Self::PerTriangle(radiances) => radiances.get(triangle).copied().unwrap_or(Rgb::BLACK),
        }
    }

    /// Whether nothing is emitted at all.
    #[must_use]
    pub fn is_none(&self) -> bool {
        matches!(self, Self::None)
    }
}
