//! Stratified resampling: `count` entries drawn from many in proportion to their weights, so that chains start where the
//! target is.
//!
//! The cumulative sum of the weights is cut into `count` strata of equal weight, and one point is drawn uniformly in each
//! (Kitagawa 1996). Together the points are uniform, so entry i is expected exactly n wᵢ/W times. Systematic resampling,
//! one random number for all strata, keeps that expectation too and is closer to it (less than one copy off, here less
//! than two), but what it draws together depends on the order of the entries: with weights that repeat in step with the
//! strata its variance exceeds that of independent draws, and a bootstrap that walks over the film has such an order.
//! Strata drawn independently never do worse than independent draws, whatever the order (Douc and Cappé 2005).

/// `weight`, or zero for one that is negative, infinite or not a number.
#[inline]
pub(super) fn counted(weight: f64) -> f64 {
    if weight > 0.0 && weight.is_finite() {
        weight
    } else {
        0.0
    }
}

/// The indices of `count` entries in ascending order, each chosen `count` · wᵢ/W times in expectation, with fewer than two
/// more or less. `uniform` gives independent uniform numbers in [0, 1), one for each.
///
/// Weights that are negative or not finite count as zero, and an entry of weight zero is never chosen (nor one beyond the
/// 2³² that an index can name). `None` if the weights sum to zero or to more than an `f64` holds.
#[must_use]
pub fn resample(weights: &[f64], count: usize, mut uniform: impl FnMut() -> f64) -> Option<Vec<u32>> {
    let named = || (0..=u32::MAX).zip(weights.iter().map(|&w| counted(w)));
    let largest = named().map(|(_, w)| w).fold(0.0, f64::max);
    // Relative to the largest, so that weights near the ends of the range keep their digits.
    let share = |weight: f64| weight / largest;
    let total: f64 = named().map(|(_, w)| share(w)).sum();
    if largest <= 0.0 || !(total * largest).is_finite() {
        return None;
    }
    let mut entries = named().filter(|&(_, w)| share(w) > 0.0);
    let (mut index, first) = entries.next()?;
    let mut cumulative = share(first);
    let mut chosen = Vec::with_capacity(count);
    for stratum in 0..count {
        let point = (stratum as f64 + uniform()) / count as f64 * total;
        // Past the last entry only by rounding: then it is the last one's.
        while point >= cumulative
            && let Some((next, weight)) = entries.next()
        {
            index = next;
            cumulative += share(weight);
        }
        chosen.push(index);
    }
    Some(chosen)
}

/// How many different entries were chosen.
#[must_use]
pub fn distinct(chosen: &[u32]) -> usize {
    let mut sorted = chosen.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    sorted.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};
    use proptest::prelude::*;

    fn uniform(seed: u64) -> impl FnMut() -> f64 {
        let mut stream = StreamKey::new(seed, 0, 0).stream(Purpose::LIGHT, 0);
        move || stream.next_f64()
    }

    #[test]
    fn nothing_to_choose_from_is_none() {
        let nan = f64::NAN;
        for weights in [
            vec![],
            vec![0.0, 0.0],
            vec![nan, -1.0, f64::INFINITY, f64::NEG_INFINITY],
            vec![1e308, 1e308],
        ] {
            assert_eq!(resample(&weights, 4, uniform(1)), None, "{weights:?}");
        }
        assert_eq!(resample(&[1.0], 0, uniform(1)), Some(vec![]));
    }

    #[test]
    fn weights_that_are_none_are_never_chosen() {
        let weights = [0.0, f64::NAN, 1.0, -3.0, f64::INFINITY, 2.0, 0.0];
        // The ends of every stratum too.
        for u in [0.0, 0.5, 1.0 - f64::EPSILON / 2.0, 1.0, f64::NAN] {
            let chosen = resample(&weights, 300, || u).expect("two have weight");
            assert_eq!(chosen.len(), 300);
            assert!(chosen.iter().all(|i| [2, 5].contains(i)), "{u}: {chosen:?}");
        }
    }

    #[test]
    fn one_huge_weight_takes_all() {
        let mut weights = vec![1e-9; 1000];
        weights[500] = 1e300;
        let chosen = resample(&weights, 1000, uniform(2)).expect("has weight");
        assert_eq!((distinct(&chosen), chosen[0]), (1, 500));
    }

    #[test]
    fn a_million_tiny_weights_are_chosen_evenly() {
        for weight in [f64::MIN_POSITIVE, 5e-324, 1e-12] {
            let chosen = resample(&vec![weight; 1_000_000], 1000, uniform(3)).expect("has weight");
            for (stratum, &index) in chosen.iter().enumerate() {
                assert_eq!(index as usize / 1000, stratum, "{weight}");
            }
            assert_eq!(distinct(&chosen), 1000);
        }
    }

    #[test]
    fn distinct_counts_in_any_order() {
        assert_eq!((distinct(&[]), distinct(&[7]), distinct(&[3, 1, 3, 2, 1])), (0, 1, 3));
    }

    proptest! {
        #[test]
        fn copies_are_less_than_two_off(
            weights in prop::collection::vec(prop_oneof![Just(0.0), 0.0..1.0, 0.0..1e6], 1..50),
            count in 1..200_usize,
            seed in any::<u64>(),
        ) {
            let total: f64 = weights.iter().sum();
            prop_assume!(total > 0.0);
            let chosen = resample(&weights, count, uniform(seed)).expect("something has weight");
            prop_assert!(chosen.len() == count && chosen.is_sorted());
            for (i, weight) in weights.iter().enumerate() {
                let copies = chosen.iter().filter(|&&c| c as usize == i).count() as f64;
                prop_assert!((copies - count as f64 * weight / total).abs() < 2.0);
                prop_assert!(copies == 0.0 || *weight > 0.0);
            }
        }
    }
}
