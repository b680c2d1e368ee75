//! Chains of whole paths make the picture that other techniques with both ends make, under every light, behind every camera and
//! with every kind of surface; with direct light rendered apart and without.
//!
//! As all techniques are compared ([`super::agree`]): 20 runs each, the cases of a scene one family with a significance of 1 %,
//! the smallest bias of the mean that is seen stated, and one of twice its limit refused.

use super::agree::{PIXELS, agree};
use super::agreement::Contender;
use crate::support::scenes::{inline, shipped};
use chainlight::plan::{Base, Technique};
use chainlight::scene::Scene;
use std::sync::Arc;

/// Those that are compared, each with what is seen of it.
fn contenders(sees: [f64; 4]) -> Vec<(Contender, f64)> {
    let mlt = Contender::of(Technique::Mlt, Base::Pt);
    let all = [
        Contender::of(Technique::Bdpt, Base::Pt),
        Contender::of(Technique::Pssmlt, Base::Bdpt),
        mlt,
        mlt.by_chains_alone(),
    ];
    all.into_iter().zip(sees).collect()
}

/// A heap of things of all kinds that fills the picture, seen by a camera under some light: checkers, rough metal and glass, a coat,
/// and a ring whose normals are those of a smooth one. The patch of floor beside them is a smooth mirror.
fn heap(camera: &str, lights: &str, lamp: &str) -> Arc<Scene> {
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: 6), camera: {camera},
            film: (width: 24, height: 24, filter: Gaussian(radius: 1.5, sigma: 0.5)),
            textures: {{"checks": Checkerboard(even: (0.8, 0.7, 0.6), odd: (0.2, 0.3, 0.6), scale: (6, 6))}},
            materials: {{
                "floor": Diffuse(reflectance: "checks"),
                "white": Diffuse(reflectance: (0.7, 0.7, 0.7)),
                "gold": RoughConductor(metal: "Au", alpha: 0.3),
                "brushed": RoughConductor(metal: "Cu", alpha_u: 0.4, alpha_v: 0.2),
                "frost": RoughDielectric(interior_ior: 1.5, alpha: 0.3),
                "coat": Plastic(diffuse_reflectance: (0.2, 0.5, 0.3)),
                "mirror": Conductor(metal: "Ag"),
            }},
            lights: [{lights}],
            shapes: [
                (shape: Quad(corner: (-2, 0, 2), edge_u: (4, 0, 0), edge_v: (0, 0, -4)), material: "floor"),
                (shape: Quad(corner: (-2, 0, -1), edge_u: (4, 0, 0), edge_v: (0, 3, 0)), material: "white"),
                (shape: Quad(corner: (0.2, 0.01, 1.4), edge_u: (0.8, 0, 0), edge_v: (0, 0, -0.6)), material: "mirror"),
                (shape: Box(min: (-0.9, 0, -0.6), max: (-0.1, 0.9, 0.2)), material: "gold"),
                (shape: Sphere(center: (0.5, 0.35, 0.2), radius: 0.35), material: "frost"),
                (shape: Cylinder(from: (1.1, 0, -0.4), to: (1.1, 0.8, -0.4), radius: 0.25), material: "brushed"),
                (shape: Torus(center: (-0.4, 0.2, 0.9), axis: (0.3, 1, 0.2), major_radius: 0.4, minor_radius: 0.15,
                    segments: (12, 8)), material: "coat"),
                {lamp}
            ])"#
        ),
        PIXELS,
    )
}

const PERSPECTIVE: &str = "Perspective(origin: (1.5, 3, 4), target: (0, 0.3, 0), fov: 30)";
const LENS: &str =
    "ThinLens(origin: (1.5, 3, 4), target: (0, 0.3, 0), fov: 30, aperture_radius: 0.2, focus_distance: 4.8)";
const PARALLEL: &str = "Orthographic(origin: (1.5, 3, 4), target: (0, 0.3, 0), height: 2.4)";
const LAMP: &str =
    r#"(shape: Sphere(center: (-1.2, 1.6, 1), radius: 0.15), material: "white", emission: (30, 28, 25)),"#;
const POINT: &str = "Point(position: (1.6, 1.8, 0.8), intensity: (3, 2.5, 2))";
const SPOT: &str = "Spot(position: (-1, 2.5, 1.5), target: (0, 0.3, 0.2), intensity: (9, 8, 9), cutoff: 30, beam: 20)";
const RAYS: &str = "Directional(direction: (-0.7, -1, -0.4), irradiance: (2, 1.8, 1.5))";
const AROUND: &str = "Environment(radiance: (0.2, 0.25, 0.3))";
const DISC: &str = "Sun(direction: (0.5, 1, 0.8), scale: 0.002)";

#[test]
fn under_a_lamp() {
    agree(
        "paths under a lamp",
        heap(PERSPECTIVE, "", LAMP),
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

#[test]
fn under_a_point() {
    agree(
        "paths under a point",
        heap(PERSPECTIVE, POINT, ""),
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

#[test]
fn under_a_spot_behind_a_lens() {
    agree(
        "paths under a spot",
        heap(LENS, SPOT, ""),
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

#[test]
fn under_parallel_light_before_a_parallel_camera() {
    agree(
        "paths under parallel light",
        heap(PARALLEL, RAYS, ""),
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

#[test]
fn under_light_from_all_around() {
    agree(
        "paths under an even sky",
        heap(PERSPECTIVE, AROUND, ""),
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

/// Paths that leave the scene meet all lights at infinity at once.
#[test]
fn under_several_lights_at_infinity_behind_a_lens() {
    let lights = [AROUND, DISC, "Sky(sun_direction: (0.5, 1, 0.8), scale: 0.002)", RAYS].join(", ");
    agree(
        "paths under several skies",
        heap(LENS, &lights, ""),
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

#[test]
fn under_all_lights_at_once_before_a_parallel_camera() {
    let lights = [POINT, SPOT, RAYS, AROUND, DISC].join(", ");
    agree(
        "paths under all lights",
        heap(PARALLEL, &lights, LAMP),
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

/// Light that is bent on its way to the floor, and again on its way to the lens.
#[test]
fn behind_smooth_glass_under_a_wide_lamp() {
    let scene = inline(
        r#"(version: 1, settings: (max_depth: 6), camera: Perspective(origin: (1.5, 3, 4), target: (0, 0.3, 0), fov: 30),
        film: (width: 24, height: 24),
        materials: {
            "white": Diffuse(reflectance: (0.7, 0.7, 0.7)),
            "glass": Dielectric(interior_ior: 1.5),
            "diamond": Dielectric(interior_ior: 2.4),
        },
        shapes: [
            (shape: Quad(corner: (-2, 0, 2), edge_u: (4, 0, 0), edge_v: (0, 0, -4)), material: "white"),
            (shape: Sphere(center: (0.5, 0.5, 0.4), radius: 0.45), material: "glass"),
            (shape: Box(min: (-0.9, 0.05, -0.6), max: (-0.1, 0.9, 0.5)), material: "glass"),
            (shape: Torus(center: (-0.2, 0.3, 1), axis: (0.3, 1, 0.2), major_radius: 0.3, minor_radius: 0.12, segments: (12, 8)),
                material: "diamond"),
            (shape: Quad(corner: (-1.5, 3.5, -1.5), edge_u: (3, 0, 0), edge_v: (0, 0, 3)), material: "white", emission: (3, 2.8, 2.5)),
        ])"#,
        PIXELS,
    );
    agree(
        "paths behind smooth glass",
        scene,
        16,
        contenders([0.05, 0.1, 0.1, 0.1]),
    );
}

/// Smooth meshes with normals of their own, seen in mirrors and through glass, and sun and sky through a window.
#[test]
fn in_rooms_of_meshes() {
    for (name, case, sees) in [
        (
            "cornell-glossy.ron",
            "paths in cornell-glossy",
            [0.02, 0.02, 0.11, 0.08],
        ),
        (
            "cornell-window.ron",
            "paths in cornell-window",
            [0.06, 0.06, 0.12, 0.35],
        ),
        ("depth-of-field.ron", "paths in depth-of-field", [0.1, 0.1, 0.15, 0.15]),
    ] {
        agree(case, shipped(name, PIXELS), 16, contenders(sees));
    }
}
