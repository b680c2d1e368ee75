//! How far a histogram is from probabilities.

/// Total variation: half the sum of absolute differences; the largest difference that any set of classes shows.
pub fn total_variation(shares: &[f64], probabilities: &[f64]) -> f64 {
    let differences = shares.iter().zip(probabilities).map(|(s, p)| (s - p).abs());
    0.5 * differences.sum::<f64>()
}

/// The total variation that is expected for `samples` independent samples: from the mean deviation of a binomial count,
/// 2 k C(n,k) pᵏ (1 − p)ⁿ⁻ᵏ⁺¹ with k = ⌊np⌋ + 1 (de Moivre 1730; Diaconis and Zabell 1991).
pub fn expected(probabilities: &[f64], samples: u64) -> f64 {
    let n = samples as f64;
    let deviation = |p: f64| {
        if p <= 0.0 || p >= 1.0 {
            return 0.0;
        }
        let k = (n * p).floor() + 1.0;
        let log_choose = libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
        2.0 * libm::exp(libm::log(k) + log_choose + k * libm::log(p) + (n - k + 1.0) * libm::log1p(-p)) / n
    };
    0.5 * probabilities.iter().map(|&p| deviation(p)).sum::<f64>()
}

/// What the total variation of `samples` independent samples exceeds with a probability of at most `alpha`: one sample
/// moves it by 1/n at most (McDiarmid 1989).
pub fn bound(probabilities: &[f64], samples: f64, alpha: f64) -> f64 {
    expected(probabilities, samples as u64) + (-libm::log(alpha) / (2.0 * samples)).sqrt()
}
