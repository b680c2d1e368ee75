//! `Conductor` and `Dielectric`: where they send light, exactly, and how often which way: a two-cell chi-square test of a
//! million choices for every interface and angle.

use crate::support::draws::stream;
use crate::support::materials::OnPlain;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::material::Scattered;
use chainlight::material::conductor::Conductor;
use chainlight::material::dielectric::Dielectric;
use glam::{DVec3, Vec3};

const SAMPLES: usize = 1_000_000;
/// Relative indices: none, almost none, water, glass, diamond and glass from inside.
const INDICES: [f32; 6] = [1.0, 1.000_01, 1.33, 1.5, 2.4, 1.0 / 1.5];
const COSINES: [f32; 6] = [1.0, 0.9, 0.7, 0.3, 0.05, 1e-4];
/// Where the planted bias has to show: a rarer reflection off by 2 % is within the noise.
const SEEN_FROM: f64 = 0.15;
/// At most: a reflection that is as good as never or always is counted, not tested.
const FAMILY: Family = Family {
    tests: 2 * INDICES.len() * COSINES.len(),
};

fn glass(relative_ior: f32) -> Dielectric {
    Dielectric {
        relative_ior,
        reflectance: Rgb::ONE,
        transmittance: Rgb::ONE,
    }
}

/// Off the coordinate planes, on the side of the cosine's sign.
fn incoming(cosine: f32) -> Vec3 {
    let c = f64::from(cosine);
    let sine = (1.0 - c * c).max(0.0).sqrt();
    DVec3::new(0.6 * sine, -0.8 * sine, c).as_vec3()
}

/// Whether both directions are above the surface, or both below: by signs, since products of tiny cosines vanish.
fn same_side(a: Vec3, b: Vec3) -> bool {
    (a.z > 0.0) == (b.z > 0.0)
}

/// Fresnel's reflectance in the form of Cook and Torrance (1982), from the cosine and the relative index: other algebra
/// than the renderer's.
fn reflectance(cosine: f64, n: f64) -> f64 {
    let g2 = n * n - 1.0 + cosine * cosine;
    if n == 1.0 {
        return 0.0;
    }
    if g2 <= 0.0 {
        return 1.0;
    }
    let g = g2.sqrt();
    let ratio = (g - cosine) / (g + cosine);
    let inner = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    0.5 * ratio * ratio * (1.0 + inner * inner)
}

#[test]
fn interfaces_reflect_as_often_as_fresnel_says() {
    let mut case = 300;
    for n in INDICES {
        for cosine in COSINES.into_iter().flat_map(|c| [c, -c]) {
            case += 1;
            let (glass, wi) = (glass(n), incoming(cosine));
            let relative = f64::from(if cosine > 0.0 { n } else { 1.0 / n });
            let expected = reflectance(f64::from(cosine.abs()), relative);
            let mut stream = stream(case);
            let samples = (0..SAMPLES).map(|_| glass.decide(wi, stream.next_f32()).expect("not grazing"));
            let reflected = samples.filter(|sample| same_side(sample.wo, wi)).count() as u64;
            let counts = [reflected, SAMPLES as u64 - reflected];
            if expected * (1.0 - expected) * (SAMPLES as f64) < 5.0 {
                // As good as none or all: a handful at most is chosen otherwise.
                let rare = if expected < 0.5 { counts[0] } else { counts[1] };
                assert!(rare < 25, "{n} {cosine}: {counts:?}, expected {expected}");
                continue;
            }
            let name = format!("index {n}, cosine {cosine}");
            // In units of the two cells: 0.7 % of cells that are alike.
            FAMILY.follows(&name, &counts, &[expected, 1.0 - expected], 0.008);
            if (SEEN_FROM..1.0 / 1.02).contains(&expected) {
                let off = 1.02 * expected;
                FAMILY.refuses(&format!("{name}, 2 % off"), &counts, &[off, 1.0 - off]);
            }
        }
    }
}

/// Cosines of incidence for a relative index: everywhere, at both ends, and a millionth and less on either side of the
/// critical angle, if there is one.
fn sweep(relative_ior: f32) -> Vec<f32> {
    let mut cosines: Vec<f32> = (1..=400).map(|i| i as f32 / 400.0).collect();
    cosines.extend([f32::MIN_POSITIVE, 1e-30, 1e-8, 1e-4, 1.0 - f32::EPSILON]);
    let n = f64::from(relative_ior.min(1.0 / relative_ior));
    let critical = (1.0 - n * n).max(0.0).sqrt();
    for angle in [0.0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3] {
        let sine = (1.0 - critical * critical).sqrt();
        // cos(θ ± a), to first order in so small an angle.
        cosines.extend([(critical - angle * sine) as f32, (critical + angle * sine) as f32]);
    }
    cosines.retain(|c| *c > 0.0 && *c <= 1.0);
    cosines
}

fn assert_sound(sample: &Scattered, case: &str) {
    assert!(sample.wo.is_finite() && sample.ratio.is_finite(), "{case}: {sample:?}");
    assert!(
        (sample.wo.length() - 1.0).abs() < 1e-6 && sample.wo.z != 0.0,
        "{case}: {sample:?}"
    );
    assert!(
        sample.discrete && sample.density > 0.0 && sample.density <= 1.0,
        "{case}: {sample:?}"
    );
}

#[test]
fn refraction_follows_snell_and_reflection_its_law_at_every_angle() {
    for n in INDICES.into_iter().chain([0.1, 10.0, 1.0 / 1.000_01]) {
        for cosine in sweep(n).into_iter().flat_map(|c| [c, -c]) {
            let (glass, wi) = (glass(n), incoming(cosine));
            let case = format!("index {n}, cosine {cosine}");
            let relative = if cosine > 0.0 { n } else { 1.0 / n };
            for u in [0.0, 0.02, 0.5, 1.0 - 0.5 * f32::EPSILON] {
                let sample = glass.decide(wi, u).expect("not grazing");
                assert_sound(&sample, &case);
                if same_side(sample.wo, wi) {
                    assert_eq!(sample.wo, Vec3::new(-wi.x, -wi.y, wi.z), "{case}");
                    assert_eq!((sample.ratio, sample.relative_ior), (Rgb::ONE, 1.0), "{case}");
                    continue;
                }
                // Snell: the tangents of wi and of n wo are opposite, in the plane of incidence.
                let tangent = sample.wo.as_dvec3() * f64::from(relative) + wi.as_dvec3();
                let rounding = 4e-7 * f64::from(relative).max(1.0);
                assert!(
                    tangent.x.abs() < rounding && tangent.y.abs() < rounding,
                    "{case}: {tangent}"
                );
                let c = f64::from(cosine);
                let sin2 = (1.0 - c * c) / (f64::from(relative) * f64::from(relative));
                let z = (1.0 - sin2).max(0.0).sqrt();
                assert!((f64::from(sample.wo.z.abs()) - z).abs() < 4e-7, "{case}: {z}");
                assert_eq!(sample.relative_ior, relative);
            }
        }
    }
}

#[test]
fn shares_of_reflection_and_refraction_make_one() {
    for n in INDICES {
        for cosine in sweep(n).into_iter().flat_map(|c| [c, -c]) {
            let (glass, wi) = (glass(n), incoming(cosine));
            let relative = f64::from(if cosine > 0.0 { n } else { 1.0 / n });
            let often = glass.decide(wi, 1.0 - 0.5 * f32::EPSILON).expect("not grazing");
            let rare = glass.decide(wi, 0.0).expect("not grazing");
            let both = !same_side(often.wo, rare.wo);
            let sum = often.density + if both { rare.density } else { 0.0 };
            assert!((sum - 1.0).abs() <= f32::EPSILON, "{n} {cosine}: {sum}");
            // Refraction's ratio is its transmittance once the scale of radiance is taken off.
            for sample in [often, rare] {
                let unscaled = sample.ratio.g * sample.relative_ior * sample.relative_ior;
                assert!((unscaled - 1.0).abs() < 1e-6, "{n} {cosine}: {sample:?}");
            }
            let expected = reflectance(f64::from(cosine.abs()), relative);
            let stated = if same_side(rare.wo, wi) {
                f64::from(rare.density)
            } else {
                0.0
            };
            assert!((stated - expected).abs() < 1e-6, "{n} {cosine}: {stated} {expected}");
        }
    }
}

#[test]
fn conductors_reflect_into_the_mirrored_direction_alone() {
    let metal = |two_sided| Conductor {
        eta: Rgb::new(0.2, 0.9, 1.1),
        k: Rgb::new(3.9, 2.4, 2.1),
        reflectance: Rgb::new(1.0, 0.5, 0.0).into(),
        two_sided,
    };
    for cosine in sweep(1.5).into_iter().flat_map(|c| [c, -c]) {
        let wi = incoming(cosine);
        let sample = metal(true).decide(wi, 0.0).expect("not grazing");
        assert_sound(&sample, &format!("cosine {cosine}"));
        assert_eq!((sample.wo, sample.density), (Vec3::new(-wi.x, -wi.y, wi.z), 1.0));
        let one_sided = metal(false).decide(wi, 0.0);
        assert_eq!(one_sided.is_some(), cosine > 0.0, "{cosine}");
        assert!(one_sided.is_none_or(|one| one == sample));
    }
}
