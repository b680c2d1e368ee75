//! `Diffuse`: directions against their density, and samples against `evaluate`. Nine chi-square tests of a million
//! samples in 20 x 20 cells of the whole sphere.

use crate::support::cells::{Grid, direction, height_and_angle};
use crate::support::draws::stream;
use crate::support::materials::OnPlain;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::material::diffuse::Diffuse;
use chainlight::sampling::warp;
use glam::Vec3;
use std::f64::consts::TAU;

const SAMPLES: usize = 1_000_000;
const REFLECTANCE: Rgb = Rgb::new(0.9, 0.5, 0.0);
/// Cosines of incidence, from the front and from behind, down to grazing.
const COSINES: [f32; 6] = [1.0, 0.6, 1e-3, -1e-3, -0.6, -1.0];
/// Every cosine on the two-sided material, and those in front of the one-sided one.
const FAMILY: Family = Family { tests: 9 };
const SEES: f64 = 0.016;

fn matt(two_sided: bool) -> Diffuse {
    Diffuse {
        reflectance: REFLECTANCE.into(),
        two_sided,
    }
}

fn incoming(cosine: f32) -> Vec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    Vec3::new(0.8 * sine, -0.6 * sine, cosine)
}

fn counts(case: usize, matt: &Diffuse, wi: Vec3, grid: &Grid) -> Vec<u64> {
    let mut stream = stream(200 + case);
    let samples = (0..SAMPLES).filter_map(|_| matt.scatter(wi, stream.next_pair()));
    grid.count(samples.map(|sample| height_and_angle(sample.wo)))
}

#[test]
fn directions_follow_the_density_that_evaluate_states() {
    let grid = Grid::around([-1.0, 1.0]);
    let mut tests = 0;
    for two_sided in [true, false] {
        for cosine in COSINES {
            let (matt, wi) = (matt(two_sided), incoming(cosine));
            let density = |z, phi| f64::from(matt.value(wi, direction(z, phi).as_vec3()).density);
            let probabilities = grid.simpson(4, density);
            let total: f64 = probabilities.iter().sum();
            let counts = counts(tests, &matt, wi, &grid);
            let drawn = counts.iter().sum::<u64>() as f64 / SAMPLES as f64;
            // A direction in the surface itself is refused: one in ten million.
            assert!((drawn - total).abs() < 1e-5, "{cosine} {two_sided}: {drawn} {total}");
            if cosine < 0.0 && !two_sided {
                assert_eq!(total, 0.0);
                continue;
            }
            assert!((total - 1.0).abs() < 1e-6);
            FAMILY.follows(
                &format!("cosine {cosine}, two-sided {two_sided}"),
                &counts,
                &probabilities,
                SEES,
            );
            tests += 1;
            let side = |z: f64, _| if (z > 0.0) == (cosine > 0.0) { 1.0 / TAU } else { 0.0 };
            FAMILY.refuses("the cosine forgotten", &counts, &grid.midpoint(1, side));
        }
    }
    assert_eq!(tests, FAMILY.tests);
}

#[test]
fn samples_agree_with_evaluate() {
    let mut stream = stream(299);
    for _ in 0..100_000 {
        let wi = warp::uniform_sphere(stream.next_pair());
        let matt = matt(true);
        let Some(sample) = matt.scatter(wi, stream.next_pair()) else {
            continue;
        };
        let evaluated = matt.value(wi, sample.wo);
        assert!(!sample.discrete && sample.relative_ior == 1.0);
        assert_eq!(sample.density, evaluated.density);
        assert!((sample.wo.length() - 1.0).abs() < 1e-6);
        for (ratio, value) in sample.ratio.to_array().into_iter().zip(evaluated.value.to_array()) {
            assert!(
                (ratio * evaluated.density - value).abs() <= 4.0 * f32::EPSILON * value,
                "{wi}"
            );
        }
    }
}

#[test]
fn reflection_is_reciprocal() {
    let mut stream = stream(298);
    for two_sided in [true, false] {
        let matt = matt(two_sided);
        for _ in 0..100_000 {
            let (a, b) = (
                warp::uniform_sphere(stream.next_pair()),
                warp::uniform_sphere(stream.next_pair()),
            );
            let there = matt.value(a, b).value / b.z.abs();
            let back = matt.value(b, a).value / a.z.abs();
            for (there, back) in there.to_array().into_iter().zip(back.to_array()) {
                assert!(
                    (there - back).abs() <= 4.0 * f32::EPSILON * there,
                    "{a} {b}: {there} {back}"
                );
            }
        }
    }
}
