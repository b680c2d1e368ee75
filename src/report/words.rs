//! Estimates in words, as tables have them.

use crate::study::{Interval, TimeTo};

/// A value with its interval; `show` writes a number.
#[must_use]
pub fn interval(interval: Option<Interval>, show: impl Fn(f64) -> String) -> String {
    match interval {
        None => "not known".to_owned(),
        Some(Interval { value, bounds }) => format!("{} ({} to {})", show(value), show(bounds[0]), show(bounds[1])),
    }
}

/// The time to an error, in seconds: what most runs did not reach is longer than a run. Without an interval where runs are too few
/// for one.
#[must_use]
pub fn seconds(time: Option<&TimeTo>) -> String {
    let show = |v: f64| {
        if v.is_finite() {
            format!("{v:.2}")
        } else {
            "...".to_owned()
        }
    };
    match time {
        None => "no telling".to_owned(),
        Some(time) if !time.seconds.value.is_finite() => "longer".to_owned(),
        Some(time) => {
            let [low, high] = time.seconds.bounds;
            let most = if time.at_most { "< " } else { "" };
            let value = show(time.seconds.value);
            if low == 0.0 && high.is_infinite() {
                return format!("{most}{value}");
            }
            format!("{most}{value} ({}-{})", show(low), show(high))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_or_not_reached_is_said() {
        let two = |v: f64| format!("{v:.1}");
        let known = Interval {
            value: 2.0,
            bounds: [1.5, 3.0],
        };
        assert_eq!(interval(Some(known), two), "2.0 (1.5 to 3.0)");
        assert_eq!(interval(None, two), "not known");
        let time = |value: f64, high: f64, at_most: bool| TimeTo {
            error: 0.1,
            seconds: Interval {
                value,
                bounds: [1.0, high],
            },
            reached: 3,
            at_most,
        };
        assert_eq!(seconds(Some(&time(1.5, f64::INFINITY, true))), "< 1.50 (1.00-...)");
        assert_eq!(seconds(Some(&time(f64::INFINITY, f64::INFINITY, false))), "longer");
        assert_eq!(seconds(None), "no telling");
        let few = TimeTo {
            seconds: Interval {
                value: 1.5,
                bounds: [0.0, f64::INFINITY],
            },
            ..time(1.5, f64::INFINITY, false)
        };
        assert_eq!(seconds(Some(&few)), "1.50");
    }
}
