//! Scenes of tests: those that ship, and those that a test writes.

use chainlight::scene::{
    Format, LightDescription, Scene, SceneOverrides, SceneSource, ShapeKind, flatten, parse_scene, read_scene,
};
use std::path::Path;
use std::sync::Arc;

/// A shipped scene, compiled with a film of `size` x `size` pixels and the given filter instead of its own.
pub fn shipped(name: &str, size: u32) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    compile(
        &read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain())),
        size,
    )
}

/// The glass box with a lamp for a ceiling, and paths of up to `max_depth` edges: what is there is found with about as much light by
/// all that finds it.
pub fn glass_under_wide_lamp(size: u32, max_depth: u32) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/cornell-glass.ron");
    let mut source = read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain()));
    source.description.settings.max_depth = max_depth;
    for shape in &mut source.description.shapes {
        if let (Some(_), ShapeKind::Quad { corner, edge_u, edge_v }) = (shape.emission, &mut shape.shape) {
            // Just below the ceiling.
            *corner = [6.0, 545.0, 10.0];
            (edge_u[0], edge_v[2]) = (530.0, 530.0);
        }
    }
    compile(&source, size)
}

/// A shipped scene with the box filter of the references, its lights scaled by `brightness`.
pub fn box_filtered(name: &str, size: u32, brightness: f32) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    let mut source = read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain()));
    source.description.film.filter = Default::default();
    for emission in source
        .description
        .shapes
        .iter_mut()
        .filter_map(|shape| shape.emission.as_mut())
    {
        *emission = *emission * brightness;
    }
    source
        .description
        .lights
        .iter_mut()
        .for_each(|light| brighten(light, brightness));
    compile(&source, size)
}

fn brighten(light: &mut LightDescription, by: f32) {
    match light {
        LightDescription::Point { intensity: light, .. }
        | LightDescription::Spot { intensity: light, .. }
        | LightDescription::Directional { irradiance: light, .. } => *light = *light * by,
        LightDescription::Environment { radiance, scale, .. } => {
            *radiance = radiance.map(|radiance| radiance * by);
            if radiance.is_none() {
                *scale *= by;
            }
        }
        LightDescription::Sun { scale, .. } | LightDescription::Sky { scale, .. } => *scale *= by,
    }
}

/// A scene written in a test.
pub fn inline(text: &str, size: u32) -> Arc<Scene> {
    let source = parse_scene("inline.ron", text, Format::Ron, Path::new("."));
    compile(&source.unwrap_or_else(|error| panic!("{}", error.plain())), size)
}

/// A scene written in a test, with the film that it names.
pub fn as_written(text: &str) -> Arc<Scene> {
    let source = parse_scene("inline.ron", text, Format::Ron, Path::new("."));
    let source = source.unwrap_or_else(|error| panic!("{}", error.plain()));
    let flattened = flatten(&source).unwrap_or_else(|error| panic!("{}", error.plain()));
    Arc::new(Scene::compile(&source.description, &flattened, SceneOverrides::default()).expect("a valid filter"))
}

/// A scene compiled with a square film of `size` x `size` pixels.
pub fn compile(source: &SceneSource, size: u32) -> Arc<Scene> {
    let flattened = flatten(source).unwrap_or_else(|error| panic!("{}", error.plain()));
    let overrides = SceneOverrides {
        size: Some((size, size)),
        max_depth: None,
    };
    Arc::new(Scene::compile(&source.description, &flattened, overrides).expect("a valid filter"))
}
