//! Films of techniques with both ends hold light of any size: how bright a sample is depends on what the camera sees, not on the
//! lights or the scene's size.
//!
//! Techniques are compared with path tracing, whose film keeps far more bits. Light that a film cuts off or drops is missing
//! from the mean, by half or all of it in the scenes here where the unit is taken from the lights. The ratios of means are held to
//! 3 %; their errors are below 0.5 %.

use crate::support::scenes::inline;
use crate::support::verdict::say;
use chainlight::film::Tally;
use chainlight::plan::{Plan, PlanOptions, Technique};
use chainlight::render::start;
use chainlight::scene::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const SIZE: u32 = 16;
/// A scene whose floor the light's own paths practically never meet.
const FAR: &str = "a point so far that it is a sun";

/// A floor of a size under a light, seen from nearby.
fn floor(half: f64, light: &str, lamp: &str) -> Arc<Scene> {
    let width = 2.0 * half;
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: 3),
            camera: Perspective(origin: (0, 1.5, 6), target: (0, 0.3, 0), fov: 35), film: (width: {SIZE}, height: {SIZE}),
            materials: {{"floor": Diffuse(reflectance: (0.6, 0.6, 0.6)), "black": Diffuse(reflectance: (0, 0, 0))}},
            lights: [{light}],
            shapes: [
                (shape: Quad(corner: (-{half}, 0, {half}), edge_u: ({width}, 0, 0), edge_v: (0, 0, -{width})), material: "floor"),
                {lamp}
            ])"#
        ),
        SIZE,
    )
}

/// The mean over pixels and channels, and what the film could not take.
fn mean(scene: &Arc<Scene>, technique: Technique, steps: u64) -> (f64, Tally) {
    let plan = Plan::with(scene, technique, &PlanOptions::default()).expect("a plan");
    let never = AtomicBool::new(false);
    let mut render = start(Arc::clone(scene), plan, 5, 1, &never, &|_| {}).expect("a small film");
    render.burst(steps, &|_| {});
    let picture = render.picture();
    let channels = picture.rgb.iter().flat_map(|rgb| rgb.to_array().map(f64::from));
    (channels.sum::<f64>() / (3 * picture.rgb.len()) as f64, render.tally())
}

#[test]
fn neither_size_nor_distance_of_what_shines_cuts_light_off() {
    let point = |height: &str, intensity: &str| {
        format!("Point(position: (0, {height}, 0), intensity: ({intensity}, {intensity}, {intensity}))")
    };
    let near = point("1", "1");
    let bulb = |radius: &str, emission: &str| {
        format!(
            r#"(shape: Sphere(center: (1, 4, 1), radius: {radius}), material: "black",
                emission: ({emission}, {emission}, {emission})),"#
        )
    };
    let scenes = [
        ("a point over a small floor", floor(10.0, &near, "")),
        ("a point over a large floor", floor(3e3, &near, "")),
        ("a point over a plain", floor(1e6, &point("0.5", "1"), "")),
        (FAR, floor(20.0, &point("1e6", "1e12"), "")),
        (
            "a point so dim that nobody would see it",
            floor(20.0, &point("1", "1e-20"), ""),
        ),
        ("a bulb", floor(5.0, "", &bulb("1e-2", "1e4"))),
        ("a bulb like a pinprick", floor(5.0, "", &bulb("1e-7", "1e12"))),
    ];
    for (name, scene) in scenes {
        let techniques: &[Technique] = if name == FAR {
            &[Technique::Bdpt]
        } else {
            &[Technique::Bdpt, Technique::Lt]
        };
        let (expected, _) = mean(&scene, Technique::Pt, 1024);
        assert!(expected > 0.0, "{name}");
        for &technique in techniques {
            let (found, tally) = mean(&scene, technique, 1024);
            let ratio = found / expected;
            say(&format!("{name}, {technique}: {ratio:.4} of pt's light, {tally:?}"));
            assert_eq!(tally.saturated, 0, "{name}, {technique}");
            // What is seen of a plain at its horizon is truly nothing beside the rest.
            let samples = 1024 * u64::from(SIZE * SIZE);
            assert!(tally.vanished < samples / 1000, "{name}, {technique}: {tally:?}");
            assert!((0.97..1.03).contains(&ratio), "{name}, {technique}: {ratio}");
        }
    }
}
