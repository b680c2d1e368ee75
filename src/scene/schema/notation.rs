//! Reads a schema: what a reference leads to, between what bounds a number lies, and how a value is written in RON.

use serde_json::Value;

/// The schema that a reference of `root` leads to; any other schema itself.
#[must_use]
pub fn resolve<'a>(root: &'a Value, schema: &'a Value) -> &'a Value {
    let name = definition(schema);
    name.and_then(|name| root.get("$defs")?.get(name)).unwrap_or(schema)
}

/// The name of the definition that a schema refers to.
pub(super) fn definition(schema: &Value) -> Option<&str> {
    schema.get("$ref")?.as_str()?.strip_prefix("#/$defs/")
}

/// What numbers a schema allows, in all elements of its arrays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least, and whether it is allowed itself.
    pub least: Option<(f64, bool)>,
    /// The largest, which is allowed itself.
    pub most: Option<f64>,
}

/// The bounds of the numbers of a schema; references and choices are followed to the first that has some.
#[must_use]
pub fn bounds(root: &Value, schema: &Value) -> Bounds {
    let schema = resolve(root, schema);
    if let Some(items) = schema.get("items") {
        return bounds(root, items);
    }
    if let Some(choice) = schema.get("anyOf").and_then(|choices| choices.get(0)) {
        return bounds(root, choice);
    }
    let number = |key: &str| schema.get(key).and_then(Value::as_f64);
    let closed = number("minimum").map(|least| (least, true));
    Bounds {
        least: closed.or(number("exclusiveMinimum").map(|least| (least, false))),
        most: number("maximum"),
    }
}

/// How `value`, which follows `schema`, is written in RON. Fields that are null are left out.
#[must_use]
pub fn in_ron(root: &Value, schema: &Value, value: &Value) -> String {
    let schema = resolve(root, schema);
    if let Some(choices) = schema.get("oneOf").and_then(Value::as_array) {
        return variant_in_ron(root, choices, value);
    }
    match value {
        Value::Array(values) => {
            let items = schema.get("items").unwrap_or(&Value::Null);
            // Three numbers stand in an `anyOf` where a texture's name may, and are no list there either.
            let is_list = schema.get("type").is_some() && schema.get("maxItems").is_none();
            let values = values.iter().map(|value| in_ron(root, items, value));
            let inside = values.collect::<Vec<_>>().join(", ");
            if is_list {
                format!("[{inside}]")
            } else {
                format!("({inside})")
            }
        }
        Value::Object(entries) => match schema.get("properties") {
            Some(fields) => {
                let given = entries.iter().filter(|(_, value)| !value.is_null());
                let field = |(name, value): (&String, &Value)| {
                    let schema = fields.get(name).unwrap_or(&Value::Null);
                    format!("{name}: {}", in_ron(root, schema, value))
                };
                format!("({})", given.map(field).collect::<Vec<_>>().join(", "))
            }
            None => {
                let schema = schema.get("additionalProperties").unwrap_or(&Value::Null);
                let entry = |(name, value): (&String, &Value)| format!("{name:?}: {}", in_ron(root, schema, value));
                format!("{{{}}}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
            }
        },
        Value::String(text) => format!("{text:?}"),
        Value::Null => "None".to_owned(),
        Value::Bool(_) | Value::Number(_) => value.to_string(),
    }
}

/// A value of an enum: `Vertical`, `Box(radius: 0.5)`, `Translate((1, 2, 3))`.
fn variant_in_ron(root: &Value, choices: &[Value], value: &Value) -> String {
    let Some((name, content)) = value.as_object().and_then(|entries| entries.iter().next()) else {
        return value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    };
    let schema = choices.iter().find_map(|choice| choice.get("properties")?.get(name));
    let content = in_ron(root, schema.unwrap_or(&Value::Null), content);
    // The brackets of fields are the variant's own; those of a tuple are not.
    if schema.is_some_and(|schema| schema.get("properties").is_some()) {
        format!("{name}{content}")
    } else {
        format!("{name}({content})")
    }
}
