//! chainlight: an offline renderer for difficult light.
//!
//! From a file to a picture:
//!
//! 1. [`scene::read_scene`] reads a description, [`scene::flatten()`] validates it and puts its shapes into the world,
//!    [`scene::Scene::compile`] makes read-only tables of it, with a tree over its primitives;
//! 2. [`plan::Plan::new`] decides which effects exist, and which systems and columns they bring;
//! 3. [`render::Render::new`] builds tile worlds from the plan, and [`render::drive`] runs them, step by step, until a
//!    budget is spent; the [`systems`] of a step walk whole columns of the tile's tables;
//! 4. [`film::Film::develop`] turns the sums into a [`film::Picture`] with its errors; [`film::write_exr`] writes it.
//!
//! ```
//! use chainlight::plan::{Plan, Technique};
//! use chainlight::render::{Render, Rendering};
//! use chainlight::scene::{Format, Scene, SceneOverrides, flatten, parse_scene};
//! use std::{path::Path, sync::Arc};
//!
//! let text = r#"(
//!     version: 1,
//!     camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 30),
//!     film: (width: 16, height: 16),
//!     materials: {"lamp": Diffuse(reflectance: (0, 0, 0))},
//!     shapes: [(shape: Sphere(radius: 1), material: "lamp", emission: (3, 2, 1))],
//! )"#;
//! let source = parse_scene("lamp.ron", text, Format::Ron, Path::new("."))?;
//! let scene = Scene::compile(&source.description, &flatten(&source)?, SceneOverrides::default())?;
//! let scene = Arc::new(scene);
//! let plan = Plan::new(&scene, Technique::Pt, None);
//! let (seed, threads) = (0, 1);
//! let mut render = Render::new(scene, plan, seed, threads)?;
//! render.burst(4, &|_| {});
//! let picture = render.film.develop();
//! assert_eq!(picture.rgb[8 * 16 + 8].to_array(), [3.0, 2.0, 1.0]);
//! # Ok::<(), miette::Report>(())
//! ```
//!
//! How the house is built, and why, is in `ARCHITECTURE.md`.

/// The crate whose macros [`system!`] and [`columns!`] use.
pub use bevy_ecs;

pub mod camera;
pub mod chain;
pub mod check;
pub mod cli;
pub mod color;
pub mod film;
pub mod geometry;
pub mod layer;
pub mod light;
pub mod material;
pub mod math;
pub mod path;
pub mod plan;
pub mod render;
pub mod replay;
pub mod report;
pub mod sampling;
pub mod scene;
pub mod stats;
pub mod study;
#[path = "../systems/mod.rs"]
pub mod systems;
pub mod table;
pub mod texture;
pub mod tolerance;
