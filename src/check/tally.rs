//! Sums of a test function over replicas: mean, spread and skewness, and the replicas that weigh most.

/// The value that lies farthest out, and the replica that has it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Extreme {
    pub(super) value: f64,
    pub(super) chain: u32,
}

/// What the values of a test function add up to. Values of zero need not be added: the number of replicas is known apart.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tally {
    sum: f64,
    sizes: f64,
    squares: f64,
    cubes: f64,
    /// The largest value above zero.
    pub(super) most: Extreme,
    /// The least value below zero.
    pub(super) least: Extreme,
}

/// A mean over replicas, as tests need it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mean {
    pub(super) mean: f64,
    /// Its standard error.
    pub(super) error: f64,
    /// Skewness of the mean's distribution: that of one value over the root of their number.
    pub(super) skewness: f64,
    /// The mean of the values' magnitudes.
    pub(super) size: f64,
    /// Equal values that would have the same ratio of (Σ|v|)² to Σv².
    pub(super) effective: f64,
}

impl Tally {
    /// Adds `value`, which replica `chain` has.
    #[inline]
    pub(super) fn add(&mut self, value: f64, chain: u32) {
        let square = value * value;
        self.sum += value;
        self.sizes += value.abs();
        self.squares += square;
        self.cubes += square * value;
        if value > self.most.value {
            self.most = Extreme { value, chain };
        }
        if value < self.least.value {
            self.least = Extreme { value, chain };
        }
    }

    /// Adds a coin's outcome, less the probability `a` of heads, by replica `chain`. What is known of such a coin stands for what one
    /// outcome says of its spread: where it is as good as certain, all outcomes are alike, and none tells how seldom another comes.
    #[inline]
    pub(super) fn add_coin(&mut self, heads: bool, a: f64, chain: u32) {
        let (value, variance) = (if heads { 1.0 - a } else { -a }, a * (1.0 - a));
        if variance == 0.0 {
            // What could not have been is evidence like any other.
            self.add(value, chain);
            return;
        }
        self.sum += value;
        self.sizes += 2.0 * variance;
        self.squares += variance;
        self.cubes += variance * (1.0 - 2.0 * a);
        if value > self.most.value {
            self.most = Extreme { value, chain };
        }
        if value < self.least.value {
            self.least = Extreme { value, chain };
        }
    }

    /// Adds the sums of other replicas.
    pub(super) fn merge(&mut self, other: &Self) {
        self.sum += other.sum;
        self.sizes += other.sizes;
        self.squares += other.squares;
        self.cubes += other.cubes;
        if other.most.value > self.most.value {
            self.most = other.most;
        }
        if other.least.value < self.least.value {
            self.least = other.least;
        }
    }

    /// The mean over `replicas` replicas.
    pub(super) fn mean(&self, replicas: u64) -> Mean {
        let n = replicas.max(2) as f64;
        let mean = self.sum / n;
        let variance = (self.squares / n - mean * mean).max(0.0);
        // Of a constant, cancellation leaves some rounding.
        let variance = if variance <= 1e-13 * self.squares / n {
            0.0
        } else {
            variance
        };
        let third = self.cubes / n - 3.0 * mean * self.squares / n + 2.0 * mean * mean * mean;
        let skewness = if variance > 0.0 {
            third / (variance * variance.sqrt() * n.sqrt())
        } else {
            0.0
        };
        Mean {
            mean,
            error: (variance / (n - 1.0)).sqrt(),
            skewness,
            size: self.sizes / n,
            effective: if self.squares > 0.0 {
                self.sizes * self.sizes / self.squares
            } else {
                0.0
            },
        }
    }
}

impl Mean {
    /// The mean in standard errors, corrected for skewness by Hall's (1992) cubic transformation: means of values with a long
    /// tail come out small together with their errors, which would raise false alarms.
    pub(super) fn z(&self) -> f64 {
        if self.mean == 0.0 {
            return 0.0;
        }
        let t = self.mean / self.error;
        if !t.is_finite() {
            return t;
        }
        let s = self.skewness;
        t + s * (2.0 * t * t + 1.0) / 6.0 + s * s * t * t * t / 27.0
    }

    /// The same where the error is known, not estimated from the same values: then it does not come out small together with the mean,
    /// and skewness acts the other way (the expansion of Cornish and Fisher 1938, inverted, with the excess kurtosis that rare events
    /// have, the square of their skewness).
    pub(super) fn z_of_known_error(&self) -> f64 {
        let t = self.mean / self.error;
        if self.mean == 0.0 || !t.is_finite() {
            return self.z();
        }
        let s = self.skewness;
        t - s * (t * t - 1.0) / 6.0 + 5.0 * s * s * (t * t * t - t) / 72.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};
    use crate::stats::normal::upper_quantile;

    #[test]
    fn coins_that_are_as_good_as_certain_are_no_evidence() {
        let mut coins = Tally::default();
        for chain in 0..10_000 {
            coins.add_coin(true, 1.0 - 1e-7, chain);
        }
        let mean = coins.mean(10_000);
        // Fewer than one effective value: no test is made of them. The mean itself is well within its error.
        assert!(mean.effective < 1.0 && mean.mean.abs() < 0.1 * mean.error, "{mean:?}");
        // A coin that always comes up heads, and is said to be fair.
        let mut unfair = Tally::default();
        for chain in 0..10_000 {
            unfair.add_coin(true, 0.5, chain);
        }
        assert!(unfair.mean(10_000).z() > 50.0);
    }

    #[test]
    fn sums_of_parts_are_the_sum() {
        let values = [1.0, -2.0, 0.5, 4.0, -0.25];
        let mut whole = Tally::default();
        let (mut a, mut b) = (Tally::default(), Tally::default());
        for (chain, &value) in (0..).zip(&values) {
            whole.add(value, chain);
            if chain < 2 { &mut a } else { &mut b }.add(value, chain);
        }
        a.merge(&b);
        assert_eq!(a, whole);
        assert_eq!((whole.most.chain, whole.least.chain), (3, 1));
        let mean = whole.mean(10);
        assert_eq!((mean.mean, mean.size), (0.325, 0.775));
        let scatter: f64 = values.iter().map(|v| (v - 0.325) * (v - 0.325)).sum::<f64>() + 5.0 * 0.325 * 0.325;
        assert!((mean.error - (scatter / 90.0).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_constant_has_no_error() {
        let mut tally = Tally::default();
        (0..1000).for_each(|chain| tally.add(-1.0 + 1.0 / 1.05, chain));
        let mean = tally.mean(1000);
        assert_eq!(mean.error, 0.0);
        assert_eq!(mean.z(), f64::NEG_INFINITY);
        assert_eq!(Tally::default().mean(1000).z(), 0.0);
    }

    /// Coins that hardly ever, or nearly always, come up heads, 40 times the rarer outcome in a sample.
    #[test]
    fn skewed_coins_raise_no_false_alarms() {
        let (repetitions, n) = (4000, 2000_u64);
        let limit = upper_quantile(0.005);
        for probability in [0.02, 0.98] {
            let (mut known, mut estimated) = ([0; 2], [0; 2]);
            for repetition in 0..repetitions {
                let mut stream = StreamKey::new(2, repetition, 0).stream(Purpose::FILM, 0);
                let mut tally = Tally::default();
                for chain in 0..n as u32 {
                    tally.add_coin(stream.next_f64() < probability, probability, chain);
                }
                let mean = tally.mean(n);
                let count = |counts: &mut [i32; 2], z: f64| {
                    counts[0] += i32::from(z < -limit);
                    counts[1] += i32::from(z > limit);
                };
                count(&mut known, mean.z_of_known_error());
                count(&mut estimated, mean.z());
            }
            // By the binomial distribution 17 and 24, give or take 5, and 53, give or take 7, on one side.
            assert!(known.iter().all(|&count| (5..=38).contains(&count)), "{known:?}");
            assert!(estimated.iter().any(|&count| count > 38), "{estimated:?}");
        }
    }

    /// Means of 2000 values each, one in forty of which is exponential and the others nothing, minus what they are on average:
    /// the corrected statistic exceeds its quantiles as often as it should, on both sides; the plain one does not.
    #[test]
    fn skewed_values_raise_no_false_alarms() {
        let (repetitions, n) = (4000, 2000_u64);
        let limit = upper_quantile(0.005);
        let (mut corrected, mut plain) = ([0; 2], [0; 2]);
        for repetition in 0..repetitions {
            let mut stream = StreamKey::new(1, repetition, 0).stream(Purpose::FILM, 0);
            let mut tally = Tally::default();
            for chain in 0..n as u32 {
                let value = if stream.next_f64() < 0.025 {
                    -libm::log(1.0 - stream.next_f64())
                } else {
                    0.0
                };
                tally.add(value - 0.025, chain);
            }
            let mean = tally.mean(n);
            let count = |counts: &mut [i32; 2], z: f64| {
                counts[0] += i32::from(z < -limit);
                counts[1] += i32::from(z > limit);
            };
            count(&mut corrected, mean.z());
            count(&mut plain, mean.mean / mean.error);
        }
        // 20 on each side, give or take 4.5.
        assert!(
            corrected.iter().all(|&count| (6..=36).contains(&count)),
            "{corrected:?}"
        );
        assert!(plain[0] > 45, "{plain:?}");
    }
}
