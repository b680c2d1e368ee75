//! The rule of Metropolis et al. (1953) and Hastings (1970): with what probability a chain moves to its proposal.

use std::fmt;

/// With what probability a chain moves, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The acceptance a(x→y), in [0, 1]; never NaN.
    pub acceptance: f32,
    /// What it rests on.
    pub reason: Reason,
}

/// What an acceptance rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// f(y) T(y→x) is at least f(x) T(x→y): accepted surely.
    Sure,
    /// The ratio of the two decides.
    Ratio,
    /// f(y) is zero, or negative, which no target is: never accepted.
    TargetZero,
    /// f(y) is infinite or not a number: never accepted.
    TargetNotFinite,
    /// T(x→y) is zero: y cannot have been drawn, so the proposal contradicts its own density. Never accepted.
    NoWayThere,
    /// T(y→x) is zero: a move could never be taken back. Never accepted.
    NoWayBack,
    /// One of the densities is infinite or not a number: never accepted, there or back.
    NoDensity,
    /// f(x) is zero, negative or not finite: no chain should stand there, so it leaves for the first y that has a target.
    LeavesInvalid,
}

impl Reason {
    /// The reason in a few words.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Sure => "accepted surely",
            Self::Ratio => "decided by the ratio",
            Self::TargetZero => "impossible: the proposal's target is zero",
            Self::TargetNotFinite => "impossible: the proposal's target is not finite",
            Self::NoWayThere => "impossible: the proposal's density is zero",
            Self::NoWayBack => "impossible: no way back",
            Self::NoDensity => "impossible: a transition density is not finite",
            Self::LeavesInvalid => "leaves a state without a target",
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text())
    }
}

/// The largest difference of log densities that is looked at. e^±500 times any ratio of two positive `f32` (within
/// e^±193) stays inside `f64`'s normal range (e^±708), and beyond it the acceptance is 1, or zero as an `f32`, anyway.
const LARGEST_LOG: f64 = 500.0;

/// The acceptance a(x→y) = min(1, f(y) T(y→x) / (f(x) T(x→y))) of a proposal y in the state x.
///
/// `current` and `proposed` are the target values f(x) and f(y). `log_forward` = ln T(x→y) and `log_reverse` =
/// ln T(y→x), both including the probability of choosing the mutation in x and in y; −∞ stands for a density of zero. Only
/// their difference counts, so what they share may be left out of both. The product is never formed in a way that could
/// overflow or vanish, and equal densities (the symmetric mutations) cost no exponential.
///
/// An `f(x)` that is not positive and finite is left for certain. It breaks no balance: a target of zero carries no flow
/// (f(x) T(x→y) a(x→y) = 0, and no y moves back to such an x), and a chain that stayed would render nothing for ever.
#[inline]
#[must_use]
pub fn metropolis(current: f32, proposed: f32, log_forward: f64, log_reverse: f64) -> Decision {
    let never = |reason| Decision {
        acceptance: 0.0,
        reason,
    };
    let surely = |reason| Decision {
        acceptance: 1.0,
        reason,
    };
    if !proposed.is_finite() {
        return never(Reason::TargetNotFinite);
    }
    if proposed <= 0.0 {
        return never(Reason::TargetZero);
    }
    if !(log_forward < f64::INFINITY && log_reverse < f64::INFINITY) {
        return never(Reason::NoDensity);
    }
    if log_forward == f64::NEG_INFINITY {
        return never(Reason::NoWayThere);
    }
    if log_reverse == f64::NEG_INFINITY {
        return never(Reason::NoWayBack);
    }
    if !(current > 0.0 && current.is_finite()) {
        return surely(Reason::LeavesInvalid);
    }
    let log_ratio = log_reverse - log_forward;
    let mut ratio = f64::from(proposed) / f64::from(current);
    if log_ratio != 0.0 {
        ratio *= libm::exp(log_ratio.clamp(-LARGEST_LOG, LARGEST_LOG));
    }
    if ratio >= 1.0 {
        return surely(Reason::Sure);
    }
    Decision {
        acceptance: ratio as f32,
        reason: Reason::Ratio,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const DENORMAL: f32 = 1e-44;
    const TARGETS: [f32; 10] = [
        0.0,
        -0.0,
        DENORMAL,
        1.0,
        1e38,
        f32::MAX,
        f32::INFINITY,
        f32::NAN,
        -1.0,
        f32::NEG_INFINITY,
    ];
    const LOGS: [f64; 7] = [0.0, 1e4, -1e4, 1e308, f64::NEG_INFINITY, f64::INFINITY, f64::NAN];

    fn is_target(f: f32) -> bool {
        f > 0.0 && f < f32::INFINITY
    }

    /// The rule in logarithms, for valid targets and finite densities.
    fn by_logarithms(current: f32, proposed: f32, forward: f64, reverse: f64) -> f64 {
        let log = |f: f32| libm::log(f64::from(f));
        libm::exp(((log(proposed) - log(current)) + (reverse - forward)).min(0.0))
    }

    /// `f32` rounds to 6e-8, and below 1e-38 to multiples of 1.4e-45.
    fn near(a: f32, expected: f64) -> bool {
        (f64::from(a) - expected).abs() <= 1e-6 * expected + 1e-45
    }

    #[test]
    fn every_combination_of_extremes_has_a_probability_and_the_right_reason() {
        for current in TARGETS {
            for proposed in TARGETS {
                for forward in LOGS {
                    for reverse in LOGS {
                        let d = metropolis(current, proposed, forward, reverse);
                        let case = format!("{current} {proposed} {forward} {reverse}: {d:?}");
                        assert!((0.0..=1.0).contains(&d.acceptance), "{case}");
                        if !is_target(proposed) {
                            let reason = if proposed.is_finite() {
                                Reason::TargetZero
                            } else {
                                Reason::TargetNotFinite
                            };
                            assert_eq!((d.acceptance, d.reason), (0.0, reason), "{case}");
                        } else if !(forward < f64::INFINITY && reverse < f64::INFINITY) {
                            assert_eq!((d.acceptance, d.reason), (0.0, Reason::NoDensity), "{case}");
                        } else if forward == f64::NEG_INFINITY {
                            assert_eq!((d.acceptance, d.reason), (0.0, Reason::NoWayThere), "{case}");
                        } else if reverse == f64::NEG_INFINITY {
                            assert_eq!((d.acceptance, d.reason), (0.0, Reason::NoWayBack), "{case}");
                        } else if !is_target(current) {
                            assert_eq!((d.acceptance, d.reason), (1.0, Reason::LeavesInvalid), "{case}");
                        } else {
                            let expected = by_logarithms(current, proposed, forward, reverse);
                            assert!(near(d.acceptance, expected), "{case}, expected {expected}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn equal_densities_leave_the_plain_ratio() {
        for log in [0.0, -3.25, 1e4, -1e300] {
            let d = metropolis(4.0, 1.0, log, log);
            assert_eq!((d.acceptance, d.reason), (0.25, Reason::Ratio));
        }
        assert_eq!(metropolis(2.0, 2.0, 1.0, 1.0).reason, Reason::Sure);
        assert_eq!(Reason::NoWayBack.to_string(), "impossible: no way back");
    }

    /// Densities that outweigh the targets, and the other way round.
    #[test]
    fn targets_and_densities_cancel_without_overflow() {
        let log = |x: f32| libm::log(f64::from(x));
        for (x, y) in [(DENORMAL, 1e38_f32), (1e38, DENORMAL), (1e-38, 1e38)] {
            // T(x→y) = f(y): proposals drawn from the target itself are accepted always, up to rounding.
            for shift in [0.0, 1e4, -1e4] {
                let d = metropolis(x, y, log(y) + shift, log(x) + shift);
                assert!(d.acceptance > 1.0 - 1e-6, "{x} {y} {shift}: {d:?}");
            }
        }
    }

    /// Positive targets of every magnitude.
    fn target() -> impl Strategy<Value = f32> {
        (1..0x7f80_0000_u32).prop_map(f32::from_bits)
    }

    proptest! {
        #[test]
        fn acceptance_is_the_ratio(
            current in target(), proposed in target(), forward in -1e4..1e4_f64, gap in -100.0..100.0_f64,
        ) {
            let reverse = forward + gap;
            let d = metropolis(current, proposed, forward, reverse);
            let expected = by_logarithms(current, proposed, forward, reverse);
            prop_assert!(near(d.acceptance, expected), "{d:?}, expected {expected}");
        }

        /// f(x) T(x→y) a(x→y) = f(y) T(y→x) a(y→x), in logarithms, to 1e-6.
        #[test]
        fn flow_balances_in_detail(
            x in target(), y in target(), forward in -1e4..1e4_f64, gap in -100.0..100.0_f64,
        ) {
            let reverse = forward + gap;
            let (there, back) = (metropolis(x, y, forward, reverse), metropolis(y, x, reverse, forward));
            // One of the two is certain, and the other the ratio; too small a ratio has too few digits.
            prop_assert_eq!(there.acceptance.max(back.acceptance), 1.0);
            prop_assume!(there.acceptance.min(back.acceptance) >= f32::MIN_POSITIVE);
            let log = |f: f32| libm::log(f64::from(f));
            let flow = log(x) + forward + log(there.acceptance);
            let flow_back = log(y) + reverse + log(back.acceptance);
            prop_assert!((flow - flow_back).abs() < 1e-6, "{flow} {flow_back}");
        }
    }
}
