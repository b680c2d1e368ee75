//! Pictures of things in surroundings that shine, against closed forms and quadratures: rays that leave the scene and
//! samples of the surroundings share the light, whatever shines there at once.

use crate::support::render::{lit_scene, picture, whole};
use crate::support::verdict::Family;
use chainlight::plan::Technique;
use chainlight::scene::Scene;
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const TECHNIQUES: [Technique; 2] = [Technique::Pt, Technique::PtReference];
/// Three surroundings of a ball, four of a floor.
const FAMILY: Family = Family {
    tests: 7 * TECHNIQUES.len(),
};
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

/// A narrow view of a floor.
fn floor(lights: &str) -> Arc<Scene> {
    let shapes = "(shape: Quad(corner: (-1, 0, 1), edge_u: (2, 0, 0), edge_v: (0, 0, -2)), material: \"matt\")";
    let camera = "origin: (0, 3, 0), target: (0, 0, 0), up: (0, 0, 1), fov: 1";
    lit_scene(4, camera, MATERIALS, shapes, lights)
}

#[track_caller]
fn is(name: &str, scene: &Arc<Scene>, steps: u64, expected: f64) {
    for technique in TECHNIQUES {
        let mean = whole(&picture(scene, technique, 7, steps), 1);
        let case = format!("{name}, {technique:?}");
        FAMILY.is(&case, mean, expected, 1e-3 * expected, SEES);
        FAMILY.is_not(&case, mean, 1.02 * expected, 1e-3 * expected);
    }
}

#[test]
fn a_ball_in_surroundings_of_one_radiance_reflects_its_share() {
    is("constant", &ball("Environment(radiance: (1, 1, 1))"), 400, 0.5);
    // Two that overlap, and one that cannot be met.
    let both = "Environment(radiance: (1, 0.25, 1)), Environment(radiance: (0, 0.75, 0), scale: 1)";
    is("two at once", &ball(both), 800, 0.5);
    let straight = "Environment(radiance: (1, 0.5, 1)), Directional(direction: (0, 0, -1), irradiance: (0, 0, 0))";
    is("beside a dark one", &ball(straight), 400, 0.25);
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
    for technique in TECHNIQUES {
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
    is("sun", &floor(SUNLIGHT), 100, reflected(sun));
    is("sky", &floor(SKYLIGHT), 400, reflected(sky));
    let both = format!("{SKYLIGHT}, {SUNLIGHT}");
    is("sun and sky", &floor(&both), 400, reflected(sun + sky));
    let all = format!("{both}, Directional(direction: (0, -1, 0), irradiance: (0, 0.2, 0))");
    is("and parallel light", &floor(&all), 800, reflected(sun + sky + 0.2));
}
