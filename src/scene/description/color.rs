//! Colours that may be textures.

use crate::color::Rgb;
use crate::scene::schema::quantity::{Name, Share};
use crate::texture::Color;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// A colour parameter of a material: three numbers, or the name of a texture.
#[derive(Clone, Debug, PartialEq)]
pub enum ColorDescription {
    /// The same everywhere, written `(r, g, b)`.
    Constant([f32; 3]),
    /// What the texture of this name has at the surface point, written `"name"`.
    Texture(String),
}

impl ColorDescription {
    /// The colour as materials hold it; `number` finds textures by name, and validation has seen to it that it does.
    pub fn resolve(&self, number: impl Fn(&str) -> Option<u32>) -> Color {
        match self {
            Self::Constant(color) => Color::Constant(Rgb::from(*color)),
            Self::Texture(name) => number(name).map_or(Color::Constant(Rgb::BLACK), Color::Texture),
        }
    }
}

impl From<Rgb> for ColorDescription {
    fn from(color: Rgb) -> Self {
        Self::Constant(color.to_array())
    }
}

impl Serialize for ColorDescription {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Constant(color) => color.serialize(serializer),
            Self::Texture(name) => name.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for ColorDescription {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColorOrName)
    }
}

impl JsonSchema for ColorDescription {
    fn schema_name() -> Cow<'static, str> {
        "Color".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut constant = Share::json_schema(generator);
        constant.insert("description".to_owned(), "The same everywhere.".into());
        let mut texture = Name::json_schema(generator);
        let text = "What the texture of this name has at the surface point.";
        texture.insert("description".to_owned(), text.into());
        json_schema!({
            "description": "A colour parameter of a material: three numbers, or the name of a texture.",
            "anyOf": [constant, texture],
        })
    }
}

struct ColorOrName;

impl<'de> Visitor<'de> for ColorOrName {
    type Value = ColorDescription;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a colour `(r, g, b)` or the name of a texture in double quotes")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Self::Value, E> {
        Ok(ColorDescription::Texture(name.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut channels: A) -> Result<Self::Value, A::Error> {
        let mut color = [0.0; 3];
        for (index, channel) in color.iter_mut().enumerate() {
            *channel = channels
                .next_element()?
                .ok_or_else(|| de::Error::invalid_length(index, &"an array of length 3"))?;
        }
        Ok(ColorDescription::Constant(color))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_and_names_are_read_from_both_formats_and_written_back() {
        let colour = ColorDescription::Constant([1.0, 0.25, 0.0]);
        let name = ColorDescription::Texture("wood".to_owned());
        for (ron, json, expected) in [
            ("(1, 0.25, 0)", "[1, 0.25, 0]", &colour),
            ("\"wood\"", "\"wood\"", &name),
        ] {
            assert_eq!(ron::from_str::<ColorDescription>(ron).as_ref(), Ok(expected));
            let from_json: ColorDescription = serde_json::from_str(json).expect("a colour");
            assert_eq!(from_json, *expected);
            let written = ron::to_string(expected).expect("text");
            assert_eq!(ron::from_str::<ColorDescription>(&written).as_ref(), Ok(expected));
        }
    }

    #[test]
    fn what_is_neither_is_refused() {
        for text in [
            "1",
            "(1, 2)",
            "(1, 2, 3, 4)",
            "wood",
            "(r: 1, g: 0, b: 0)",
            "true",
            "()",
        ] {
            assert!(ron::from_str::<ColorDescription>(text).is_err(), "{text}");
        }
    }
}
