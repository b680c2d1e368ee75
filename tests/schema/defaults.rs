//! Documented defaults are the real ones: writing them changes nothing.

use super::{Fields, tables};
use chainlight::material::microfacet::Distribution;
use chainlight::scene::schema::{bounds, in_ron, reference, resolve, scene_schema};
use chainlight::scene::{
    CameraDescription, FilmDescription, FilterDescription, LightDescription, MaterialDescription, SceneDescription,
    SettingsDescription, ShapeDescription, ShapeKind, TextureDescription, TransformStep,
};
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::fmt::Debug;

/// Whether JSON without a field says the same as JSON with it, and the same RON too.
fn agree<T: DeserializeOwned + PartialEq + Debug>(json: [&Value; 2], ron: [&str; 2]) -> Result<(), String> {
    let [without, with] = json.map(|text| serde_json::from_value::<T>(text.clone()).map_err(|error| error.to_string()));
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    let [ron_without, ron_with] = ron.map(|text| options.from_str::<T>(text).map_err(|error| error.to_string()));
    let (without, with, ron_without, ron_with) = (without?, with?, ron_without?, ron_with?);
    if without == with && without == ron_without && without == ron_with {
        return Ok(());
    }
    Err(format!("{without:?}\n{with:?}\n{ron_without:?}\n{ron_with:?}"))
}

fn agree_as(of: &str, json: [&Value; 2], ron: [&str; 2]) -> Result<(), String> {
    match of {
        "Scene" => agree::<SceneDescription>(json, ron),
        "Settings" => agree::<SettingsDescription>(json, ron),
        "Camera" => agree::<CameraDescription>(json, ron),
        "Film" => agree::<FilmDescription>(json, ron),
        "Filter" => agree::<FilterDescription>(json, ron),
        "Texture" => agree::<TextureDescription>(json, ron),
        "Material" => agree::<MaterialDescription>(json, ron),
        "Distribution" => agree::<Distribution>(json, ron),
        "Light" => agree::<LightDescription>(json, ron),
        "Shape" => agree::<ShapeDescription>(json, ron),
        "ShapeKind" => agree::<ShapeKind>(json, ron),
        "TransformStep" => agree::<TransformStep>(json, ron),
        other => panic!("the schema has a type that this test does not know: {other}"),
    }
}

/// What comes of leaving a field out, and of writing `default` in its place.
fn compare(root: &Value, table: &Fields, field: &str, default: &Value) -> Result<(), String> {
    let without = table.instance(root, &[]);
    let with = table.instance(root, &[(field, default)]);
    let own = match table.of.as_str() {
        "Scene" => root,
        of => &root["$defs"][of],
    };
    let ron = [&without, &with].map(|value| in_ron(root, own, value));
    agree_as(&table.of, [&without, &with], [&ron[0], &ron[1]])
        .map_err(|error| format!("{} {} {field}: {error}\n{ron:?}", table.of, table.variant))
}

#[test]
fn writing_a_default_is_leaving_it_out() {
    let root = scene_schema();
    let mut count = 0;
    for table in tables(&root) {
        for (field, schema) in table.each() {
            if let Some(default) = schema.get("default") {
                compare(&root, &table, field, default).expect("the documented default");
                count += 1;
            }
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn another_value_than_the_default_is_noticed() {
    let root = scene_schema();
    for (of, variant, field, wrong) in [
        ("Light", "Sun", "turbidity", serde_json::json!(4)),
        ("Film", "", "filter", serde_json::json!({"Tent": {"radius": 0.5}})),
        (
            "Material",
            "Plastic",
            "diffuse_reflectance",
            serde_json::json!([0.5, 0.5, 0.51]),
        ),
        ("Shape", "", "transform", serde_json::json!([{"Translate": [0, 0, 0]}])),
    ] {
        let tables = tables(&root);
        let table = tables.iter().find(|table| table.of == of && table.variant == variant);
        assert!(
            compare(&root, table.expect("a table"), field, &wrong).is_err(),
            "{of} {variant} {field}"
        );
    }
}

/// The rows of the page: type, variant, cells.
fn rows(page: &str) -> Vec<(String, String, Vec<String>)> {
    let (mut of, mut variant) = (String::new(), String::new());
    let mut rows = Vec::new();
    for line in page.lines() {
        if let Some(name) = line.strip_prefix("## ") {
            (of, variant) = (name.to_owned(), String::new());
        } else if let Some(name) = line.strip_prefix("### ") {
            variant = name.split('`').nth(1).expect("a variant").to_owned();
        } else if let Some(cells) = line.strip_prefix("| `") {
            let cells = cells.trim_end_matches(" |").split(" | ").map(str::trim);
            rows.push((of.clone(), variant.clone(), cells.map(str::to_owned).collect()));
        }
    }
    rows
}

/// The page says of every field of every variant what the schema says.
#[test]
fn the_reference_has_every_field_with_its_default() {
    let (root, page) = (scene_schema(), reference());
    let rows = rows(&page);
    let mut count = 0;
    for table in tables(&root) {
        for (field, schema) in table.each() {
            count += 1;
            let name = format!("{field}`");
            let row = rows
                .iter()
                .find(|(of, variant, cells)| *of == table.of && *variant == table.variant && cells[0] == name);
            let (.., cells) = row.unwrap_or_else(|| panic!("{} {} {field} is not there", table.of, table.variant));
            let expected = match schema.get("default") {
                _ if table.requires(field) => "required".to_owned(),
                None | Some(Value::Null) => {
                    assert!(!cells[3].starts_with('`'), "{cells:?}");
                    continue;
                }
                Some(value) => format!("`{}`", in_ron(&root, schema, value)),
            };
            assert_eq!(cells[3], expected, "{} {} {field}", table.of, table.variant);
        }
    }
    assert_eq!(count, rows.len());
}

/// `Default 3.` and `in [1, 10]` in a description are what the schema has.
#[test]
fn descriptions_agree_with_what_they_describe() {
    let root = scene_schema();
    let (mut defaults, mut ranges) = (0, 0);
    for table in tables(&root) {
        for (field, schema) in table.each() {
            let place = format!("{} {} {field}", table.of, table.variant);
            let text = schema["description"].as_str().expect("a description");
            if let Some((_, value)) = text.split_once("Default ") {
                let default = schema
                    .get("default")
                    .unwrap_or_else(|| panic!("{place} has no default"));
                let value = value.trim_start_matches('`');
                assert!(is_stated(&root, schema, default, value), "{place}: {text}");
                defaults += 1;
            }
            if let Some((_, range)) = text.split_once("in [").or(text.split_once("in (")) {
                ranges += usize::from(holds_range(&root, schema, range, &place));
            }
        }
    }
    assert!(defaults > 30 && ranges > 20, "{defaults} {ranges}");
}

/// Whether `text` begins with the default: as RON, or as one number for all channels.
pub(super) fn is_stated(root: &Value, schema: &Value, default: &Value, text: &str) -> bool {
    let begins = |value: &str| {
        text.strip_prefix(value)
            .is_some_and(|rest| !rest.starts_with(|next: char| next.is_alphanumeric()) && !is_fraction(rest))
    };
    let one = match default.as_array().map(Vec::as_slice) {
        Some([first, rest @ ..]) if rest.iter().all(|other| other == first) => begins(&first.to_string()),
        _ => false,
    };
    one || begins(&in_ron(root, schema, default))
}

/// Whether a number goes on: `.5`.
fn is_fraction(rest: &str) -> bool {
    let mut next = rest.chars();
    next.next() == Some('.') && next.next().is_some_and(|digit| digit.is_ascii_digit())
}

/// Holds the bounds that `range` begins with (`0, 1] ...`) against the schema's; whether there were numbers to hold.
pub(super) fn holds_range(root: &Value, schema: &Value, range: &str, place: &str) -> bool {
    let Some(inside) = range.split([']', ')']).next() else {
        return false;
    };
    let Some((least, most)) = inside.split_once(", ") else {
        return false;
    };
    let bounds = bounds(root, resolve(root, schema));
    let mut held = false;
    if let Ok(least) = least.parse::<f64>() {
        assert_eq!(bounds.least.map(|(least, _)| least), Some(least), "{place}: {range}");
        held = true;
    }
    if let Ok(most) = most.parse::<f64>() {
        assert_eq!(bounds.most, Some(most), "{place}: {range}");
        held = true;
    }
    held
}
