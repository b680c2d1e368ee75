//! Pictures of a matt floor under lights that no path meets, against closed forms: a sample is the answer.

use crate::support::render::{lit_scene, picture, whole};
use chainlight::plan::Technique;
use std::f64::consts::PI;

const REFLECTANCE: f64 = 0.5;

/// Radiance of the floor at the world's origin, seen from above in a narrow view, in every channel.
fn floor(lights: &str, more_shapes: &str) -> [f64; 3] {
    let scene = lit_scene(
        4,
        "origin: (0, 8, 0), target: (0, 0, 0), up: (0, 0, 1), fov: 0.01",
        "\"matt\": Diffuse(reflectance: (0.5, 0.5, 0.5)), \"black\": Diffuse(reflectance: (0, 0, 0))",
        &format!(
            "(shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -6)), material: \"matt\"), {more_shapes}"
        ),
        lights,
    );
    let mut found = None;
    for technique in [Technique::Pt, Technique::PtReference] {
        let picture = picture(&scene, technique, 3, 16);
        let means = [0, 1, 2].map(|channel| whole(&picture, channel).mean);
        assert!(found.is_none_or(|found| found == means), "{found:?} {means:?}");
        found = Some(means);
    }
    found.expect("two pictures")
}

#[track_caller]
fn is(found: [f64; 3], irradiance: [f64; 3]) {
    for (found, irradiance) in found.into_iter().zip(irradiance) {
        let expected = REFLECTANCE / PI * irradiance;
        assert!((found - expected).abs() <= 1e-3 * expected, "{found} {expected}");
    }
}

#[test]
fn a_point_lights_the_floor_by_its_cosine_over_the_squared_distance() {
    let d2 = 1.0 + 4.0 + 0.25;
    let cosine = 2.0 / f64::sqrt(d2);
    let point = "Point(position: (1, 2, 0.5), intensity: (30, 20, 10))";
    is(
        floor(point, ""),
        [30.0, 20.0, 10.0].map(|intensity| intensity * cosine / d2),
    );
    let below = "Point(position: (1, -2, 0.5), intensity: (30, 20, 10))";
    is(floor(below, ""), [0.0; 3]);
}

#[test]
fn a_spot_lights_what_is_in_its_cone() {
    let spot = |target: &str| {
        format!("Spot(position: (0, 3, 0), target: {target}, intensity: (9, 9, 18), cutoff: 20, beam: 15)")
    };
    is(floor(&spot("(0, 0, 0)"), ""), [1.0, 1.0, 2.0]);
    // The floor point is 26.6 degrees off the axis.
    is(floor(&spot("(1.5, 0, 0)"), ""), [0.0; 3]);
}

#[test]
fn parallel_light_lights_the_floor_by_its_cosine() {
    let light = "Directional(direction: (3, -4, 0), irradiance: (5, 10, 0))";
    is(floor(light, ""), [4.0, 8.0, 0.0]);
}

#[test]
fn something_in_between_casts_a_shadow() {
    // Off the camera's view.
    let screen = "(shape: Quad(corner: (0.75, 1, 1), edge_u: (0.5, 0, 0), edge_v: (0, 0, -2)), material: \"black\")";
    for light in [
        "Point(position: (2, 2, 0), intensity: (1, 1, 1))",
        "Spot(position: (2, 2, 0), target: (0, 0, 0), intensity: (1, 1, 1))",
        "Directional(direction: (-1, -1, 0), irradiance: (1, 1, 1))",
    ] {
        assert!(floor(light, "")[0] > 0.0, "{light}");
        assert_eq!(floor(light, screen), [0.0; 3], "{light}");
    }
}
