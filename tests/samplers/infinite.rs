//! Lights at infinity against the densities that they state: directions as a point of the scene samples them, and rays
//! sent into the scene. A million each in 20 x 20 cells.

use super::remote::{SCENE, SUNWARD, alone, discs, parallel, wide};
use crate::support::cells::{Grid, angle, direction, height_and_angle, one_minus_cos};
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::light::{Emitted, Endpoint, Light, LightSample, LightTable};
use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

const SAMPLES: usize = 1_000_000;
/// Nine wide lights, sampled and sent; three discs, sampled and sent; places of parallel light.
const FAMILY: Family = Family { tests: 25 };
const SEES: f64 = 0.018;
const FROM: Vec3 = Vec3::new(2.0, 0.5, -1.0);

fn sampled(case: usize, table: &LightTable) -> impl Iterator<Item = LightSample> {
    let mut stream = stream(800 + case);
    (0..SAMPLES).filter_map(move |_| table.sample(FROM, stream.next_f64(), stream.next_pair()))
}

fn sent(case: usize, table: &LightTable) -> impl Iterator<Item = Emitted> {
    let mut stream = stream(850 + case);
    (0..SAMPLES).filter_map(move |_| {
        let choice = stream.next_f64();
        let point = stream.next_pair();
        table.emit(choice, point, stream.next_pair())
    })
}

/// Probabilities of cells; those that the midpoints miss get a sliver.
fn wide_probabilities(grid: &Grid, density: impl Fn(Vec3) -> f64) -> Vec<f64> {
    let mut probabilities = grid.midpoint(48, |z, phi| density(direction(z, phi).as_vec3()));
    probabilities.iter_mut().for_each(|p| *p = p.max(1e-12));
    probabilities
}

/// Few samples may find nothing: those that round to where there is no light.
fn nearly_all(counts: &[u64], name: &str) {
    let found: u64 = counts.iter().sum();
    assert!(found as usize > SAMPLES - 100, "{name}: {found}");
}

#[test]
fn directions_to_wide_lights_follow_the_stated_density() {
    let grid = Grid::around([-1.0, 1.0]);
    for (case, (name, light)) in wide().into_iter().enumerate() {
        let table = alone(light);
        let travel = |to: Vec3| f64::from(table.density(0, FROM, Vec3::ZERO, -to));
        let probabilities = wide_probabilities(&grid, travel);
        let total: f64 = probabilities.iter().sum();
        assert!((total - 1.0).abs() < 2e-3, "{name}: {total}");
        let counts = grid.count(sampled(case, &table).map(|s| height_and_angle(s.direction)));
        nearly_all(&counts, name);
        FAMILY.follows(name, &counts, &probabilities, SEES);
        // As if the sphere's heights were drawn like angles.
        let biased = wide_probabilities(&grid, |to| travel(to) * (1.0 + 0.05 * f64::from(to.z)));
        FAMILY.refuses(&format!("{name}, tilted"), &counts, &biased);
        // Rays that the light sends: the same directions, the other way.
        let counts = grid.count(sent(case, &table).map(|ray| height_and_angle(-ray.direction)));
        nearly_all(&counts, name);
        let stated = |to: Vec3| f64::from(table.emission_densities(0, -to, -to).position);
        FAMILY.follows(
            &format!("{name}, sent"),
            &counts,
            &wide_probabilities(&grid, stated),
            SEES,
        );
    }
}

/// Coordinates in a frame about the sun.
fn about_the_sun(d: Vec3) -> DVec3 {
    let axis = SUNWARD.normalize();
    let (x, y) = axis.any_orthonormal_pair();
    DMat3::from_cols(x, y, axis).transpose() * d.as_dvec3()
}

#[test]
fn directions_to_discs_follow_the_stated_density() {
    let grid = Grid::around([0.0, 1.0]);
    for (case, (name, radius, light)) in discs().into_iter().enumerate() {
        let table = alone(light);
        let sine = libm::sin(0.5 * f64::from(radius).to_radians());
        let rim = 2.0 * sine * sine;
        let density = f64::from(table.density(0, FROM, Vec3::ZERO, -SUNWARD.normalize().as_vec3())) * rim;
        let probabilities = grid.simpson(2, |_, _| density);
        assert!((probabilities.iter().sum::<f64>() - 1.0).abs() < 1e-5, "{name}");
        let seen = |to: Vec3| {
            let d = about_the_sun(to);
            let t = one_minus_cos(d) / rim;
            [if t < 1.001 { t.min(1.0) } else { t }, angle(d.x, d.y)]
        };
        let counts = grid.count(sampled(20 + case, &table).map(|s| seen(s.direction)));
        nearly_all(&counts, name);
        FAMILY.follows(name, &counts, &probabilities, SEES);
        let by_angle = grid.simpson(2, |t, _| 0.5 / TAU / t.max(1e-9).sqrt());
        FAMILY.refuses(&format!("{name}, uniform in angle"), &counts, &by_angle);
        let counts = grid.count(sent(20 + case, &table).map(|ray| seen(-ray.direction)));
        nearly_all(&counts, name);
        FAMILY.follows(&format!("{name}, sent"), &counts, &probabilities, SEES);
    }
}

fn every_infinite() -> Vec<(&'static str, Light)> {
    let discs = discs().into_iter().map(|(name, _, light)| (name, light));
    wide().into_iter().chain(discs).collect()
}

#[test]
fn samples_state_the_density_and_radiance_of_their_direction() {
    for (case, (name, light)) in every_infinite().into_iter().enumerate() {
        let table = alone(light);
        assert!(!table.is_delta(0) && table.infinite().eq([0]));
        assert_eq!(table.endpoint(0), Endpoint::Infinite);
        for sample in sampled(case, &table).take(20_000) {
            let travel = -sample.direction;
            assert_eq!(sample.normal, travel, "{name}");
            assert_eq!(sample.density, table.density(0, FROM, Vec3::ZERO, travel), "{name}");
            assert_eq!(sample.radiance, table.radiance(0, travel, travel), "{name}");
            assert!(
                !sample.discrete && sample.direction.is_normalized(),
                "{name}: {sample:?}"
            );
            let span = sample.target.as_dvec3() - FROM.as_dvec3();
            let off = span.normalize().distance(sample.direction.as_dvec3());
            let outside = sample.target.distance(SCENE.center) > SCENE.radius;
            assert!(outside && off < 1e-6, "{name}: {sample:?}");
        }
        for ray in sent(case, &table).take(20_000) {
            assert_eq!(ray.normal, ray.direction, "{name}");
            assert_eq!(
                ray.densities,
                table.emission_densities(0, ray.normal, ray.direction),
                "{name}"
            );
            let product = f64::from(ray.densities.position) * f64::from(ray.densities.direction);
            let radiance = table.radiance(0, ray.direction, ray.direction);
            assert!(
                (f64::from(ray.ratio.g) * product / f64::from(radiance.g) - 1.0).abs() < 1e-5,
                "{name}: {ray:?}"
            );
        }
    }
}

/// The least and the largest numbers that streams draw, of lights with nothing but edges.
#[test]
fn the_ends_of_the_unit_interval_are_directions_too() {
    let ends = [0.0, 0.5, 1.0 - 1.0 / 16_777_216.0];
    for (name, light) in every_infinite() {
        let table = alone(light);
        for choice in [0.0, 0.3, 1.0_f64.next_down()] {
            for u in ends {
                for v in ends {
                    if let Some(sample) = table.sample(FROM, choice, [u, v]) {
                        assert!(sample.density > 0.0 && sample.density.is_finite(), "{name}: {sample:?}");
                        assert!(
                            sample.radiance.is_finite() && sample.direction.is_normalized(),
                            "{name}: {sample:?}"
                        );
                    }
                    if let Some(ray) = table.emit(choice, [u, v], [v, u]) {
                        assert!(ray.ratio.is_finite() && ray.origin.is_finite(), "{name}: {ray:?}");
                    }
                }
            }
        }
    }
}

/// Points of the disc in its own frame, by area and angle.
fn on_disc(ray: &Emitted) -> [f64; 2] {
    let d = ray.direction.as_dvec3();
    let (x, y) = d.any_orthonormal_pair();
    let p = (ray.origin.as_dvec3() - SCENE.center.as_dvec3()) / f64::from(SCENE.radius);
    let (x, y) = (p.dot(x), p.dot(y));
    let r2 = x * x + y * y;
    [if r2 < 1.0 + 1e-5 { r2.min(1.0) } else { r2 }, angle(x, y)]
}

#[test]
fn light_from_infinity_fills_a_disc_that_hides_the_scene() {
    let grid = Grid::around([0.0, 1.0]);
    let table = alone(parallel());
    let stated = table.emission_densities(0, Vec3::X, Vec3::X);
    assert_eq!(stated.position, 1.0);
    let area = f64::from(stated.direction) * f64::from(SCENE.radius) * f64::from(SCENE.radius);
    let probabilities = grid.simpson(2, |_, _| 0.5 * area);
    assert!((probabilities.iter().sum::<f64>() - 1.0).abs() < 1e-5);
    let counts = grid.count(sent(40, &table).map(|ray| on_disc(&ray)));
    assert_eq!(counts.iter().sum::<u64>() as usize, SAMPLES);
    FAMILY.follows("parallel light", &counts, &probabilities, SEES);
    let in_radius = grid.simpson(2, |r2, _| 0.5 / TAU / r2.max(1e-9).sqrt());
    FAMILY.refuses("parallel light, uniform in radius", &counts, &in_radius);
    for (case, (name, light)) in every_infinite()
        .into_iter()
        .chain([("parallel", parallel())])
        .enumerate()
    {
        for ray in sent(case, &alone(light)).take(5_000) {
            let p = ray.origin.as_dvec3() - SCENE.center.as_dvec3();
            let before = p.dot(ray.direction.as_dvec3()) / f64::from(SCENE.radius);
            assert!((before + 1.0).abs() < 1e-5, "{name}: {ray:?}");
            assert!(on_disc(&ray)[0] <= 1.0, "{name}: {ray:?}");
            let disc = 1.0 / (PI * f64::from(SCENE.radius) * f64::from(SCENE.radius));
            assert!((f64::from(ray.densities.direction) / disc - 1.0).abs() < 1e-6, "{name}");
        }
    }
}
