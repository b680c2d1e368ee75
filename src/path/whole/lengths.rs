//! How lengths of new paths are chosen, and the strategies that draw them.

/// The lengths of new paths: k edges with a probability in proportion to (k + 2) to the power −`exponent`. Light grows dim
/// geometrically with length, but in mirrors and glass it may hardly do, and paths that are never tried are never found: so the tail
/// is heavy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    /// The fewest edges.
    pub shortest: u32,
    /// The most, not fewer.
    pub longest: u32,
    /// How fast longer paths get rarer, not negative.
    pub exponent: f64,
}

impl Lengths {
    /// The probability of a length; 0 outside the range.
    #[must_use]
    pub fn probability(&self, length: u32) -> f64 {
        if !(self.shortest..=self.longest).contains(&length) {
            return 0.0;
        }
        self.weight(length) / self.weights().sum::<f64>()
    }

    /// The length that `u` in [0, 1) chooses.
    #[must_use]
    pub fn sample(&self, u: f64) -> u32 {
        let mut left = u * self.weights().sum::<f64>();
        for (length, weight) in (self.shortest..).zip(self.weights()) {
            if left < weight {
                return length;
            }
            left -= weight;
        }
        self.longest
    }

    fn weight(&self, length: u32) -> f64 {
        libm::pow(f64::from(length) + 2.0, -self.exponent)
    }

    fn weights(&self) -> impl Iterator<Item = f64> {
        (self.shortest..=self.longest).map(|length| self.weight(length))
    }
}

/// The strategies by which new paths of k edges are drawn: t from 1 to k + 1. Half of them could be any; the other half meet a
/// light, sample one, or are seen by the lens from the light's end, which find most of most scenes' light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StrategyChoice {
    /// k.
    pub length: u32,
}

impl StrategyChoice {
    /// The probability of the strategy with t vertices from the camera.
    #[must_use]
    pub fn probability(&self, t: u32) -> f64 {
        f64::from(self.weight(t)) / f64::from(self.sum())
    }

    /// The t that `u` in [0, 1) chooses.
    #[must_use]
    pub fn sample(&self, u: f64) -> u32 {
        let mut left = u * f64::from(self.sum());
        for t in 1..=self.length {
            let weight = f64::from(self.weight(t));
            if left < weight {
                return t;
            }
            left -= weight;
        }
        self.length + 1
    }

    fn weight(&self, t: u32) -> u32 {
        let k = self.length;
        if !(1..=k + 1).contains(&t) {
            return 0;
        }
        let preferred = u32::from(t == k + 1) + u32::from(t == k) + u32::from(t == 1);
        3 + preferred * (k + 1)
    }

    fn sum(&self) -> u32 {
        6 * (self.length + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_the_probabilities_with_which_they_are_drawn() {
        let lengths = Lengths {
            shortest: 3,
            longest: 12,
            exponent: 2.0,
        };
        let mut counts = [0_u32; 16];
        const DRAWS: u32 = 100_000;
        for i in 0..DRAWS {
            counts[lengths.sample((f64::from(i) + 0.5) / f64::from(DRAWS)) as usize] += 1;
        }
        let mut sum = 0.0;
        for (length, count) in (0..).zip(counts) {
            let probability = lengths.probability(length);
            sum += probability;
            assert!(
                (f64::from(count) / f64::from(DRAWS) - probability).abs() < 2e-5,
                "{length}"
            );
        }
        assert!((sum - 1.0).abs() < 1e-12);
        assert_eq!((lengths.probability(2), lengths.probability(13)), (0.0, 0.0));
    }

    #[test]
    fn strategies_have_the_probabilities_with_which_they_are_drawn() {
        const DRAWS: u32 = 60_000;
        for length in 1..6 {
            let choice = StrategyChoice { length };
            let mut counts = [0_u32; 8];
            for i in 0..DRAWS {
                counts[choice.sample((f64::from(i) + 0.5) / f64::from(DRAWS)) as usize] += 1;
            }
            let mut sum = 0.0;
            for (t, count) in (0..).zip(counts) {
                let probability = choice.probability(t);
                sum += probability;
                assert!(
                    (f64::from(count) / f64::from(DRAWS) - probability).abs() < 4e-5,
                    "{length} {t}"
                );
            }
            assert!((sum - 1.0).abs() < 1e-12, "{length}: {sum}");
        }
    }
}
