//! Holds the values of a scene against their ranges: every number finite, and nothing that a later stage would divide
//! by can be zero. What depends on transforms and on mesh files is checked where they are applied and read.

mod light;
mod material;
mod shape;
mod texture;
mod view;

use super::at::At;
use super::description::{MAX_DEPTH_LIMIT, MaterialDescription, SceneDescription, ShapeKind};
use super::error::{SceneError, SceneWarning};
use super::read::SceneSource;
use std::collections::{BTreeMap, BTreeSet};

/// Checks a scene, and returns what is allowed but probably not meant.
///
/// # Errors
/// At the first value that is out of its range, with its place.
pub fn validate(source: &SceneSource) -> Result<Vec<SceneWarning>, SceneError> {
    let scene = &source.description;
    let root = At::root(source);
    let max_depth = scene.settings.max_depth;
    if !(1..=MAX_DEPTH_LIMIT).contains(&max_depth) {
        let message = format!("expected a depth from 1 to {MAX_DEPTH_LIMIT}, found {max_depth}");
        let help = "it counts edges: 1 shows emitters alone, 2 adds direct light, 16 is the default";
        return Err(root.key("settings").key("max_depth").error(message, help));
    }
    view::film(&root.key("film"), &scene.film)?;
    view::camera(&root.key("camera"), &scene.camera)?;
    for (name, texture) in &scene.textures {
        if name.is_empty() {
            return Err(root.key("textures").name(name).error("a texture's name is empty", ""));
        }
        texture::check(&root.key("textures").key(name), texture)?;
    }
    let known = material::Known {
        materials: &scene.materials,
        textures: scene.textures.keys().map(String::as_str).collect(),
    };
    for (name, material) in &scene.materials {
        if name.is_empty() {
            return Err(root.key("materials").name(name).error("a material's name is empty", ""));
        }
        material::check(&root.key("materials").key(name), material, &known)?;
    }
    for (index, light) in scene.lights.iter().enumerate() {
        light::check(&root.key("lights").index(index), light)?;
    }
    let shapes = root.key("shapes");
    if scene.shapes.is_empty() {
        return Err(shapes.error(
            "expected at least one shape",
            "such as `(shape: Sphere(radius: 1), material: \"white\")`",
        ));
    }
    let mut names = BTreeMap::new();
    for (index, shape) in scene.shapes.iter().enumerate() {
        let at = shapes.index(index);
        if let Some(name) = &shape.name {
            if name.is_empty() {
                return Err(at
                    .key("name")
                    .error("a shape's name is empty", "leave it out, or give it one"));
            }
            if let Some(first) = names.insert(name, index) {
                let message = format!("the name `{name}` belongs to shapes[{first}] already");
                return Err(at
                    .key("name")
                    .error(message, "give each shape a name of its own, or none"));
            }
        }
        shape::check(&at, shape, &scene.materials)?;
    }
    Ok(unused_materials(&root, scene).into_iter().collect())
}

/// One warning for all of them: each would walk the text again.
fn unused_materials(root: &At, scene: &SceneDescription) -> Option<SceneWarning> {
    let named = scene.shapes.iter().filter_map(|shape| shape.material.as_ref());
    let sides = scene.materials.values().flat_map(|material| match material {
        MaterialDescription::TwoSided { front, back } => vec![front, back],
        _ => Vec::new(),
    });
    let used: BTreeSet<&String> = named.chain(sides).collect();
    let unused: Vec<&String> = scene.materials.keys().filter(|name| !used.contains(name)).collect();
    let at = root.key("materials").name(unused.first()?);
    let mut names = unused
        .iter()
        .take(5)
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ");
    if unused.len() > 5 {
        names.push_str(&format!(" and {} more", unused.len() - 5));
    }
    let help = "remove what is not needed, or name it in a shape's `material`";
    Some(at.warning(format!("no shape uses the material {names}"), help))
}

/// Whether a shape's material must stand in the scene file: a mesh may bring its own.
pub(super) fn needs_material(kind: &ShapeKind) -> bool {
    !matches!(kind, ShapeKind::Obj { .. })
}
