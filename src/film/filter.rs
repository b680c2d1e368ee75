//! Reconstruction filters, sampled: each sample of a pixel is taken at an offset drawn from the filter's density, and
//! counts in full (filter importance sampling, Ernst et al. 2006). No sample has a weight then, none is shared between
//! pixels, and their mean has an ordinary standard error.
//!
//! A filter is the product of one density in x and the same in y.

mod gaussian;
mod tent;

use crate::scene::FilterDescription;
use gaussian::TruncatedGaussian;

/// Why a description is no filter.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum FilterError {
    /// The radius is not a length.
    #[error("a filter's radius is {0} pixels")]
    #[diagnostic(help("give it a radius from 0.001 to 1000 pixels; 0.5 is the pixel itself"))]
    Radius(f32),
    /// The standard deviation is not one that is told from zero, or from a box.
    #[error("a Gaussian filter's sigma is {sigma} pixels, with a radius of {radius}")]
    #[diagnostic(help("give it a sigma between 0.03 and 100 times the radius; a third of it is common"))]
    Sigma {
        /// The standard deviation asked for.
        sigma: f32,
        /// The radius beside it.
        radius: f32,
    },
}

/// The least and the largest standard deviation of a Gaussian filter, in radii: below, it is hardly told from zero, and
/// above from a box.
pub const SIGMA_PER_RADIUS: [f32; 2] = [0.03, 100.0];

/// A filter, ready to be sampled.
#[derive(Clone, Debug)]
pub struct Filter(Kind);

#[derive(Clone, Debug)]
enum Kind {
    Box { radius: f32 },
    Tent { radius: f32 },
    Gaussian(Box<TruncatedGaussian>),
}

impl Filter {
    /// The filter of a description.
    ///
    /// # Errors
    /// Where a length is out of range or not a number.
    pub fn new(description: &FilterDescription) -> Result<Self, FilterError> {
        let (FilterDescription::Box { radius }
        | FilterDescription::Tent { radius }
        | FilterDescription::Gaussian { radius, .. }) = *description;
        if !(1e-3..=1e3).contains(&radius) {
            return Err(FilterError::Radius(radius));
        }
        Ok(Self(match *description {
            FilterDescription::Box { .. } => Kind::Box { radius },
            FilterDescription::Tent { .. } => Kind::Tent { radius },
            FilterDescription::Gaussian { sigma, .. } => {
                let [least, most] = SIGMA_PER_RADIUS;
                if !(least..=most).contains(&(sigma / radius)) {
                    return Err(FilterError::Sigma { sigma, radius });
                }
                Kind::Gaussian(Box::new(TruncatedGaussian::new(f64::from(radius), f64::from(sigma))))
            }
        }))
    }

    /// The farthest an offset reaches in x or y, in pixels.
    #[must_use]
    pub fn radius(&self) -> f32 {
        match &self.0 {
            Kind::Box { radius } | Kind::Tent { radius } => *radius,
            Kind::Gaussian(g) => g.radius() as f32,
        }
    }

    /// The offset from the pixel's centre, in pixels, for two uniform numbers in [0, 1): distributed as
    /// [`Filter::density`], each coordinate increasing in its number and within ± the radius.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> [f32; 2] {
        match &self.0 {
            Kind::Box { radius } => u.map(|u| (2.0 * u - 1.0) * radius),
            Kind::Tent { radius } => u.map(|u| tent::sample(u) * radius),
            Kind::Gaussian(g) => u.map(|u| g.sample(u)),
        }
    }

    /// The density of an offset, per square pixel: integrates to one.
    #[must_use]
    pub fn density(&self, offset: [f32; 2]) -> f32 {
        self.density_1d(offset[0]) * self.density_1d(offset[1])
    }

    fn density_1d(&self, x: f32) -> f32 {
        match &self.0 {
            Kind::Box { radius } => {
                if x.abs() <= *radius {
                    0.5 / radius
                } else {
                    0.0
                }
            }
            Kind::Tent { radius } => tent::density(x / radius) / radius,
            Kind::Gaussian(g) => g.density(f64::from(x)) as f32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::chi_square::{ChiSquare, chi_square};
    use crate::stats::normal::sidak;

    /// A false alarm in a thousand over all filters together.
    const ALPHA: f64 = 1e-3;
    const SAMPLES: usize = 1_000_000;
    const SIDE: usize = 20;

    fn filters() -> Vec<FilterDescription> {
        vec![
            FilterDescription::Box { radius: 0.5 },
            FilterDescription::Box { radius: 1.7 },
            FilterDescription::Tent { radius: 1.0 },
            FilterDescription::Tent { radius: 0.3 },
            FilterDescription::Gaussian {
                radius: 1.5,
                sigma: 0.5,
            },
            FilterDescription::Gaussian {
                radius: 2.0,
                sigma: 0.3,
            },
            FilterDescription::Gaussian {
                radius: 1.0,
                sigma: 3.0,
            },
        ]
    }

    fn filter(description: &FilterDescription) -> Filter {
        Filter::new(description).expect("a valid description")
    }

    /// The density integrated over each cell of a grid over the filter's square, by 6 x 6 midpoint-corrected (Simpson)
    /// nodes a side.
    fn probabilities(filter: &Filter) -> Vec<f64> {
        const NODES: usize = 12;
        let step = 2.0 * f64::from(filter.radius()) / (SIDE * NODES) as f64;
        let at =
            |i: usize| ((i as f64 * step - f64::from(filter.radius())) as f32).clamp(-filter.radius(), filter.radius());
        let weight = |i: usize| match i {
            0 | NODES => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let cell = |cell: usize| {
            let (column, row) = (cell % SIDE * NODES, cell / SIDE * NODES);
            let nodes = (0..=NODES).flat_map(|j| (0..=NODES).map(move |i| (i, j)));
            let value = |(i, j)| weight(i) * weight(j) * f64::from(filter.density([at(column + i), at(row + j)]));
            nodes.map(value).sum::<f64>() * (step / 3.0) * (step / 3.0)
        };
        (0..SIDE * SIDE).map(cell).collect()
    }

    /// Samples of the filter, its numbers passed through `bent` first, against its density.
    fn test(filter: &Filter, bent: impl Fn(f32) -> f32) -> ChiSquare {
        let mut state = 0x853c_49e6_748f_ea9b_u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / 16_777_216.0
        };
        let mut counts = vec![0_u64; SIDE * SIDE];
        let cell = |x: f32| {
            let place = (f64::from(x) / f64::from(filter.radius()) + 1.0) * 0.5 * SIDE as f64;
            (place as usize).min(SIDE - 1)
        };
        for _ in 0..SAMPLES {
            let [x, y] = filter.sample([bent(uniform()), bent(uniform())]);
            counts[cell(y) * SIDE + cell(x)] += 1;
        }
        chi_square(&counts, &probabilities(filter))
    }

    #[test]
    fn densities_integrate_to_one() {
        for description in filters() {
            let total: f64 = probabilities(&filter(&description)).iter().sum();
            assert!((total - 1.0).abs() < 1e-5, "{description:?}: {total}");
        }
    }

    #[test]
    fn samples_follow_the_density() {
        let filters = filters();
        let alpha = sidak(ALPHA, filters.len());
        for description in filters {
            let result = test(&filter(&description), |u| u);
            // What it would have seen: cells off by this much in the root mean square, 19 times in 20.
            let visible = result.smallest_visible_deviation(alpha, 0.95);
            assert!(
                result.p > alpha && visible < 0.016,
                "{description:?}: {result:?}, sees {visible}"
            );
        }
    }

    /// The numbers are bent by 3 %, which moves the cells by 2.4 % in the root mean square.
    #[test]
    fn samples_bent_by_three_percent_do_not() {
        let filters = filters();
        let alpha = sidak(ALPHA, filters.len());
        for description in filters {
            let result = test(&filter(&description), |u| u + 0.03 * u * (1.0 - u));
            assert!(result.p < alpha, "{description:?}: {result:?}");
        }
    }

    #[test]
    fn samples_increase_with_their_number_and_stay_within_the_radius() {
        const STEPS: u32 = 1 << 24;
        for description in filters().into_iter().chain([FilterDescription::Gaussian {
            radius: 3.0,
            sigma: 0.1,
        }]) {
            let filter = filter(&description);
            let x = |i: u32| filter.sample([i as f32 / STEPS as f32, 0.5])[0];
            // Dense around the joints of any table of up to 512 pieces, and at both ends.
            let dense = (0..=512_u32).flat_map(|k| {
                let joint = k * (STEPS / 512);
                joint.saturating_sub(40)..(joint + 40).min(STEPS)
            });
            let mut last = f32::NEG_INFINITY;
            for i in dense.clone() {
                assert!(
                    x(i) >= last && x(i).abs() <= filter.radius(),
                    "{description:?} at {i}: {last} then {}",
                    x(i)
                );
                last = x(i);
            }
            assert_eq!(x(0), -filter.radius());
            assert!(x(STEPS / 2).abs() < 1e-6 * filter.radius());
        }
    }

    #[test]
    fn nonsense_is_refused() {
        for radius in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(matches!(
                Filter::new(&FilterDescription::Box { radius }),
                Err(FilterError::Radius(_))
            ));
        }
        for sigma in [0.0, -1.0, f32::NAN, 1e9] {
            assert!(matches!(
                Filter::new(&FilterDescription::Gaussian { radius: 1.0, sigma }),
                Err(FilterError::Sigma { .. })
            ));
        }
    }

    #[test]
    fn descriptions_read_as_written() {
        let read: FilterDescription = ron::from_str("Gaussian(radius: 1.5, sigma: 0.5)").expect("valid");
        assert_eq!(
            read,
            FilterDescription::Gaussian {
                radius: 1.5,
                sigma: 0.5
            }
        );
        assert!(ron::from_str::<FilterDescription>("Tent(radius: 1.0, sigma: 0.5)").is_err());
    }
}
