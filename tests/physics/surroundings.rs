//! Pictures of things in surroundings that shine, against closed forms and quadratures: rays that leave the scene and
//! samples of the surroundings share the light, whatever shines there at once.

use crate::support::render::{lit_scene, mean, picture, whole};
use crate::support::verdict::Family;
use chainlight::plan::{Plan, Technique};
use chainlight::render::start;
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Light tracing, the last, is for the floors alone: next to nothing of what it sends lands in a small part of a ball.
const TECHNIQUES: [Technique; 4] = [Technique::Pt, Technique::PtReference, Technique::Bdpt, Technique::Lt];
/// Independent renders whose spread is the error of techniques that bring light to many pixels at once.
const RENDERS: u64 = 48;
/// Three surroundings of a ball, four of a floor.
const FAMILY: Family = Family { tests: 3 * 3 + 4 * 4 };
const SEES: f64 = 0.02;
const MATERIALS: &str = "\"matt\": Diffuse(reflectance: (0.5, 0.5, 0.5))";
const SUNLIGHT: &str = "Sun(direction: (1, 2, -1), turbidity: 4, scale: 0.5)";
const SKYLIGHT: &str = "Sky(sun_direction: (1, 2, -1), turbidity: 4)";

/// A view that shows nothing but the ball.
fn ball(lights: &str) -> Arc<Scene> {
    let camera = "origin: (0, 0, 4), target: (0, 0, 0), fov: 5";
    lit_scene(
        4,
        camera,
        MATERIALS,
        "(shape: Sphere(radius: 1), material: \"matt\")",
        lights,
    )
}

/// A view that shows nothing but most of a floor.
fn floor(lights: &str) -> Arc<Scene> {
    let shapes = "(shape: Quad(corner: (-1, 0, 1), edge_u: (2, 0, 0), edge_v: (0, 0, -2)), material: \"matt\")";
    let camera = "origin: (0, 3, 0), target: (0, 0, 0), up: (0, 0, 1), fov: 32";
    lit_scene(4, camera, MATERIALS, shapes, lights)
}

/// Mean green radiance of the picture that `technique` makes of `steps` samples per pixel in all.
fn green(scene: &Arc<Scene>, technique: Technique, steps: u64) -> Estimate {
    if matches!(technique, Technique::Pt | Technique::PtReference) {
        return whole(&picture(scene, technique, 7, steps), 1);
    }
    // Light tracing sees some of what it sends, and never chooses which.
    let steps = if technique == Technique::Lt { 8 * steps } else { steps };
    let means = (0..RENDERS).map(|seed| {
        let plan = Plan::new(scene, technique, None);
        let scene = Arc::clone(scene);
        let mut render = start(scene, plan, seed, 1, &AtomicBool::new(false), &|_| ()).expect("a small film");
        render.burst(steps.div_ceil(RENDERS), &|_| ());
        mean(&render.picture(), 1, |_, _| true).mean
    });
    Estimate::of(&means.collect::<Vec<_>>())
}

#[track_caller]
fn is(name: &str, scene: &Arc<Scene>, techniques: &[Technique], steps: u64, expected: f64) {
    for &technique in techniques {
        let mean = green(scene, technique, steps);
        let case = format!("{name}, {technique:?}");
        FAMILY.is(&case, mean, expected, 1e-3 * expected, SEES);
        FAMILY.is_not(&case, mean, 1.02 * expected, 1e-3 * expected);
    }
}

#[test]
fn a_ball_in_surroundings_of_one_radiance_reflects_its_share() {
    is(
        "constant",
        &ball("Environment(radiance: (1, 1, 1))"),
        &TECHNIQUES[..3],
        400,
        0.5,
    );
    // Two that overlap, and one that cannot be met.
    let both = "Environment(radiance: (1, 0.25, 1)), Environment(radiance: (0, 0.75, 0), scale: 1)";
    is("two at once", &ball(both), &TECHNIQUES[..3], 800, 0.5);
    let straight = "Environment(radiance: (1, 0.5, 1)), Directional(direction: (0, 0, -1), irradiance: (0, 0, 0))";
    is("beside a dark one", &ball(straight), &TECHNIQUES[..3], 400, 0.25);
}

#[test]
fn what_leaves_the_scene_sees_the_surroundings() {
    let camera = "origin: (0, 0, 4), target: (0, 0, 9), fov: 60";
    let shapes = "(shape: Sphere(radius: 1), material: \"matt\")";
    let scene = lit_scene(
        3,
        camera,
        MATERIALS,
        shapes,
        "Environment(radiance: (1, 2, 3)), Environment(radiance: (0, 1, 0))",
    );
    for technique in [Technique::Pt, Technique::PtReference] {
        let picture = picture(&scene, technique, 7, 4);
        for pixel in &picture.rgb {
            assert_eq!(pixel.to_array(), [1.0, 3.0, 3.0], "{technique:?}");
        }
    }
}

/// Irradiance of the floor by a quadrature over the met lights: ∫ L z dω = ½ ∫ L d(z²) dφ, but for the sun.
fn sky_irradiance(scene: &Scene) -> f64 {
    const STEPS: usize = 300;
    let mut sum = 0.0;
    for i in 0..STEPS {
        let z = ((i as f64 + 0.5) / STEPS as f64).sqrt();
        for j in 0..STEPS {
            let angle = TAU * (j as f64 + 0.5) / STEPS as f64;
            let r = (1.0 - z * z).sqrt();
            let to = DVec3::new(r * libm::cos(angle), z, r * libm::sin(angle)).as_vec3();
            sum += f64::from(scene.lights.radiance(0, -to, -to).g);
        }
    }
    sum * PI / (STEPS * STEPS) as f64
}

fn sun_irradiance() -> f64 {
    let scene = floor(SUNLIGHT);
    let towards = Vec3::new(1.0, 2.0, -1.0).normalize();
    let radiance = f64::from(scene.lights.radiance(0, -towards, -towards).g);
    let half = libm::sin(0.5 * 0.2665_f64.to_radians());
    radiance * 2.0 * TAU * half * half * f64::from(towards.y)
}

#[test]
fn sun_and_sky_light_a_floor_alone_and_together() {
    let (sun, sky) = (sun_irradiance(), sky_irradiance(&floor(SKYLIGHT)));
    let reflected = |irradiance: f64| 0.5 / PI * irradiance;
    is("sun", &floor(SUNLIGHT), &TECHNIQUES, 100, reflected(sun));
    is("sky", &floor(SKYLIGHT), &TECHNIQUES, 400, reflected(sky));
    let both = format!("{SKYLIGHT}, {SUNLIGHT}");
    is("sun and sky", &floor(&both), &TECHNIQUES, 400, reflected(sun + sky));
    let all = format!("{both}, Directional(direction: (0, -1, 0), irradiance: (0, 0.2, 0))");
    is(
        "and parallel light",
        &floor(&all),
        &TECHNIQUES,
        800,
        reflected(sun + sky + 0.2),
    );
}
