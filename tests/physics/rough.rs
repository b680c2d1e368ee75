//! Rough and coated materials: laws that hold for any pair of directions and any parameters, and limits.

use crate::support::cells::direction;
use crate::support::draws::stream;
use crate::support::materials::PLAIN;
use crate::support::rough::*;
use crate::support::verdict::say;
use chainlight::color::Rgb;
use chainlight::material::conductor::Conductor;
use chainlight::material::dielectric::Dielectric;
use chainlight::material::fresnel;
use chainlight::material::plastic::Plastic;
use chainlight::material::{Evaluated, Model, ScatterDraw, Transport};
use chainlight::sampling::warp;
use chainlight::tolerance::LEAST_ROUGHNESS;
use glam::Vec3;
use std::f64::consts::TAU;

const PAIRS: usize = 20_000;
const ALPHAS: [[f32; 2]; 5] = [[1.0, 1.0], [0.3, 0.3], [0.1, 0.4], [0.02, 0.02], [1.0, 0.02]];
const BOTH: [Transport; 2] = [Transport::Radiance, Transport::Importance];

/// A visitor of every model with a density, over its parameters.
trait Visit {
    /// `blur` is the least roughness: how sharply values depend on directions.
    fn visit<M: Model>(&mut self, model: M, blur: f64, relative_ior: f64);
}

fn every_model(visit: &mut impl Visit) {
    for distribution in DISTRIBUTIONS {
        for alpha in ALPHAS {
            let blur = f64::from(alpha[0].min(alpha[1]));
            visit.visit(copper(distribution, alpha), blur, 1.0);
            for ior in [1.5, 1.0 / 1.33, 2.4, 1.05] {
                visit.visit(ground(distribution, alpha, ior), blur, f64::from(ior));
            }
        }
    }
    for nonlinear in [false, true] {
        visit.visit(plastic(1.49, Rgb::new(0.2, 0.5, 0.8), nonlinear), 1.0, 1.0);
    }
}

fn plastic(ior: f32, base: Rgb, nonlinear: bool) -> Plastic {
    Plastic::new(ior, [base.into(), Rgb::ONE.into()], nonlinear, true)
}

/// The relative error that rounding directions to `f32` may bring: that of the half vector in units of the roughness.
fn rounding(wi: Vec3, wo: Vec3, blur: f64, relative_ior: f64) -> f64 {
    let index = if wi.z > 0.0 { relative_ior } else { 1.0 / relative_ior };
    let (i, o) = (wi.as_dvec3(), wo.as_dvec3());
    let length = if wi.z * wo.z > 0.0 {
        (i + o).length()
    } else {
        (i + o * index).length()
    };
    1e-5 + 3e-6 / (blur * length)
}

fn near(a: f32, b: f32, relative: f64) -> bool {
    let (a, b) = (f64::from(a), f64::from(b));
    (a - b).abs() <= relative * a.abs().max(b.abs()) + 1e-30
}

struct Draws(u64);

impl Visit for Draws {
    fn visit<M: Model>(&mut self, model: M, blur: f64, relative_ior: f64) {
        let mut directions = stream(700);
        for draw in draws(701, PAIRS) {
            let wi = warp::uniform_sphere(directions.next_pair());
            for transport in BOTH {
                let Some(sample) = model
                    .sample(&PLAIN, wi, draw, transport)
                    .filter(|sample| !sample.discrete)
                else {
                    continue;
                };
                let slack = rounding(wi, sample.wo, blur, relative_ior);
                if slack > 0.02 {
                    continue;
                }
                let evaluated = model.evaluate(&PLAIN, wi, sample.wo, transport);
                let case = format!("{model:?} {wi} {draw:?}: {sample:?} {evaluated:?}, slack {slack}");
                assert!((sample.wo.length() - 1.0).abs() < 3e-7, "{case}");
                assert!(near(sample.density, evaluated.density, slack), "{case}");
                assert!(near(sample.reverse, evaluated.reverse, slack), "{case}");
                let values = sample.ratio.to_array().into_iter().zip(evaluated.value.to_array());
                for (ratio, value) in values {
                    assert!(near(ratio * sample.density, value, slack), "{case}");
                }
                self.0 += 1;
            }
        }
    }
}

#[test]
fn what_is_drawn_has_the_value_and_the_densities_that_are_evaluated() {
    let mut compared = Draws(0);
    every_model(&mut compared);
    say(&format!("{} draws compared", compared.0));
    assert!(compared.0 > 1_000_000, "{}", compared.0);
}

struct Pairs(u64);

impl Visit for Pairs {
    fn visit<M: Model>(&mut self, model: M, _: f64, relative_ior: f64) {
        let mut directions = stream(702);
        for draw in draws(703, PAIRS) {
            let a = warp::uniform_sphere(directions.next_pair());
            // A pair that the model knows, or any.
            let drawn = model
                .sample(&PLAIN, a, draw, Transport::Radiance)
                .filter(|sample| !sample.discrete);
            let b = drawn.map_or_else(|| warp::uniform_sphere(directions.next_pair()), |sample| sample.wo);
            let value = |from: Vec3, to: Vec3, transport| model.evaluate(&PLAIN, from, to, transport);
            let radiance = (value(a, b, Transport::Radiance), value(b, a, Transport::Radiance));
            let importance = value(a, b, Transport::Importance);
            let case = format!("{model:?} {a} {b}: {radiance:?} {importance:?}");
            let whole = |evaluated: &Evaluated| evaluated.value.is_finite() && evaluated.density.is_finite();
            assert!(whole(&radiance.0) && whole(&radiance.1) && whole(&importance), "{case}");
            // The index from inside is rounded once more than from outside.
            assert!(near(radiance.0.reverse, radiance.1.density, 1e-4), "{case}");
            assert!(near(radiance.0.density, importance.density, 1e-6), "{case}");
            let index = if a.z > 0.0 { relative_ior } else { 1.0 / relative_ior };
            let crossed = if a.z * b.z > 0.0 { 1.0 } else { (index * index) as f32 };
            for c in 0..3 {
                let per_cosine = |evaluated: &Evaluated, wo: Vec3| evaluated.value.to_array()[c] / wo.z.abs();
                let (there, back) = (per_cosine(&radiance.0, b), per_cosine(&radiance.1, a));
                assert!(near(there * crossed, back, 1e-4), "reciprocity, {case}");
                assert!(near(per_cosine(&importance, b), back, 1e-4), "adjoint, {case}");
            }
            self.0 += u64::from(radiance.0.density > 0.0);
        }
    }
}

#[test]
fn values_are_reciprocal_and_importance_is_radiance_turned_around() {
    let mut compared = Pairs(0);
    every_model(&mut compared);
    say(&format!("{} pairs compared", compared.0));
    assert!(compared.0 > 700_000, "{}", compared.0);
}

/// The draw that chooses what is chosen last.
const LAST: ScatterDraw = ScatterDraw {
    direction: [1.0 - 0.5 * f32::EPSILON, 0.0],
    lobe: 0.0,
};
/// What [`albedo`] may be off by.
const SLACK: f32 = 1e-5;
const SWEEP: [f32; 9] = [1.0, 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, LEAST_ROUGHNESS];
const COSINES: [f32; 7] = [1.0, 0.8, 0.5, 0.2, 0.05, 1e-3, 1e-6];

#[test]
fn rough_surfaces_make_no_light_and_lose_little_when_smooth() {
    for distribution in DISTRIBUTIONS {
        for alpha in SWEEP {
            let mut losses = Vec::new();
            for cosine in COSINES {
                let wi = incoming(cosine);
                let metal = albedo(&mirror(distribution, [alpha; 2]), wi, Transport::Radiance)[0].g;
                let [reflected, refracted] = albedo(&ground(distribution, [alpha; 2], 1.5), wi, Transport::Importance);
                let glass = reflected.g + refracted.g;
                assert!(
                    metal <= 1.0 + SLACK && glass <= 1.0 + SLACK,
                    "{distribution:?} {alpha} {cosine}: {metal} {glass}"
                );
                assert!(
                    metal > 0.3 && glass > 0.3,
                    "{distribution:?} {alpha} {cosine}: {metal} {glass}"
                );
                losses.push(format!("{:.4}/{:.4}", 1.0 - metal, 1.0 - glass));
                // What both lose vanishes with the roughness, the sooner the steeper the light falls.
                let bound = 2.0 * alpha / cosine.max(alpha);
                assert!(
                    1.0 - metal < bound && 1.0 - glass < bound,
                    "{distribution:?} {alpha} {cosine}: {metal} {glass}"
                );
            }
            say(&format!(
                "{distribution:?} {alpha}: a white metal and glass lose {}",
                losses.join(" ")
            ));
        }
    }
}

#[test]
fn the_smoothest_rough_surfaces_agree_with_smooth_ones() {
    for distribution in DISTRIBUTIONS {
        for cosine in COSINES.into_iter().filter(|c| *c >= 0.05).flat_map(|c| [c, -c]) {
            let wi = incoming(cosine);
            let rough = copper(distribution, [LEAST_ROUGHNESS; 2]);
            let smooth = Conductor {
                eta: rough.eta,
                k: rough.k,
                reflectance: rough.reflectance,
                two_sided: true,
            };
            let smooth_glass = Dielectric {
                relative_ior: 1.5,
                reflectance: Rgb::ONE,
                transmittance: Rgb::ONE,
            };
            let rough_glass = ground(distribution, [LEAST_ROUGHNESS; 2], 1.5);
            let mut apart = 0.0_f32;
            let mut compare = |a: [Rgb; 2], b: [Rgb; 2]| {
                for (a, b) in a.into_iter().zip(b) {
                    apart = apart.max((a - b).map(f32::abs).max_channel());
                }
            };
            let mirrored = smooth
                .sample(&PLAIN, wi, LAST, Transport::Radiance)
                .map(|sample| sample.ratio);
            let mirrored = [mirrored.unwrap_or(Rgb::BLACK), Rgb::BLACK];
            compare(albedo(&rough, wi, Transport::Radiance), mirrored);
            for transport in BOTH {
                let index = if wi.z > 0.0 { 1.5 } else { 1.0 / 1.5 };
                let fresnel = fresnel::dielectric(wi.z.abs(), index);
                let passed = smooth_glass.sample(&PLAIN, wi, LAST, transport);
                let passed = passed.filter(|sample| sample.wo.z * wi.z < 0.0);
                let passed = passed.map_or(Rgb::BLACK, |sample| sample.ratio * sample.density);
                compare(
                    albedo(&rough_glass, wi, transport),
                    [Rgb::splat(fresnel.reflectance), passed],
                );
            }
            say(&format!("{distribution:?} cosine {cosine}: apart by {apart:.1e}"));
            assert!(apart < 1e-3, "{distribution:?} {cosine}: {apart}");
        }
    }
}

#[test]
fn between_equal_indices_nothing_is_there() {
    for distribution in DISTRIBUTIONS {
        for cosine in COSINES.into_iter().flat_map(|c| [c, -c]) {
            let (nothing, wi) = (ground(distribution, [0.3, 0.3], 1.0), incoming(cosine));
            for draw in draws(704, 100) {
                for transport in BOTH {
                    let sample = nothing.sample(&PLAIN, wi, draw, transport).expect("light passes");
                    assert!(
                        sample.discrete && sample.wo == -wi && sample.ratio == Rgb::ONE,
                        "{wi}: {sample:?}"
                    );
                    assert_eq!((sample.density, sample.reverse, sample.relative_ior), (1.0, 1.0, 1.0));
                    assert_eq!(nothing.evaluate(&PLAIN, wi, sample.wo, transport), Evaluated::ZERO);
                }
            }
        }
    }
}

#[test]
fn between_nearly_equal_indices_light_passes_almost_straight_and_whole() {
    const DRAWS: u32 = 2000;
    for distribution in DISTRIBUTIONS {
        for alpha in [1.0, 0.1, 1e-2, LEAST_ROUGHNESS] {
            for off in [f32::EPSILON, 1e-6, 1e-5, 1e-3] {
                for cosine in [1.0, 0.8, 0.5, 0.2].into_iter().flat_map(|c| [c, -c]) {
                    let (glass, wi) = (ground(distribution, [alpha; 2], 1.0 + off), incoming(cosine));
                    let case = format!("{distribution:?} {alpha}, index 1 + {off}, cosine {cosine}");
                    let (mut bent, mut kept) = (0.0_f32, 0.0);
                    for draw in draws(705, DRAWS as usize) {
                        let Some(sample) = glass.sample(&PLAIN, wi, draw, Transport::Importance) else {
                            continue;
                        };
                        let finite = |density: f32| density > 0.0 && density.is_finite();
                        assert!(finite(sample.density) && finite(sample.reverse), "{case}: {sample:?}");
                        assert!(sample.ratio.g <= 1.0, "{case}: {sample:?}");
                        kept += sample.ratio.g / DRAWS as f32;
                        if sample.wo.z * wi.z < 0.0 {
                            bent = bent.max((sample.wo + wi).length());
                        }
                        let evaluated = glass.evaluate(&PLAIN, wi, sample.wo, Transport::Radiance);
                        let finite = evaluated.density.is_finite() && evaluated.reverse.is_finite();
                        assert!(evaluated.value.is_finite() && finite, "{case}: {evaluated:?}");
                    }
                    // At the critical angle of a facet light bends by √(2 off).
                    assert!(bent < 2e-7 + 2.0 * (2.0 * off).sqrt(), "{case}: bent by {bent}");
                    // What facets hide from straight light is what they hide at any index.
                    assert!(kept > 1.0 - 0.5 * alpha.max(1e-4) / cosine.abs(), "{case}: kept {kept}");
                }
            }
        }
    }
}

/// What a coated surface reflects: its mirror image, and the integral of its base's value over the heights of directions.
fn reflected_by_coated(coated: &Plastic, wi: Vec3) -> Rgb {
    const HEIGHTS: u32 = 20_000;
    let first = ScatterDraw {
        direction: [0.5; 2],
        lobe: 0.0,
    };
    let mirrored = coated
        .sample(&PLAIN, wi, first, Transport::Radiance)
        .filter(|sample| sample.discrete);
    let mirrored = mirrored.map_or(Rgb::BLACK, |sample| sample.ratio * sample.density);
    let mut scattered = [0.0_f64; 3];
    for k in 0..HEIGHTS {
        let z = (f64::from(k) + 0.5) / f64::from(HEIGHTS) * f64::from(wi.z.signum());
        let wo = direction(z, 1.0).as_vec3();
        let value = coated.evaluate(&PLAIN, wi, wo, Transport::Radiance).value.to_array();
        (0..3).for_each(|c| scattered[c] += TAU * f64::from(value[c]) / f64::from(HEIGHTS));
    }
    mirrored + Rgb::from(scattered.map(|s| s as f32))
}

#[test]
fn a_white_base_under_a_clear_coat_reflects_everything() {
    for ior in [1.0, 1.000_01, 1.33, 1.49, 2.4, 1.0 / 1.5] {
        for nonlinear in [false, true] {
            let white = plastic(ior, Rgb::ONE, nonlinear);
            for cosine in COSINES.into_iter().flat_map(|c| [c, -c]) {
                let reflected = reflected_by_coated(&white, incoming(cosine));
                assert!(
                    (reflected.g - 1.0).abs() < 2e-5,
                    "{ior} {nonlinear} {cosine}: {reflected:?}"
                );
            }
        }
        let colour = Rgb::new(0.1, 0.5, 0.9);
        let both = [false, true].map(|nonlinear| reflected_by_coated(&plastic(ior, colour, nonlinear), incoming(0.9)));
        let [linear, deep] = both.map(Rgb::to_array);
        // Light that goes back and forth takes the colour each time.
        assert!(
            linear.into_iter().zip(deep).all(|(linear, deep)| deep <= linear + 1e-6),
            "{ior}"
        );
    }
}

/// The mean of Fresnel's reflectance over a hemisphere in closed form (Walsh 1926; as Duntley 1942 has it), for n > 1.
fn walsh(n: f64) -> f64 {
    let (n2, n4) = (n * n, n * n * n * n);
    let (plus, minus) = (n2 + 1.0, n2 - 1.0);
    0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
        + n2 * minus * minus / (plus * plus * plus) * libm::log((n - 1.0) / (n + 1.0))
        - 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / (plus * (n4 - 1.0))
        + 8.0 * n4 * (n4 + 1.0) / (plus * (n4 - 1.0) * (n4 - 1.0)) * libm::log(n)
}

#[test]
fn diffuse_light_is_reflected_as_the_closed_form_says() {
    for n in [1.05, 1.33, 1.49, 1.5, 1.8, 2.4, 5.0, 10.0, 100.0] {
        let (outside, inside) = (fresnel::diffuse_reflectance(n), fresnel::diffuse_reflectance(1.0 / n));
        let expected = walsh(n);
        assert!((outside - expected).abs() < 1e-7, "{n}: {outside} {expected}");
        assert!(
            (inside - (1.0 - (1.0 - expected) / (n * n))).abs() < 1e-7,
            "{n}: {inside}"
        );
    }
    assert_eq!(fresnel::diffuse_reflectance(1.0), 0.0);
}
