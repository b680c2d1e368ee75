//! Lights that no path meets: what arrives from them, and where they send light.

use super::remote::{SCENE, SUNWARD, alone, parallel, point, spots};
use crate::support::cells::{Grid, angle, height_and_angle, one_minus_cos};
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::light::{Emitted, Endpoint, Light, LightTable};
use glam::{DMat3, Vec3};
use std::f64::consts::TAU;

const SAMPLES: usize = 1_000_000;
/// Four spots, a point.
const FAMILY: Family = Family { tests: 5 };
const SEES: f64 = 0.016;

fn sent(case: usize, table: &LightTable) -> impl Iterator<Item = Emitted> {
    let mut stream = stream(900 + case);
    (0..SAMPLES).filter_map(move |_| {
        let choice = stream.next_f64();
        let point = stream.next_pair();
        table.emit(choice, point, stream.next_pair())
    })
}

#[test]
fn spots_send_light_as_their_densities_say() {
    let grid = Grid::around([0.0, 1.0]);
    let axis = SUNWARD.normalize();
    let (x, y) = axis.any_orthonormal_pair();
    let world = DMat3::from_cols(x, y, axis);
    for (case, (name, [_, cutoff], light)) in spots().into_iter().enumerate() {
        let table = alone(light);
        let sine = libm::sin(0.5 * f64::from(cutoff).to_radians());
        let rim = 2.0 * sine * sine;
        let stated = |t: f64| {
            let m = t * rim;
            let r = (m * (2.0 - m)).sqrt();
            let towards = (world * glam::DVec3::new(r, 0.0, 1.0 - m)).as_vec3();
            f64::from(table.emission_densities(0, towards, towards).direction) * rim
        };
        let mut probabilities = grid.midpoint(8, |t, _| stated(t));
        probabilities.iter_mut().for_each(|p| *p = p.max(1e-12));
        let total: f64 = probabilities.iter().sum();
        assert!((total - 1.0).abs() < 2e-3, "{name}: {total}");
        let counts = grid.count(sent(case, &table).map(|ray| {
            let d = world.transpose() * ray.direction.as_dvec3();
            let t = one_minus_cos(d) / rim;
            [if t < 1.001 { t.min(1.0) } else { t }, angle(d.x, d.y)]
        }));
        assert!(counts.iter().sum::<u64>() as usize > SAMPLES - 200, "{name}");
        FAMILY.follows(name, &counts, &probabilities, SEES);
        let tilted = grid.midpoint(8, |t, _| stated(t).max(1e-12) * (1.03 - 0.06 * t));
        FAMILY.refuses(&format!("{name}, tilted"), &counts, &tilted);
    }
}

#[test]
fn points_send_light_evenly_in_all_directions() {
    let grid = Grid::around([-1.0, 1.0]);
    let table = alone(point());
    let stated = table.emission_densities(0, Vec3::X, Vec3::X);
    let probabilities = grid.simpson(2, |_, _| f64::from(stated.direction));
    let counts = grid.count(sent(10, &table).map(|ray| height_and_angle(ray.direction)));
    assert_eq!(counts.iter().sum::<u64>() as usize, SAMPLES);
    FAMILY.follows("point", &counts, &probabilities, SEES);
}

/// Irradiance on a plane is what a sample brings times the cosine: I cos θ / d².
#[test]
fn points_fall_off_with_the_squared_distance() {
    let table = alone(point());
    let light = Vec3::new(1.0, 2.0, 3.0);
    for from in [
        Vec3::ZERO,
        Vec3::new(1.0, 2.0, 2.9),
        Vec3::new(1e5, -3e5, 2e4),
        Vec3::new(1.0, 2.0, 3.000_001),
    ] {
        let sample = table.sample(from, 0.5, [0.5; 2]).expect("light from everywhere");
        let d2 = (light.as_dvec3() - from.as_dvec3()).length_squared();
        for (found, intensity) in sample.radiance.to_array().into_iter().zip([3.0, 2.0, 1.0]) {
            assert!(
                (f64::from(found) / f64::from(sample.density) * d2 / intensity - 1.0).abs() < 1e-6,
                "{from}"
            );
        }
        assert!(sample.discrete && sample.target == light && sample.density == 1.0);
        assert_eq!(table.density(0, from, sample.position, sample.normal), 0.0);
    }
    assert_eq!(table.sample(light, 0.5, [0.5; 2]), None);
}

#[test]
fn spots_shine_as_points_do_inside_their_beam_and_not_beyond_the_cutoff() {
    for (name, [beam, cutoff], light) in spots() {
        let table = alone(light);
        let axis = SUNWARD.normalize();
        let side = axis.any_orthonormal_vector();
        let irradiance = |degrees: f64| {
            let angle = degrees.to_radians();
            let away = axis * libm::cos(angle) + side * libm::sin(angle);
            let from = (glam::DVec3::new(1.0, 2.0, 3.0) + away * 2.0).as_vec3();
            table
                .sample(from, 0.5, [0.5; 2])
                .map_or(Rgb::BLACK, |s| s.radiance / s.density)
        };
        let full = irradiance(f64::from(beam) * 0.99);
        assert!((full.r / 0.75 - 1.0).abs() < 1e-3, "{name}: {full:?}");
        assert!(irradiance(f64::from(cutoff) * 1.01).is_black(), "{name}");
        if beam < cutoff {
            let between = irradiance(f64::from(0.5 * (beam + cutoff))).r / 0.75;
            assert!(between > 0.2 && between < 0.8, "{name}: {between}");
        }
    }
}

#[test]
fn parallel_light_arrives_alike_everywhere() {
    let table = alone(parallel());
    for from in [Vec3::ZERO, Vec3::new(4.0, -3.0, 2.0)] {
        let sample = table.sample(from, 0.5, [0.5; 2]).expect("light from everywhere");
        assert_eq!((sample.radiance, sample.density), (Rgb::new(3.0, 2.0, 1.0), 1.0));
        assert!(sample.discrete && sample.target.distance(SCENE.center) > SCENE.radius);
        assert!(sample.direction.distance(SUNWARD.normalize().as_vec3()) < 1e-6);
    }
}

#[test]
fn discrete_lights_are_met_by_nothing() {
    let spot = spots().remove(0).2;
    for (light, endpoint) in [
        (point(), Endpoint::Point),
        (spot, Endpoint::Point),
        (parallel(), Endpoint::Infinite),
    ] {
        let table = alone(light);
        assert!(table.is_delta(0) && table.infinite().next().is_none());
        assert_eq!(table.endpoint(0), endpoint);
        assert!(table.radiance(0, Vec3::X, Vec3::X).is_black());
        for ray in sent(20, &table).take(1000) {
            assert_eq!(ray.endpoint, endpoint);
            assert_eq!(ray.densities, table.emission_densities(0, ray.normal, ray.direction));
            assert_eq!(ray.densities.position, 1.0);
            assert_eq!((ray.position, ray.normal), (ray.origin, ray.direction));
        }
    }
}

/// The film's unit: the same order as what the light makes of a white surface in the scene, near the light if it has a place.
#[test]
fn lights_that_cannot_be_seen_count_by_what_they_light() {
    let brightest = |light: Light| f64::from(alone(light).max_radiance());
    let expected = 3.0 * (256.0 * 256.0) / 25.0 / (0.5 * TAU);
    assert!((brightest(point()) / expected - 1.0).abs() < 1e-6);
    assert!((brightest(spots().remove(0).2) / expected - 1.0).abs() < 1e-6);
    assert!((brightest(parallel()) / (3.0 / (0.5 * TAU)) - 1.0).abs() < 1e-6);
}
