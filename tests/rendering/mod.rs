//! The renderer as a whole: same bytes, same light, exactly the planned tables.

mod bytes;
mod metrics;
mod oracle;
mod staged;
mod target;
mod world;

use chainlight::film::Picture;
use chainlight::plan::{Plan, Technique};
use chainlight::render::Render;
use chainlight::scene::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::support::scenes::{box_filtered, compile, inline, shipped};

/// A render that has taken no step yet.
pub fn start(scene: &Arc<Scene>, technique: Technique, seed: u64, threads: usize, tile: Option<u32>) -> Render {
    let plan = Plan::new(scene, technique, tile);
    Render::new(Arc::clone(scene), plan, seed, threads).expect("a small film and few threads")
}

/// The picture of `steps` samples per pixel.
pub fn picture(scene: &Arc<Scene>, technique: Technique, seed: u64, steps: u64) -> Picture {
    let plan = Plan::new(scene, technique, None);
    let nobody = AtomicBool::new(false);
    let render = chainlight::render::start(Arc::clone(scene), plan, seed, 2, &nobody, &|_| {});
    let mut render = render.expect("a small film and few threads");
    render.burst(steps, &|_| {});
    render.picture()
}
