//! The `shapes` block: one variant per kind of shape, and the transforms that place it.

use crate::color::Rgb;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A shape, what it is made of, and where it stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "shape")]
pub struct ShapeDescription {
    /// A name for messages, profiles and tools; unique where given. Default: none, shown as `shapes[3]`.
    #[serde(default)]
    pub name: Option<String>,
    /// Its geometry, in its own space.
    pub shape: ShapeKind,
    /// The name of its material. Required but for `Obj`, where it replaces the mesh's own materials.
    #[serde(default)]
    pub material: Option<String>,
    /// Radiance in W sr⁻¹ m⁻², emitted on the side of the geometric normal alone. Default: none. For `Obj` it
    /// replaces the emission of the mesh's own materials.
    #[serde(default)]
    pub emission: Option<Rgb>,
    /// Transforms from the shape's own space to the world, applied in the order listed. Default: none.
    #[serde(default)]
    pub transform: Vec<TransformStep>,
}

/// Geometry in the shape's own space. Lengths in scene units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "kind_of_shape")]
pub enum ShapeKind {
    /// A parallelogram; its geometric normal is `edge_u` x `edge_v`.
    Quad {
        /// The corner where the two edges meet.
        corner: [f32; 3],
        /// From the corner along one side.
        edge_u: [f32; 3],
        /// From the corner along the other side; not parallel to `edge_u`.
        edge_v: [f32; 3],
    },
    /// A closed box along the axes of its own space; normals point outward.
    Box {
        /// The corner with the smallest coordinates.
        min: [f32; 3],
        /// The corner with the largest coordinates; larger than `min` in each.
        max: [f32; 3],
    },
    /// A sphere; normals point outward.
    Sphere {
        /// Its centre. Default (0, 0, 0).
        #[serde(default)]
        center: [f32; 3],
        /// Its radius, > 0.
        radius: f32,
    },
    /// A triangle mesh in a Wavefront OBJ file; normals by winding, counter-clockwise seen from outside.
    Obj {
        /// The file, relative to the folder of the scene file.
        file: PathBuf,
        /// Whether the file's vertex normals (`vn`) shade it. Default true; false shades every triangle flat.
        #[serde(default = "yes")]
        smooth: bool,
    },
}

/// One step of a transform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "transform_step")]
pub enum TransformStep {
    /// Moves by a vector, in scene units.
    Translate([f32; 3]),
    /// Scales along each axis about the origin; no factor may be zero, negative ones mirror.
    Scale([f32; 3]),
    /// Turns about an axis through the origin, counter-clockwise seen from the tip of the axis.
    Rotate {
        /// The axis; any length but zero.
        axis: [f32; 3],
        /// The angle in degrees.
        degrees: f32,
    },
    /// Any affine map, as the four rows of a matrix that multiplies column vectors; the last row must be (0, 0, 0, 1).
    Matrix([[f32; 4]; 4]),
}

fn yes() -> bool {
    true
}
