//! Reconstruction filters, sampled: each sample of a pixel is taken at an offset drawn from the filter's density, and
//! counts in full (filter importance sampling, Ernst et al. 2006). No sample has a weight then, none is shared between
//! pixels, and their mean has an ordinary standard error.
//!
//! A filter is the product of one density in x and the same in y.

mod gaussian;
mod tent;

use gaussian::TruncatedGaussian;
use serde::{Deserialize, Serialize};

/// A filter as a scene describes it. Lengths are in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum FilterDescription {
    /// Constant over a square.
    Box {
        /// Half the square's side. 0.5 is the pixel itself.
        radius: f32,
    },
    /// Falls linearly to zero.
    Tent {
        /// Where it reaches zero.
        radius: f32,
    },
    /// A normal density, cut off at the radius.
    Gaussian {
        /// Where it is cut off.
        radius: f32,
        /// Its standard deviation before the cut.
        sigma: f32,
    },
}

impl Default for FilterDescription {
    /// The pixel's own square.
    fn default() -> Self {
        Self::Box { radius: 0.5 }
    }
}

/// Why a description is no filter.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum FilterError {
    /// The radius is not a length.
    #[error("a filter's radius is {0} pixels")]
    #[diagnostic(help("give it a radius from 0.001 to 1000 pixels; 0.5 is the pixel itself"))]
    Radius(f32),
    /// The standard deviation is not one that is told from zero, or from a box.
    #[error("a Gaussian filter's sigma is {sigma} pixels, with a radius of {radius}")]
    #[diagnostic(help("give it a sigma between a hundredth and a hundred times the radius; a third of it is common"))]
    Sigma {
        /// The standard deviation asked for.
        sigma: f32,
        /// The radius beside it.
        radius: f32,
    },
}

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
    pub fn new(description: FilterDescription) -> Result<Self, FilterError> {
        let (FilterDescription::Box { radius }
        | FilterDescription::Tent { radius }
        | FilterDescription::Gaussian { radius, .. }) = description;
        if !(1e-3..=1e3).contains(&radius) {
            return Err(FilterError::Radius(radius));
        }
        Ok(Self(match description {
            FilterDescription::Box { .. } => Kind::Box { radius },
            FilterDescription::Tent { .. } => Kind::Tent { radius },
            FilterDescription::Gaussian { sigma, .. } => {
                if !(0.01..=100.0).contains(&(sigma / radius)) {
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
