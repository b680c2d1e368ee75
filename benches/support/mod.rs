//! Scenes to measure on, and interleaved measuring.

use chainlight::color::Rgb;
use chainlight::sampling::{Purpose, StreamKey};
use chainlight::scene::{
    Emission, Flattened, Format, Geometry, Instance, MaterialDescription, Mesh, Scene, SceneOverrides, flatten,
    parse_scene, read_scene,
};
use glam::Vec3;
use std::path::Path;
use std::sync::Arc;

/// The shipped scene of this name with a film of `size` x `size` pixels.
pub fn shipped(name: &str, size: u32) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.ron"));
    let source = read_scene(&path).expect("a shipped scene");
    let flattened = flatten(&source).expect("a shipped scene");
    let overrides = SceneOverrides {
        size: Some((size, size)),
        max_depth: None,
    };
    Arc::new(Scene::compile(&source.description, &flattened, overrides).expect("a valid filter"))
}

/// A closed room full of bumpy spheres, about `triangles` in all, lit by a quad under its ceiling: incoherent rays over
/// a tree that fits no cache.
pub fn bumpy_room(triangles: usize, size: u32) -> Arc<Scene> {
    let text = r#"(version: 1, settings: (max_depth: 16),
        camera: Perspective(origin: (5, 5, 9.5), target: (5, 4, 0), fov: 70),
        film: (width: 8, height: 8),
        materials: {"grey": Diffuse(reflectance: (0.7, 0.7, 0.7)), "red": Diffuse(reflectance: (0.7, 0.3, 0.2))},
        shapes: [
            (shape: Quad(corner: (0, 0, 0), edge_u: (0, 0, 10), edge_v: (10, 0, 0)), material: "grey"),
            (shape: Quad(corner: (0, 10, 0), edge_u: (10, 0, 0), edge_v: (0, 0, 10)), material: "grey"),
            (shape: Quad(corner: (0, 0, 0), edge_u: (10, 0, 0), edge_v: (0, 10, 0)), material: "grey"),
            (shape: Quad(corner: (0, 0, 10), edge_u: (0, 10, 0), edge_v: (10, 0, 0)), material: "grey"),
            (shape: Quad(corner: (0, 0, 0), edge_u: (0, 10, 0), edge_v: (0, 0, 10)), material: "red"),
            (shape: Quad(corner: (10, 0, 0), edge_u: (0, 0, 10), edge_v: (0, 10, 0)), material: "red"),
            (shape: Quad(corner: (3, 9.99, 3), edge_u: (4, 0, 0), edge_v: (0, 0, 4)), material: "grey", emission: (9, 9, 8)),
        ])"#;
    let source = parse_scene("room.ron", text, Format::Ron, Path::new(".")).expect("a valid room");
    let mut flattened = flatten(&source).expect("a valid room");
    add_spheres(&mut flattened, triangles);
    let overrides = SceneOverrides {
        size: Some((size, size)),
        max_depth: None,
    };
    Arc::new(Scene::compile(&source.description, &flattened, overrides).expect("a valid filter"))
}

fn add_spheres(flattened: &mut Flattened, triangles: usize) {
    let grey = flattened.materials.len() as u32;
    let description = MaterialDescription::Diffuse {
        reflectance: Rgb::splat(0.6).into(),
        two_sided: true,
    };
    flattened.materials.push(("bumps".into(), description));
    let spheres = 64;
    // A grid of n x 2n cells is 4 n² triangles.
    let side = ((triangles / spheres) as f64 / 4.0).sqrt() as u32;
    let mut stream = StreamKey::new(2, 0, 0).stream(Purpose::FILM, 0);
    for number in 0..spheres {
        let mut draw = |low: f32, high: f32| low + (high - low) * stream.next_f32();
        let center = Vec3::new(draw(1.0, 9.0), draw(0.8, 8.0), draw(0.8, 8.0));
        let mesh = bumpy_sphere(center, draw(0.3, 0.9), side, number as f32, grey);
        flattened.instances.push(Instance {
            name: format!("sphere {number}"),
            geometry: Geometry::Mesh(mesh),
            emission: Emission::None,
        });
    }
}

fn bumpy_sphere(center: Vec3, radius: f32, side: u32, phase: f32, material: u32) -> Mesh {
    let (rows, columns) = (side, 2 * side);
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for column in 0..columns {
            // Rows end just short of the poles, so that no triangle is degenerate.
            let theta = std::f32::consts::PI * (0.01 + 0.98 * row as f32 / rows as f32);
            let phi = std::f32::consts::TAU * column as f32 / columns as f32;
            let (sin, cos) = (chainlight::math::sin, chainlight::math::cos);
            let direction = Vec3::new(sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi));
            let bump = 1.0 + 0.06 * sin(9.0 * theta + phase) * sin(11.0 * phi) + 0.02 * sin(41.0 * phi + 37.0 * theta);
            mesh.positions.push(center + direction * radius * bump);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let next = (column + 1) % columns;
            let [a, b] = [row * columns + column, row * columns + next];
            let [c, d] = [a + columns, b + columns];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    mesh.materials = vec![material; mesh.triangles.len()];
    mesh
}

/// The median of some figures.
pub fn median(mut figures: Vec<f64>) -> f64 {
    figures.sort_by(f64::total_cmp);
    figures[figures.len() / 2]
}
