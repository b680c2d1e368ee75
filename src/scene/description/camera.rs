//! The `camera` block.

use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A camera. World space, right-handed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "kind_of_camera")]
#[schemars(rename = "Camera")]
pub enum CameraDescription {
    /// A pinhole camera: everything is in focus.
    Perspective {
        /// The pinhole, in scene units.
        #[schemars(with = "quantity::Position")]
        origin: [f32; 3],
        /// A point that projects to the centre of the film, in scene units; must differ from `origin`.
        #[schemars(with = "quantity::Position")]
        target: [f32; 3],
        /// A direction that points up in the picture; any length but zero, not parallel to the view.
        /// Default (0, 1, 0).
        #[serde(default = "plus_y")]
        #[schemars(with = "quantity::Direction")]
        up: [f32; 3],
        /// Full angle of view in degrees, in [1e-4, 179.9999], across the side of the film that `fov_axis` names.
        #[schemars(with = "quantity::AngleOfView")]
        fov: f32,
        /// Which side of the film `fov` spans. Default `Vertical`.
        #[serde(default)]
        fov_axis: FovAxis,
    },
    /// A camera with a lens: in focus at one distance, blurred elsewhere.
    ThinLens {
        /// The centre of the lens, in scene units.
        #[schemars(with = "quantity::Position")]
        origin: [f32; 3],
        /// A point that projects to the centre of the film, in scene units; must differ from `origin`.
        #[schemars(with = "quantity::Position")]
        target: [f32; 3],
        /// A direction that points up in the picture; any length but zero, not parallel to the view.
        /// Default (0, 1, 0).
        #[serde(default = "plus_y")]
        #[schemars(with = "quantity::Direction")]
        up: [f32; 3],
        /// Full angle of view in degrees, in [1e-4, 179.9999], across the side of the film that `fov_axis` names.
        #[schemars(with = "quantity::AngleOfView")]
        fov: f32,
        /// Which side of the film `fov` spans. Default `Vertical`.
        #[serde(default)]
        fov_axis: FovAxis,
        /// Radius of the lens in scene units, in [1e-9, 1e9]: the focal length over twice the f-number.
        #[schemars(with = "quantity::LensLength")]
        aperture_radius: f32,
        /// From the lens to the plane that is in focus, along the view, in scene units, in [1e-9, 1e9]. Default: to `target`.
        #[serde(default)]
        #[schemars(with = "Option<quantity::LensLength>")]
        focus_distance: Option<f32>,
    },
    /// A camera whose rays are all parallel.
    Orthographic {
        /// The centre of the film's image in the scene, in scene units; what lies behind it is not seen.
        #[schemars(with = "quantity::Position")]
        origin: [f32; 3],
        /// A point that projects to the centre of the film, in scene units; must differ from `origin`.
        #[schemars(with = "quantity::Position")]
        target: [f32; 3],
        /// A direction that points up in the picture; any length but zero, not parallel to the view.
        /// Default (0, 1, 0).
        #[serde(default = "plus_y")]
        #[schemars(with = "quantity::Direction")]
        up: [f32; 3],
        /// What the film's height spans, in scene units, in [1e-9, 1e9].
        #[schemars(with = "quantity::LensLength")]
        height: f32,
    },
}

/// The side of the film that an angle of view spans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "field_of_view_axis")]
#[schemars(rename = "FovAxis")]
pub enum FovAxis {
    /// From the left edge to the right.
    Horizontal,
    /// From the bottom edge to the top. The default.
    #[default]
    Vertical,
    /// Across the shorter side.
    Smaller,
    /// Across the longer side.
    Larger,
}

fn plus_y() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}
