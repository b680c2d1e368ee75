//! What a scene file says, as plain data: one serde type per block of the format. The same types read RON and JSON.
//!
//! Nothing here is checked beyond its shape (names, types, counts): [`validate`](crate::scene::validate()) holds the
//! values against their ranges, so that an error can point at the place in the file.

mod camera;
mod color;
mod film;
mod light;
mod material;
mod settings;
mod shape;
mod texture;
mod unique_map;

pub use camera::{CameraDescription, FovAxis};
pub use color::ColorDescription;
pub use film::{EXPOSURE, FilmDescription, FilterDescription, MAX_FILM_PIXELS, MAX_FILM_SIDE};
pub use light::LightDescription;
pub use material::MaterialDescription;
pub use settings::{DEFAULT_MAX_DEPTH, MAX_DEPTH_LIMIT, SettingsDescription};
pub use shape::{ShapeDescription, ShapeKind, TransformStep};
pub use texture::{TextureDescription, TextureEncoding, TextureFilter, TextureWrap};

use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The version of the format that this program reads and writes.
pub const FORMAT_VERSION: u32 = 1;

/// A whole scene file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "scene")]
#[schemars(rename = "Scene")]
pub struct SceneDescription {
    /// Version of the format; must be [`FORMAT_VERSION`]. Required, so that a later format can tell old files.
    #[schemars(with = "quantity::Version")]
    pub version: u32,
    /// How to render, where the command line does not say otherwise. Default: each setting's own.
    #[serde(default)]
    pub settings: SettingsDescription,
    /// The camera. Required.
    pub camera: CameraDescription,
    /// The film behind it. Required.
    pub film: FilmDescription,
    /// Textures by name. Default: none. Two of the same name are an error.
    #[serde(default, deserialize_with = "unique_map::textures")]
    #[schemars(extend("propertyNames" = quantity::not_empty()))]
    pub textures: BTreeMap<String, TextureDescription>,
    /// Materials by name. Default: none. Two of the same name are an error.
    #[serde(default, deserialize_with = "unique_map::materials")]
    #[schemars(extend("propertyNames" = quantity::not_empty()))]
    pub materials: BTreeMap<String, MaterialDescription>,
    /// Lights that are no shapes. Default: none.
    #[serde(default)]
    pub lights: Vec<LightDescription>,
    /// Shapes, in the order in which they become instances; at least one. Required.
    #[schemars(length(min = 1))]
    pub shapes: Vec<ShapeDescription>,
}
