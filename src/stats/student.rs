//! Student's t distribution: quantiles, tail probabilities, and the interval of a mean whose error was itself estimated.

use super::fisher::{f_upper_tail, quantile_of_tails};

/// The t below which a variable of Student's distribution lies with probability `p`. Degrees of freedom may be fractional
/// or infinite (then this is the normal distribution's). Without a degree of freedom nothing is known, and every quantile
/// but the median is infinite.
#[must_use]
pub fn t_quantile(p: f64, degrees_of_freedom: f64) -> f64 {
    if p.is_nan() || degrees_of_freedom.is_nan() || !(0.0..=1.0).contains(&p) {
        return f64::NAN;
    }
    if p == 0.5 {
        return 0.0;
    }
    let beyond = 2.0 * p.min(1.0 - p);
    let magnitude = if degrees_of_freedom > 0.0 {
        // The square of the variable has the F distribution with one degree of freedom above.
        quantile_of_tails(1.0 - beyond, beyond, 1.0, degrees_of_freedom).sqrt()
    } else {
        f64::INFINITY
    };
    if p < 0.5 { -magnitude } else { magnitude }
}

/// The probability that a variable of Student's distribution is farther from zero than `t`, on either side. One without a
/// degree of freedom, or where `t` is zero; not a number where `t` is not.
#[must_use]
pub fn t_two_sided_p(t: f64, degrees_of_freedom: f64) -> f64 {
    if t.is_nan() || degrees_of_freedom.is_nan() {
        f64::NAN
    } else if degrees_of_freedom > 0.0 {
        f_upper_tail(t * t, 1.0, degrees_of_freedom)
    } else {
        1.0
    }
}

/// The interval that holds the true mean with probability `confidence`: the mean give or take t standard errors. All
/// numbers where the standard error has no degree of freedom.
#[must_use]
pub fn t_interval(mean: f64, standard_error: f64, degrees_of_freedom: f64, confidence: f64) -> [f64; 2] {
    if degrees_of_freedom <= 0.0 {
        return [f64::NEG_INFINITY, f64::INFINITY];
    }
    let reach = standard_error * t_quantile(0.5 + 0.5 * confidence, degrees_of_freedom);
    [mean - reach, mean + reach]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::normal;

    #[test]
    fn quantiles_are_those_of_tables() {
        for (p, degrees, expected) in [
            (0.975, 1.0, 12.706_204_736_432_1),
            (0.8, 2.0, 1.060_660_171_779_82),
            (0.975, 3.0, 3.182_446_305_284_26),
            (0.95, 15.0, 1.753_050_355_692_55),
            (0.975, 15.0, 2.131_449_545_559_32),
            (0.9995, 15.0, 4.072_765_195_903_89),
            // The normal quantile and the first term of its expansion, (z³ + z) / 4d.
            (0.975, 1e6, 1.959_966_356_814),
        ] {
            let got = t_quantile(p, degrees);
            assert!((got - expected).abs() < 1e-9 * expected, "{p} {degrees}: {got}");
            assert!((t_quantile(1.0 - p, degrees) + got).abs() < 1e-9 * got, "{p} {degrees}");
            let beyond = t_two_sided_p(got, degrees);
            assert!((beyond - 2.0 * (1.0 - p)).abs() < 1e-11, "{p} {degrees}: {beyond}");
        }
        // Between whole degrees of freedom it goes smoothly: halfway between those of 3 and 4, a little below the middle.
        let middle = 0.5 * (t_quantile(0.975, 3.0) + t_quantile(0.975, 4.0));
        let half = t_quantile(0.975, 3.5);
        assert!(half < middle && half > 0.97 * middle, "{half} {middle}");
    }

    #[test]
    fn infinitely_many_degrees_give_the_normal_distribution() {
        for p in [1e-12, 0.025, 0.3, 0.9, 0.999] {
            let expected = normal::upper_quantile(1.0 - p);
            let got = t_quantile(p, f64::INFINITY);
            // 1 − p keeps four digits of 1e-12.
            assert!((got - expected).abs() < 1e-4 * expected.abs(), "{p}: {got}");
        }
        let (t, z) = (t_two_sided_p(6.0, f64::INFINITY), normal::two_sided_p(6.0));
        assert!((t - z).abs() < 1e-11 * z, "{t} {z}");
    }

    #[test]
    fn an_interval_is_the_mean_give_or_take_t_errors() {
        let [low, high] = t_interval(10.0, 2.0, 3.0, 0.95);
        assert!((low - (10.0 - 6.364_892_610_6)).abs() < 1e-9 && (high - (10.0 + 6.364_892_610_6)).abs() < 1e-9);
        assert_eq!(t_interval(1.0, 0.0, 0.0, 0.95), [f64::NEG_INFINITY, f64::INFINITY]);
        assert_eq!(
            t_interval(1.0, f64::INFINITY, 3.0, 0.95),
            [f64::NEG_INFINITY, f64::INFINITY]
        );
        assert_eq!(t_interval(1.0, 0.0, 3.0, 0.95), [1.0, 1.0]);
    }

    #[test]
    fn without_a_degree_of_freedom_nothing_is_known() {
        assert_eq!(
            (t_quantile(0.9, 0.0), t_quantile(0.1, 0.0)),
            (f64::INFINITY, f64::NEG_INFINITY)
        );
        assert_eq!((t_quantile(0.5, 0.0), t_two_sided_p(9.0, 0.0)), (0.0, 1.0));
        assert!(
            t_quantile(1.1, 3.0).is_nan()
                && t_quantile(0.9, f64::NAN).is_nan()
                && t_two_sided_p(f64::NAN, 1.0).is_nan()
        );
    }
}
