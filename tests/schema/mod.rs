//! The scene format's schema and reference page: held against the reader, the shipped scenes and the manuals.

mod defaults;
mod manuals;
mod scenes;

use chainlight::scene::schema::{reference, resolve, scene_schema, schema_text};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A table of fields: of a variant of an enum, or of a type itself.
struct Fields<'a> {
    of: String,
    /// Empty where the table is that of the type itself.
    variant: String,
    schema: &'a Value,
}

impl<'a> Fields<'a> {
    fn each(&self) -> impl Iterator<Item = (&'a String, &'a Value)> {
        self.schema["properties"].as_object().expect("fields").iter()
    }

    fn requires(&self, field: &str) -> bool {
        let required = self.schema.get("required").and_then(Value::as_array);
        required.is_some_and(|names| names.iter().any(|name| name == field))
    }

    /// The least JSON of it, with `more` fields.
    fn instance(&self, root: &Value, more: &[(&str, &Value)]) -> Value {
        let mut fields = least(root, self.schema);
        for (name, value) in more {
            fields[*name] = (*value).clone();
        }
        if self.variant.is_empty() {
            fields
        } else {
            json!({ &self.variant: fields })
        }
    }
}

/// Every table of fields of the schema.
fn tables(root: &Value) -> Vec<Fields<'_>> {
    let definitions = root["$defs"].as_object().expect("definitions").iter();
    let named = definitions.map(|(name, schema)| (name.as_str(), schema));
    let mut tables = Vec::new();
    for (of, schema) in [("Scene", root)].into_iter().chain(named) {
        let choices = schema.get("oneOf").and_then(Value::as_array).into_iter().flatten();
        let variants = choices.filter_map(|choice| choice["properties"].as_object()?.iter().next());
        let own = [(String::new(), schema)];
        for (variant, schema) in own
            .into_iter()
            .chain(variants.map(|(name, schema)| (name.clone(), schema)))
        {
            if schema.get("properties").is_some() {
                tables.push(Fields {
                    of: of.to_owned(),
                    variant,
                    schema,
                });
            }
        }
    }
    tables
}

/// The least value that a schema allows: required fields alone, and the first of all choices.
fn least(root: &Value, schema: &Value) -> Value {
    let schema = resolve(root, schema);
    if let Some(value) = schema.get("const") {
        return value.clone();
    }
    for choices in ["oneOf", "anyOf", "enum"] {
        match schema.get(choices).and_then(|choices| choices.get(0)) {
            Some(first) if choices == "enum" => return first.clone(),
            Some(first) => return least(root, first),
            None => {}
        }
    }
    let kind = match &schema["type"] {
        Value::Array(kinds) => &kinds[0],
        kind => kind,
    };
    match kind.as_str().expect("a type") {
        "object" => {
            let required = schema.get("required").and_then(Value::as_array).into_iter().flatten();
            let names = required.filter_map(Value::as_str);
            names
                .map(|name| (name.to_owned(), least(root, &schema["properties"][name])))
                .collect()
        }
        "array" => {
            let count = schema.get("minItems").and_then(Value::as_u64).unwrap_or(0);
            (0..count).map(|_| least(root, &schema["items"])).collect()
        }
        "string" => json!("x"),
        "boolean" => json!(false),
        "integer" => schema["minimum"].clone(),
        "number" => schema.get("minimum").unwrap_or(&json!(1)).clone(),
        other => panic!("{other}"),
    }
}

/// Holds a generated file against what the program generates; `UPDATE_SCHEMA=1` writes it instead.
fn is_fresh(path: &str, text: &str) {
    let path: PathBuf = repository().join(path);
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        fs::write(&path, text).expect("written");
    }
    let committed = fs::read_to_string(&path).expect("the committed file");
    assert!(
        committed == text,
        "{} is stale: run this test with UPDATE_SCHEMA=1",
        path.display()
    );
}

#[test]
fn the_committed_schema_is_the_programs_own() {
    is_fresh("scenes/scene.schema.json", &schema_text());
}

#[test]
fn the_committed_reference_is_the_programs_own() {
    is_fresh("scenes/REFERENCE.md", &reference());
}

#[test]
fn the_reference_leads_nowhere_else() {
    let page = reference();
    for link in page.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        let found = match link.strip_prefix('#') {
            Some(heading) => page
                .lines()
                .filter_map(|line| line.strip_prefix("## "))
                .any(|line| line.to_lowercase() == heading),
            None => repository().join("scenes").join(link).is_file(),
        };
        assert!(found, "{link}");
    }
}

#[test]
fn the_schema_is_one_and_tells_everything() {
    let root = scene_schema();
    jsonschema::draft202012::meta::validate(&root).expect("a valid schema");
    for table in tables(&root) {
        let place = format!("{} {}", table.of, table.variant);
        assert_eq!(table.schema["additionalProperties"], json!(false), "{place}");
        for (field, schema) in table.each() {
            let description = schema["description"].as_str().unwrap_or("");
            assert!(!description.is_empty(), "{place} {field}");
            assert!(
                !description.contains("[`") && !description.contains("_M"),
                "{place} {field}: {description}"
            );
            let told = table.requires(field) || schema.get("default").is_some() || field == "$schema";
            assert!(told, "{place} {field} is neither required nor has it a default");
        }
    }
}

/// Numbers without bounds would be accepted by the schema and refused by the reader, which has `f32`.
#[test]
fn every_number_has_bounds() {
    fn walk(schema: &Value) {
        match schema {
            Value::Object(entries) => {
                if ["number", "integer"].iter().any(|kind| {
                    entries
                        .get("type")
                        .is_some_and(|own| own == kind || own.as_array().is_some_and(|own| own[0] == *kind))
                }) && !entries.contains_key("const")
                {
                    assert!(entries.contains_key("maximum"), "{schema}");
                    assert!(
                        entries.contains_key("minimum") || entries.contains_key("exclusiveMinimum"),
                        "{schema}"
                    );
                }
                entries.values().for_each(walk);
            }
            Value::Array(values) => values.iter().for_each(walk),
            _ => {}
        }
    }
    walk(&scene_schema());
}
