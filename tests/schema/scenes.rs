//! The schema accepts what the reader accepts, and refuses mistakes.

use super::{least, repository, tables};
use chainlight::scene::schema::{resolve, scene_schema};
use chainlight::scene::{Format, SceneError, flatten, parse_scene, read_scene, validate};
use jsonschema::Validator;
use rand_core::Rng;
use rand_pcg::Pcg32;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

fn validator() -> Validator {
    jsonschema::draft202012::new(&scene_schema()).expect("a valid schema")
}

fn complaints(validator: &Validator, scene: &Value) -> String {
    let all = validator.iter_errors(scene);
    all.map(|error| format!("{}: {error}", error.instance_path()))
        .collect::<Vec<_>>()
        .join("\n")
}

fn shipped() -> Vec<PathBuf> {
    let folders = ["scenes", "scenes/materials"].map(|folder| repository().join(folder));
    let entries = folders
        .iter()
        .flat_map(|folder| folder.read_dir().expect("a folder"))
        .map(|entry| entry.expect("an entry").path());
    let mut scenes: Vec<PathBuf> = entries
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .collect();
    scenes.sort();
    scenes
}

#[test]
fn every_shipped_scene_follows_the_schema() {
    let validator = validator();
    let scenes = shipped();
    assert!(scenes.len() >= 12, "{scenes:?}");
    for path in scenes {
        let source = read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain()));
        let json = serde_json::to_string(&source.description).expect("JSON");
        let scene = serde_json::from_str(&json).expect("JSON");
        assert_eq!(complaints(&validator, &scene), "", "{}", path.display());
    }
}

/// Nothing but what the showcase, a template, has in store for other subjects.
#[test]
fn every_shipped_scene_is_read_without_a_warning() {
    for path in shipped() {
        let source = read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain()));
        let flattened = flatten(&source).unwrap_or_else(|error| panic!("{}", error.plain()));
        let warnings = flattened.warnings.iter().map(|warning| warning.plain());
        let in_store = ["no shape uses the material", "no material of a shape uses the texture"];
        let is_template = path.ends_with("materials/showcase.ron");
        let others: Vec<String> = warnings
            .filter(|warning| !(is_template && in_store.iter().any(|words| warning.contains(words))))
            .collect();
        assert!(others.is_empty(), "{}: {others:?}", path.display());
    }
}

/// The JSON scene that the readme shows.
fn readme_scene() -> Value {
    let readme = include_str!("../../README.md");
    let blocks = readme.split("```json\n").skip(1);
    let mut scenes = blocks.filter(|block| block.starts_with("{\n  \"$schema\""));
    let text = scenes
        .next()
        .and_then(|block| block.split("```").next())
        .expect("a scene");
    serde_json::from_str(text).expect("JSON")
}

fn try_validate(scene: &Value) -> Result<(), SceneError> {
    let source = parse_scene("scene.json", &scene.to_string(), Format::Json, Path::new(""))?;
    validate(&source).map(|_| ())
}

#[test]
fn the_readmes_json_scene_is_one() {
    let scene = readme_scene();
    assert_eq!(complaints(&validator(), &scene), "");
    let source = parse_scene("scene.json", &scene.to_string(), Format::Json, Path::new("")).expect("a scene");
    assert!(flatten(&source).expect("a valid scene").warnings.is_empty());
}

/// A mistake: what it is, where, and what stands there (nothing removes the field).
type Mistake = (&'static str, &'static str, Option<Value>);

fn mistakes() -> Vec<Mistake> {
    vec![
        ("misspelt field", "/film/widht", Some(json!(64))),
        (
            "misspelt field of a variant",
            "/camera/Perspective/fof",
            Some(json!(40)),
        ),
        ("misspelt block", "/material", Some(json!({}))),
        ("wrong type", "/film/width", Some(json!("wide"))),
        ("fraction of a pixel", "/film/width", Some(json!(64.5))),
        ("no pixels", "/film/width", Some(json!(0))),
        (
            "negative roughness",
            "/materials/satin/RoughConductor/alpha",
            Some(json!(-0.1)),
        ),
        ("too smooth", "/materials/satin/RoughConductor/alpha", Some(json!(1e-5))),
        (
            "reflects too much",
            "/materials/white/Diffuse/reflectance",
            Some(json!([0.5, 1.5, 0.5])),
        ),
        (
            "unknown variant",
            "/materials/white",
            Some(json!({"Difuse": {"reflectance": [1, 1, 1]}})),
        ),
        ("two variants at once", "/materials/white/Plastic", Some(json!({}))),
        (
            "unknown unit variant",
            "/camera/Perspective/fov_axis",
            Some(json!("vertical")),
        ),
        ("missing field", "/camera/Perspective/target", None),
        ("missing block", "/film", None),
        ("missing version", "/version", None),
        ("another version", "/version", Some(json!(2))),
        (
            "colour of five numbers",
            "/materials/white/Diffuse/reflectance",
            Some(json!([1, 1, 1, 1, 1])),
        ),
        (
            "colour of two numbers",
            "/materials/white/Diffuse/reflectance",
            Some(json!([1, 1])),
        ),
        (
            "one number for a colour",
            "/materials/white/Diffuse/reflectance",
            Some(json!(1)),
        ),
        (
            "nameless texture",
            "/materials/white/Diffuse/reflectance",
            Some(json!("")),
        ),
        (
            "nameless material",
            "/materials/",
            Some(json!({"Diffuse": {"reflectance": [1, 1, 1]}})),
        ),
        ("negative light", "/shapes/1/emission", Some(json!([1, -1, 1]))),
        ("radius of zero", "/shapes/1/shape/Sphere/radius", Some(json!(0))),
        (
            "coordinate out of reach",
            "/shapes/1/shape/Sphere/center",
            Some(json!([0, 1e10, 0])),
        ),
        (
            "unknown metal",
            "/materials/satin/RoughConductor/metal",
            Some(json!("Gold")),
        ),
        (
            "fields for numbers",
            "/shapes/1/transform",
            Some(json!([{"Translate": {"x": 1, "y": 2, "z": 3}}])),
        ),
        ("a step that is none", "/shapes/1/transform", Some(json!(["Translate"]))),
        ("no shapes", "/shapes", Some(json!([]))),
        ("null for a number", "/film/width", Some(json!(null))),
        ("angle of view", "/camera/Perspective/fov", Some(json!(180))),
        ("half a schema", "/$schema", Some(json!(1))),
    ]
}

fn put(scene: &mut Value, place: &str, value: Option<Value>) {
    let (parent, name) = place.rsplit_once('/').expect("a place");
    let parent = scene.pointer_mut(parent).and_then(Value::as_object_mut).expect(place);
    match value {
        Some(value) => parent.insert(name.to_owned(), value),
        None => Some(parent.remove(name).expect(place)),
    };
}

#[test]
fn mistakes_are_refused_by_the_schema_and_by_the_reader() {
    let validator = validator();
    let whole = json!({
        "version": 1,
        "camera": {"Perspective": {"origin": [0, 1, 5], "target": [0, 1, 0], "fov": 40, "fov_axis": "Vertical"}},
        "film": {"width": 64, "height": 64},
        "materials": {
            "white": {"Diffuse": {"reflectance": [0.5, 0.5, 0.5]}},
            "satin": {"RoughConductor": {"metal": "Au", "alpha": 0.1}},
        },
        "shapes": [
            {"shape": {"Quad": {"corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0]}}, "material": "satin"},
            {"shape": {"Sphere": {"radius": 1}}, "material": "white", "emission": [1, 1, 1], "transform": []},
        ],
    });
    assert_eq!(complaints(&validator, &whole), "");
    assert!(try_validate(&whole).is_ok());
    for (what, place, value) in mistakes() {
        let mut scene = whole.clone();
        put(&mut scene, place, value);
        assert!(!validator.is_valid(&scene), "the schema accepts: {what}");
        assert!(try_validate(&scene).is_err(), "the reader accepts: {what}");
    }
}

/// A number from 0 to below `count`.
fn below(random: &mut Pcg32, count: usize) -> usize {
    (random.next_u64() % count.max(1) as u64) as usize
}

/// A value that a schema allows, drawn at random: every choice, bounds themselves and what lies between.
fn draw(root: &Value, schema: &Value, random: &mut Pcg32) -> Value {
    let schema = resolve(root, schema);
    for choices in ["oneOf", "anyOf", "enum"] {
        if let Some(all) = schema.get(choices).and_then(Value::as_array) {
            let chosen = &all[below(random, all.len())];
            return if choices == "enum" {
                chosen.clone()
            } else {
                draw(root, chosen, random)
            };
        }
    }
    if let Some(value) = schema.get("const") {
        return value.clone();
    }
    let kind = match &schema["type"] {
        Value::Array(kinds) => &kinds[below(random, kinds.len())],
        kind => kind,
    };
    match kind.as_str().expect("a type") {
        "null" => Value::Null,
        "boolean" => json!(below(random, 2) == 0),
        "string" => json!(["x", "a b", "ü\"\\"][below(random, 3)]),
        "integer" => {
            let [least, most] = ["minimum", "maximum"].map(|key| schema[key].as_u64().expect("a bound"));
            json!([least, most, least + below(random, (most - least) as usize) as u64][below(random, 3)])
        }
        "number" => {
            let most = schema["maximum"].as_f64().expect("a bound");
            let least = schema.get("minimum").and_then(Value::as_f64);
            let least = least.unwrap_or(1e-30);
            let share = below(random, 1 << 20) as f64 / f64::from(1 << 20);
            json!([least, most, least + (most - least) * share, 1.0_f64.clamp(least, most)][below(random, 4)])
        }
        "array" => {
            let least = schema.get("minItems").and_then(Value::as_u64).unwrap_or(0) as usize;
            let count = match schema.get("maxItems") {
                Some(_) => least,
                None => least + below(random, 3),
            };
            (0..count).map(|_| draw(root, &schema["items"], random)).collect()
        }
        "object" => {
            let mut object = Map::new();
            let required = schema.get("required").and_then(Value::as_array);
            for (name, field) in schema
                .get("properties")
                .and_then(Value::as_object)
                .into_iter()
                .flatten()
            {
                let is_required = required.is_some_and(|names| names.iter().any(|required| required == name));
                if is_required || below(random, 2) == 0 {
                    object.insert(name.clone(), draw(root, field, random));
                }
            }
            if let Some(entries @ Value::Object(_)) = schema.get("additionalProperties") {
                for name in ["a", "b c"] {
                    object.insert(name.to_owned(), draw(root, entries, random));
                }
            }
            Value::Object(object)
        }
        other => panic!("{other}"),
    }
}

#[test]
fn what_follows_the_schema_is_read() {
    const CASES: usize = 1000;
    let (root, validator) = (scene_schema(), validator());
    let mut random = Pcg32::new(7, 1);
    for case in 0..CASES {
        let scene = draw(&root, &root, &mut random);
        assert_eq!(complaints(&validator, &scene), "", "{scene}");
        let read = parse_scene("scene.json", &scene.to_string(), Format::Json, Path::new(""));
        if let Err(error) = read {
            panic!("case {case}: {}", error.plain());
        }
    }
}

#[test]
fn the_least_of_every_variant_is_read() {
    let (root, validator) = (scene_schema(), validator());
    for table in tables(&root) {
        let value = table.instance(&root, &[]);
        let mut scene = least(&root, &root);
        match table.of.as_str() {
            "Scene" => {}
            "Settings" => scene["settings"] = value,
            "Camera" => scene["camera"] = value,
            "Film" => scene["film"] = value,
            "Filter" => scene["film"]["filter"] = value,
            "Texture" => scene["textures"] = json!({ "x": value }),
            "Material" => scene["materials"] = json!({ "x": value }),
            "Light" => scene["lights"] = json!([value]),
            "Shape" => scene["shapes"] = json!([value]),
            "ShapeKind" => scene["shapes"][0]["shape"] = value,
            "TransformStep" => scene["shapes"][0]["transform"] = json!([value]),
            other => panic!("the schema has a type that this test does not know: {other}"),
        }
        assert_eq!(complaints(&validator, &scene), "", "{scene}");
        let read = parse_scene("scene.json", &scene.to_string(), Format::Json, Path::new(""));
        assert!(read.is_ok(), "{} {}", table.of, table.variant);
    }
}
