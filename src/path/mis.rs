//! Multiple importance sampling: how techniques that can find the same path share it.
//!
//! Every technique weighs by the same function. What a sample is compared with comes in as **odds**: the sum, over all
//! other techniques that could have found it, of (their density / its own)^β. The weight is 1 / (1 + odds). Densities of
//! two techniques are in the same measure; only their ratio counts, so that nothing overflows or vanishes on the way.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The exponent β of the weights (Veach 1997, §9.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Heuristic {
    /// β = 1: within a constant of the least variance that weights can give.
    Balance,
    /// β = 2: less noise where one technique is much better than the others, which is usual.
    #[default]
    Power,
}

/// There is no such heuristic.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected power or balance")]
pub struct UnknownHeuristic;

impl fmt::Display for Heuristic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Balance => "balance",
            Self::Power => "power",
        })
    }
}

impl FromStr for Heuristic {
    type Err = UnknownHeuristic;

    fn from_str(name: &str) -> Result<Self, UnknownHeuristic> {
        match name {
            "balance" => Ok(Self::Balance),
            "power" => Ok(Self::Power),
            _ => Err(UnknownHeuristic),
        }
    }
}

/// What odds are held to: far beyond any that leave a weight behind, and small enough that their products stay finite.
const MAX_ODDS: f64 = 1e150;

impl Heuristic {
    /// The odds of a technique whose density is `ratio` times that of the one that drew the sample. A ratio that is not a
    /// number (of two densities that are zero) has no odds: nothing was drawn, and the weight does not matter.
    #[inline]
    #[must_use]
    pub fn odds(self, ratio: f64) -> f64 {
        // A factor that is chosen, and no branch: where every path asks, it is the same each time.
        let odds = ratio
            * match self {
                Self::Balance => 1.0,
                Self::Power => ratio,
            };
        if odds.is_nan() { 0.0 } else { odds.min(MAX_ODDS) }
    }

    /// The weight of a sample drawn with density `own` where one other technique would have drawn it with density `other`.
    #[inline]
    #[must_use]
    pub fn share(self, own: f32, other: f32) -> f32 {
        if own == 0.0 {
            return 0.0;
        }
        weight(self.odds(f64::from(other) / f64::from(own)))
    }
}

/// The weight of a sample against which the odds are `odds`.
#[inline]
#[must_use]
pub fn weight(odds: f64) -> f32 {
    (1.0 / (1.0 + odds)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_technique_without_rivals_takes_all() {
        let power = Heuristic::Power;
        assert_eq!(power.share(3.0, 0.0), 1.0);
        assert_eq!(power.share(0.0, 3.0), 0.0);
        assert_eq!(power.share(2.0, 2.0), 0.5);
        assert_eq!(power.share(3.0, 1.0), 0.9);
        assert_eq!(Heuristic::Balance.share(3.0, 1.0), 0.75);
        assert_eq!(power.share(f32::INFINITY, 1.0), 1.0);
        assert_eq!(power.share(1.0, f32::INFINITY), 0.0);
        assert_eq!(power.share(0.0, 0.0), 0.0);
    }

    #[test]
    fn odds_are_never_negative_nor_nonsense() {
        for heuristic in [Heuristic::Balance, Heuristic::Power] {
            for ratio in [0.0, 1e-300, 1.0, 1e300, f64::INFINITY, f64::NAN] {
                let odds = heuristic.odds(ratio);
                assert!(odds >= 0.0 && (odds * odds).is_finite(), "{ratio}: {odds}");
                assert!((0.0..=1.0).contains(&weight(odds)));
            }
        }
    }

    proptest! {
        #[test]
        fn weights_of_two_techniques_sum_to_one(a in 1e-38f32..3e38, b in 1e-38f32..3e38) {
            for heuristic in [Heuristic::Balance, Heuristic::Power] {
                let sum = heuristic.share(a, b) + heuristic.share(b, a);
                prop_assert!((sum - 1.0).abs() < 1e-6, "{a} {b} {sum}");
            }
        }
    }
}
