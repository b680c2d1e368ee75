//! Scales: a world a million times as large, or as small, has densities by area that are off by a factor of 10¹² a vertex. Where the
//! scale is a power of two nothing is rounded differently, and so chains must do the same, bit for bit: no constant of a path's
//! densities, targets or acceptances is in scene units.

use super::paths;
use crate::support::scenes::as_written;
use chainlight::render::Rendering;
use chainlight::scene::Scene;
use std::sync::Arc;

/// A vector in a world of this scale, every number exactly that of the world of scale 1 times the scale.
fn scaled(vector: [f32; 3], exponent: i32) -> String {
    let by = libm::exp2(f64::from(exponent));
    let [x, y, z] = vector.map(|c| f64::from(c) * by);
    format!("({x:e}, {y:e}, {z:e})")
}

/// A room with glass, a mirror, gloss and a lamp, 2^exponent as large; its paths have up to sixty vertices.
fn room(exponent: i32) -> Arc<Scene> {
    let v = |x, y, z| scaled([x, y, z], exponent);
    let radius = |r: f32| format!("{:e}", f64::from(r) * libm::exp2(f64::from(exponent)));
    let wall = |name: &str, corner: [f32; 3], u: [f32; 3], w: [f32; 3], material: &str| {
        format!(
            "(name: \"{name}\", shape: Quad(corner: {}, edge_u: {}, edge_v: {}), material: \"{material}\"), ",
            scaled(corner, exponent),
            scaled(u, exponent),
            scaled(w, exponent)
        )
    };
    let walls = [
        wall("floor", [-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0], "white"),
        wall("ceiling", [-2.0, 3.0, 2.0], [0.0, 0.0, -4.0], [4.0, 0.0, 0.0], "white"),
        wall("back", [-2.0, 0.0, -2.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], "mirror"),
        wall("left", [-2.0, 0.0, 2.0], [0.0, 0.0, -4.0], [0.0, 3.0, 0.0], "gloss"),
        wall("right", [2.0, 0.0, 2.0], [0.0, 3.0, 0.0], [0.0, 0.0, -4.0], "mirror"),
    ];
    let text = format!(
        "(version: 1, settings: (max_depth: 60),
          camera: Perspective(origin: {}, target: {}, fov: 45),
          film: (width: 16, height: 16, filter: Gaussian(radius: 1.5, sigma: 0.5)),
          materials: {{
              \"white\": Diffuse(reflectance: (0.9, 0.9, 0.9)),
              \"mirror\": Conductor(eta: (0, 0, 0), k: (1, 1, 1), reflectance: (0.98, 0.98, 0.98)),
              \"gloss\": RoughConductor(metal: \"Au\", alpha: 0.1),
              \"glass\": Dielectric(interior_ior: 1.5),
              \"lamp\": Diffuse(reflectance: (0, 0, 0)),
          }},
          shapes: [{}
              (name: \"ball\", shape: Sphere(center: {}, radius: {}), material: \"glass\"),
              (name: \"lamp\", shape: Sphere(center: {}, radius: {}), material: \"lamp\", emission: (4, 3, 2)),
          ])",
        v(0.3, 1.1, 5.0),
        v(0.0, 1.0, 0.0),
        walls.concat(),
        v(0.4, 0.7, 0.4),
        radius(0.6),
        v(-0.9, 2.3, 0.2),
        radius(0.25),
    );
    as_written(&text)
}

#[test]
fn chains_do_the_same_in_worlds_of_any_size() {
    let chains = paths(2, 128, 1 << 13).set("new_path:weight=0.5,exponent=0.5");
    let run = |exponent| {
        let render = chains.run(&room(exponent), 200);
        (render.run.normalizations(), render.picture().rgb)
    };
    let (b, picture) = run(0);
    assert!(b.iter().all(|&b| b > 0.0 && b.is_finite()), "{b:?}");
    assert!(picture.iter().any(|color| !color.is_black()));
    for exponent in [-20, 20] {
        let (other_b, other) = run(exponent);
        assert_eq!(other_b, b, "2^{exponent}");
        assert_eq!(other, picture, "2^{exponent}");
    }
}
