//! Renders a scene without touching the disk: read, flatten, compile, plan, render, develop.
//!
//! `cargo run --release --example render_to_memory [SCENE]`
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

use chainlight::plan::{Plan, Technique};
use chainlight::render::{Budget, Render, drive};
use chainlight::scene::{Scene, SceneOverrides, flatten, read_scene};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

fn main() -> miette::Result<()> {
    let path = std::env::args_os()
        .nth(1)
        .map_or_else(|| PathBuf::from("scenes/cornell-box.ron"), PathBuf::from);
    let source = read_scene(&path)?;
    let flattened = flatten(&source)?;
    let overrides = SceneOverrides {
        size: Some((128, 128)),
        max_depth: None,
    };
    let scene = Arc::new(Scene::compile(&source.description, &flattened, overrides)?);

    let plan = Plan::new(&scene, Technique::Pt, None);
    for effect in plan.effects.iter().filter(|effect| effect.on) {
        println!("{}: {}", effect.effect.name(), effect.reason);
    }

    let (seed, threads) = (0, 2);
    let mut render = Render::new(scene, plan, seed, threads)?;
    let outcome = drive(&mut render, Budget::Steps(32), &AtomicBool::new(false), &|_| {});
    let picture = render.film.develop();
    let mean = picture.rgb.iter().map(|rgb| rgb.mean()).sum::<f32>() / picture.rgb.len() as f32;
    println!(
        "{} samples per pixel in {:.2?}; mean radiance {mean:.4}",
        outcome.steps, outcome.elapsed
    );
    Ok(())
}
