//! No material makes light, and none makes nonsense, whatever its parameters.

use crate::support::cells::{Grid, direction};
use crate::support::materials::OnPlain;
use chainlight::color::Rgb;
use chainlight::material::conductor::Conductor;
use chainlight::material::dielectric::Dielectric;
use chainlight::material::diffuse::Diffuse;
use chainlight::material::fresnel;
use glam::Vec3;

const COSINES: [f32; 12] = [
    0.0,
    f32::MIN_POSITIVE,
    1e-30,
    1e-8,
    1e-5,
    1e-3,
    0.1,
    0.3,
    0.6,
    0.9,
    1.0 - f32::EPSILON,
    1.0,
];

fn incoming(cosine: f32) -> Vec3 {
    Vec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine)
}

#[test]
fn diffuse_surfaces_reflect_their_reflectance() {
    let grid = Grid::around([-1.0, 1.0]);
    for reflectance in [0.0, 0.3, 1.0] {
        let matt = Diffuse {
            reflectance: Rgb::splat(reflectance).into(),
            two_sided: true,
        };
        // Tiny cosines are left out: below 1e-19 their products with others vanish.
        for cosine in COSINES.into_iter().filter(|c| *c > 1e-19).flat_map(|c| [c, -c]) {
            let value = |z, phi| f64::from(matt.value(incoming(cosine), direction(z, phi).as_vec3()).value.g);
            let albedo: f64 = grid.simpson(2, value).iter().sum();
            assert!((albedo - f64::from(reflectance)).abs() < 1e-6, "{cosine}: {albedo}");
        }
    }
}

#[test]
fn conductors_reflect_between_nothing_and_all() {
    let extremes = [0.0, 1e-6, 1e-3, 0.1, 0.5, 1.0, 1.5, 3.0, 10.0, 1e3, 1e6];
    for eta in extremes {
        for k in extremes {
            for cosine in COSINES {
                let reflectance = fresnel::conductor(cosine, eta, k);
                assert!((0.0..=1.0).contains(&reflectance), "{eta} {k} {cosine}: {reflectance}");
            }
            let metal = Conductor {
                eta: Rgb::splat(eta),
                k: Rgb::splat(k),
                reflectance: Rgb::ONE.into(),
                two_sided: true,
            };
            for cosine in COSINES.into_iter().flat_map(|c| [c, -c]) {
                let ratio = metal
                    .decide(incoming(cosine), 0.0)
                    .map_or(Rgb::BLACK, |sample| sample.ratio);
                assert!((0.0..=1.0).contains(&ratio.g), "{eta} {k} {cosine}: {ratio:?}");
            }
        }
    }
    assert_eq!(fresnel::conductor(0.4, 0.0, 1.0), 1.0, "the ideal mirror");
}

/// Head-on, ((n − 1)² + k²) / ((n + 1)² + k²).
#[test]
fn conductors_reflect_head_on_as_the_textbook_says() {
    for eta in [0.0_f32, 1e-3, 0.2, 1.0, 3.0, 1e3, 1e6] {
        for k in [0.0_f32, 1e-3, 0.5, 4.0, 1e3, 1e6] {
            let (n, a) = (f64::from(eta), f64::from(k));
            let expected = ((n - 1.0) * (n - 1.0) + a * a) / ((n + 1.0) * (n + 1.0) + a * a);
            let reflectance = f64::from(fresnel::conductor(1.0, eta, k));
            assert!(
                (reflectance - expected).abs() < 1e-6,
                "{eta} {k}: {reflectance} {expected}"
            );
        }
    }
}

#[test]
fn dielectrics_pass_on_what_they_do_not_reflect() {
    let mut indices = vec![0.1, 0.5, 1.0 / 1.5, 0.999_99, 1.0, 1.000_01, 1.33, 1.5, 2.4, 10.0];
    indices.extend((1..100).map(|i| 0.1 * i as f32));
    for relative_ior in indices {
        let glass = Dielectric {
            relative_ior,
            reflectance: Rgb::ONE,
            transmittance: Rgb::ONE,
        };
        for cosine in COSINES.into_iter().filter(|c| *c > 0.0).flat_map(|c| [c, -c]) {
            let wi = incoming(cosine);
            // The power of each branch: its probability times its ratio, free of the scale of radiance.
            let power = |u| {
                let sample = glass.decide(wi, u).expect("not grazing");
                let share = sample.density * sample.ratio.g * sample.relative_ior * sample.relative_ior;
                ((sample.wo.z > 0.0) == (wi.z > 0.0), share)
            };
            let (first, last) = (power(0.0), power(1.0 - 0.5 * f32::EPSILON));
            let total = last.1 + if first.0 == last.0 { 0.0 } else { first.1 };
            assert!(
                (total - 1.0).abs() < 1e-6,
                "{relative_ior} {cosine}: {first:?} {last:?}"
            );
        }
    }
}
