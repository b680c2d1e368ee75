//! The kinds of shapes, one file each: from the description of one to its geometry in world space.

pub(super) mod cuboid;
pub(super) mod mtl;
pub(super) mod obj;
pub(super) mod obj_lines;
pub(super) mod quad;
pub(super) mod sphere;

use super::at::At;
use super::error::SceneError;
use super::mesh::Mesh;

/// Refuses a mesh of a few triangles that left the bounds of the world, or shrank to nothing, in its transform.
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
