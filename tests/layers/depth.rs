//! Layers by length: paths of so many edges are what a render with fewer edges has, from the same numbers.

use super::{begun, plan};
use crate::support::scenes::{compile, shipped};
use chainlight::layer::Layers;
use chainlight::plan::{Base, Technique};
use chainlight::scene::{Scene, read_scene};
use std::path::Path;
use std::sync::Arc;

const SIZE: u32 = 24;
const STEPS: u64 = 12;
/// Edges before roulette: beyond it, a path's numbers depend on how long it may become.
const EDGES: [u32; 4] = [1, 2, 3, 4];
/// Layers are rounded apart from pictures: relative to the pixel, and, films being in fixed point, to the brightest one.
const ROUNDING: f64 = 4e-6;
const RESOLUTION: f64 = 1.0 / (1_u64 << 38) as f64;

fn limited(name: &str, max_depth: u32) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    let mut source = read_scene(&path).unwrap_or_else(|error| panic!("{}", error.plain()));
    source.description.settings.max_depth = max_depth;
    compile(&source, SIZE)
}

/// A render's picture as numbers.
fn picture(scene: &Arc<Scene>) -> Vec<f64> {
    let mut render = begun(scene, plan(scene, (Technique::Pt, Base::Pt), None), 11, 1);
    render.burst(STEPS, &|_| {});
    numbers(&render.picture().rgb)
}

fn numbers(rgb: &[chainlight::color::Rgb]) -> Vec<f64> {
    rgb.iter().flat_map(|rgb| rgb.to_array()).map(f64::from).collect()
}

/// The largest difference relative to `b` that the films' resolution does not explain.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let explained = RESOLUTION * b.iter().copied().fold(0.0, f64::max);
    let of_pixel = |(a, b): (&f64, &f64)| ((a - b).abs() - explained).max(0.0) / b.abs().max(f64::MIN_POSITIVE);
    a.iter().zip(b).map(of_pixel).fold(0.0, f64::max)
}

#[test]
fn layers_of_short_paths_are_the_picture_that_short_paths_make() {
    for name in ["cornell-glass.ron", "island.ron", "veach-plates.ron"] {
        let scene = shipped(name, SIZE);
        let layers = [("one", "CL"), ("two", "C.L"), ("three", "C..L"), ("four", "C.{3}L")];
        let layers = Some(Arc::new(Layers::new(layers).expect("expressions")));
        let mut render = begun(&scene, plan(&scene, (Technique::Pt, Base::Pt), layers), 11, 1);
        render.burst(STEPS, &|_| {});
        let mut sum = vec![0.0; (3 * SIZE * SIZE) as usize];
        for (layer, edges) in render.layers().iter().zip(EDGES) {
            let more = numbers(&layer.rgb);
            assert!(
                more.iter().any(|&value| value > 0.0),
                "{name}: no path has {edges} edges"
            );
            sum.iter_mut().zip(&more).for_each(|(sum, more)| *sum += more);
            let expected = picture(&limited(name, edges));
            let off = difference(&sum, &expected);
            assert!(off < ROUNDING, "{name}, up to {edges} edges: off by {off:e}");
            let longer = difference(&sum, &picture(&limited(name, edges + 1)));
            assert!(longer > ROUNDING, "{name}: an edge more goes unnoticed");
        }
    }
}
