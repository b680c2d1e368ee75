//! `RoughConductor`, `RoughDielectric` and `Plastic`: directions over the whole sphere against the density that `evaluate`
//! states, with what is discrete and what is absorbed as cells of their own. Chi-square tests of 400 000 samples in 402
//! cells; each must refuse the density of a neighbouring roughness, index or probability.

use crate::support::materials::PLAIN;
use crate::support::rough::*;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::material::plastic::Plastic;
use chainlight::material::{Model, ScatterDraw, Transport};

const SAMPLES: usize = 400_000;
const FAMILY: Family = Family {
    tests: 2 * 3 * 4 + 2 * 2 * 6 + 3 * 5,
};
/// The root mean square of relative deviations of cells that each test sees.
const SEES: f64 = 0.03;
/// Isotropic and brushed; narrower lobes than cells of the sphere are tested in `rough_lobes`.
const ALPHAS: [[f32; 2]; 3] = [[0.15, 0.15], [1.0, 1.0], [0.15, 0.5]];

#[test]
fn rough_metals_reflect_as_their_density_says() {
    let mut case = 400;
    for distribution in DISTRIBUTIONS {
        for alpha in ALPHAS {
            for cosine in [1.0, 0.6, 0.05, -0.6] {
                case += 1;
                let (metal, wi) = (copper(distribution, alpha), incoming(cosine));
                let counts = Heights::Even.counts(&metal, wi, draws(case, SAMPLES));
                let name = format!("{distribution:?} {alpha:?}, cosine {cosine}");
                FAMILY.follows(&name, &counts, &Heights::Even.expected(&metal, wi, 0.0), SEES);
                let rougher = copper(distribution, alpha.map(|a| 1.05 * a));
                FAMILY.refuses(
                    &format!("{name}, 5 % off"),
                    &counts,
                    &Heights::Even.expected(&rougher, wi, 0.0),
                );
            }
        }
    }
}

#[test]
fn ground_glass_reflects_and_refracts_as_its_density_says() {
    let mut case = 430;
    for distribution in DISTRIBUTIONS {
        for alpha in [[0.3, 0.3], [0.25, 0.8]] {
            for (cosine, ior) in [
                (1.0, 1.5),
                (0.5, 1.5),
                (0.05, 1.5),
                (-0.8, 1.5),
                (-0.3, 1.5),
                (0.4, 2.4),
            ] {
                case += 1;
                let (glass, wi) = (ground(distribution, alpha, ior), incoming(cosine));
                let counts = Heights::WidePoles.counts(&glass, wi, draws(case, SAMPLES));
                let name = format!("{distribution:?} {alpha:?}, index {ior}, cosine {cosine}");
                FAMILY.follows(&name, &counts, &Heights::WidePoles.expected(&glass, wi, 0.0), SEES);
                let denser = ground(distribution, alpha, 1.03 * ior);
                FAMILY.refuses(
                    &format!("{name}, 3 % off"),
                    &counts,
                    &Heights::WidePoles.expected(&denser, wi, 0.0),
                );
            }
        }
    }
}

#[test]
fn plastic_mirrors_and_scatters_as_its_density_says() {
    let plastic = |ior, nonlinear| {
        let (base, coat) = (Rgb::new(0.2, 0.5, 0.8), Rgb::new(1.0, 0.9, 0.8));
        Plastic::new(ior, [base.into(), coat.into()], nonlinear, true)
    };
    let mut case = 460;
    for (ior, nonlinear) in [(1.49, false), (1.8, true), (1.0 / 1.3, false)] {
        for cosine in [1.0, 0.7, 0.2, 0.01, -0.4] {
            case += 1;
            let (plastic, wi) = (plastic(ior, nonlinear), incoming(cosine));
            let draw = ScatterDraw {
                direction: [0.3, 0.6],
                lobe: 0.0,
            };
            let mirrored = plastic
                .sample(&PLAIN, wi, draw, Transport::Radiance)
                .filter(|sample| sample.discrete);
            let discrete = mirrored.map_or(0.0, |sample| f64::from(sample.density));
            let counts = Heights::Even.counts(&plastic, wi, draws(case, SAMPLES));
            let name = format!("index {ior}, cosine {cosine}, mirrored {discrete:.3}");
            let expected = Heights::Even.expected(&plastic, wi, discrete);
            if discrete == 1.0 {
                assert_eq!(counts[Heights::Even.sphere().len()], SAMPLES as u64, "{name}");
                continue;
            }
            FAMILY.follows(&name, &counts, &expected, SEES);
            if discrete < 0.9 {
                let mut off = expected;
                let cells = Heights::Even.sphere().len();
                let moved = 0.05 * (1.0 - discrete);
                off[..cells].iter_mut().for_each(|share| *share *= 0.95);
                off[cells] += moved;
                FAMILY.refuses(&format!("{name}, 5 % off"), &counts, &off);
            }
        }
    }
}
