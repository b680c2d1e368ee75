//! Rough and mixed materials as tests need them: cases, directions, and samples sorted into cells.

use super::cells::{Grid, direction, height_and_angle, one_minus_cos};
use super::draws::stream;
use super::materials::PLAIN;
use chainlight::color::Rgb;
use chainlight::material::microfacet::{Distribution, Microfacets};
use chainlight::material::rough_conductor::RoughConductor;
use chainlight::material::rough_dielectric::RoughDielectric;
use chainlight::material::{Model, ScatterDraw, Scattered, Transport};
use glam::{DVec3, Vec3};

pub const DISTRIBUTIONS: [Distribution; 2] = [Distribution::Ggx, Distribution::Beckmann];
/// Midpoints along each side of a cell: edges of lobes run through cells.
const POINTS: usize = 32;

/// The share of a cell that the rule says is empty.
const LEAST_SHARE: f64 = 1e-9;

/// A metal that reflects everything, so that what is lost is lost between facets.
pub fn mirror(distribution: Distribution, alpha: [f32; 2]) -> RoughConductor {
    RoughConductor {
        microfacets: Microfacets::new(distribution, alpha),
        eta: Rgb::BLACK,
        k: Rgb::ONE,
        reflectance: Rgb::ONE.into(),
        two_sided: true,
    }
}

/// Copper.
pub fn copper(distribution: Distribution, alpha: [f32; 2]) -> RoughConductor {
    RoughConductor {
        eta: Rgb::new(0.200_438, 0.924_033, 1.102_21),
        k: Rgb::new(3.912_95, 2.452_85, 2.142_19),
        ..mirror(distribution, alpha)
    }
}

/// Ground glass, or another clear medium.
pub fn ground(distribution: Distribution, alpha: [f32; 2], relative_ior: f32) -> RoughDielectric {
    RoughDielectric {
        microfacets: Microfacets::new(distribution, alpha),
        relative_ior,
        reflectance: Rgb::ONE,
        transmittance: Rgb::ONE,
    }
}

/// A direction of this cosine, off the coordinate planes.
pub fn incoming(cosine: f32) -> Vec3 {
    let c = f64::from(cosine);
    let sine = (1.0 - c * c).max(0.0).sqrt();
    DVec3::new(0.6 * sine, -0.8 * sine, c).as_vec3()
}

/// Draws of case `case`: `samples` of them.
pub fn draws(case: usize, samples: usize) -> impl Iterator<Item = ScatterDraw> {
    let mut stream = stream(case);
    (0..samples).map(move |_| ScatterDraw {
        direction: stream.next_pair(),
        lobe: stream.next_f32(),
    })
}

/// Counts of samples in the cells of `grid`, of discrete ones, and of paths that were absorbed; `place` gives a sample's
/// coordinates.
pub fn counts(
    grid: &Grid,
    model: &impl Model,
    wi: Vec3,
    draws: impl Iterator<Item = ScatterDraw>,
    place: impl Fn(&Scattered) -> [f64; 2],
) -> Vec<u64> {
    let mut counts = vec![0; grid.len() + 2];
    for draw in draws {
        let cell = match model.sample(&PLAIN, wi, draw, Transport::Radiance) {
            None => grid.len() + 1,
            Some(sample) if sample.discrete => grid.len(),
            Some(sample) => {
                let cell = grid.cell(place(&sample));
                assert!(cell < grid.len(), "{sample:?} is outside");
                cell
            }
        };
        counts[cell] += 1;
    }
    counts
}

/// What the counts should be in proportion to: `density` per unit of the grid's coordinates, a discrete lobe, and the rest.
pub fn expected(grid: &Grid, discrete: f64, density: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let mut cells = grid.midpoint(POINTS, density);
    let absorbed = 1.0 - discrete - cells.iter().sum::<f64>();
    assert!(absorbed > -2e-4, "densities integrate to {}", 1.0 - absorbed);
    cells.extend([discrete, absorbed]);
    // A corner of the support may lie between midpoints.
    cells.into_iter().map(|share| share.max(LEAST_SHARE)).collect()
}

/// The whole sphere in 20 x 20 cells of the angle around and of t, with |z| = 1 − t²: lobes about the poles are as narrow as
/// refraction makes them, and t widens them. The upper half has t > 0.
pub fn sphere() -> Grid {
    Grid::around([-1.0, 1.0])
}

/// Counts over the sphere of directions.
pub fn sphere_counts(model: &impl Model, wi: Vec3, draws: impl Iterator<Item = ScatterDraw>) -> Vec<u64> {
    counts(&sphere(), model, wi, draws, |sample| {
        let [z, phi] = height_and_angle(sample.wo);
        let from_pole = one_minus_cos(sample.wo.as_dvec3().with_z(z.abs()));
        [from_pole.max(0.0).sqrt().min(1.0).copysign(z), phi]
    })
}

/// The density that a model states, over the sphere of directions.
pub fn sphere_expected(model: &impl Model, wi: Vec3, discrete: f64) -> Vec<f64> {
    expected(&sphere(), discrete, |t, phi| {
        let wo = direction((1.0 - t * t).copysign(t), phi).as_vec3();
        2.0 * t.abs() * f64::from(model.evaluate(&PLAIN, wi, wo, Transport::Radiance).density)
    })
}
