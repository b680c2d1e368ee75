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

/// Writes values beside an axis: where it has more than a decade 1, 2 and 5 of each, so that labels do not run into each other.
pub(super) fn labels(axis: &Range<f64>) -> impl Fn(&f64) -> String + use<> {
    let crowded = axis.end > 10.0 * axis.start;
    move |&value| {
        let digit = libm::round(value / libm::pow(10.0, libm::floor(libm::log10(value) + 1e-9)));
        if crowded && ![1.0, 2.0, 5.0, 10.0].contains(&digit) {
            return String::new();
        }
        label(value)
    }
}

/// A value beside its axis: powers of ten as such, others as they are.
fn label(value: f64) -> String {
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
    fn long_axes_have_few_labels() {
        let values = [0.1, 0.2, 0.3, 0.5, 0.9, 1.0, 4.0, 5.0];
        let long = labels(&(0.09..6.0));
        assert_eq!(values.map(|v| long(&v)), ["0.1", "0.2", "", "0.5", "", "1", "", "5"]);
        let short = labels(&(0.2..1.0));
        assert_eq!(values.map(|v| short(&v))[2], "0.3");
    }

    #[test]
    fn labels_are_short() {
        let labels = [1.0, 0.1, 0.125, 8.0, 1e-4, 1e6, 2e-5, 1000.0].map(label);
        assert_eq!(labels, ["1", "0.1", "0.125", "8", "1e-4", "1e6", "2e-5", "1e3"]);
    }
}
