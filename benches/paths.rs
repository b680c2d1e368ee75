//! Chains of whole paths in stages (`mlt`) against their proposals made depth first (`mlt-reference`): nanoseconds per mutation, by
//! kind of mutation and by stage, with the length of paths (to 64 edges), and from a thousand chains to a quarter of a million. Both
//! techniques are in the same states, so the work is the same. All light is left to the chains.
//!
//! `cargo bench --bench paths` prints tables; with `-- box`, `-- glass`, `-- door`, `-- room`, `-- lengths` or `-- chains`, only that part. Rounds
//! interleave everything that is compared in one process: medians of ratios hold on a noisy machine, absolute times do not.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

#[path = "support/chains.rs"]
mod side_by_side;
mod support;

use chainlight::plan::{Direct, PlanOptions, Technique};
use chainlight::scene::{Format, Scene, SceneOverrides, flatten, parse_scene};
use side_by_side::{Compared, GROUPS, GROWTH, ROUNDS, USUAL_CHAINS, heading, stages};
use std::path::Path;
use std::sync::Arc;
use support::{bumpy_room, shipped};

/// Pixels along each side of the film.
const SIZE: u32 = 64;
const KINDS: [&str; 6] = [
    "new_path",
    "bidirectional",
    "lens",
    "lens_subpath",
    "caustic",
    "multi_chain",
];
/// Numbers of edges that all paths have.
const LENGTHS: [u32; 6] = [2, 4, 8, 16, 32, 64];

fn compared(shortest: Option<u32>) -> Compared {
    Compared {
        techniques: [Technique::Mlt, Technique::MltReference],
        options: PlanOptions {
            direct: Some(Direct::Chains),
            ..PlanOptions::default()
        },
        shortest,
    }
}

/// Mutations and stages on one scene. A mutation alone is tried where it is suitable; elsewhere a new path is made, and turned down.
fn tables(name: &str, scene: &Arc<Scene>) {
    println!(
        "\n{name}: {} primitives, {SIZE} x {SIZE} pixels, {GROUPS} groups, one thread; ns per mutation",
        scene.geometry.primitive_count()
    );
    let compared = compared(None);
    heading("mutation");
    let mixture = compared.line("as usual", scene, USUAL_CHAINS, None, ROUNDS[0]);
    for kind in KINDS {
        compared.line(kind, scene, USUAL_CHAINS, Some(kind), ROUNDS[0]);
    }
    println!("  as usual, by stage:");
    stages(&mixture);
}

/// A closed room whose walls emit and reflect: paths of any number of edges bring light.
fn room_of_light(max_depth: u32) -> Arc<Scene> {
    let wall = |corner: &str, u: &str, v: &str| {
        format!(r#"(shape: Quad(corner: {corner}, edge_u: {u}, edge_v: {v}), material: "wall", emission: (1, 1, 1)),"#)
    };
    let walls = [
        wall("(-1, -1, -1)", "(2, 0, 0)", "(0, 2, 0)"),
        wall("(-1, -1, 1)", "(0, 2, 0)", "(2, 0, 0)"),
        wall("(-1, -1, -1)", "(0, 2, 0)", "(0, 0, 2)"),
        wall("(1, -1, -1)", "(0, 0, 2)", "(0, 2, 0)"),
        wall("(-1, -1, -1)", "(0, 0, 2)", "(2, 0, 0)"),
        wall("(-1, 1, -1)", "(2, 0, 0)", "(0, 0, 2)"),
    ]
    .concat();
    let text = format!(
        r#"(version: 1, settings: (max_depth: {max_depth}),
        camera: Perspective(origin: (0.3, -0.4, 0.5), target: (-0.2, 0.1, -1), fov: 100),
        film: (width: {SIZE}, height: {SIZE}), materials: {{"wall": Diffuse(reflectance: (0.9, 0.9, 0.9))}}, shapes: [{walls}])"#
    );
    let source = parse_scene("room.ron", &text, Format::Ron, Path::new(".")).expect("a valid room");
    let flattened = flatten(&source).expect("a valid room");
    Arc::new(Scene::compile(&source.description, &flattened, SceneOverrides::default()).expect("a valid filter"))
}

fn lengths() {
    println!("\na room of light, where all paths have so many edges:");
    heading("edges");
    for length in LENGTHS {
        let scene = room_of_light(length);
        compared(Some(length)).line(&length.to_string(), &scene, USUAL_CHAINS / 4, None, ROUNDS[0]);
    }
}

fn chains(scene: &Arc<Scene>) {
    println!("\nthe Cornell box by so many chains:");
    heading("chains");
    for chains in GROWTH {
        compared(None).line(&chains.to_string(), scene, chains, None, ROUNDS[1]);
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // `cargo test --benches` runs this too, and wants no figures.
    if arguments.iter().any(|argument| argument == "--test") {
        return;
    }
    let parts = ["box", "glass", "door", "room", "lengths", "chains"];
    let asked = |part: &str| arguments.iter().any(|argument| argument == part);
    let wanted = |part| asked(part) || !parts.into_iter().any(asked);
    if wanted("box") {
        tables("Cornell box", &shipped("cornell-box", SIZE));
    }
    if wanted("glass") {
        tables("Cornell box with glass", &shipped("cornell-glass", SIZE));
    }
    if wanted("door") {
        tables("a door ajar", &shipped("door-ajar", SIZE));
    }
    if wanted("room") {
        tables("bumpy room", &bumpy_room(2_090_000, SIZE));
    }
    if wanted("lengths") {
        lengths();
    }
    if wanted("chains") {
        chains(&shipped("cornell-box", SIZE));
    }
}
