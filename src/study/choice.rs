//! Which way to take, of several of which it is predicted what they will cost.

use super::prediction::{Predicted, Prediction};

/// A way to render, as far as the choice is concerned.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Its name.
    pub name: String,
    /// How much light it cannot find, as a share of the picture; 1 where that may be anywhere.
    pub misses: f64,
    /// What it costs, in seconds or in squared error; `None` where nothing can be told of it.
    pub cost: Option<Predicted>,
}

/// How another way compares with the one that was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rival {
    /// It costs so many times as much, and that is told apart from as much.
    Dearer(Prediction),
    /// It costs so many times as much, but that may well be as much or less.
    Alike(Prediction),
    /// It misses more light.
    MissesMore,
    /// Nothing could be told of it.
    Unknown,
}

/// A choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The number of the candidate that was taken.
    pub taken: usize,
    /// All others: their numbers, and how they compare with it.
    pub rivals: Vec<(usize, Rival)>,
}

/// Takes, of those that miss least light, the candidate whose cost is lowest in the median. `None` if nothing can be told of any of
/// those.
#[must_use]
pub fn choose(candidates: &[Candidate]) -> Option<Choice> {
    let least = candidates
        .iter()
        .map(|candidate| candidate.misses)
        .fold(f64::INFINITY, f64::min);
    let fits = |candidate: &Candidate| candidate.misses <= least;
    let value = |candidate: &Candidate| Some(candidate.cost?.prediction().value);
    let able = candidates.iter().enumerate().filter(|(_, candidate)| fits(candidate));
    let costs = able.filter_map(|(number, candidate)| Some((number, value(candidate)?)));
    let (taken, _) = costs.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let cost = candidates[taken].cost?;
    let others = candidates.iter().enumerate().filter(|(number, _)| *number != taken);
    let rivals = others.map(|(number, other)| {
        let rival = match other.cost {
            _ if !fits(other) => Rival::MissesMore,
            None => Rival::Unknown,
            Some(dearer) => match cost.times_to(&dearer) {
                times if times.bounds[0] > 1.0 => Rival::Dearer(times),
                times => Rival::Alike(times),
            },
        };
        (number, rival)
    });
    Some(Choice {
        taken,
        rivals: rivals.collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(name: &str, misses: f64, cost: Option<(f64, f64)>) -> Candidate {
        Candidate {
            name: name.to_owned(),
            misses,
            cost: cost.map(|(value, spread)| Predicted {
                ln: libm::log(value),
                spread,
                degrees: 5.0,
                least: 0.0,
            }),
        }
    }

    #[test]
    fn the_lowest_cost_is_taken_and_others_are_told_apart_or_not() {
        let candidates = [
            candidate("pt", 0.0, Some((40.0, 0.1))),
            candidate("bdpt", 0.0, Some((11.0, 0.3))),
            candidate("mlt", 0.0, Some((10.0, 0.1))),
            candidate("pssmlt", 0.0, None),
        ];
        let choice = choose(&candidates).expect("costs");
        assert_eq!(choice.taken, 2);
        let [(0, Rival::Dearer(pt)), (1, Rival::Alike(bdpt)), (3, Rival::Unknown)] = choice.rivals[..] else {
            panic!("{choice:?}")
        };
        assert!((pt.value - 4.0).abs() < 1e-9 && pt.bounds[0] > 1.0);
        assert!((bdpt.value - 1.1).abs() < 1e-9 && bdpt.bounds[0] < 1.0 && bdpt.bounds[1] > 1.1);
    }

    #[test]
    fn of_equals_the_first_is_taken() {
        let equal = [("a", 0.2), ("b", 0.1)].map(|(name, spread)| candidate(name, 0.0, Some((2.0, spread))));
        let choice = choose(&equal).expect("costs");
        assert!(matches!(
            (choice.taken, &choice.rivals[..]),
            (0, [(1, Rival::Alike(times))]) if (times.value - 1.0).abs() < 1e-12
        ));
    }

    #[test]
    fn who_misses_more_is_not_taken_however_cheap() {
        let candidates = [
            candidate("pt", 1.0, Some((1.0, 0.1))),
            candidate("mlt", 0.25, Some((50.0, 0.1))),
            candidate("bdpt", 0.25, Some((80.0, 0.1))),
        ];
        let choice = choose(&candidates).expect("costs");
        assert_eq!((choice.taken, choice.rivals[0]), (1, (0, Rival::MissesMore)));
        // Not even where nothing can be told of the others.
        let dark = [candidate("pt", 1.0, Some((1.0, 0.1))), candidate("mlt", 0.25, None)];
        assert_eq!(choose(&dark), None);
        assert_eq!(choose(&[]), None);
    }
}
