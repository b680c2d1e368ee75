//! Multiple importance sampling: how techniques that can find the same path share it.

/// The weight of a sample drawn with density `own` where another technique would have drawn it with density `other`:
/// the power heuristic with exponent 2 (Veach 1997, §9.2.4). Both densities are in the same measure and count one
/// sample each.
///
/// Computed from the ratio of the two, so that their squares neither overflow nor vanish. A technique that cannot draw
/// the sample has density 0 and takes no share.
#[inline]
#[must_use]
pub fn power_heuristic(own: f32, other: f32) -> f32 {
    if own <= other {
        // Also where both are 0: then nothing was drawn, and the weight does not matter.
        let ratio = if other > 0.0 { own / other } else { 0.0 };
        let squared = ratio * ratio;
        squared / (1.0 + squared)
    } else {
        let ratio = other / own;
        1.0 / (1.0 + ratio * ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::power_heuristic;
    use proptest::prelude::*;

    #[test]
    fn a_technique_without_rivals_takes_all() {
        assert_eq!(power_heuristic(3.0, 0.0), 1.0);
        assert_eq!(power_heuristic(0.0, 3.0), 0.0);
        assert_eq!(power_heuristic(2.0, 2.0), 0.5);
        assert_eq!(power_heuristic(3.0, 1.0), 0.9);
    }

    proptest! {
        #[test]
        fn weights_of_two_techniques_sum_to_one(a in 1e-38f32..3e38, b in 1e-38f32..3e38) {
            let sum = power_heuristic(a, b) + power_heuristic(b, a);
            prop_assert!((sum - 1.0).abs() < 1e-6, "{a} {b} {sum}");
        }
    }
}
