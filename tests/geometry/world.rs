//! Compiled scenes from lists of shapes, and their queues as plain functions.

use crate::support::ways::ways;
use chainlight::color::Rgb;
use chainlight::geometry::{
    Geometry, Hit, HitColumns, HitDistance, HitInstance, HitPrimitive, HitUv, NO_HIT, RayColumns, RayDirection,
    RayOrigin, SegmentColumns, SegmentTarget, SegmentTransmittance,
};
use chainlight::scene::{self, Emission, Flattened, Format, Instance, Mesh, Scene, SceneOverrides, parse_scene};
use chainlight::table::{Column, Rows, lane_groups};
use glam::{DVec2, Mat3, Vec3};
use std::path::Path;
use std::sync::LazyLock;

pub type Triangle = [Vec3; 3];
/// Origin and direction of a ray, or the two ends of a segment.
pub type Line = (Vec3, Vec3);

const REST: &str = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
    film: (width: 1, height: 1), materials: {"white": Diffuse(reflectance: (0.5, 0.5, 0.5))}, shapes: [])"#;

static DESCRIPTION: LazyLock<scene::SceneDescription> = LazyLock::new(|| {
    let source = parse_scene("rest.ron", REST, Format::Ron, Path::new("")).expect("a scene without shapes");
    source.description
});

/// A scene while it grows: one instance per call. What goes in is not validated, so that broken numbers get through.
#[derive(Default)]
pub struct World {
    instances: Vec<Instance>,
}

impl World {
    pub fn mesh(mut self, triangles: &[Triangle]) -> Self {
        self.push(mesh_of(triangles), Emission::None);
        self
    }

    pub fn light_mesh(mut self, triangles: &[Triangle]) -> Self {
        self.push(mesh_of(triangles), Emission::uniform(Rgb::ONE));
        self
    }

    pub fn smooth(mut self, triangles: &[Triangle], normals: Vec<Vec3>) -> Self {
        let mut mesh = mesh_of(triangles);
        mesh.normals = normals;
        self.push(mesh, Emission::None);
        self
    }

    pub fn sphere(mut self, center: Vec3, radius: f32) -> Self {
        self.push_sphere(center, radius, Emission::None);
        self
    }

    pub fn light_sphere(mut self, center: Vec3, radius: f32) -> Self {
        self.push_sphere(center, radius, Emission::uniform(Rgb::ONE));
        self
    }

    pub fn disk(mut self, center: Vec3, normal: Vec3, radius: f32) -> Self {
        // Only the normal matters to rays.
        let frame = Mat3::from_cols(Vec3::X, Vec3::Y, normal);
        self.push_round(scene::Geometry::Disk {
            center,
            radius,
            frame,
            material: 0,
        });
        self
    }

    pub fn cylinder(mut self, from: Vec3, to: Vec3, radius: f32) -> Self {
        self.push_round(scene::Geometry::Cylinder {
            from,
            to,
            radius,
            frame: Mat3::IDENTITY,
            material: 0,
        });
        self
    }

    fn push_round(&mut self, geometry: scene::Geometry) {
        self.instances.push(Instance {
            name: String::new(),
            geometry,
            emission: Emission::None,
        });
    }

    fn push(&mut self, mesh: Mesh, emission: Emission) {
        self.instances.push(Instance {
            name: String::new(),
            geometry: scene::Geometry::Mesh(mesh),
            emission,
        });
    }

    fn push_sphere(&mut self, center: Vec3, radius: f32, emission: Emission) {
        self.instances.push(Instance {
            name: String::new(),
            geometry: scene::Geometry::Sphere {
                center,
                radius,
                frame: Mat3::IDENTITY,
                material: 0,
            },
            emission,
        });
    }

    pub fn compile(self) -> Scene {
        let flattened = Flattened {
            instances: self.instances,
            materials: DESCRIPTION.materials.clone().into_iter().collect(),
            lights: Vec::new(),
            textures: Vec::new(),
            warnings: Vec::new(),
        };
        Scene::compile(&DESCRIPTION, &flattened, SceneOverrides::default()).expect("a box filter")
    }
}

/// Triangles as a mesh in which none shares a vertex.
fn mesh_of(triangles: &[Triangle]) -> Mesh {
    Mesh {
        positions: triangles.concat(),
        triangles: (0..triangles.len() as u32)
            .map(|t| [0, 1, 2].map(|c| 3 * t + c))
            .collect(),
        materials: vec![0; triangles.len()],
        ..Mesh::default()
    }
}

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub distance: f32,
    pub instance: u32,
    pub primitive: u32,
    pub uv: DVec2,
}

impl Found {
    pub fn hit(&self) -> Option<Hit> {
        (self.instance != NO_HIT).then_some(Hit {
            instance: self.instance,
            primitive: self.primitive,
            uv: self.uv,
        })
    }

    /// All of it, to the last bit.
    pub fn bits(&self) -> (u32, u32, u32, [u64; 2]) {
        let uv = self.uv.to_array().map(f64::to_bits);
        (self.distance.to_bits(), self.instance, self.primitive, uv)
    }

    pub fn name(&self) -> (u32, u32) {
        (self.instance, self.primitive)
    }
}

fn column<C: Column>(rows: usize) -> Vec<C> {
    (0..rows).map(|_| C::zeroed()).collect()
}

fn filled<C: Column>(values: impl ExactSizeIterator<Item = C::Value>) -> Vec<C> {
    let mut column = column(lane_groups(values.len()));
    for (i, value) in values.enumerate() {
        column.put(i, value);
    }
    column
}

/// The closest hits of rays.
pub fn closest(geometry: &Geometry, rays: &[Line]) -> Vec<Found> {
    let origin: Vec<RayOrigin> = filled(rays.iter().map(|ray| ray.0));
    let direction: Vec<RayDirection> = filled(rays.iter().map(|ray| ray.1));
    let rows = lane_groups(rays.len());
    let (mut distance, mut instance) = (column::<HitDistance>(rows), column::<HitInstance>(rows));
    let (mut primitive, mut uv) = (column::<HitPrimitive>(rows), column::<HitUv>(rows));
    geometry.closest_hits(
        RayColumns {
            origin: &origin,
            direction: &direction,
            len: rays.len(),
        },
        HitColumns {
            distance: &mut distance,
            instance: &mut instance,
            primitive: &mut primitive,
            uv: &mut uv,
        },
    );
    (0..rays.len())
        .map(|i| Found {
            distance: distance.at(i),
            instance: instance.at(i),
            primitive: primitive.at(i),
            uv: uv.at(i),
        })
        .collect()
}

/// The closest hits of rays, and whether segments are free, which every way to trace must agree on to the last bit.
pub fn closest_and_free_by_all_ways(geometry: &Geometry, rays: &[Line], segments: &[Line]) -> (Vec<Found>, Vec<bool>) {
    let found = closest(geometry, rays);
    let passed = free(geometry, segments);
    let mut other = geometry.clone();
    for (tracer, instructions) in ways() {
        other.trace_with(tracer, instructions);
        for ((a, b), ray) in found.iter().zip(closest(&other, rays)).zip(rays) {
            assert_eq!(a.bits(), b.bits(), "{tracer:?} {instructions:?} {ray:?}: {a:?} {b:?}");
        }
        for ((a, b), segment) in passed.iter().zip(free(&other, segments)).zip(segments) {
            assert_eq!(*a, b, "{tracer:?} {instructions:?} {segment:?}");
        }
    }
    (found, passed)
}

/// Whether segments are free.
pub fn free(geometry: &Geometry, segments: &[Line]) -> Vec<bool> {
    let origin: Vec<RayOrigin> = filled(segments.iter().map(|segment| segment.0));
    let target: Vec<SegmentTarget> = filled(segments.iter().map(|segment| segment.1));
    let mut transmittance = column::<SegmentTransmittance>(lane_groups(segments.len()));
    let queue = SegmentColumns {
        origin: &origin,
        target: &target,
        len: segments.len(),
    };
    geometry.transmittances(queue, &mut transmittance);
    let all = (0..segments.len()).map(|i| transmittance.at(i));
    all.map(|passed| {
        assert!(passed == Rgb::ONE || passed == Rgb::BLACK, "{passed:?}");
        passed == Rgb::ONE
    })
    .collect()
}
