//! From a description to shapes in world space.

use super::at::At;
use super::description::{MaterialDescription, SceneDescription, ShapeDescription, ShapeKind};
use super::error::{SceneError, SceneWarning};
use super::lights;
use super::mesh::Mesh;
use super::read::SceneSource;
use super::shapes::height_field::{Ground, Heights};
use super::shapes::torus::Torus;
use super::shapes::{cuboid, cylinder, disk, height_field, obj, quad, sphere, torus};
use super::textures;
use super::transform::compose;
use super::validate::validate;
use crate::color::Rgb;
use crate::light::Light;
use crate::texture::Texture;
use glam::{Mat3, Vec3};
use std::sync::Arc;

/// The most primitives of a scene.
pub const MAX_PRIMITIVES: u64 = 1 << 31;

/// A scene's shapes in world space, and the materials that they refer to.
#[derive(Clone, Debug)]
pub struct Flattened {
    /// One per shape of the description, in its order.
    pub instances: Vec<Instance>,
    /// Name and description of every material: those of the scene file in the order of their names, then those that
    /// meshes bring along, in the order of their first use, named `file:material`.
    pub materials: Vec<(String, MaterialDescription)>,
    /// Name and kind of every light of the `lights` block, in its order; the names are `lights[2] (Sun)`.
    pub lights: Vec<(String, Light)>,
    /// Name and texture of every texture that materials of shapes refer to, in the order of their names.
    pub textures: Vec<(String, Arc<Texture>)>,
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
        /// The axes of its own space, of unit length: its texture turns with them.
        frame: Mat3,
        /// An index into [`Flattened::materials`].
        material: u32,
    },
    /// A disk.
    Disk {
        /// Its centre.
        center: Vec3,
        /// Its radius, positive.
        radius: f32,
        /// Unit vectors to the right and up over its texture, and its normal. A mirrored disk's are left-handed.
        frame: Mat3,
        /// An index into [`Flattened::materials`].
        material: u32,
    },
    /// A tube without ends; its geometric normal points outward.
    Cylinder {
        /// The centre of one end.
        from: Vec3,
        /// The centre of the other end; another point.
        to: Vec3,
        /// Its radius, positive.
        radius: f32,
        /// Unit vectors: its texture goes around the second, from the seam at the third, turned around.
        frame: Mat3,
        /// An index into [`Flattened::materials`].
        material: u32,
    },
}

impl Geometry {
    /// Number of triangles; 1 for shapes that are no mesh.
    #[must_use]
    pub fn primitive_count(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.triangles.len(),
            Self::Sphere { .. } | Self::Disk { .. } | Self::Cylinder { .. } => 1,
        }
    }

    /// The material of every primitive.
    #[must_use]
    pub fn materials(&self) -> &[u32] {
        match self {
            Self::Mesh(mesh) => &mesh.materials,
            Self::Sphere { material, .. } | Self::Disk { material, .. } | Self::Cylinder { material, .. } => {
                std::slice::from_ref(material)
            }
        }
    }
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
    /// The same radiance everywhere.
    #[must_use]
    pub fn uniform(radiance: Rgb) -> Self {
        if radiance.is_black() {
            Self::None
        } else {
            Self::Uniform(radiance)
        }
    }

    /// One radiance per triangle.
    #[must_use]
    pub fn per_triangle(radiances: Vec<Rgb>) -> Self {
        match radiances.first() {
            Some(first) if radiances.iter().all(|radiance| radiance == first) => Self::uniform(*first),
            Some(_) => Self::PerTriangle(radiances),
            None => Self::None,
        }
    }

    /// The radiance that a triangle emits; any index will do for a shape that is no mesh.
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

/// Validates a scene, reads the meshes that it names, and places every shape in the world.
///
/// # Errors
/// At the first value out of its range, transform that cannot be applied, or mesh file that cannot be used, with its
/// place in the scene file.
pub fn flatten(source: &SceneSource) -> Result<Flattened, SceneError> {
    let mut warnings = validate(source)?;
    let scene = &source.description;
    let textures = textures::load_used(source, &mut warnings)?;
    let mut materials = Materials::new(scene);
    let shapes = At::root(source).key("shapes");
    let mut instances = Vec::with_capacity(scene.shapes.len());
    let mut primitives = 0;
    for (index, shape) in scene.shapes.iter().enumerate() {
        let at = shapes.index(index);
        let instance = place(&at, index, shape, &mut materials, &mut warnings)?;
        primitives += instance.geometry.primitive_count() as u64;
        if primitives > MAX_PRIMITIVES {
            let message = format!("with this shape the scene has more than {MAX_PRIMITIVES} primitives");
            return Err(at.error(message, "use coarser meshes"));
        }
        let is_bare = matches!(&instance.geometry, Geometry::Mesh(mesh) if mesh.uvs.is_empty());
        if is_bare
            && shape
                .material
                .as_ref()
                .is_some_and(|name| !textures::named_by(scene, name).is_empty())
        {
            let message = "this mesh has no texture coordinates (`vt`): its material shows one point of its texture";
            warnings.push(
                at.key("material")
                    .warning(message, "give the mesh some, or the shape a plain material"),
            );
        }
        instances.push(instance);
    }
    let placed = scene.lights.iter().enumerate().map(|(index, light)| {
        let at = At::root(source).key("lights").index(index);
        Ok((
            format!("lights[{index}] ({})", light.name()),
            lights::place(&at, light)?,
        ))
    });
    let lights = placed.collect::<Result<Vec<_>, SceneError>>()?;
    if instances.iter().all(|instance| instance.emission.is_none()) {
        warnings.extend(darkness(source, &lights));
    }
    Ok(Flattened {
        instances,
        materials: materials.list,
        lights,
        textures,
        warnings,
    })
}

/// What is to be said of a scene where no shape emits, if none of its other lights does.
fn darkness(source: &SceneSource, lights: &[(String, Light)]) -> Option<SceneWarning> {
    let root = At::root(source);
    if lights.is_empty() {
        let message = "nothing in this scene emits light: the picture will be black";
        return Some(
            root.key("shapes")
                .warning(message, "give a shape an `emission: (1, 1, 1)`"),
        );
    }
    lights.iter().all(|(_, light)| light.is_black()).then(|| {
        let message = "no light of this scene has any power: the picture will be black";
        let help =
            "give one an intensity, an irradiance, a radiance or a scale above zero, or a picture that is not black";
        root.key("lights").warning(message, help)
    })
}

fn place(
    at: &At,
    index: usize,
    shape: &ShapeDescription,
    materials: &mut Materials,
    warnings: &mut Vec<SceneWarning>,
) -> Result<Instance, SceneError> {
    let map = compose(&at.key("transform"), &shape.transform)?;
    let material = shape.material.as_deref().and_then(|name| materials.index(name));
    let mut emission = Emission::uniform(shape.emission.unwrap_or(Rgb::BLACK));
    // Validation has seen to it that only a mesh file may come without one.
    let known = material.unwrap_or_default();
    let geometry = match &shape.shape {
        ShapeKind::Quad { corner, edge_u, edge_v } => {
            Geometry::Mesh(quad::mesh(at, *corner, [*edge_u, *edge_v], &map, known)?)
        }
        ShapeKind::Box { min, max } => Geometry::Mesh(cuboid::mesh(at, *min, *max, &map, known)?),
        ShapeKind::Sphere { center, radius } => sphere::geometry(at, *center, *radius, &map, known)?,
        ShapeKind::Disk { center, normal, radius } => disk::geometry(at, *center, *normal, *radius, &map, known)?,
        ShapeKind::Cylinder { from, to, radius } => cylinder::geometry(at, [*from, *to], *radius, &map, known)?,
        ShapeKind::Torus {
            center,
            axis,
            major_radius,
            minor_radius,
            segments,
        } => {
            let torus = Torus {
                center: *center,
                axis: *axis,
                major_radius: *major_radius,
                minor_radius: *minor_radius,
                segments: *segments,
            };
            Geometry::Mesh(torus::mesh(at, torus, &map, known)?)
        }
        ShapeKind::HeightField {
            file,
            heights,
            corner,
            edge_u,
            edge_v,
            height,
        } => {
            let ground = Ground {
                corner: *corner,
                edge_u: *edge_u,
                edge_v: *edge_v,
                height: *height,
            };
            // Validation has seen to it that there is one of the two.
            let heights = match file {
                Some(file) => Heights::read(&at.key("shape").variant("HeightField").key("file"), file)?,
                None => Heights::listed(heights.as_deref().unwrap_or_default()),
            };
            Geometry::Mesh(height_field::mesh(at, &heights, &ground, &map, known)?)
        }
        ShapeKind::Obj { file, smooth } => {
            let at = at.key("shape").variant("Obj").key("file");
            let loaded = obj::load(&at, file, *smooth, &map, material, materials)?;
            warnings.extend(loaded.warnings);
            if shape.emission.is_none() {
                emission = loaded.emission;
            }
            Geometry::Mesh(loaded.mesh)
        }
    };
    let name = shape.name.clone().unwrap_or_else(|| format!("shapes[{index}]"));
    Ok(Instance {
        name,
        geometry,
        emission,
    })
}

/// The growing list of materials.
pub(super) struct Materials {
    list: Vec<(String, MaterialDescription)>,
    /// How many stand in the scene file: the first ones, sorted by name.
    described: usize,
}

impl Materials {
    fn new(scene: &SceneDescription) -> Self {
        let entries = scene.materials.iter();
        let list: Vec<_> = entries
            .map(|(name, material)| (name.clone(), material.clone()))
            .collect();
        Self {
            described: list.len(),
            list,
        }
    }

    fn index(&self, name: &str) -> Option<u32> {
        let found = self.list[..self.described].binary_search_by(|(known, _)| known.as_str().cmp(name));
        found.ok().map(|index| index as u32)
    }

    /// The index of a material that a mesh brings along; the same material of the same file is listed once.
    pub(super) fn add(&mut self, name: String, material: &MaterialDescription) -> u32 {
        let entry = (name, material.clone());
        let brought = &self.list[self.described..];
        let index = brought
            .iter()
            .position(|known| *known == entry)
            .unwrap_or(brought.len())
            + self.described;
        if index == self.list.len() {
            self.list.push(entry);
        }
        index as u32
    }
}
