//! A function on [0, 1] with what chains find hard: two bumps with a gap between them that little leads through, and a step.

/// Weight, centre and width (a standard deviation) of each bump.
const BUMPS: [[f64; 3]; 2] = [[3.0, 0.2, 0.06], [5.0, 0.6, 0.03]];
/// What there is everywhere, and alone in the gaps.
const FLOOR: f64 = 0.05;
/// Where the step is, and how high.
const STEP: [f64; 2] = [0.8, 0.8];

/// f(x).
pub fn value(x: f64) -> f64 {
    let bump = |[weight, center, width]: [f64; 3]| {
        let d = (x - center) / width;
        weight * libm::exp(-0.5 * d * d)
    };
    let step = if x >= STEP[0] { STEP[1] } else { 0.0 };
    BUMPS.into_iter().map(bump).sum::<f64>() + FLOOR + step
}

/// ∫ f from `a` to `b`.
pub fn integral(a: f64, b: f64) -> f64 {
    let bump = |[weight, center, width]: [f64; 3]| {
        let scale = width * std::f64::consts::SQRT_2;
        let up_to = |x: f64| libm::erf((x - center) / scale);
        // sqrt(π/2) σ (erf − erf).
        weight * scale * 0.5 * std::f64::consts::PI.sqrt() * (up_to(b) - up_to(a))
    };
    let step = STEP[1] * (b.max(STEP[0]) - a.max(STEP[0]));
    BUMPS.into_iter().map(bump).sum::<f64>() + FLOOR * (b - a) + step
}

/// The probability of each of `bins` bins of equal width.
pub fn bins(bins: usize) -> Vec<f64> {
    let edge = |bin: usize| bin as f64 / bins as f64;
    let whole = integral(0.0, 1.0);
    (0..bins)
        .map(|bin| integral(edge(bin), edge(bin + 1)) / whole)
        .collect()
}
