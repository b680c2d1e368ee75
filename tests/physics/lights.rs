//! Lights that are no shapes: their power, what they light, how large they are, and what they become in the limit.

use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::geometry::BoundingSphere;
use chainlight::light::{
    Constant, Directional, Emitter, EmitterShape, Image, Light, LightTable, Point, SUN_RADIUS, Sky, Spot, Sun,
};
use chainlight::stats::z_test::Estimate;
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const SAMPLES: usize = 400_000;
/// Irradiances of three environments, and light that three send through a window.
const FAMILY: Family = Family { tests: 6 };
const SCENE: BoundingSphere = BoundingSphere {
    center: Vec3::new(1.0, 0.0, -1.0),
    radius: 2.0,
};

fn table(lights: Vec<Light>) -> LightTable {
    LightTable::with_lights(Vec::new(), lights, SCENE)
}

fn uniform_image(radiance: Rgb) -> Image {
    Image::new((5, 3), vec![radiance; 15], DVec3::Y, 0.0).expect("an environment")
}

/// Two suns in one picture, and a floor between them.
fn picture() -> (Light, f64) {
    let mut texels = vec![Rgb::splat(0.1); 32 * 16];
    texels[3 * 32 + 5] = Rgb::splat(100.0);
    texels[9 * 32 + 31] = Rgb::splat(30.0);
    // Each texel's share of the integral: its row's hat over 1 − cos θ, times its share of a turn.
    let depth = |row: f64| 1.0 - libm::cos(PI * (row + 0.5) / 16.0);
    let hat = |row: f64| 0.5 * (depth(row + 1.0) - depth(row - 1.0)) * TAU / 32.0;
    let total = 0.1 * 2.0 * TAU + 99.9 * hat(3.0) + 29.9 * hat(9.0);
    let image = Image::new((32, 16), texels, DVec3::new(0.2, 1.0, 0.0), 10.0).expect("an environment");
    (Light::Image(Arc::new(image)), total)
}

fn sky() -> Light {
    Light::Sky(Arc::new(Sky::new(
        DVec3::new(1.0, 0.6, 0.2),
        DVec3::Y,
        3.0,
        Rgb::splat(0.2),
        1.0,
    )))
}

fn powers(table: &LightTable, case: usize) -> Vec<f64> {
    let mut stream = stream(950 + case);
    let ray = |_| {
        let choice = stream.next_f64();
        let point = stream.next_pair();
        table
            .emit(choice, point, stream.next_pair())
            .map_or(0.0, |ray| f64::from(ray.ratio.mean()))
    };
    (0..SAMPLES).map(ray).collect()
}

#[test]
fn the_mean_of_what_is_sent_is_the_power() {
    let disc = PI * 4.0;
    let gray = Rgb::splat(2.0);
    let (picture, total) = picture();
    let rim = |degrees: f64| 2.0 * libm::sin(0.5 * degrees.to_radians()) * libm::sin(0.5 * degrees.to_radians());
    let spot = Spot::new(Vec3::ZERO, DVec3::Z, gray, 30.0, 20.0);
    let lights = [
        (
            "point",
            Light::Point(Point {
                position: Vec3::ONE,
                intensity: gray,
            }),
            8.0 * PI,
        ),
        ("spot", Light::Spot(spot), 2.0 * PI * (rim(20.0) + rim(30.0))),
        (
            "parallel",
            Light::Directional(Directional {
                direction: Vec3::X,
                irradiance: gray,
            }),
            2.0 * disc,
        ),
        (
            "constant",
            Light::Constant(Constant { radiance: gray }),
            2.0 * 4.0 * PI * disc,
        ),
        (
            "picture of one colour",
            Light::Image(Arc::new(uniform_image(gray))),
            2.0 * 4.0 * PI * disc,
        ),
        ("picture", picture, total * disc),
        (
            "disc",
            Light::Sun(Sun::disc(DVec3::ONE, 0.5, gray)),
            2.0 * TAU * rim(0.5) * disc,
        ),
    ];
    for (case, (name, light, power)) in lights.iter().enumerate() {
        let estimate = Estimate::of(&powers(&table(vec![light.clone()]), case));
        // All of these are drawn in proportion to what they emit: a sample alone tells the power.
        assert!(
            (estimate.mean / power - 1.0).abs() < 1e-4 && estimate.error < 1e-5 * power,
            "{name}: {estimate:?}"
        );
    }
    let all = table(lights.iter().map(|(_, light, _)| light.clone()).collect());
    let power: f64 = lights.iter().map(|(_, _, power)| power).sum();
    let estimate = Estimate::of(&powers(&all, 20));
    assert!((estimate.mean / power - 1.0).abs() < 1e-3, "{estimate:?} {power}");
}

/// Irradiance of the upper side of a plane by samples of the lights.
fn irradiance(table: &LightTable, normal: Vec3, case: usize) -> Vec<f64> {
    let mut stream = stream(980 + case);
    let sample = |_| {
        let sample = table.sample(SCENE.center, stream.next_f64(), stream.next_pair());
        sample.map_or(0.0, |s| {
            f64::from(s.radiance.g / s.density * normal.dot(s.direction).max(0.0))
        })
    };
    (0..SAMPLES).map(sample).collect()
}

/// What reflects all light in surroundings of radiance 1 cannot be seen: the irradiance on every plane is π.
#[test]
fn surroundings_of_one_radiance_are_a_furnace() {
    let lights = [
        Light::Constant(Constant { radiance: Rgb::ONE }),
        Light::Image(Arc::new(uniform_image(Rgb::ONE))),
    ];
    for (case, light) in lights.into_iter().enumerate() {
        let table = table(vec![light]);
        let values = irradiance(&table, Vec3::new(0.36, 0.48, -0.8), case);
        let estimate = Estimate::of(&values);
        FAMILY.is("furnace", estimate, PI, 1e-5, 0.015);
        FAMILY.is_not("furnace, off by 2 %", estimate, 1.02 * PI, 1e-5);
        for to in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, 0.0, -0.8)] {
            assert!((table.radiance(0, to, to).r - 1.0).abs() < 1e-6);
        }
    }
}

/// The sampled irradiance of the sky against a quadrature of its radiance.
#[test]
fn the_sky_lights_the_ground_with_its_radiance() {
    let table = table(vec![sky()]);
    let mut expected = 0.0;
    const STEPS: usize = 400;
    for i in 0..STEPS {
        // Heights squared are even: ∫ L z dω = ½ ∫ L d(z²) dφ.
        let z = ((i as f64 + 0.5) / STEPS as f64).sqrt();
        for j in 0..STEPS {
            let angle = TAU * (j as f64 + 0.5) / STEPS as f64;
            let r = (1.0 - z * z).sqrt();
            let to = DVec3::new(r * libm::cos(angle), z, r * libm::sin(angle)).as_vec3();
            expected += f64::from(table.radiance(0, -to, -to).g) * PI / (STEPS * STEPS) as f64;
        }
    }
    let values = irradiance(&table, Vec3::Y, 10);
    FAMILY.is(
        "sky on the ground",
        Estimate::of(&values),
        expected,
        1e-3 * expected,
        0.01,
    );
    // Sampling follows the radiance: samples hardly differ before the cosine.
    let mut stream = stream(999);
    let totals: Vec<f64> = (0..20_000)
        .filter_map(|_| table.sample(SCENE.center, stream.next_f64(), stream.next_pair()))
        .map(|s| f64::from(s.radiance.mean() / s.density))
        .collect();
    let estimate = Estimate::of(&totals);
    let spread = estimate.error * (totals.len() as f64).sqrt() / estimate.mean;
    assert!(spread < 0.1, "{spread}");
    assert!(table.radiance(0, Vec3::Y, Vec3::Y).is_black());
}

/// What is sent through a window of the scene is what arrives there: its irradiance times its area.
#[test]
fn light_that_is_sent_arrives_as_it_is_seen() {
    let sun = Sun::disc(DVec3::new(1.0, 2.0, -1.0), 5.0, Rgb::splat(4.0));
    let lights = [
        ("sky", sky()),
        ("constant", Light::Constant(Constant { radiance: Rgb::ONE })),
        ("disc", Light::Sun(sun)),
    ];
    for (case, (name, light)) in lights.into_iter().enumerate() {
        let table = table(vec![light]);
        let seen = Estimate::of(&irradiance(&table, Vec3::Y, 20 + case));
        let mut stream = stream(970 + case);
        let mut through = || {
            let choice = stream.next_f64();
            let point = stream.next_pair();
            let ray = table.emit(choice, point, stream.next_pair())?;
            let (origin, direction) = ((ray.origin - SCENE.center).as_dvec3(), ray.direction.as_dvec3());
            let met = origin - direction * (origin.y / direction.y);
            let inside = direction.y < 0.0 && met.x.abs() < 1.0 && met.z.abs() < 1.0;
            inside.then(|| 0.25 * f64::from(ray.ratio.g))
        };
        let sent: Vec<f64> = (0..5 * SAMPLES).map(|_| through().unwrap_or(0.0)).collect();
        let slack = 3.0 * seen.error;
        FAMILY.is(name, Estimate::of(&sent), seen.mean, slack, 0.02);
    }
}

#[test]
fn the_sun_has_its_size_and_its_irradiance() {
    let up = DVec3::Y;
    let elevation = 50_f64.to_radians();
    let sun = DVec3::new(libm::cos(elevation), libm::sin(elevation), 0.0);
    let table = table(vec![Light::Sun(Sun::through_air(sun * 7.0, up * 3.0, 3.0, 1.0))]);
    let side = DVec3::new(-sun.y, sun.x, 0.0);
    let seen = |degrees: f64| {
        let angle = degrees.to_radians();
        let to = (sun * libm::cos(angle) + side * libm::sin(angle)).as_vec3();
        table.radiance(0, -to, -to)
    };
    let radius = f64::from(SUN_RADIUS);
    let radiance = seen(0.0);
    // Three sides of the disc: the fourth is below.
    assert!(radiance.g > 1.5e4 && seen(radius * 0.999) == radiance && seen(-radius * 0.999) == radiance);
    assert!(seen(radius * 1.001).is_black() && seen(180.0).is_black());
    let solid_angle = 6.797e-5;
    let values = irradiance(&table, sun.as_vec3(), 11);
    let expected = f64::from(radiance.g) * solid_angle;
    let estimate = Estimate::of(&values);
    assert!((estimate.mean / expected - 1.0).abs() < 1e-3, "{estimate:?} {expected}");
    // Redder and darker the lower it stands.
    let at = |degrees: f64| {
        let angle = degrees.to_radians();
        let sun = DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
        let table = LightTable::with_lights(Vec::new(), vec![Light::Sun(Sun::through_air(sun, up, 3.0, 1.0))], SCENE);
        table.max_radiance()
    };
    assert!(at(90.0) > at(30.0) && at(30.0) > at(10.0) && at(10.0) > at(1.0) && at(1.0) > 0.0);
}

/// A sphere that shrinks at constant power becomes a point light; a disc at constant irradiance parallel light.
#[test]
fn small_lights_become_points_and_directions() {
    let from = Vec3::new(0.5, -0.25, 3.0);
    let center = Vec3::new(-2.0, 4.0, 1.0);
    let intensity = 5.0;
    let point = table(vec![Light::Point(Point {
        position: center,
        intensity: Rgb::splat(intensity),
    })]);
    let limit = point
        .sample(from, 0.5, [0.5; 2])
        .map(|s| s.radiance.g / s.density)
        .expect("light");
    for radius in [1e-2, 1e-4, 1e-7, 1e-12] {
        let radiance = f64::from(intensity) / (PI * f64::from(radius) * f64::from(radius));
        let sphere = LightTable::new(vec![Emitter {
            shape: EmitterShape::Sphere { center, radius },
            radiance: Rgb::splat(radiance as f32),
            area: (4.0 * PI * f64::from(radius) * f64::from(radius)) as f32,
        }]);
        let sample = sphere.sample(from, 0.5, [0.3, 0.7]).expect("light");
        let irradiance = sample.radiance.g / sample.density;
        assert!(
            (irradiance / limit - 1.0).abs() < 1e-4,
            "{radius}: {irradiance} {limit}"
        );
        assert!(sample.density.is_finite());
    }
    let towards = DVec3::new(0.3, 0.9, -0.1);
    for degrees in [1.0, 0.2665, 0.01, 0.001] {
        let half = libm::sin(0.5 * f64::from(degrees).to_radians());
        let disc = Sun::disc(towards, degrees, Rgb::splat((1.0 / (2.0 * TAU * half * half)) as f32));
        let sample = table(vec![Light::Sun(disc)])
            .sample(from, 0.5, [0.3, 0.7])
            .expect("light");
        assert!(
            (sample.radiance.g / sample.density - 1.0).abs() < 1e-5,
            "{degrees}: {sample:?}"
        );
        let off = sample.direction.as_dvec3().distance(towards.normalize());
        assert!(off < 1.001 * f64::from(degrees).to_radians() + 1e-7, "{degrees}: {off}");
    }
}

/// A hot texel that holds nearly all light becomes parallel light: its irradiance from every side of the scene.
#[test]
fn a_hot_texel_is_found_every_time() {
    let (width, height) = (512, 256);
    let mut texels = vec![Rgb::splat(1e-6); width * height];
    texels[60 * width + 100] = Rgb::splat(1e6);
    let image = Image::new((width, height), texels, DVec3::Y, 0.0).expect("an environment");
    let table = table(vec![Light::Image(Arc::new(image))]);
    let mut stream = stream(960);
    let mut axis = Vec3::ZERO;
    let mut nearby = 0;
    for _ in 0..1000 {
        let sample = table
            .sample(Vec3::ZERO, stream.next_f64(), stream.next_pair())
            .expect("light");
        assert!(sample.density.is_finite() && sample.radiance.is_finite());
        axis = if axis == Vec3::ZERO { sample.direction } else { axis };
        nearby += usize::from(axis.dot(sample.direction) > 0.999);
    }
    assert!(nearby >= 999, "{nearby}");
}
