//! When a render that aims at an error stops.
//!
//! It looks at its error at doubling checkpoints only, and stops on the upper bound. Looking at every step and stopping
//! on the estimate would stop where the estimate happens to be low, which is where it is wrong; with doubling steps the
//! few looks that could stop too early are far from the target, so the bound's confidence survives looking.

use super::error::PictureError;

/// The numbers of steps after which the error is looked at: first, 2 first, 4 first, and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checkpoints {
    first_step: u64,
}

impl Checkpoints {
    /// Checkpoints from `first_step` on; zero counts as one.
    #[must_use]
    pub const fn new(first_step: u64) -> Self {
        Self {
            first_step: if first_step == 0 { 1 } else { first_step },
        }
    }

    /// The first checkpoint after `after_steps` steps. `u64::MAX` where doubling ends.
    #[must_use]
    pub const fn next(&self, after_steps: u64) -> u64 {
        // floor(log2(steps / first)) + 1 doublings, without a loop.
        match (after_steps / self.first_step).checked_ilog2() {
            None => self.first_step,
            Some(doublings) => {
                let factor = 1_u64.checked_shl(doublings + 1);
                match factor {
                    Some(factor) => self.first_step.saturating_mul(factor),
                    None => u64::MAX,
                }
            }
        }
    }
}

/// Whether to stop: the error's upper bound, not its estimate, is at most `target`, in the same units (as a rule both
/// are fractions of the mean, see [`PictureError::relative_to`]). Never for a target that is not a number.
#[must_use]
pub fn decide(error: &PictureError, target: f64) -> bool {
    error.upper <= target
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::group_means::GroupMeans;
    use crate::stats::synthetic::Source;

    #[test]
    fn checkpoints_double() {
        let checkpoints = Checkpoints::new(3);
        let mut steps = 0;
        let seen: Vec<u64> = (0..5)
            .map(|_| {
                steps = checkpoints.next(steps);
                steps
            })
            .collect();
        assert_eq!(seen, [3, 6, 12, 24, 48]);
        assert_eq!(
            (checkpoints.next(2), checkpoints.next(5), checkpoints.next(47)),
            (3, 6, 48)
        );
        assert_eq!(Checkpoints::new(0).next(0), 1);
        assert_eq!(Checkpoints::new(1).next(u64::MAX), u64::MAX);
        assert_eq!(Checkpoints::new(3).next(u64::MAX - 1), u64::MAX);
        assert_eq!(Checkpoints::new(1).next((1 << 63) - 1), 1 << 63);
    }

    #[test]
    fn the_upper_bound_decides() {
        let error = PictureError::of_independent(&[0.01; 4]);
        assert!(error.rms < 0.11 && !decide(&error, 0.11));
        assert!(decide(&error, error.upper) && !decide(&error, f64::NAN));
        assert!(!decide(
            &PictureError {
                upper: f64::NAN,
                ..error
            },
            0.11
        ));
    }

    const GROUPS: usize = 16;
    const STATISTICS: usize = 3;
    /// Errors to reach, as fractions of the mean, which is one: over an octave of steps, as doubling has a different
    /// distance to the checkpoint that suffices for each.
    const TARGETS: [f64; 4] = [0.05, 0.055, 0.06, 0.065];

    /// A picture of true values one, from groups whose every step is correlated with the one before.
    struct Render {
        source: Source,
        correlation: f64,
        steps: u64,
        states: Vec<f64>,
        sums: Vec<f64>,
    }

    impl Render {
        fn new(seed: u64, correlation: f64) -> Self {
            let mut source = Source::new(seed);
            let states = (0..GROUPS * STATISTICS).map(|_| source.normal()).collect();
            Self {
                source,
                correlation,
                steps: 0,
                states,
                sums: vec![0.0; GROUPS * STATISTICS],
            }
        }

        fn advance(&mut self, steps: u64) {
            let innovation = (1.0 - self.correlation * self.correlation).sqrt();
            while self.steps < steps {
                self.steps += 1;
                for (state, sum) in self.states.iter_mut().zip(&mut self.sums) {
                    *state = self.correlation * *state + innovation * self.source.normal();
                    *sum += 1.0 + 0.5 * *state;
                }
            }
        }

        fn means(&self) -> GroupMeans {
            let values = self.sums.iter().map(|sum| sum / self.steps as f64).collect();
            GroupMeans::new(GROUPS, STATISTICS, values).expect("a table")
        }

        fn stated(&self) -> PictureError {
            let means = self.means();
            let error = PictureError::of(&means).expect("groups");
            error.relative_to(means.grand_mean()).expect("a mean")
        }

        fn is_within(&self, target: f64) -> bool {
            let squares: f64 = self
                .means()
                .estimates()
                .iter()
                .map(|e| (e.mean - 1.0) * (e.mean - 1.0))
                .sum();
            (squares / STATISTICS as f64).sqrt() <= target
        }
    }

    /// The share of `renders` renders that are within the target when they stop, for every target.
    fn shares_within_target(renders: u64, correlation: f64, stop: fn(&mut Render, f64)) -> [f64; 4] {
        TARGETS.map(|target| {
            let within = (0..renders).filter(|&seed| {
                let mut render = Render::new(seed, correlation);
                stop(&mut render, target);
                render.is_within(target)
            });
            within.count() as f64 / renders as f64
        })
    }

    fn stop_on_the_bound(render: &mut Render, target: f64) {
        let checkpoints = Checkpoints::new(4);
        loop {
            render.advance(checkpoints.next(render.steps));
            if decide(&render.stated(), target) {
                return;
            }
        }
    }

    fn stop_on_the_estimate_at_every_step(render: &mut Render, target: f64) {
        render.advance(4);
        while render.stated().rms > target {
            render.advance(render.steps + 1);
        }
    }

    /// Over 1000 renders a share near 0.95 has a standard error of 0.007: a true share below 0.88 would be seen.
    #[test]
    fn renders_that_stop_on_the_bound_are_within_the_target() {
        for correlation in [0.0, 0.6] {
            let shares = shares_within_target(1000, correlation, stop_on_the_bound);
            assert!(shares.iter().all(|&share| share >= 0.9), "{correlation}: {shares:?}");
        }
    }

    /// The planted mistake: of the renders that stop on the estimate, two in five are not where they say.
    #[test]
    fn renders_that_stop_on_the_estimate_are_not() {
        for correlation in [0.0, 0.6] {
            let shares = shares_within_target(200, correlation, stop_on_the_estimate_at_every_step);
            assert!(shares.iter().all(|&share| share < 0.75), "{correlation}: {shares:?}");
        }
    }
}
