//! Discrete distributions: choosing an entry with a probability in proportion to its weight.

/// A distribution over `0..len`, sampled by inverting its cumulative sums: monotone in the random number, so that a
/// small change of the number is a small change of the choice.
#[derive(Clone, Debug, Default)]
pub struct Discrete {
    /// `cumulative[i]` is the probability of an index `<= i`; the last entry with any weight is exactly 1.
    cumulative: Vec<f64>,
    probabilities: Vec<f32>,
}

impl Discrete {
    /// A distribution in proportion to `weights` (finite, not negative). Empty if no weight is positive. A weight whose
    /// share of the total is zero in `f32` counts as none, so that what is chosen can be divided by its probability.
    #[must_use]
    pub fn new(weights: impl Iterator<Item = f64> + Clone) -> Self {
        let total: f64 = weights.clone().sum();
        if total.is_nan() || total <= 0.0 {
            return Self::default();
        }
        let share = move |weight: f64| (weight / total) as f32;
        let weights = weights.map(move |weight| if share(weight) > 0.0 { weight } else { 0.0 });
        let mut sum = 0.0;
        let mut cumulative: Vec<f64> = Vec::new();
        let mut last_positive = 0;
        for (i, weight) in weights.clone().enumerate() {
            if weight > 0.0 {
                last_positive = i;
            }
            sum += weight;
            cumulative.push(sum / total);
        }
        for c in &mut cumulative[last_positive..] {
            *c = 1.0;
        }
        let probabilities = weights.map(share).collect();
        Self {
            cumulative,
            probabilities,
        }
    }

    /// Whether there is nothing to choose.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cumulative.is_empty()
    }

    /// Number of entries.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cumulative.len()
    }

    /// The entry that `u` in [0, 1) chooses; never one of weight zero. `None` if the distribution is empty.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: f64) -> Option<usize> {
        let index = self.cumulative.partition_point(|&c| c <= u);
        (index < self.cumulative.len()).then_some(index)
    }

    /// What is left of `u` when it has chosen entry `index`: how far along the entry's share it lies, a uniform number in
    /// [0, 1) of its own.
    #[inline]
    #[must_use]
    pub fn rest(&self, u: f64, index: usize) -> f64 {
        let start = if index > 0 { self.cumulative[index - 1] } else { 0.0 };
        let rest = (u - start) / (self.cumulative[index] - start);
        rest.clamp(0.0, 1.0_f64.next_down())
    }

    /// The probability of entry `index`.
    #[inline]
    #[must_use]
    pub fn probability(&self, index: usize) -> f32 {
        self.probabilities[index]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_rest(d: &Discrete, u: f64) -> Option<(usize, f64)> {
        d.sample(u).map(|index| (index, d.rest(u, index)))
    }

    #[test]
    fn entries_without_weight_are_never_chosen() {
        let d = Discrete::new([0.0, 1.0, 0.0, 3.0, 0.0].into_iter());
        assert_eq!(d.sample(0.0), Some(1));
        assert_eq!(d.sample(0.249_999), Some(1));
        assert_eq!(d.sample(0.25), Some(3));
        assert_eq!(d.sample(1.0 - f64::EPSILON), Some(3));
        assert_eq!(d.probability(3), 0.75);
        assert_eq!(d.probability(4), 0.0);
    }

    #[test]
    fn what_is_left_of_the_number_spans_the_unit_interval_in_every_entry() {
        let d = Discrete::new([1.0, 0.0, 3.0].into_iter());
        assert_eq!(with_rest(&d, 0.125), Some((0, 0.5)));
        assert_eq!(with_rest(&d, 0.25), Some((2, 0.0)));
        assert_eq!(with_rest(&d, 0.625), Some((2, 0.5)));
        let last = with_rest(&d, 1.0_f64.next_down());
        assert!(last.is_some_and(|(index, rest)| index == 2 && rest > 0.999_999 && rest < 1.0));
        assert_eq!(with_rest(&Discrete::default(), 0.5), None);
    }

    #[test]
    fn no_weight_means_nothing_to_choose() {
        for weights in [vec![], vec![0.0, 0.0]] {
            let d = Discrete::new(weights.into_iter());
            assert!(d.is_empty());
            assert_eq!(d.sample(0.5), None);
        }
    }
}
