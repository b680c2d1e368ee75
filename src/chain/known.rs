//! Draws over all that a [`Kernel`] can lead to, with a density that is known without the kernel's user: what transition
//! densities are tested against.
//!
//! A mutation that says its density is T is tested by the weights r = q/T of its proposals, where q is the density of these
//! draws. Were they uniform over the support V, each coordinate would multiply r by w = 1/(V k), where k is the kernel's
//! density; E[w²] is 2.1 for steps from 1/1024 to 1/16, and over twenty coordinates the few largest weights would be all
//! there is of any sum. So a coordinate is uniform over the support with a probability p only, and a small step otherwise:
//! its factor is 1 + p (w − 1), and as p falls with depth as 1/(1 + d), r has a fourth moment of at most
//! [`KnownDraws::FOURTH_MOMENT`] whatever the number of coordinates. A factor by which T is wrong shows whole; what is wrong
//! with the shape of one coordinate's density shows with p, far above the noise that it would have with p = 1.

use super::Kernel;

/// The factors of r that bounds are for, as many as any state has: two of the film, and seven at every depth of two subpaths,
/// where Σ 1/(1 + d)² = π²/6 and higher powers add up to less.
const FACTORS: f64 = 2.0 + 2.0 * 7.0 * std::f64::consts::PI * std::f64::consts::PI / 6.0;

/// Draws about a coordinate: uniform over the support of a kernel with a probability, and by the kernel otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownDraws {
    kernel: Kernel,
    /// The probability of a uniform draw, in units of 2⁻³².
    share: u32,
}

impl KnownDraws {
    /// What E[r⁴] is at most over the small steps from any state, where every coordinate at depth d is drawn by
    /// [`at`](Self::at) d.
    pub const FOURTH_MOMENT: f64 = 16.0;

    /// Draws about where `kernel` leads, with the share of uniform ones that coordinates at depth 0 have.
    ///
    /// Of x = p (w − 1), E[x] = 0 and |w − 1| ≤ W, the largest w. Where p W ≤ 1/2,
    /// E[(1 + x)⁴] ≤ 1 + (6 + 4/2 + 1/4) E[x²], so ln E[r⁴] ≤ 8.25 p² Var(w) times the sum over coordinates of 1/(1 + d)².
    #[must_use]
    pub fn about(kernel: Kernel) -> Self {
        let [largest, square] = kernel.weights_of_uniform();
        let variance = (square - 1.0).max(f64::MIN_POSITIVE);
        let bound = libm::sqrt(libm::log(Self::FOURTH_MOMENT) / (8.25 * FACTORS * variance));
        Self {
            kernel,
            share: (bound.min(0.5 / largest) * 4_294_967_296.0) as u32,
        }
    }

    /// The draws of coordinates at `depth`.
    #[must_use]
    pub const fn at(self, depth: u32) -> Self {
        Self {
            share: (self.share as u64 / (1 + depth as u64)) as u32,
            ..self
        }
    }

    /// The probability that a draw is uniform over the support.
    #[must_use]
    pub fn share(&self) -> f64 {
        f64::from(self.share) / 4_294_967_296.0
    }

    /// A draw about `c` by 64 random bits: half of them say how it is drawn.
    #[must_use]
    pub fn draw(&self, c: u32, [how, random]: [u32; 2]) -> u32 {
        if how < self.share {
            self.kernel.uniform_in_support(c, random)
        } else {
            self.kernel.perturb(c, random)
        }
    }

    /// As [`draw`](Self::draw), of a wide coordinate.
    #[must_use]
    pub fn draw_wide(&self, c: u64, [how, random]: [u32; 2]) -> u64 {
        if how < self.share {
            self.kernel.uniform_in_support_wide(c, random)
        } else {
            self.kernel.perturb_wide(c, random)
        }
    }

    /// ln of the density, per unit of the coordinate, of drawing `to` about `from`; −∞ where no step leads.
    #[must_use]
    pub fn log_density(&self, from: u32, to: u32) -> f64 {
        self.log_mixed(self.kernel.log_density(from, to))
    }

    /// As [`log_density`](Self::log_density), of wide coordinates.
    #[must_use]
    pub fn log_density_wide(&self, from: u64, to: u64) -> f64 {
        self.log_mixed(self.kernel.log_density_wide(from, to))
    }

    fn log_mixed(&self, of_step: f64) -> f64 {
        if of_step == f64::NEG_INFINITY {
            return of_step;
        }
        let share = self.share();
        libm::log(share / self.kernel.support_length() + (1.0 - share) * libm::exp(of_step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::{KernelError, LEAST_STEP};
    use crate::sampling::{Purpose, StreamKey};

    /// Kernels of all widths: shares of uniform draws fall as they get wider, and E[r⁴] over many coordinates, from its
    /// integral over the sizes of steps, stays below its bound.
    #[test]
    fn fourth_moments_are_bounded_whatever_the_number_of_coordinates() -> Result<(), KernelError> {
        let mut last = 1.0;
        for (smallest, largest) in [
            (0.25, 0.250_001),
            (1.0 / 64.0, 1.0 / 32.0),
            (1.0 / 1024.0, 1.0 / 16.0),
            (LEAST_STEP, 0.5),
        ] {
            let known = KnownDraws::about(Kernel::new(smallest, largest)?);
            assert!(known.share() > 0.0 && known.share() <= last, "{known:?}");
            last = known.share();
            let log_ratio = libm::log(f64::from(largest) / f64::from(smallest));
            let fourth = |share: f64| {
                let steps = 4000;
                let sum: f64 = (0..steps)
                    .map(|step| {
                        let v = (f64::from(step) + 0.5) / f64::from(steps);
                        let size = f64::from(largest) * libm::exp(-log_ratio * v);
                        let weight = size * log_ratio / f64::from(largest - smallest);
                        libm::pow(1.0 + share * (weight - 1.0), 4.0)
                    })
                    .sum();
                libm::log(sum / f64::from(steps))
            };
            let deep: f64 = (0..100).map(|depth| fourth(known.at(depth).share())).sum();
            let moment = libm::exp(2.0 * fourth(known.share()) + 14.0 * deep);
            assert!(moment <= KnownDraws::FOURTH_MOMENT, "{moment} of {known:?}");
        }
        Ok(())
    }

    /// Σ q/k over small steps is their number, and Σ k/q over draws is theirs, to five standard errors of at most 2⁻⁹ each.
    #[test]
    fn draws_have_the_density_that_is_said() -> Result<(), KernelError> {
        let kernel = Kernel::new(1.0 / 64.0, 1.0 / 16.0)?;
        let known = KnownDraws { kernel, share: 1 << 31 };
        let mut stream = StreamKey::new(3, 0, 0).stream(Purpose::FILM, 0);
        let count = 1 << 18;
        let mut means = [0.0; 4];
        for _ in 0..count {
            let (c, random) = (stream.next_u32(), [stream.next_u32(), stream.next_u32()]);
            let wide = u64::from(c) << 32;
            let ratio = |to: u32| libm::exp(known.log_density(c, to) - kernel.log_density(c, to));
            let ratio_wide = |to: u64| libm::exp(known.log_density_wide(wide, to) - kernel.log_density_wide(wide, to));
            means[0] += ratio(kernel.perturb(c, random[1]));
            means[1] += 1.0 / ratio(known.draw(c, random));
            means[2] += ratio_wide(kernel.perturb_wide(wide, random[1]));
            means[3] += 1.0 / ratio_wide(known.draw_wide(wide, random));
        }
        for mean in means {
            assert!((mean / f64::from(count) - 1.0).abs() < 5.0 / 512.0, "{means:?}");
        }
        assert_eq!(known.log_density(7, 7), f64::NEG_INFINITY);
        Ok(())
    }
}
