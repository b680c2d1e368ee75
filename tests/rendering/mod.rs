//! The renderer as a whole: same bytes, same light, exactly the planned tables.

mod bytes;
mod oracle;
mod staged;
mod target;
mod world;

use chainlight::film::Picture;
use chainlight::plan::{Plan, Technique};
use chainlight::render::{Render, Rendering};
use chainlight::scene::{Format, Scene, SceneOverrides, SceneSource, flatten, parse_scene, read_scene};
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
    compile(&source, size)
}

/// A scene written in a test.
pub fn inline(text: &str, size: u32) -> Arc<Scene> {
    let source = parse_scene("inline.ron", text, Format::Ron, Path::new("."));
    compile(&source.unwrap_or_else(|error| panic!("{}", error.plain())), size)
}

fn compile(source: &SceneSource, size: u32) -> Arc<Scene> {
    let flattened = flatten(source).unwrap_or_else(|error| panic!("{}", error.plain()));
    let overrides = SceneOverrides {
        size: Some((size, size)),
        max_depth: None,
    };
    Arc::new(Scene::compile(&source.description, &flattened, overrides).expect("a valid filter"))
}

/// A render that has taken no step yet.
pub fn start(scene: &Arc<Scene>, technique: Technique, seed: u64, threads: usize, tile: Option<u32>) -> Render {
    let plan = Plan::new(scene, technique, tile);
    Render::new(Arc::clone(scene), plan, seed, threads).expect("a small film and few threads")
}

/// The picture of `steps` samples per pixel.
pub fn picture(scene: &Arc<Scene>, technique: Technique, seed: u64, steps: u64) -> Picture {
    let mut render = start(scene, technique, seed, 2, None);
    render.burst(steps, &|_| {});
    render.film.develop()
}
