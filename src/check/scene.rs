//! The scene that mutations are checked in where none is given.

use crate::scene::{Format, Scene, SceneOverrides, flatten, parse_scene};
use miette::{Result, miette};
use std::path::Path;
use std::sync::Arc;

/// A corner of a diffuse room with a glass sphere, a mirror of metal and two lights off its middle: paths of several lengths
/// and signatures, diffuse and specular. It is open to the front and above, so that paths end at every depth.
/// The lights are large and not much brighter than what they light: replicas that see them weigh little more than others.
const TEXT: &str = r#"(
    version: 1,
    settings: (max_depth: 7),
    camera: Perspective(origin: (0.3, 1.1, 4.2), target: (0, 0.8, 0), fov: 42),
    film: (width: 16, height: 16),
    materials: {
        "white": Diffuse(reflectance: (0.8, 0.8, 0.75)),
        "red": Diffuse(reflectance: (0.7, 0.25, 0.2)),
        "glass": Dielectric(interior_ior: 1.5),
        "metal": Conductor(eta: (0.2, 0.92, 1.1), k: (3.9, 2.45, 2.14)),
        "lamp": Diffuse(reflectance: (0.1, 0.1, 0.1)),
    },
    shapes: [
        (name: "floor", shape: Quad(corner: (-2, 0, 2), edge_u: (4, 0, 0), edge_v: (0, 0, -4)), material: "white"),
        (name: "back", shape: Quad(corner: (-2, 0, -2), edge_u: (4, 0, 0), edge_v: (0, 3, 0)), material: "white"),
        (name: "left", shape: Quad(corner: (-2, 0, 2), edge_u: (0, 0, -4), edge_v: (0, 3, 0)), material: "red"),
        (name: "mirror", shape: Quad(corner: (2, 0.2, -1.5), edge_u: (0, 0, 2), edge_v: (0, 1.5, 0)), material: "metal"),
        (name: "ball", shape: Sphere(center: (0.4, 0.7, 0.4), radius: 0.6), material: "glass"),
        (name: "lamp", shape: Sphere(center: (-0.9, 2.3, 0.2), radius: 0.6), material: "lamp", emission: (2, 1.7, 1.3)),
        (name: "small lamp", shape: Sphere(center: (1.3, 0.4, -0.9), radius: 0.35), material: "lamp", emission: (1, 1.3, 2.7)),
    ],
)"#;

/// The scene that mutations are checked in where none is given: a small room with glass, metal and two lights.
///
/// # Errors
/// None, as a test holds.
pub fn built_in_scene() -> Result<Arc<Scene>> {
    let source = parse_scene("built-in scene", TEXT, Format::Ron, Path::new("."))?;
    let flattened = flatten(&source)?;
    if let Some(warning) = flattened.warnings.first() {
        return Err(miette!("the built-in scene: {}", warning.plain()));
    }
    let scene = Scene::compile(&source.description, &flattened, SceneOverrides::default())?;
    Ok(Arc::new(scene))
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_built_in_scene_compiles() {
        let scene = super::built_in_scene().expect("a scene");
        assert_eq!((scene.width, scene.height, scene.light_names.len()), (16, 16, 2));
    }
}
