//! From flattened shapes to the read-only tables that rendering walks.

use super::flatten::{Emission, Flattened, Geometry as Shape};
use super::{Mesh, SceneDescription};
use crate::camera::Camera;
use crate::color::Rgb;
use crate::film::{Filter, FilterError};
use crate::geometry::{Geometry, Instance, InstanceShape, NOT_EMITTING};
use crate::light::{Emitter, EmitterShape, LightTable};
use crate::material::MaterialTable;
use std::f32::consts::PI;
use std::sync::Arc;

/// A scene as rendering sees it: tables only, never written to.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Shapes and the tree over them.
    pub geometry: Geometry,
    /// Materials that some shape uses.
    pub materials: MaterialTable,
    /// Everything that emits.
    pub lights: LightTable,
    /// The camera.
    pub camera: Camera,
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// The reconstruction filter.
    pub filter: Filter,
    /// The most edges of a path: 1 shows emitters seen directly, 2 adds direct light.
    pub max_depth: u32,
    /// Names of the shapes that emit.
    pub light_names: Vec<String>,
    /// Names of all instances, by number.
    pub instance_names: Vec<String>,
}

/// What the command line says about a scene, beyond its file.
#[derive(Clone, Copy, Debug, Default)]
pub struct SceneOverrides {
    /// Film size in pixels instead of the file's.
    pub size: Option<(u32, u32)>,
    /// The most edges of a path instead of the file's.
    pub max_depth: Option<u32>,
}

impl Scene {
    /// Compiles a validated description and its flattened shapes into tables, and builds the tree.
    ///
    /// # Errors
    /// A reconstruction filter that cannot be sampled.
    pub fn compile(
        description: &SceneDescription,
        flattened: &Flattened,
        overrides: SceneOverrides,
    ) -> Result<Self, FilterError> {
        let (width, height) = overrides
            .size
            .unwrap_or((description.film.width, description.film.height));
        let filter = Filter::new(&description.film.filter)?;
        let mut tables = Tables::new(flattened);
        for instance in &flattened.instances {
            match &instance.geometry {
                Shape::Mesh(mesh) => tables.add_mesh(mesh, &instance.emission),
                Shape::Sphere {
                    center,
                    radius,
                    material,
                } => {
                    tables.add_sphere(*center, *radius, *material, instance.emission.of(0));
                }
            }
        }
        tables.geometry.build_tree();
        let lit = flattened
            .instances
            .iter()
            .filter(|instance| !instance.emission.is_none());
        Ok(Self {
            geometry: tables.geometry,
            materials: tables.materials,
            lights: LightTable::new(tables.emitters),
            camera: Camera::new(&description.camera, width, height),
            width,
            height,
            filter,
            max_depth: overrides.max_depth.unwrap_or(description.settings.max_depth),
            light_names: lit.map(|instance| instance.name.clone()).collect(),
            instance_names: flattened.instances.iter().map(|i| i.name.clone()).collect(),
        })
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixel_count(&self) -> u32 {
        self.width * self.height
    }
}

/// Tables while they grow.
struct Tables {
    geometry: Geometry,
    materials: MaterialTable,
    emitters: Vec<Emitter>,
    /// From a flattened material's number to that of the compiled table, which holds only used ones.
    numbers: Vec<Option<u32>>,
}

impl Tables {
    fn new(flattened: &Flattened) -> Self {
        let mut used = vec![false; flattened.materials.len()];
        for instance in &flattened.instances {
            match &instance.geometry {
                Shape::Mesh(mesh) => mesh
                    .materials
                    .iter()
                    .for_each(|&material| used[material as usize] = true),
                Shape::Sphere { material, .. } => used[*material as usize] = true,
            }
        }
        let mut materials = MaterialTable::default();
        for (name, texture) in &flattened.textures {
            materials.textures.push(name.clone(), Arc::clone(texture));
        }
        let numbers = flattened
            .materials
            .iter()
            .zip(used)
            .map(|((name, description), used)| used.then(|| materials.push(name.clone(), description)))
            .collect();
        Self {
            geometry: Geometry::default(),
            materials,
            emitters: Vec::new(),
            numbers,
        }
    }

    fn add_mesh(&mut self, mesh: &Mesh, emission: &Emission) {
        let geometry = &mut self.geometry;
        let first_primitive = geometry.materials.len() as u32;
        geometry.instances.push(Instance {
            shape: InstanceShape::Mesh {
                first_triangle: geometry.triangles.len() as u32,
                triangle_count: mesh.triangles.len() as u32,
                first_vertex: geometry.positions.len() as u32,
                first_normal: (!mesh.normals.is_empty()).then_some(geometry.normals.len() as u32),
            },
            first_primitive,
        });
        geometry.positions.extend_from_slice(&mesh.positions);
        geometry.normals.extend_from_slice(&mesh.normals);
        geometry.triangles.extend_from_slice(&mesh.triangles);
        for (triangle, &material) in mesh.materials.iter().enumerate() {
            let emitter = Emitter {
                shape: EmitterShape::Triangle(mesh.corners(triangle)),
                radiance: emission.of(triangle),
                area: mesh.area(triangle),
            };
            self.add_primitive(material, emitter);
        }
    }

    fn add_sphere(&mut self, center: glam::Vec3, radius: f32, material: u32, radiance: Rgb) {
        let first_primitive = self.geometry.materials.len() as u32;
        self.geometry.instances.push(Instance {
            shape: InstanceShape::Sphere { center, radius },
            first_primitive,
        });
        let shape = EmitterShape::Sphere { center, radius };
        self.add_primitive(
            material,
            Emitter {
                shape,
                radiance,
                area: 4.0 * PI * radius * radius,
            },
        );
    }

    fn add_primitive(&mut self, material: u32, emitter: Emitter) {
        // Every material that a primitive names was marked as used.
        self.geometry.materials.extend(self.numbers[material as usize]);
        if emitter.radiance.is_black() {
            self.geometry.lights.push(NOT_EMITTING);
        } else {
            self.geometry.lights.push(self.emitters.len() as u32);
            self.emitters.push(emitter);
        }
    }
}
