//! The reference page of the scene format, made from its schema.

use super::notation::{bounds, definition, in_ron, resolve};
use super::quantity::UNIT;
use super::scene_schema;
use serde_json::Value;
use std::fmt::Write;

/// Where the manual of a variant stands in the source, if it has one: type, variant (empty for the type itself), files.
pub const MANUALS: &[(&str, &str, &[&str])] = &[
    ("Camera", "Perspective", &["src/camera/perspective.rs"]),
    ("Camera", "ThinLens", &["src/camera/thin_lens.rs"]),
    ("Camera", "Orthographic", &["src/camera/orthographic.rs"]),
    ("Texture", "Checkerboard", &["src/texture/checkerboard.rs"]),
    ("Texture", "Bitmap", &["src/texture/bitmap.rs"]),
    ("Material", "Diffuse", &["src/material/diffuse.rs"]),
    ("Material", "Conductor", &["src/material/conductor.rs"]),
    ("Material", "RoughConductor", &["src/material/rough_conductor.rs"]),
    ("Material", "Dielectric", &["src/material/dielectric.rs"]),
    ("Material", "RoughDielectric", &["src/material/rough_dielectric.rs"]),
    ("Material", "Plastic", &["src/material/plastic.rs"]),
    ("Material", "TwoSided", &["src/material/two_sided.rs"]),
    ("Light", "Point", &["src/light/point.rs"]),
    ("Light", "Spot", &["src/light/spot.rs"]),
    ("Light", "Directional", &["src/light/directional.rs"]),
    ("Light", "Environment", &["src/light/constant.rs", "src/light/image.rs"]),
    ("Light", "Sun", &["src/light/sun.rs"]),
    ("Light", "Sky", &["src/light/sky.rs"]),
    ("Shape", "", &["src/light/emitter.rs"]),
    ("Distribution", "", &["src/material/microfacet/mod.rs"]),
];

const HEAD: &str = "# The scene format

Written by `chainlight schema --reference` from the types that read scenes; do not edit it. How the parts go together, with
conventions of space, light and texture coordinates, is the manual of the module `chainlight::scene`
([source](../src/scene/mod.rs)).

Values and defaults are in RON. In JSON, brackets of fields and `{}` become objects, brackets of numbers and `[]` become
arrays, and a name before a bracket becomes an object of one key: `Sphere(radius: 0.5)` is `{\"Sphere\": {\"radius\": 0.5}}`,
`Translate((1, 2, 3))` is `{\"Translate\": [1, 2, 3]}`, `Vertical` is `\"Vertical\"`. JSON scenes may name their schema under the
key `$schema`: [scene.schema.json](scene.schema.json).

Ranges hold for every number of a value. Lengths are in scene units, metres by convention.
";

/// The page, in Markdown; links are relative to the folder `scenes`.
#[must_use]
pub fn reference() -> String {
    let root = scene_schema();
    let page = Page { root: &root };
    let mut out = HEAD.to_owned();
    page.section(&mut out, "Scene", &root);
    for (name, schema) in root.get("$defs").and_then(Value::as_object).into_iter().flatten() {
        page.section(&mut out, name, schema);
    }
    out
}

struct Page<'a> {
    root: &'a Value,
}

// Writing to a string cannot fail.
impl Page<'_> {
    fn section(&self, out: &mut String, name: &str, schema: &Value) {
        let _ = writeln!(
            out,
            "\n## {name}\n\n{}{}",
            text(schema, "description"),
            manuals(name, "")
        );
        let choices = schema.get("anyOf").and_then(Value::as_array);
        for (index, choice) in choices.into_iter().flatten().enumerate() {
            let gap = if index == 0 { "\n" } else { "" };
            let _ = writeln!(out, "{gap}- {}: {}", self.kind(choice), text(choice, "description"));
        }
        let choices = schema.get("oneOf").and_then(Value::as_array);
        for (index, choice) in choices.into_iter().flatten().enumerate() {
            if index == 0 && choice.get("const").is_some() {
                out.push('\n');
            }
            self.variant(out, name, choice);
        }
        self.fields(out, schema);
    }

    fn variant(&self, out: &mut String, of: &str, choice: &Value) {
        let about = text(choice, "description");
        let content = choice.get("properties").and_then(Value::as_object);
        match content.and_then(|properties| properties.iter().next()) {
            None => {
                let _ = writeln!(out, "- `{}`: {about}", text(choice, "const"));
            }
            Some((name, content)) => {
                let _ = writeln!(out, "\n### {of}: `{name}`\n\n{about}{}", manuals(of, name));
                if content.get("properties").is_some() {
                    self.fields(out, content);
                } else {
                    let _ = writeln!(
                        out,
                        "\n`{name}(...)` holds {}{}.",
                        self.kind(content),
                        self.range(content, ", ")
                    );
                }
            }
        }
    }

    fn fields(&self, out: &mut String, schema: &Value) {
        let Some(fields) = schema.get("properties").and_then(Value::as_object) else {
            return;
        };
        let required = |name: &str| {
            let names = schema.get("required").and_then(Value::as_array);
            names.is_some_and(|names| names.iter().any(|required| required == name))
        };
        out.push_str("\n| field | type | range, unit | default | meaning |\n|---|---|---|---|---|\n");
        for (name, field) in fields {
            let about = text(field, "description").replace("\n\n", " ");
            let (about, default) = split_default(about.trim_end_matches(" Required."));
            let default = match field.get("default") {
                _ if required(name) => "required".to_owned(),
                Some(Value::Null) | None => default.unwrap_or("none").to_owned(),
                Some(value) => format!("`{}`", in_ron(self.root, field, value)),
            };
            let (kind, range) = (self.kind(field), self.range(field, ""));
            let _ = writeln!(out, "| `{name}` | {kind} | {range} | {default} | {about} |");
        }
    }

    /// What a value of the schema is, in words.
    fn kind(&self, schema: &Value) -> String {
        if let Some(name) = definition(schema) {
            return format!("[{name}](#{})", name.to_lowercase());
        }
        if let Some(choices) = schema.get("anyOf").and_then(Value::as_array) {
            let present = choices.iter().filter(|choice| text(choice, "type") != "null");
            return present.map(|choice| self.kind(choice)).collect::<Vec<_>>().join(" or ");
        }
        if let Some(value) = schema.get("const") {
            return format!("`{value}`");
        }
        if let Some(values) = schema.get("enum").and_then(Value::as_array) {
            let values = values.iter().filter(|value| !value.is_null());
            return values.map(|value| format!("`{value}`")).collect::<Vec<_>>().join(", ");
        }
        match type_name(schema) {
            "number" => "number".to_owned(),
            "integer" => "whole number".to_owned(),
            "boolean" => "`true`, `false`".to_owned(),
            "string" => "text".to_owned(),
            "array" => {
                let items = schema.get("items").unwrap_or(&Value::Null);
                let least = schema.get("minItems").and_then(Value::as_u64);
                match (least, schema.get("maxItems").and_then(Value::as_u64)) {
                    (Some(count), Some(_)) => format!("{count} × {}", self.kind(items)),
                    (Some(least), None) => format!("list of {least} or more × {}", self.kind(items)),
                    _ => format!("list of {}", self.kind(items)),
                }
            }
            "object" => match schema.get("additionalProperties") {
                Some(entries @ Value::Object(_)) => format!("map from names to {}", self.kind(entries)),
                _ => "fields".to_owned(),
            },
            other => other.to_owned(),
        }
    }

    /// Bounds and unit, after `before` if there are any.
    fn range(&self, schema: &Value, before: &str) -> String {
        if definition(schema).is_some() && resolve(self.root, schema).get("anyOf").is_none() {
            return String::new();
        }
        let bounds = bounds(self.root, schema);
        let unit = unit(self.root, schema);
        let range = match (bounds.least, bounds.most) {
            (Some((least, closed)), Some(most)) => {
                format!("{}{}, {}]", if closed { '[' } else { '(' }, number(least), number(most))
            }
            _ => String::new(),
        };
        let parts: Vec<String> = [range, unit.to_owned()]
            .into_iter()
            .filter(|part| !part.is_empty())
            .collect();
        if parts.is_empty() {
            return String::new();
        }
        format!("{before}{}", parts.join(" "))
    }
}

/// The unit of the numbers of a schema.
fn unit<'a>(root: &'a Value, schema: &'a Value) -> &'a str {
    let schema = resolve(root, schema);
    let inner = schema.get("items").or_else(|| schema.get("anyOf")?.get(0));
    inner.map_or_else(|| text(schema, UNIT), |inner| unit(root, inner))
}

/// A description without the sentence that states the default, and what that sentence says where it is in words:
/// `Default: three quarters of the cutoff.`
fn split_default(about: &str) -> (String, Option<&str>) {
    let Some(start) = about.find("Default") else {
        return (about.to_owned(), None);
    };
    let end = about[start..].find(". ").map_or(about.len(), |end| start + end + 2);
    let sentence = about[start..end].trim_end();
    let Some(words) = sentence.strip_prefix("Default: ") else {
        // A value and what follows it, which may be worth knowing: only the bare value goes.
        let bare = sentence.trim_start_matches("Default ").trim_end_matches('.');
        let is_bare = !bare.contains(": ") && !bare.contains(';') && (!bare.contains(", ") || bare.ends_with(')'));
        let kept = if is_bare {
            join(&about[..start], &about[end..])
        } else {
            about.to_owned()
        };
        return (kept, None);
    };
    (join(&about[..start], &about[end..]), Some(words.trim_end_matches('.')))
}

fn join(before: &str, after: &str) -> String {
    format!("{before}{after}").trim().to_owned()
}

/// Links to the manuals of a variant, or of a type.
fn manuals(of: &str, variant: &str) -> String {
    let files = MANUALS
        .iter()
        .filter(|(known, name, _)| *known == of && *name == variant);
    let links = files.flat_map(|(_, _, files)| files.iter());
    links.map(|file| format!(" [Manual](../{file}).")).collect()
}

/// The type of a schema, if it is one type or null.
fn type_name(schema: &Value) -> &str {
    match schema.get("type") {
        Some(Value::Array(types)) => types
            .iter()
            .filter_map(Value::as_str)
            .find(|name| *name != "null")
            .unwrap_or(""),
        other => other.and_then(Value::as_str).unwrap_or(""),
    }
}

fn text<'a>(schema: &'a Value, key: &str) -> &'a str {
    schema.get(key).and_then(Value::as_str).unwrap_or("")
}

/// A number as people write it: without rows of zeros.
fn number(value: f64) -> String {
    if value == 0.0 || (1.0e-3..1.0e6).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_told_once() {
        for (about, kept, words) in [
            ("Haze. Default 3.", "Haze.", None),
            ("Up. Default (0, 1, 0).", "Up.", None),
            (
                "Smooth. Default true; false is flat.",
                "Smooth. Default true; false is flat.",
                None,
            ),
            ("Beam. Default: half of `cutoff`.", "Beam.", Some("half of `cutoff`")),
            (
                "Names. Default: none. No two alike.",
                "Names. No two alike.",
                Some("none"),
            ),
        ] {
            assert_eq!(split_default(about), (kept.to_owned(), words));
        }
    }

    #[test]
    fn tables_have_a_row_for_every_field() {
        let page = reference();
        for row in [
            "| `max_depth` | whole number | [1, 1024] edges | `16` |",
            "| `up` | 3 × number | [-1e9, 1e9] any length but zero | `(0, 1, 0)` |",
            "| `filter` | [Filter](#filter) |  | `Box(radius: 0.5)` |",
            "| `shapes` | list of 1 or more × [Shape](#shape) |  | required |",
        ] {
            assert!(page.contains(row), "{row}\n{page}");
        }
    }
}
