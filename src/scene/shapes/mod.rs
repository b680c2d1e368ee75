//! The kinds of shapes, one file each: from the description of one to its geometry in world space.

pub(super) mod cuboid;
pub(super) mod cylinder;
pub(super) mod disk;
pub(super) mod height_field;
pub(super) mod mtl;
pub(super) mod obj;
pub(super) mod obj_lines;
pub(super) mod quad;
pub(super) mod sphere;
pub(super) mod torus;

use super::at::At;
use super::error::SceneError;
use super::mesh::Mesh;
use super::transform::similarity_scale;
use glam::{DAffine3, DMat3, DVec3, Mat3};

/// The smallest radius in world space: with it, areas and their reciprocals stay in the range of `f32`.
const MIN_RADIUS: f64 = 1.0e-9;

/// Refuses a mesh that left the bounds of the world, or shrank to nothing, in its transform.
fn checked(at: &At, mesh: Mesh) -> Result<Mesh, SceneError> {
    if !mesh.is_within_bounds() {
        return Err(too_far(at));
    }
    if !(0..mesh.triangles.len()).all(|triangle| mesh.has_area(triangle)) {
        let message = "this shape is too small, or too thin for its distance from the origin, to have an area";
        return Err(at.error(
            message,
            "choose a smaller unit of length, or move the scene to the origin",
        ));
    }
    Ok(mesh)
}

fn too_far(at: &At) -> SceneError {
    let message = "this shape reaches more than 1e9 scene units from the origin in world space";
    at.error(message, "choose a larger unit of length")
}

fn too_small(at: &At, what: &str, radius: f64) -> SceneError {
    let radius = radius as f32;
    let message = format!("this {what}'s radius in world space is {radius:e}, too small to compute with");
    at.error(message, "choose a smaller unit of length")
}

/// By how much a map scales all lengths alike; an error that begins with `message` where it does not.
fn similarity(at: &At, map: &DAffine3, message: &str) -> Result<f64, SceneError> {
    similarity_scale(map).ok_or_else(|| {
        at.key("transform")
            .error(message, "scale it alike along all axes, or use an `Obj` mesh instead")
    })
}

/// What a map does to normals, but for their length.
fn normal_map(map: &DAffine3) -> DMat3 {
    map.matrix3.inverse().transpose()
}

/// Axes in a shape's own space, in the world; of unit length, mirrored where the map mirrors.
fn unit_axes(map: &DAffine3, axes: DMat3) -> Mat3 {
    let axes = map.matrix3 * axes;
    DMat3::from_cols(
        axes.x_axis.normalize(),
        axes.y_axis.normalize(),
        axes.z_axis.normalize(),
    )
    .as_mat3()
}

/// Axes of a shape that is round about `axis`: y along it; z is +z as far as that goes, and +x about the z axis.
fn axes_about(axis: DVec3) -> DMat3 {
    let y = axis.normalize();
    let towards = if y.z.abs() < 0.999 { DVec3::Z } else { DVec3::X };
    let x = y.cross(towards).normalize();
    DMat3::from_cols(x, y, x.cross(y))
}
