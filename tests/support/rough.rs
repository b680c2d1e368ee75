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
/// The largest uniform number.
const LAST: f32 = 1.0 - 0.5 * f32::EPSILON;
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

/// Where a density is looked up in every cell.
#[derive(Clone, Copy, Debug)]
pub enum Points {
    /// At 40 x 40 midpoints: exact for lobes inside a cell, since they are smooth.
    Rows,
    /// At points that fill the cell evenly without rows (Roberts 2018: multiples of powers of the root p of p³ = p + 1): edges
    /// of lobes that run along the cell would be missed a row at a time.
    Spread,
}

impl Points {
    fn list(self) -> Vec<[f64; 2]> {
        const SIDE: u32 = 40;
        const SPREAD: u32 = 2400;
        const P: f64 = 1.324_717_957_244_746;
        match self {
            Self::Rows => (0..SIDE * SIDE)
                .map(|k| [k % SIDE, k / SIDE].map(|i| (f64::from(i) + 0.5) / f64::from(SIDE)))
                .collect(),
            Self::Spread => (0..SPREAD)
                .map(|k| [P, P * P].map(|power| ((f64::from(k) + 0.5) / power).fract()))
                .collect(),
        }
    }
}

/// What the counts should be in proportion to: `density` per unit of the grid's coordinates, a discrete lobe, and the rest.
pub fn expected(grid: &Grid, points: Points, discrete: f64, density: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let points = points.list();
    let (dx, dy) = (
        (grid.x[1] - grid.x[0]) / grid.columns as f64,
        (grid.y[1] - grid.y[0]) / grid.rows as f64,
    );
    let cell = |i: usize| {
        let (x, y) = (
            grid.x[0] + dx * (i % grid.columns) as f64,
            grid.y[0] + dy * (i / grid.columns) as f64,
        );
        let sum: f64 = points.iter().map(|[u, v]| density(x + dx * u, y + dy * v)).sum();
        sum * dx * dy / points.len() as f64
    };
    let mut cells: Vec<f64> = (0..grid.len()).map(cell).collect();
    let absorbed = 1.0 - discrete - cells.iter().sum::<f64>();
    assert!(absorbed > -1e-3, "densities integrate to {}", 1.0 - absorbed);
    cells.extend([discrete, absorbed]);
    // A corner of the support may lie between points.
    cells.into_iter().map(|share| share.max(LEAST_SHARE)).collect()
}

/// How heights z over the sphere are cut into cells.
#[derive(Clone, Copy, Debug)]
pub enum Heights {
    /// Evenly.
    Even,
    /// By t with |z| = 1 − t², which widens lobes about the poles: what refracts is as narrow as the index makes it.
    WidePoles,
}

impl Heights {
    /// The whole sphere in 20 x 20 cells of the height, or what stands for it, and of the angle around.
    pub fn sphere(self) -> Grid {
        Grid::around([-1.0, 1.0])
    }

    fn place(self, wo: Vec3) -> [f64; 2] {
        let [z, phi] = height_and_angle(wo);
        match self {
            Self::Even => [z, phi],
            Self::WidePoles => {
                let from_pole = one_minus_cos(wo.as_dvec3().with_z(z.abs()));
                [from_pole.clamp(0.0, 1.0).sqrt().copysign(z), phi]
            }
        }
    }

    /// Counts over the sphere of directions.
    pub fn counts(self, model: &impl Model, wi: Vec3, draws: impl Iterator<Item = ScatterDraw>) -> Vec<u64> {
        counts(&self.sphere(), model, wi, draws, |sample| self.place(sample.wo))
    }

    /// The density that a model states, over the sphere of directions.
    pub fn expected(self, model: &impl Model, wi: Vec3, discrete: f64) -> Vec<f64> {
        let points = match self {
            Self::Even => Points::Rows,
            Self::WidePoles => Points::Spread,
        };
        expected(&self.sphere(), points, discrete, |t, phi| {
            let (z, stretch) = match self {
                Self::Even => (t, 1.0),
                Self::WidePoles => ((1.0 - t * t).copysign(t), 2.0 * t.abs()),
            };
            let wo = direction(z, phi).as_vec3();
            stretch * f64::from(model.evaluate(&PLAIN, wi, wo, Transport::Radiance).density)
        })
    }
}

/// The mean ratio, split into reflection and transmission, over a grid of draws that is exact to about a ten-thousandth: it is
/// denser towards the ends of the numbers that choose directions, where lobes have their tails, and the lobe number's
/// share of each lobe is found by bisection.
pub fn albedo(model: &impl Model, wi: Vec3, transport: Transport) -> [Rgb; 2] {
    const SIDE: u32 = 64;
    let (mut sums, mut weights) = ([[0.0_f64; 3]; 2], 0.0);
    for cell in 0..SIDE * SIDE {
        let place = [cell % SIDE, cell / SIDE].map(|k| (f64::from(k) + 0.5) / f64::from(SIDE));
        let direction = place.map(|t| (t * t * (3.0 - 2.0 * t)) as f32);
        let weight: f64 = place.map(|t| 6.0 * t * (1.0 - t)).into_iter().product();
        weights += weight;
        let sample = |lobe: f32| model.sample(&PLAIN, wi, ScatterDraw { direction, lobe }, transport);
        let lobe = |sample: &Option<Scattered>| sample.map(|sample| (sample.discrete, sample.wo.z * wi.z > 0.0));
        let (first, last) = (sample(0.0), sample(LAST));
        let share = if lobe(&first) == lobe(&last) {
            1.0
        } else {
            let (mut low, mut high) = (0.0_f32, 1.0_f32);
            for _ in 0..22 {
                let middle = 0.5 * (low + high);
                if lobe(&sample(middle)) == lobe(&first) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            f64::from(high)
        };
        for (sample, share) in [(first, share), (last, 1.0 - share)] {
            let Some(sample) = sample else { continue };
            assert!(
                sample.ratio.is_finite() && sample.density.is_finite(),
                "{model:?} {wi}: {sample:?}"
            );
            let side = usize::from(sample.wo.z * wi.z < 0.0);
            let ratio = sample.ratio.to_array();
            (0..3).for_each(|c| sums[side][c] += weight * share * f64::from(ratio[c]));
        }
    }
    sums.map(|sum| Rgb::from(sum.map(|s| (s / weights) as f32)))
}
