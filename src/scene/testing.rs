//! Helpers for the tests of this folder.

use super::{Format, Geometry, Instance, Mesh, SceneError, flatten, parse_scene};
use glam::Vec3;
use std::path::Path;

/// A scene of one white shape; `shape` and `transform` in RON.
pub(super) fn scene_of(shape: &str, transform: &str) -> String {
    format!(
        "(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40), film: (width: 4, height: 4),
        materials: {{\"white\": Diffuse(reflectance: (0.5, 0.5, 0.5))}},
        shapes: [(shape: {shape}, material: \"white\", transform: [{transform}])])"
    )
}

pub(super) fn try_flatten_one(shape: &str, transform: &str) -> Result<Instance, SceneError> {
    let source = parse_scene("test.ron", &scene_of(shape, transform), Format::Ron, Path::new(""))?;
    Ok(flatten(&source)?.instances.remove(0))
}

pub(super) fn flatten_one(shape: &str, transform: &str) -> Instance {
    match try_flatten_one(shape, transform) {
        Ok(instance) => instance,
        Err(error) => panic!("{}", error.plain()),
    }
}

pub(super) fn mesh_of(instance: &Instance) -> Mesh {
    match &instance.geometry {
        Geometry::Mesh(mesh) => mesh.clone(),
        other => panic!("{other:?}"),
    }
}

pub(super) fn areas(mesh: &Mesh) -> Vec<f32> {
    (0..mesh.triangles.len()).map(|triangle| mesh.area(triangle)).collect()
}

pub(super) fn normals(mesh: &Mesh) -> Vec<Vec3> {
    (0..mesh.triangles.len())
        .map(|triangle| mesh.geometric_normal(triangle))
        .collect()
}

/// The volume inside a closed mesh, positive when its normals point outward.
pub(super) fn volume(mesh: &Mesh) -> f32 {
    (0..mesh.triangles.len())
        .map(|triangle| {
            let [a, b, c] = mesh.corners(triangle);
            a.dot(b.cross(c)) / 6.0
        })
        .sum()
}
