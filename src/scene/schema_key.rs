//! The key `$schema` of JSON scenes: it tells editors where the schema is, and is no part of the scene.
//!
//! It is taken out between the parser and the description, so that the description does not know of it, RON has no such
//! field, and unknown fields stay errors.

use super::description::SceneDescription;
use serde::de::{self, Deserialize, DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// The key.
pub(super) const SCHEMA_KEY: &str = "$schema";

/// Reads a scene from JSON, with or without the key.
pub(super) fn read(text: &str) -> Result<SceneDescription, serde_json::Error> {
    let mut parser = serde_json::Deserializer::from_str(text);
    let scene = SceneDescription::deserialize(WithKey(&mut parser))?;
    parser.end()?;
    Ok(scene)
}

/// A deserializer of a struct that may have the key beside its fields.
struct WithKey<D>(D);

impl<'de, D: Deserializer<'de>> Deserializer<'de> for WithKey<D> {
    type Error = D::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, D::Error> {
        self.0.deserialize_any(WithoutKey(visitor))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, D::Error> {
        self.0.deserialize_struct(name, fields, WithoutKey(visitor))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

/// A visitor or a map, with the key taken out.
struct WithoutKey<T>(T);

impl<'de, V: Visitor<'de>> Visitor<'de> for WithoutKey<V> {
    type Value = V::Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.expecting(f)
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<V::Value, A::Error> {
        self.0.visit_map(Entries { entries, seen: false })
    }

    fn visit_seq<A: SeqAccess<'de>>(self, values: A) -> Result<V::Value, A::Error> {
        self.0.visit_seq(values)
    }
}

/// The entries of a map but for the key.
struct Entries<A> {
    entries: A,
    /// Whether the key has come.
    seen: bool,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for Entries<A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, A::Error> {
        while let Some(key) = self.entries.next_key::<Cow<'de, str>>()? {
            if key != SCHEMA_KEY {
                return seed.deserialize(key.into_deserializer()).map(Some);
            }
            if self.seen {
                return Err(de::Error::duplicate_field(SCHEMA_KEY));
            }
            self.seen = true;
            self.entries.next_value::<String>()?;
        }
        Ok(None)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, A::Error> {
        self.entries.next_value_seed(seed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"{
  "$schema": "scene.schema.json",
  "version": 1,
  "camera": {"Perspective": {"origin": [0, 1, 5], "target": [0, 1, 0], "fov": 40}},
  "film": {"width": 64, "height": 64},
  "shapes": []
}"#;

    #[test]
    fn the_key_changes_nothing_and_may_be_left_out() {
        let with = read(SCENE).expect("a scene");
        let without = read(&SCENE.replace("  \"$schema\": \"scene.schema.json\",\n", "")).expect("a scene");
        assert_eq!(with, without);
        let json = serde_json::to_string(&with).expect("JSON");
        assert!(!json.contains('$'), "{json}");
    }

    #[test]
    fn other_keys_and_keys_of_another_type_are_refused_where_they_stand() {
        for (from, to, message) in [
            (
                "$schema",
                "$scheme",
                "unknown field `$scheme`, expected one of `version`",
            ),
            (
                "\"scene.schema.json\"",
                "7",
                "invalid type: integer `7`, expected a string",
            ),
            (
                "\"version\": 1",
                "\"$schema\": \"\", \"version\": 1",
                "duplicate field `$schema`",
            ),
            (
                "\"width\"",
                "\"$schema\": \"\", \"width\"",
                "unknown field `$schema`, expected one of `width`",
            ),
        ] {
            let error = read(&SCENE.replacen(from, to, 1)).expect_err(to);
            assert!(error.to_string().starts_with(message), "{error}");
            let line = match from {
                "\"version\": 1" => 3,
                "\"width\"" => 5,
                _ => 2,
            };
            assert_eq!(error.line(), line, "{error}");
        }
        assert!(
            read(&format!("{SCENE} x"))
                .expect_err("text behind it")
                .to_string()
                .starts_with("trailing")
        );
    }
}
