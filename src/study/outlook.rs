//! All that a pilot lets foresee of a way to render: three kinds of errors, each with its forecast.
//!
//! What they have in common is told by the one that a few bright samples do not rule, the error without its worst pixels. How far they
//! rule the others, t = ln (error / error without them), says how little those are worth: half of a tail that a pilot happened on is
//! believed in, and by as much predictions are less sure. These constants and those of [`Forecast`] are from pilots and studies of five
//! shipped scenes (`examples/predictions.rs`).

use super::pilot::Pilot;
use super::pooled::Pooled;
use super::prediction::Forecast;

/// The share of a tail's logarithm that is believed in.
const TAIL_BELIEVED: f64 = 0.5;
/// How unsure predictions are for each unit of it, as the standard deviation of their logarithms.
const TAIL_SPREAD: f64 = 0.5;
/// How unsure those of relMSE are without any, beside what all are.
const REL_MSE_SPREAD: f64 = 0.15;
/// The same of errors over blocks: some hundred statistics, where pictures have thousands of pixels.
const BLOCKS_SPREAD: f64 = 0.3;

/// A kind of error that is foreseen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreseen {
    /// Relative mean squared error without the worst 0.1 % of pixels.
    Trimmed,
    /// Relative mean squared error.
    RelMse,
    /// The bound of the relative error over block means, below which `--target-error` stops.
    Blocks,
}

impl Foreseen {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Trimmed, Self::RelMse, Self::Blocks];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Trimmed => "relMSE without the worst 0.1 %",
            Self::RelMse => "relMSE",
            Self::Blocks => "--target-error",
        }
    }

    /// The squared error that `error`, as people give it, stands for: relMSE is squared already.
    #[must_use]
    pub fn squared(self, error: f64) -> f64 {
        match self {
            Self::Trimmed | Self::RelMse => error,
            Self::Blocks => error * error,
        }
    }
}

/// What looks at a pilot say: pairs of seconds of steps and squared errors, the earliest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outlook {
    /// Seconds before the first step.
    pub start_seconds: f64,
    /// relMSE without the worst 0.1 % of pixels.
    pub trimmed: Vec<[f64; 2]>,
    /// relMSE.
    pub rel_mse: Vec<[f64; 2]>,
    /// Squares of bounds of the error over block means.
    pub blocks: Vec<[f64; 2]>,
}

impl Outlook {
    /// What a pilot says, with errors relative to `pooled`.
    #[must_use]
    pub fn of(pilot: &Pilot, pooled: &Pooled) -> Self {
        let mut outlook = Self {
            start_seconds: pilot.start_seconds,
            ..Self::default()
        };
        for look in &pilot.looks {
            if let Some(expected) = pooled.expected(&look.error) {
                outlook.trimmed.push([look.seconds, expected.rel_mse_trimmed]);
                outlook.rel_mse.push([look.seconds, expected.rel_mse]);
            }
            if let Some(blocks) = look.blocks {
                outlook.blocks.push([look.seconds, blocks.upper * blocks.upper]);
            }
        }
        outlook
    }

    /// The looks that tell of an error.
    #[must_use]
    pub fn looks(&self, foreseen: Foreseen) -> &[[f64; 2]] {
        match foreseen {
            Foreseen::Trimmed => &self.trimmed,
            Foreseen::RelMse => &self.rel_mse,
            Foreseen::Blocks => &self.blocks,
        }
    }

    /// How an error will fall. `None` where nothing can be told: no light was found, or too little to know its error.
    #[must_use]
    pub fn forecast(&self, foreseen: Foreseen) -> Option<Forecast> {
        let of = |foreseen| Forecast::of(self.start_seconds, self.looks(foreseen));
        let (trimmed, all) = (of(Foreseen::Trimmed)?, of(Foreseen::RelMse)?);
        let tail = libm::log(all.squared_error / trimmed.squared_error).max(0.0);
        let spread = TAIL_SPREAD * tail;
        Some(match foreseen {
            Foreseen::Trimmed => trimmed,
            Foreseen::RelMse => Forecast {
                squared_error: trimmed.squared_error * libm::exp(TAIL_BELIEVED * tail),
                ..trimmed
            }
            .less_sure(spread)
            .less_sure(REL_MSE_SPREAD),
            Foreseen::Blocks => of(Foreseen::Blocks)?.less_sure(spread).less_sure(BLOCKS_SPREAD),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn falling(work: f64) -> Vec<[f64; 2]> {
        [0.25, 0.5, 1.0, 2.0].map(|s| [s, work / s]).into()
    }

    #[test]
    fn a_tail_is_half_believed_in_and_makes_everything_less_sure_but_the_error_without_it() {
        let outlook = |factor: f64| Outlook {
            start_seconds: 1.0,
            trimmed: falling(0.1),
            rel_mse: falling(0.1 * factor),
            blocks: falling(0.02),
        };
        let at = |outlook: &Outlook, foreseen| {
            let forecast = outlook.forecast(foreseen).expect("all is told");
            forecast.squared_error_after(3.0)
        };
        let (plain, heavy) = (outlook(1.0), outlook(100.0));
        let ratio = |foreseen| libm::exp(at(&heavy, foreseen).ln - at(&plain, foreseen).ln);
        assert_eq!(at(&heavy, Foreseen::Trimmed), at(&plain, Foreseen::Trimmed));
        assert!((ratio(Foreseen::RelMse) - 10.0).abs() < 1e-9);
        assert!((ratio(Foreseen::Blocks) - 1.0).abs() < 1e-12);
        for foreseen in [Foreseen::RelMse, Foreseen::Blocks] {
            assert!(at(&heavy, foreseen).spread > 2.0 * at(&plain, foreseen).spread);
            assert!(at(&plain, foreseen).spread > at(&plain, Foreseen::Trimmed).spread);
        }
    }

    #[test]
    fn of_a_pilot_that_found_nothing_nothing_is_told() {
        let black = Outlook {
            start_seconds: 0.1,
            trimmed: vec![[1.0, 0.0]],
            rel_mse: vec![[1.0, 0.0]],
            blocks: Vec::new(),
        };
        assert!(Foreseen::ALL.iter().all(|&foreseen| black.forecast(foreseen).is_none()));
        assert!(Outlook::default().forecast(Foreseen::Trimmed).is_none());
    }
}
