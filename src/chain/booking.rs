//! How a decision's weight is shared between the two states it is between.

/// What a decision books: `accepted` for the proposal, the rest for the current state, exactly one in all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Booking {
    /// The proposal's share, the acceptance: a multiple of 2⁻⁵³ in [0, 1].
    pub accepted: f64,
    /// The current state's share, 1 − `accepted`, exactly.
    pub kept: f64,
}

impl Booking {
    /// The booking of a decision that takes its proposal with probability `acceptance`, in [0, 1]. An acceptance finer than
    /// 2⁻⁵³ is rounded to a multiple of that, so that both shares are exact.
    #[inline]
    #[must_use]
    pub fn of(acceptance: f32) -> Self {
        let kept = 1.0 - f64::from(acceptance);
        // Exact for a multiple of 2⁻⁵³ in [0, 1] (Sterbenz's lemma from 1/2 up, no bit lost below).
        Self {
            accepted: 1.0 - kept,
            kept,
        }
    }

    /// Whether there is nothing to decide.
    #[inline]
    #[must_use]
    pub fn is_certain(self) -> bool {
        self.accepted >= 1.0
    }

    /// What is booked in all: one.
    #[inline]
    #[must_use]
    pub fn total(self) -> f64 {
        self.accepted + self.kept
    }
}

/// Whether a proposal that is accepted with probability `acceptance` is taken; `uniform` draws a number in [0, 1), and is
/// asked only where there is something to decide.
#[inline]
pub fn decide_with(acceptance: f64, uniform: impl FnOnce() -> f64) -> bool {
    acceptance > 0.0 && uniform() < acceptance
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_booked_is_exactly_one(bits in 0_u32..=1.0_f32.to_bits()) {
            let acceptance = f32::from_bits(bits);
            let booking = Booking::of(acceptance);
            prop_assert_eq!(booking.total(), 1.0);
            prop_assert!((booking.accepted - f64::from(acceptance)).abs() <= f64::EPSILON / 4.0);
            prop_assert!(booking.accepted >= 0.0 && booking.kept >= 0.0);
        }
    }

    #[test]
    fn certain_decisions_draw_nothing() {
        assert!(Booking::of(1.0).is_certain() && !Booking::of(1.0 - f32::EPSILON / 2.0).is_certain());
        assert!(!decide_with(0.0, || unreachable!("nothing to decide")));
    }
}
