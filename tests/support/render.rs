//! Small renders, judged by the film's own standard errors.

use chainlight::film::Picture;
use chainlight::plan::{Plan, Technique};
use chainlight::render::{Render, Rendering};
use chainlight::scene::{Format, Scene, SceneOverrides, flatten, parse_scene};
use chainlight::stats::z_test::Estimate;
use std::path::Path;
use std::sync::Arc;

/// Pixels along each side of the film of [`scene`].
pub const SIDE: u32 = 16;

/// The compiled scene of a camera, materials and shapes in the format's own words, before a square film.
pub fn scene(max_depth: u32, camera: &str, materials: &str, shapes: &str) -> Arc<Scene> {
    lit_scene(max_depth, camera, materials, shapes, "")
}

/// [`scene`] with lights that are no shapes.
pub fn lit_scene(max_depth: u32, camera: &str, materials: &str, shapes: &str, lights: &str) -> Arc<Scene> {
    let text = format!(
        "(version: 1, settings: (max_depth: {max_depth}), camera: Perspective({camera}),
        film: (width: {SIDE}, height: {SIDE}), materials: {{{materials}}}, shapes: [{shapes}],
        lights: [{lights}])"
    );
    let source = parse_scene("test.ron", &text, Format::Ron, Path::new("")).unwrap_or_else(|e| panic!("{}", e.plain()));
    let flattened = flatten(&source).unwrap_or_else(|e| panic!("{}", e.plain()));
    let scene = Scene::compile(&source.description, &flattened, SceneOverrides::default());
    Arc::new(scene.expect("the box filter can be sampled"))
}

/// The picture of `steps` samples per pixel. Every sample must have been finite and within the film's range.
pub fn picture(scene: &Arc<Scene>, technique: Technique, seed: u64, steps: u64) -> Picture {
    let plan = Plan::new(scene, technique, None);
    // One thread: the tests themselves run side by side.
    let mut render = Render::new(Arc::clone(scene), plan, seed, 1).expect("a film of a few pixels");
    render.burst(steps, &|_| ());
    assert_eq!(render.film.rejected(), 0, "{:?}", render.film.tally());
    render.film.develop()
}

/// The mean of one channel over the pixels that `chosen` names by column and row, with its standard error.
pub fn mean(picture: &Picture, channel: usize, chosen: impl Fn(u32, u32) -> bool) -> Estimate {
    let (mut sum, mut variance, mut pixels) = (0.0, 0.0, 0.0);
    for pixel in 0..picture.rgb.len() {
        let (column, row) = (pixel as u32 % picture.width, pixel as u32 / picture.width);
        if chosen(column, row) {
            let error = f64::from(picture.error[pixel].to_array()[channel]);
            sum += f64::from(picture.rgb[pixel].to_array()[channel]);
            variance += error * error;
            pixels += 1.0;
        }
    }
    Estimate {
        mean: sum / pixels,
        error: variance.sqrt() / pixels,
    }
}

/// The mean over the whole film.
pub fn whole(picture: &Picture, channel: usize) -> Estimate {
    mean(picture, channel, |_, _| true)
}

/// The means over the quarters of the film.
pub fn quarters(picture: &Picture, channel: usize) -> [Estimate; 4] {
    let half = SIDE / 2;
    [0, 1, 2, 3].map(|q| mean(picture, channel, |x, y| x / half + 2 * (y / half) == q))
}

/// Everything a picture says, as bytes.
pub fn picture_bytes(picture: &Picture) -> Vec<u8> {
    let channels = picture.rgb.iter().chain(&picture.error).flat_map(|rgb| rgb.to_array());
    channels
        .chain(picture.weight.iter().copied())
        .flat_map(f32::to_le_bytes)
        .collect()
}
