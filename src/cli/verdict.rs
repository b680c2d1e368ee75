//! Which of the ways that were tried to take, in a sentence.

use super::output::{duration, significant};
use super::pilots::Tried;
use crate::study::{Candidate, Foreseen, Predicted, Prediction, Rival, choose};
use std::fmt;

/// What a choice goes by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// Time until `--target-error` stops.
    Target(f64),
    /// Time to a relMSE without the worst 0.1 % of pixels.
    PixelError(f64),
    /// That error after so many seconds.
    PixelErrorAfter(f64),
}

impl Goal {
    const fn foreseen(self) -> Foreseen {
        match self {
            Self::Target(_) => Foreseen::Blocks,
            Self::PixelError(_) | Self::PixelErrorAfter(_) => Foreseen::Trimmed,
        }
    }

    /// What a way costs by it.
    fn cost(self, way: &Tried) -> Option<Predicted> {
        let forecast = way.outlook.forecast(self.foreseen())?;
        Some(match self {
            Self::Target(error) | Self::PixelError(error) => forecast.seconds_to(self.foreseen().squared(error)),
            Self::PixelErrorAfter(seconds) => forecast.squared_error_after(seconds),
        })
    }

    /// What it is to cost less, so many times.
    fn than(self, name: &str) -> String {
        match self {
            Self::Target(_) | Self::PixelError(_) => format!("times as fast as {name}"),
            Self::PixelErrorAfter(_) => format!("times less squared error than {name}"),
        }
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.foreseen().name();
        match self {
            Self::Target(error) => write!(f, "by the time to {name} {error}"),
            Self::PixelError(error) => write!(f, "by the time to {error}, {name} of pixels"),
            Self::PixelErrorAfter(seconds) => {
                write!(f, "by {name} of pixels after {}, start-up included", duration(*seconds))
            }
        }
    }
}

/// A choice, and why.
pub(super) struct Verdict {
    /// The number of the way that is taken; `None` if nothing can be told.
    pub(super) taken: Option<usize>,
    pub(super) sentence: String,
}

/// Chooses among the ways that were tried.
pub(super) fn of(tried: &[Tried], goal: Goal) -> Verdict {
    let candidates: Vec<Candidate> = tried
        .iter()
        .map(|way| Candidate {
            name: way.name.clone(),
            misses: way.misses,
            cost: goal.cost(way),
        })
        .collect();
    let Some(choice) = choose(&candidates) else {
        return Verdict {
            taken: None,
            sentence: "no telling which is best: pilots of those that miss least light found none, or too little to know their errors; \
                       longer ones may"
                .to_owned(),
        };
    };
    let name = |number: usize| candidates[number].name.as_str();
    let (mut dearer, mut alike, mut missing, mut unknown) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for &(number, rival) in &choice.rivals {
        match rival {
            Rival::Dearer(times) => dearer.push(format!("{} {}", times_in_words(times), goal.than(name(number)))),
            Rival::Alike(Prediction {
                value,
                bounds: [low, high],
            }) => alike.push(format!(
                "{} ({}, {} to {})",
                name(number),
                significant(value),
                significant(low),
                significant(high)
            )),
            Rival::MissesMore => missing.push(name(number).to_owned()),
            Rival::Unknown if tried[number].pilot.is_none() => {
                unknown.push(format!("{} (it did not start in time)", name(number)));
            }
            Rival::Unknown => unknown.push(name(number).to_owned()),
        }
    }
    let mut parts = Vec::new();
    if !dearer.is_empty() {
        parts.push(dearer.join(", "));
    }
    if !alike.is_empty() {
        parts.push(format!("{} cannot be told from it", alike.join(" and ")));
    }
    if !missing.is_empty() {
        parts.push(format!(
            "{} left out, for light that only others find",
            missing.join(" and ")
        ));
    }
    if !unknown.is_empty() {
        parts.push(format!("nothing can be told of {}", unknown.join(" and ")));
    }
    if parts.is_empty() {
        parts.push("there is nothing to compare it with".to_owned());
    }
    Verdict {
        taken: Some(choice.taken),
        sentence: format!("{}, {goal}: {}", name(choice.taken), parts.join("; ")),
    }
}

fn times_in_words(
    Prediction {
        value,
        bounds: [low, high],
    }: Prediction,
) -> String {
    format!("{} ({} to {})", significant(value), significant(low), significant(high))
}
