//! The scene format as data: a JSON Schema (draft 2020-12) made from the description types, and the reference page made
//! from the schema. Editors complete and check scenes with it.
//!
//! A scene that the schema accepts is read by [`parse_scene`](crate::scene::parse_scene), and what [`validate`] holds
//! single values against is in it. It does not say what concerns several values at once (`alpha` or `alpha_u` and `alpha_v`,
//! names that must exist, edges that must not be parallel), and it is stricter than the reader in this: structs are objects,
//! never lists of their fields. JSON itself takes `64.0` for a whole number, which the reader does not.
//!
//! [`validate`]: crate::scene::validate()

mod notation;
pub mod quantity;
mod reference;
mod tidy;

pub use notation::{Bounds, bounds, in_ron, resolve};
pub use reference::{MANUALS, reference};

use crate::scene::description::SceneDescription;
use crate::scene::schema_key::SCHEMA_KEY;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};

/// The JSON Schema of a scene file.
#[must_use]
pub fn scene_schema() -> Value {
    let schema = SchemaSettings::draft2020_12()
        .into_generator()
        .into_root_schema_for::<SceneDescription>();
    let mut schema = schema.to_value();
    tidy::tidy(&mut schema);
    if let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) {
        let description = "Where this schema is, for editors; the reader passes it over. In JSON alone.";
        let key = json!({"description": description, "type": "string"});
        let mut all = Map::from_iter([(SCHEMA_KEY.to_owned(), key)]);
        all.append(properties);
        *properties = all;
    }
    schema
}

/// [`scene_schema`] as the text of a file.
#[must_use]
pub fn schema_text() -> String {
    // The alternate form is indented.
    format!("{:#}\n", scene_schema())
}
