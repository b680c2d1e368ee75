//! `--spp`, `--time` and `--threads`: how long to render, and on how many threads.

use crate::render::Budget;
use clap::Args;
use std::time::Duration;

/// How long to render.
#[derive(Args, Clone, Copy, Debug)]
pub struct BudgetArgs {
    /// Samples per pixel [default: 96]
    #[arg(long, value_name = "N", conflicts_with = "time", value_parser = clap::value_parser!(u64).range(1..=u64::from(u32::MAX)))]
    spp: Option<u64>,
    /// Seconds to render; the number of samples reached is recorded, and with it --spp gives the same bytes
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    time: Option<Duration>,
}

impl BudgetArgs {
    /// The budget, `default` where none was given.
    #[must_use]
    pub fn or(self, default: Budget) -> Budget {
        self.time
            .map(Budget::Time)
            .or(self.spp.map(Budget::Steps))
            .unwrap_or(default)
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

fn parse_seconds(text: &str) -> Result<Duration, String> {
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
}
