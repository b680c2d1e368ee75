//! The `shapes` block: one variant per kind of shape, and the transforms that place it.

use crate::color::Rgb;
use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A shape, what it is made of, and where it stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "shape")]
#[schemars(rename = "Shape")]
pub struct ShapeDescription {
    /// A name for messages, profiles and tools; unique where given. Default: none, shown as `shapes[3]`.
    #[serde(default)]
    #[schemars(with = "Option<quantity::Name>")]
    pub name: Option<String>,
    /// Its geometry, in its own space.
    pub shape: ShapeKind,
    /// The name of its material. Required but for `Obj`, where it replaces the mesh's own materials.
    #[serde(default)]
    #[schemars(with = "Option<quantity::Name>")]
    pub material: Option<String>,
    /// Radiance in W sr⁻¹ m⁻², emitted on the side of the geometric normal alone. Default: none. For `Obj` it
    /// replaces the emission of the mesh's own materials.
    #[serde(default)]
    #[schemars(with = "Option<quantity::Radiance>")]
    pub emission: Option<Rgb>,
    /// Transforms from the shape's own space to the world, applied in the order listed. Default: none.
    #[serde(default)]
    pub transform: Vec<TransformStep>,
}

/// Geometry in the shape's own space. Lengths in scene units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "kind_of_shape")]
#[schemars(rename = "ShapeKind")]
pub enum ShapeKind {
    /// A parallelogram; its geometric normal is `edge_u` x `edge_v`.
    Quad {
        /// The corner where the two edges meet.
        #[schemars(with = "quantity::Position")]
        corner: [f32; 3],
        /// From the corner along one side.
        #[schemars(with = "quantity::Position")]
        edge_u: [f32; 3],
        /// From the corner along the other side; not parallel to `edge_u`.
        #[schemars(with = "quantity::Position")]
        edge_v: [f32; 3],
    },
    /// A closed box along the axes of its own space; normals point outward.
    Box {
        /// The corner with the smallest coordinates.
        #[schemars(with = "quantity::Position")]
        min: [f32; 3],
        /// The corner with the largest coordinates; larger than `min` in each.
        #[schemars(with = "quantity::Position")]
        max: [f32; 3],
    },
    /// A sphere; normals point outward.
    Sphere {
        /// Its centre. Default (0, 0, 0).
        #[serde(default)]
        #[schemars(with = "quantity::Position")]
        center: [f32; 3],
        /// Its radius, > 0.
        #[schemars(with = "quantity::Length")]
        radius: f32,
    },
    /// A flat disk.
    Disk {
        /// Its centre. Default (0, 0, 0).
        #[serde(default)]
        #[schemars(with = "quantity::Position")]
        center: [f32; 3],
        /// Its geometric normal; any length but zero.
        #[schemars(with = "quantity::Direction")]
        normal: [f32; 3],
        /// Its radius, > 0.
        #[schemars(with = "quantity::Length")]
        radius: f32,
    },
    /// A tube without ends; normals point outward.
    Cylinder {
        /// The centre of one end.
        #[schemars(with = "quantity::Position")]
        from: [f32; 3],
        /// The centre of the other end; another point.
        #[schemars(with = "quantity::Position")]
        to: [f32; 3],
        /// Its radius, > 0.
        #[schemars(with = "quantity::Length")]
        radius: f32,
    },
    /// A ring, as triangles with smooth shading normals; normals point outward.
    Torus {
        /// Its centre. Default (0, 0, 0).
        #[serde(default)]
        #[schemars(with = "quantity::Position")]
        center: [f32; 3],
        /// The axis that it goes around; any length but zero. Default (0, 1, 0).
        #[serde(default = "plus_y")]
        #[schemars(with = "quantity::Direction")]
        axis: [f32; 3],
        /// From its centre to the middle of its tube, > 0.
        #[schemars(with = "quantity::Length")]
        major_radius: f32,
        /// Radius of its tube, > 0 and below `major_radius`.
        #[schemars(with = "quantity::Length")]
        minor_radius: f32,
        /// Pieces around the axis and around the tube, each in 3..=16384. Default (64, 32).
        #[serde(default = "torus_segments")]
        #[schemars(with = "quantity::Segments")]
        segments: [u32; 2],
    },
    /// A parallelogram with hills, as triangles with smooth shading normals; its geometric normal is on the side of
    /// `edge_u` x `edge_v`.
    HeightField {
        /// A picture of the heights: PNG, JPEG, OpenEXR or Radiance HDR, relative to the folder of the scene file. The mean of
        /// its channels as numbers from 0 to 1 (any in EXR and HDR); its bottom row is at the corner. Either this or `heights`.
        #[serde(default)]
        #[schemars(with = "Option<quantity::FileName>")]
        file: Option<PathBuf>,
        /// The heights, row by row: rows along `edge_u`, the first one at the corner, all equally long.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Heights>")]
        heights: Option<Vec<Vec<f32>>>,
        /// The corner where the two edges meet. Default (0, 0, 0).
        #[serde(default)]
        #[schemars(with = "quantity::Position")]
        corner: [f32; 3],
        /// From the corner along one side.
        #[schemars(with = "quantity::Position")]
        edge_u: [f32; 3],
        /// From the corner along the other side; not parallel to `edge_u`.
        #[schemars(with = "quantity::Position")]
        edge_v: [f32; 3],
        /// By how much heights are scaled, in scene units along the normal. Default 1.
        #[serde(default = "one")]
        #[schemars(with = "quantity::Coordinate")]
        height: f32,
    },
    /// A triangle mesh in a Wavefront OBJ file; normals by winding, counter-clockwise seen from outside.
    Obj {
        /// The file, relative to the folder of the scene file.
        #[schemars(with = "quantity::FileName")]
        file: PathBuf,
        /// Whether the file's vertex normals (`vn`) shade it. Default true; false shades every triangle flat.
        #[serde(default = "yes")]
        smooth: bool,
    },
}

/// One step of a transform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "transform_step")]
#[schemars(rename = "TransformStep")]
pub enum TransformStep {
    /// Moves by a vector, in scene units.
    Translate(#[schemars(with = "quantity::Position")] [f32; 3]),
    /// Scales along each axis about the origin; no factor may be zero, negative ones mirror.
    Scale(#[schemars(with = "quantity::ScaleFactors")] [f32; 3]),
    /// Turns about an axis through the origin, counter-clockwise seen from the tip of the axis.
    Rotate {
        /// The axis; any length but zero.
        #[schemars(with = "quantity::Direction")]
        axis: [f32; 3],
        /// The angle in degrees.
        #[schemars(with = "quantity::Rotation")]
        degrees: f32,
    },
    /// Any affine map, as the four rows of a matrix that multiplies column vectors; the last row must be (0, 0, 0, 1).
    Matrix(#[schemars(with = "quantity::Matrix")] [[f32; 4]; 4]),
}

fn plus_y() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

fn torus_segments() -> [u32; 2] {
    [64, 32]
}

fn one() -> f32 {
    1.0
}

fn yes() -> bool {
    true
}
