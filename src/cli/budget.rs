//! `--spp`, `--time`, `--target-error` and `--threads`: how long to render, and on how many threads.

use crate::plan::{Effect, Plan};
use crate::render::{Budget, Goal};
use clap::Args;
use miette::{Result, miette};
use std::time::Duration;

/// How long to render.
#[derive(Args, Clone, Copy, Debug)]
pub struct BudgetArgs {
    /// Samples per pixel; for techniques with chains, mutations per pixel [default: 96]
    #[arg(long, value_name = "N", conflicts_with = "time", value_parser = parse_spp)]
    spp: Option<f64>,
    /// Seconds to render; the number of samples reached is recorded, and with it --spp gives the same bytes
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    time: Option<Duration>,
}

impl BudgetArgs {
    /// The samples per pixel that were asked for.
    #[must_use]
    pub const fn samples(self) -> Option<f64> {
        self.spp
    }

    /// The time that was asked for.
    #[must_use]
    pub const fn time(self) -> Option<Duration> {
        self.time
    }

    /// What is left of it when `spent` is spent.
    #[must_use]
    pub fn after(self, spent: Duration) -> Self {
        Self {
            time: self.time.map(|time| time.saturating_sub(spent)),
            ..self
        }
    }

    /// Refuses a number of samples that a render which goes on has passed already.
    ///
    /// # Errors
    /// Fewer samples, by [`of`](Self::of) a budget of `budget`, than the `taken` steps.
    pub fn check_resumed(self, budget: Budget, taken: u64) -> Result<()> {
        match (self.spp, budget) {
            (Some(spp), Budget::Steps(steps)) if steps < taken => Err(miette!(
                help = "--spp counts from the render's beginning: ask for more, or leave it out",
                "--spp {spp} has no effect: it is {steps} steps, and the saved render has taken {taken}"
            )),
            _ => Ok(()),
        }
    }

    /// The budget of a render of `plan` before a film of `pixels` pixels, `default` where none was given.
    ///
    /// # Errors
    /// A broken number of samples where only whole ones can be taken.
    pub fn of(self, plan: &Plan, pixels: u32, default: Default) -> Result<Budget> {
        let given = match (self.spp, self.time) {
            (Some(spp), _) => Default::Samples(spp),
            (None, Some(time)) => Default::Time(time),
            (None, None) => default,
        };
        match given {
            Default::Time(time) => Ok(Budget::Time(time)),
            Default::Samples(spp) => steps(plan, pixels, spp).map(Budget::Steps),
            Default::Endless => Ok(Budget::Steps(u64::MAX)),
        }
    }
}

/// How long to render where nothing is asked for.
#[derive(Clone, Copy, Debug)]
pub enum Default {
    /// So many samples, or mutations, per pixel.
    Samples(f64),
    /// So long.
    Time(Duration),
    /// Until something else ends it.
    Endless,
}

/// Steps that take so many samples, or mutations, per pixel.
fn steps(plan: &Plan, pixels: u32, spp: f64) -> Result<u64> {
    if let Some(chains) = &plan.chains {
        return Ok(chains.counts.steps_for(spp, pixels));
    }
    if spp.fract() != 0.0 {
        return Err(miette!(
            help = "only techniques with chains take parts of a mutation per pixel",
            "{} takes whole samples per pixel, not {spp}",
            plan.technique
        ));
    }
    Ok(spp as u64)
}

/// Until which error to render.
#[derive(Args, Clone, Copy, Debug)]
pub struct TargetArgs {
    /// Stop once the picture's relative error over block means is below this with 95 % confidence, such as 0.01; --spp or
    /// --time then is the most that is spent
    #[arg(long, value_name = "E", value_parser = parse_error)]
    target_error: Option<f64>,
}

impl TargetArgs {
    /// The error, if one was asked for.
    #[must_use]
    pub const fn error(self) -> Option<f64> {
        self.target_error
    }

    /// The goal: this error, within the budget.
    ///
    /// # Errors
    /// As [`BudgetArgs::of`].
    pub fn within(self, budget: BudgetArgs, plan: &Plan, pixels: u32, default: Default) -> Result<Goal> {
        let default = if self.target_error.is_some() {
            let groups = plan.chains.as_ref().map_or(2, |chains| chains.counts.groups);
            if groups < 2 {
                return Err(miette!(
                    help = "16 groups are enough for the error to be known well",
                    "--target-error needs --groups 2 or more: errors are the spread between groups"
                ));
            }
            if !plan.has(Effect::Emission) {
                return Err(miette!(
                    help = "give a shape an emission",
                    "--target-error has nothing to aim at: nothing emits, the picture is black"
                ));
            }
            Default::Endless
        } else {
            default
        };
        Ok(Goal {
            budget: budget.of(plan, pixels, default)?,
            target_error: self.target_error,
        })
    }
}

/// On how many threads.
#[derive(Args, Clone, Copy, Debug)]
pub struct ThreadArgs {
    /// Threads; 0 takes one per core. The picture does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=MAX_THREADS))]
    threads: u16,
}

/// The most threads to be asked for.
const MAX_THREADS: i64 = 1024;

impl ThreadArgs {
    /// The number of threads, at least one.
    #[must_use]
    pub fn count(self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            threads => usize::from(threads),
        }
    }
}

fn parse_spp(text: &str) -> Result<f64, String> {
    let most = f64::from(u32::MAX);
    match text.parse::<f64>() {
        Ok(spp) if spp > 0.0 && spp <= most => Ok(spp),
        _ => Err(format!("expected a number above 0 and up to {most}, such as 96")),
    }
}

pub(super) fn parse_error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error > 0.0 && error < 1.0 => Ok(error),
        _ => Err("expected a relative error above 0 and below 1, such as 0.01 for 1 %".to_owned()),
    }
}

pub(super) fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text
        .parse()
        .map_err(|_| "expected a number of seconds, such as 30 or 0.5".to_owned())?;
    let longest = 3.2e7;
    if !(seconds > 0.0 && seconds <= longest) {
        return Err(format!(
            "expected a number of seconds above 0 and up to {longest:e} (a year)"
        ));
    }
    Ok(Duration::from_secs_f64(seconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_positive_and_finite() {
        assert_eq!(parse_seconds("0.5"), Ok(Duration::from_millis(500)));
        for bad in ["0", "-1", "nan", "inf", "1e300", "soon", ""] {
            assert!(parse_seconds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn samples_and_errors_are_positive_numbers() {
        assert_eq!(parse_spp("9.765625"), Ok(9.765625));
        assert_eq!(parse_error("0.02"), Ok(0.02));
        for bad in ["0", "-1", "nan", "inf", "1e300", "many", ""] {
            assert!(parse_spp(bad).is_err() && parse_error(bad).is_err(), "{bad}");
        }
        assert!(parse_error("1").is_err());
    }
}
