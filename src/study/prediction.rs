//! What a pilot says of a long render: how its squared error falls with time, and how sure that is.
//!
//! The model is e²(t) = A · s^(γ − 1), s = t − t₀: what comes before the first step takes t₀ and scales with nothing. Independent samples
//! and chains that have mixed have γ = 0. Where light is found seldom, estimates of the error grow while it is found, and γ > 0: of
//! e² s, the *work*, at doubling s, differences of logarithms are γ ln 2 and noise.
//!
//! That noise is known up to a factor. A mean over time s has a variance in proportion to 1 / s, and so have estimates of squared errors:
//! with σ² at the pilot's end S, the difference between looks at s and 2 s has σ² S / (2 s). So γ is a weighted mean, σ² what is left of
//! the differences; both are drawn towards what they were in other scenes, since three differences tell little.

use crate::stats::student::t_quantile;
use serde::Serialize;

/// What γ is before anything is seen of it: its mean and standard deviation.
const GROWTH: [f64; 2] = [0.03, 0.15];
/// Growths are held to this: beyond, next to nothing would be gained by waiting, and predictions have no meaning.
const MOST_GROWTH: f64 = 0.4;
/// What σ is before anything is seen of it, and of how many differences that is worth.
const NOISE: f64 = 0.06;
const NOISE_WORTH: f64 = 3.0;
/// Standard deviation of the logarithm of what no look at one pilot can tell: other seeds, other load on the machine, the model itself.
const UNTOLD: f64 = 0.2;
/// The probability with which intervals hold the truth.
const CONFIDENCE: f64 = 0.95;

/// A positive quantity that is predicted: its logarithm is distributed about as Student's t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predicted {
    /// The logarithm in the median.
    pub ln: f64,
    /// Its standard deviation.
    pub spread: f64,
    /// Degrees of freedom of that.
    pub degrees: f64,
    /// What it cannot be less than.
    pub least: f64,
}

/// What is said of a prediction: the median, and the interval that holds the truth with a probability of 95 %.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Prediction {
    /// The median.
    pub value: f64,
    /// The interval.
    pub bounds: [f64; 2],
}

impl Predicted {
    /// The median, and the interval of 95 %.
    #[must_use]
    pub fn prediction(&self) -> Prediction {
        let half = t_quantile(0.5 * (1.0 + CONFIDENCE), self.degrees) * self.spread;
        let at = |ln: f64| self.least + libm::exp(ln);
        Prediction {
            value: at(self.ln),
            bounds: [at(self.ln - half), at(self.ln + half)],
        }
    }

    /// How many times `other` is as large as this, errors taken to be independent.
    #[must_use]
    pub fn times_to(&self, other: &Self) -> Prediction {
        let ln = |of: &Self| libm::log(of.prediction().value);
        // What is added for certain makes the quantity surer.
        let spread = |of: &Self| of.spread * libm::exp(of.ln) / of.prediction().value;
        let (a, b) = (spread(self), spread(other));
        Self {
            ln: ln(other) - ln(self),
            spread: (a * a + b * b).sqrt(),
            degrees: self.degrees.min(other.degrees),
            least: 0.0,
        }
        .prediction()
    }
}

/// How a render's squared error is expected to fall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Seconds before the first step.
    pub start: f64,
    /// Seconds of steps at the pilot's end.
    pub seconds: f64,
    /// The squared error there.
    pub squared_error: f64,
    /// γ.
    pub growth: f64,
    /// The standard deviation of γ.
    pub growth_spread: f64,
    /// σ: the standard deviation of the logarithm of the squared error as it was estimated at the pilot's end.
    pub noise: f64,
    /// The standard deviation of the logarithm of what looks do not tell.
    pub untold: f64,
}

impl Forecast {
    /// From looks at a pilot: seconds of steps and squared errors. `None` where there is no error, or nothing is known of it.
    #[must_use]
    pub fn of(start: f64, looks: &[[f64; 2]]) -> Option<Self> {
        let is_told = |&&[seconds, error]: &&[f64; 2]| seconds > 0.0 && error > 0.0 && error.is_finite();
        let told: Vec<&[f64; 2]> = looks.iter().filter(is_told).collect();
        let &&[seconds, squared_error] = told.last()?;
        // By unit of ln s and in units of σ², so that looks need not lie at exact doublings.
        let differences: Vec<[f64; 3]> = told
            .windows(2)
            .filter(|pair| pair[1][0] > pair[0][0])
            .map(|pair| {
                let ([s, e], [t, f]) = (pair[0], pair[1]);
                let [along, across] = [t / s, f * t / (e * s)].map(libm::log);
                [along, across, seconds / s - seconds / t]
            })
            .collect();
        let sum = |of: &dyn Fn(&[f64; 3]) -> f64| differences.iter().map(of).sum::<f64>();
        let weight = sum(&|[along, _, variance]| along * along / variance);
        let slope = if weight > 0.0 {
            sum(&|[along, across, variance]| along * across / variance) / weight
        } else {
            0.0
        };
        let left = sum(&|[along, across, variance]| (across - slope * along) * (across - slope * along) / variance);
        let degrees = differences.len().saturating_sub(1) as f64;
        let noise = ((left + NOISE_WORTH * NOISE * NOISE) / (degrees + NOISE_WORTH)).sqrt();
        let [usual, spread] = GROWTH;
        let precisions = [weight / (noise * noise), 1.0 / (spread * spread)];
        let precision = precisions[0] + precisions[1];
        Some(Self {
            start,
            seconds,
            squared_error,
            growth: ((precisions[0] * slope + precisions[1] * usual) / precision).clamp(0.0, MOST_GROWTH),
            growth_spread: 1.0 / precision.sqrt(),
            noise,
            untold: UNTOLD,
        })
    }

    /// The same, less sure: by a factor whose logarithm has this standard deviation.
    #[must_use]
    pub fn less_sure(self, spread: f64) -> Self {
        Self {
            untold: (self.untold * self.untold + spread * spread).sqrt(),
            ..self
        }
    }

    /// The standard deviation of the logarithm of the squared error after `seconds` of steps.
    fn spread_at(&self, seconds: f64) -> f64 {
        let away = libm::log(seconds / self.seconds) * self.growth_spread;
        // What a render errs by is as noisy as what a pilot of the same length says of it.
        let noise = self.noise * self.noise * (1.0 + self.seconds / seconds);
        (away * away + noise + self.untold * self.untold).sqrt()
    }

    /// Degrees of freedom of spreads.
    const DEGREES: f64 = NOISE_WORTH + 2.0;

    /// The squared error after `seconds`, start-up included. Of a render that has not started then, it is as if after a moment of steps.
    #[must_use]
    pub fn squared_error_after(&self, seconds: f64) -> Predicted {
        let of_steps = (seconds - self.start).max(1e-3 * self.seconds);
        let ln = libm::log(self.squared_error) - (1.0 - self.growth) * libm::log(of_steps / self.seconds);
        Predicted {
            ln,
            spread: self.spread_at(of_steps),
            degrees: Self::DEGREES,
            least: 0.0,
        }
    }

    /// Seconds, start-up included, until the squared error has fallen to this.
    #[must_use]
    pub fn seconds_to(&self, squared_error: f64) -> Predicted {
        let falls = 1.0 - self.growth;
        let along = libm::log(self.squared_error / squared_error) / falls;
        Predicted {
            ln: libm::log(self.seconds) + along,
            spread: self.spread_at(self.seconds * libm::exp(along)) / falls,
            degrees: Self::DEGREES,
            least: self.start,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, Stream, StreamKey};

    fn normal(stream: &mut Stream) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - stream.next_f64())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * stream.next_f64())
    }

    #[test]
    fn an_error_that_falls_with_the_root_of_the_time_is_foreseen() {
        let looks = [0.25, 0.5, 1.0, 2.0].map(|s| [s, 0.02 / s]);
        let forecast = Forecast::of(3.0, &looks).expect("looks");
        assert!(forecast.growth < 0.01, "{forecast:?}");
        // 0.02 / s is 0.001 after 20 s of steps.
        let time = forecast.seconds_to(1e-3).prediction();
        assert!((time.value - 23.0).abs() < 0.5, "{time:?}");
        assert!(
            time.bounds[0] > 3.0 && time.bounds[0] < 17.0 && time.bounds[1] > 30.0,
            "{time:?}"
        );
        let error = forecast.squared_error_after(23.0).prediction();
        assert!((error.value / 1e-3 - 1.0).abs() < 0.03, "{error:?}");
        // Start-up is never got below, and before its end there is no error to speak of.
        assert!(forecast.seconds_to(1e9).prediction().bounds[0] >= 3.0);
        assert!(forecast.squared_error_after(1.0).prediction().value > 1.0);
    }

    #[test]
    fn of_nothing_nothing_is_told() {
        assert_eq!(Forecast::of(0.0, &[]), None);
        for broken in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            assert_eq!(Forecast::of(0.0, &[[1.0, broken]]), None);
        }
        // A single look tells something, and what is not told is passed over.
        let one = Forecast::of(0.0, &[[0.5, f64::INFINITY], [1.0, 0.1]]).expect("a look");
        assert_eq!((one.squared_error, one.growth), (0.1, GROWTH[0]));
        assert!(one.growth_spread > 0.1);
    }

    /// Curves as the model has them: of any growth that is likely, with noise that falls while they run, and runs that differ.
    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let curves = 2000;
        let mut held = 0;
        for curve in 0..curves {
            let mut stream = StreamKey::new(7, curve, 0).stream(Purpose::FILM, 0);
            let growth = (GROWTH[0] + GROWTH[1] * normal(&mut stream)).clamp(0.0, MOST_GROWTH);
            let noise = NOISE * libm::exp(0.5 * normal(&mut stream));
            // The logarithm's noise at s has a variance in proportion to 1 / s: a sum of what every doubling brings, over s.
            let mut sum = 0.0;
            let mut before = 0.0;
            let looks = [0.125_f64, 0.25, 0.5, 1.0].map(|s| {
                sum += noise * (s - before).sqrt() * normal(&mut stream);
                before = s;
                [s, libm::exp((growth - 1.0) * libm::log(s) + sum / s)]
            });
            let forecast = Forecast::of(0.0, &looks).expect("looks");
            let end = 16.0_f64;
            let own = noise / end.sqrt() * normal(&mut stream) + UNTOLD * normal(&mut stream);
            let truth = libm::exp((growth - 1.0) * libm::log(end) + own);
            let [low, high] = forecast.squared_error_after(end).prediction().bounds;
            held += i32::from(low <= truth && truth <= high);
        }
        // On the cautious side: Student's t of few degrees of freedom, for noise that is known less than what is untold.
        assert!((1900..=1990).contains(&held), "{held}");
    }

    /// Of 20 000 pixels a few find a bright sample, the more the longer it takes; 20 of them, the worst, are left out.
    #[test]
    fn a_tail_that_is_still_being_found_is_foreseen_to_go_on() {
        let (pixels, chance) = (20_000_u64, 7.5e-5);
        let mut held = 0;
        for seed in 0..10 {
            let squared_error = |samples: u64, run: u64| {
                let hits = |pixel: u64| {
                    let mut stream = StreamKey::new(seed, pixel as u32, run).stream(Purpose::FILM, 0);
                    (0..samples).filter(|_| stream.next_f64() < chance).count() as f64
                };
                // The squared standard error of a mean of samples that are 0 or 1 / chance.
                let mut errors: Vec<f64> = (0..pixels)
                    .map(|pixel| hits(pixel) / (chance * chance * (samples * samples) as f64))
                    .collect();
                errors.sort_by(f64::total_cmp);
                errors[..19_980].iter().sum::<f64>() / 19_980.0
            };
            let looks = [16_u64, 32, 64, 128].map(|n| [n as f64, squared_error(n, 1)]);
            let forecast = Forecast::of(0.0, &looks).expect("looks");
            assert!(forecast.growth > 0.06, "{forecast:?}");
            let truth = squared_error(512, 2);
            let [low, high] = forecast.squared_error_after(512.0).prediction().bounds;
            held += i32::from(low <= truth && truth <= high);
        }
        assert!(held >= 9, "{held}");
    }

    #[test]
    fn ratios_know_what_is_certain() {
        let of = |ln: f64, spread: f64, least: f64| Predicted {
            ln,
            spread,
            degrees: 5.0,
            least,
        };
        let ratio = of(0.0, 0.3, 0.0).times_to(&of(libm::log(4.0), 0.4, 0.0));
        assert!((ratio.value - 4.0).abs() < 1e-9);
        // A spread of 0.5, times t of 97.5 % and 5 degrees of freedom.
        assert!((libm::log(ratio.bounds[1] / 4.0) - 0.5 * 2.570_58).abs() < 1e-3);
        // A long start is certain: what is unsure about a second of steps hardly matters.
        let sure = of(0.0, 0.3, 99.0).times_to(&of(0.0, 0.3, 199.0));
        assert!((sure.value - 2.0).abs() < 1e-9 && sure.bounds[1] < 2.03, "{sure:?}");
    }
}
