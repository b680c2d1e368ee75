//! Axes of logarithms.

use std::ops::Range;

/// A range of positive values and a little more, wide enough to be seen; `None` of no such values.
pub(super) fn range(values: impl Iterator<Item = f64>) -> Option<Range<f64>> {
    let seen = values.filter(|v| *v > 0.0 && v.is_finite());
    let (low, high) = seen.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return None;
    }
    let margin = libm::pow(high / low, 0.06).max(1.2);
    Some(low / margin..high * margin)
}

/// A value beside its axis: powers of ten as such, others as they are.
pub(super) fn label(value: f64) -> String {
    let power = libm::log10(value);
    let rounded = power.round();
    if (power - rounded).abs() < 1e-9 && rounded.abs() > 2.5 {
        format!("1e{rounded}")
    } else if !(0.001..1000.0).contains(&value) {
        format!("{value:.0e}")
    } else {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_all_values_and_a_margin() {
        let of = range([0.0, 3.0, f64::INFINITY, 0.01].into_iter()).expect("values");
        assert!(
            of.start < 0.01 && of.start > 0.005 && of.end > 3.0 && of.end < 6.0,
            "{of:?}"
        );
        let one = range([2.0].into_iter()).expect("a value");
        assert!(one.start < 2.0 && one.end > 2.0);
        assert_eq!(range([0.0, f64::NAN].into_iter()), None);
    }

    #[test]
    fn labels_are_short() {
        let labels = [1.0, 0.1, 0.125, 8.0, 1e-4, 1e6, 2e-5, 1000.0].map(label);
        assert_eq!(labels, ["1", "0.1", "0.125", "8", "1e-4", "1e6", "2e-5", "1e3"]);
    }
}
