//! From flattened shapes to the read-only tables that rendering walks.

use super::flatten::{Emission, Flattened, Geometry as Shape};
use super::{Mesh, SceneDescription};
use crate::camera::Camera;
use crate::color::Rgb;
use crate::film::{Filter, FilterError};
use crate::geometry::{BoundingSphere, Geometry, Instance, InstanceShape, NOT_EMITTING};
use crate::light::{Emitter, EmitterShape, LightTable};
use crate::material::MaterialTable;
use glam::Mat3;
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
    /// Names of the shapes that emit, then of the lights that are no shapes.
    pub light_names: Vec<String>,
    /// Names of all instances, by number.
    pub instance_names: Vec<String>,
    /// Primitives that do nothing to light, and are not there.
    pub null_primitives: u64,
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
            tables.add(&instance.geometry, &instance.emission);
        }
        tables.geometry.build_tree();
        let lit = flattened
            .instances
            .iter()
            .filter(|instance| !instance.emission.is_none());
        let sphere = bounding_sphere(&tables.geometry);
        let others = flattened.lights.iter().map(|(_, light)| light);
        let named = flattened.lights.iter().map(|(name, _)| name);
        Ok(Self {
            geometry: tables.geometry,
            materials: tables.materials,
            lights: LightTable::with_lights(tables.emitters, others.cloned().collect(), sphere),
            camera: Camera::new(&description.camera, width, height),
            width,
            height,
            filter,
            max_depth: overrides.max_depth.unwrap_or(description.settings.max_depth),
            light_names: lit.map(|instance| &instance.name).chain(named).cloned().collect(),
            null_primitives: tables.left_out,
            instance_names: flattened.instances.iter().map(|i| i.name.clone()).collect(),
        })
    }

    /// A sphere that no shape reaches out of.
    #[must_use]
    pub fn bounding_sphere(&self) -> BoundingSphere {
        bounding_sphere(&self.geometry)
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixel_count(&self) -> u32 {
        self.width * self.height
    }
}

fn bounding_sphere(geometry: &Geometry) -> BoundingSphere {
    let bounds = geometry.bounds();
    bounds.map_or_else(BoundingSphere::default, |(least, most)| {
        BoundingSphere::around(least, most)
    })
}

/// Tables while they grow.
struct Tables {
    geometry: Geometry,
    materials: MaterialTable,
    emitters: Vec<Emitter>,
    /// From a flattened material's number to that of the compiled table, which holds only used ones.
    numbers: Vec<Option<u32>>,
    /// Flattened materials that do nothing to light: surfaces of them that do not emit are left out.
    null: Vec<bool>,
    left_out: u64,
}

impl Tables {
    fn new(flattened: &Flattened) -> Self {
        let null: Vec<bool> = flattened.materials.iter().map(|(_, m)| m.is_null()).collect();
        let mut used = vec![false; flattened.materials.len()];
        for instance in &flattened.instances {
            for (primitive, &material) in instance.geometry.materials().iter().enumerate() {
                used[material as usize] |= !(null[material as usize] && instance.emission.of(primitive).is_black());
            }
        }
        let named = |name: &str| {
            let found = flattened.materials.iter().find(|(known, _)| known == name);
            found.map(|(_, description)| description)
        };
        let mut materials = MaterialTable::default();
        for (name, texture) in &flattened.textures {
            materials.textures.push(name.clone(), Arc::clone(texture));
        }
        let numbers = flattened
            .materials
            .iter()
            .zip(used)
            .map(|((name, description), used)| used.then(|| materials.push(name.clone(), description, named)))
            .collect();
        Self {
            geometry: Geometry::default(),
            materials,
            emitters: Vec::new(),
            numbers,
            null,
            left_out: 0,
        }
    }

    /// Whether a primitive of this material and with this emission is not there.
    fn leaves_out(&mut self, material: u32, radiance: Rgb) -> bool {
        let out = self.null[material as usize] && radiance.is_black();
        self.left_out += u64::from(out);
        out
    }

    fn add(&mut self, shape: &Shape, emission: &Emission) {
        let radiance = emission.of(0);
        match *shape {
            Shape::Mesh(ref mesh) => self.add_mesh(mesh, emission),
            Shape::Sphere {
                center,
                radius,
                frame,
                material,
            } => {
                let emitter = Emitter {
                    shape: EmitterShape::Sphere { center, radius },
                    radiance,
                    area: 4.0 * PI * radius * radius,
                };
                self.add_round(InstanceShape::Sphere { center, radius }, frame, material, emitter);
            }
            Shape::Disk {
                center,
                radius,
                frame,
                material,
            } => {
                let normal = frame.z_axis;
                let emitter = Emitter {
                    shape: EmitterShape::Disk { center, normal, radius },
                    radiance,
                    area: PI * radius * radius,
                };
                self.add_round(InstanceShape::Disk { center, normal, radius }, frame, material, emitter);
            }
            Shape::Cylinder {
                from,
                to,
                radius,
                frame,
                material,
            } => {
                let length = to.as_dvec3().distance(from.as_dvec3()) as f32;
                let emitter = Emitter {
                    shape: EmitterShape::Cylinder { from, to, radius },
                    radiance,
                    area: 2.0 * PI * radius * length,
                };
                self.add_round(InstanceShape::Cylinder { from, to, radius }, frame, material, emitter);
            }
        }
    }

    fn add_mesh(&mut self, mesh: &Mesh, emission: &Emission) {
        let kept: Vec<usize> = (0..mesh.triangles.len())
            .filter(|&triangle| !self.leaves_out(mesh.materials[triangle], emission.of(triangle)))
            .collect();
        let textured = self.needs_frames();
        let geometry = &mut self.geometry;
        let first_primitive = geometry.materials.len() as u32;
        let has_uvs = textured && !mesh.uvs.is_empty();
        geometry.instances.push(Instance {
            shape: InstanceShape::Mesh {
                first_triangle: geometry.triangles.len() as u32,
                triangle_count: kept.len() as u32,
                first_vertex: geometry.positions.len() as u32,
                first_normal: (!mesh.normals.is_empty()).then_some(geometry.normals.len() as u32),
                first_uv: has_uvs.then_some(geometry.uvs.len() as u32),
            },
            first_primitive,
        });
        if textured {
            geometry.frames.push(Mat3::IDENTITY);
        }
        if has_uvs {
            geometry.uvs.extend_from_slice(&mesh.uvs);
        }
        geometry.positions.extend_from_slice(&mesh.positions);
        geometry.normals.extend_from_slice(&mesh.normals);
        geometry
            .triangles
            .extend(kept.iter().map(|&triangle| mesh.triangles[triangle]));
        for triangle in kept {
            let emitter = Emitter {
                shape: EmitterShape::Triangle(mesh.corners(triangle)),
                radiance: emission.of(triangle),
                area: mesh.area(triangle),
            };
            self.add_primitive(mesh.materials[triangle], emitter);
        }
    }

    /// A shape that is one primitive.
    fn add_round(&mut self, shape: InstanceShape, frame: Mat3, material: u32, emitter: Emitter) {
        let first_primitive = self.geometry.materials.len() as u32;
        if self.leaves_out(material, emitter.radiance) {
            // Instances are numbered as the shapes of the scene file.
            return self.add_mesh(&Mesh::default(), &Emission::None);
        }
        self.geometry.instances.push(Instance { shape, first_primitive });
        if self.needs_frames() {
            self.geometry.frames.push(frame);
        }
        self.add_primitive(material, emitter);
    }

    /// Whether some material asks where on its texture a point is, or which way that runs.
    fn needs_frames(&self) -> bool {
        let needs = self.materials.needs();
        needs.textures || needs.tangents
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::testing::scene_of;
    use crate::scene::{Format, flatten, parse_scene};
    use std::path::Path;

    fn compiled(reflectance: &str) -> Geometry {
        let shapes = "Box(min: (0, 0, 0), max: (1, 1, 1)), material: \"white\"), (shape: Sphere(radius: 1)";
        let text = scene_of(shapes, "").replace("reflectance: (0.5, 0.5, 0.5)", reflectance);
        let text = text.replace("materials:", "textures: {\"board\": Checkerboard()}, materials:");
        let source = parse_scene("test.ron", &text, Format::Ron, Path::new("")).expect("a scene");
        let flattened = flatten(&source).expect("shapes");
        let scene = Scene::compile(&source.description, &flattened, SceneOverrides::default());
        scene.expect("the box filter can be sampled").geometry
    }

    /// A sphere and a box of these materials, and a lamp.
    fn of_glass(glass: &str) -> Scene {
        let shapes = "Box(min: (0, 0, 0), max: (1, 1, 1)), material: \"white\"), (shape: Sphere(radius: 1)";
        let text = scene_of(shapes, "").replace("Diffuse(reflectance: (0.5, 0.5, 0.5))", glass);
        let source = parse_scene("test.ron", &text, Format::Ron, Path::new("")).expect("a scene");
        let flattened = flatten(&source).expect("shapes");
        Scene::compile(&source.description, &flattened, SceneOverrides::default()).expect("a scene")
    }

    #[test]
    fn interfaces_that_do_nothing_are_not_there() {
        let there = |ior, transmittance| {
            let scene = of_glass(&format!(
                "Dielectric(interior_ior: {ior}, exterior_ior: 1.5, transmittance: {transmittance})"
            ));
            assert_eq!(scene.geometry.instance_count(), scene.instance_names.len());
            (
                scene.geometry.primitive_count(),
                scene.null_primitives,
                scene.materials.len(),
            )
        };
        assert_eq!(there("1.5", "(1, 1, 1)"), (0, 13, 0));
        assert_eq!(there("1.5", "(1, 1, 0.5)"), (13, 0, 1));
        assert_eq!(there("1.500015", "(1, 1, 1)"), (13, 0, 1));
    }

    #[test]
    fn texture_coordinates_are_kept_only_where_a_material_asks_for_them() {
        let plain = compiled("reflectance: (0.5, 0.5, 0.5)");
        assert!(plain.uvs.is_empty() && plain.frames.is_empty());
        let textured = compiled("reflectance: \"board\"");
        assert_eq!((textured.uvs.len(), textured.frames.len()), (24, 2));
    }
}
