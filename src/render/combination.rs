//! How groups make one picture.
//!
//! A group's states, times the b of its own bootstrap, are an unbiased estimate: seeds carry the weight of the pool that they
//! were drawn from. So a group counts in proportion to that b_g, and one that found no light does not count. But the mean
//! Σ b_g S_g / G would keep the bootstraps' noise for ever. What is estimated is the ratio R = Σ b_g S_g / Σ b_g, a mean over
//! states, times B, the mean weight of all samples so far: those of all bootstraps, and all independent proposals since. The
//! ratio's bias is one over the number of all bootstraps' samples.
//!
//! The spread of a ratio is that of its influence values (the infinitesimal jackknife): group g stands for
//!
//! x_g = B R + (G B b_g / Σ b)(S_g − R) + (B_g − B) R,
//!
//! whose mean is B R, and which scatter as if each group had made a picture of its own.

/// The factors that make the groups' values x_g of their means S_g.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// b_g / Σ b.
    shares: Vec<f64>,
    /// G B b_g / Σ b.
    own: Vec<f64>,
    /// B_g − G B b_g / Σ b.
    shared: Vec<f64>,
}

impl Combination {
    /// Of groups with these b of their bootstraps, and these of all their samples so far.
    #[must_use]
    pub fn new(bootstraps: &[f64], running: &[f64]) -> Self {
        let groups = running.len() as f64;
        let sum: f64 = bootstraps.iter().sum();
        let b = running.iter().sum::<f64>() / groups.max(1.0);
        let share = |&b: &f64| if sum > 0.0 { b / sum } else { 0.0 };
        let shares: Vec<f64> = bootstraps.iter().map(share).collect();
        let own: Vec<f64> = shares.iter().map(|share| groups * b * share).collect();
        let shared = running.iter().zip(&own).map(|(b, own)| b - own).collect();
        Self { shares, own, shared }
    }

    /// Makes x_g of S_g, for one pixel or block.
    pub fn apply(&self, values: &mut [f64]) {
        let mean: f64 = values
            .iter()
            .zip(&self.shares)
            .map(|(value, share)| value * share)
            .sum();
        for (value, (own, shared)) in values.iter_mut().zip(self.own.iter().zip(&self.shared)) {
            *value = *value * own + mean * shared;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_the_ratio_times_b_and_groups_without_light_do_not_count() {
        let combination = Combination::new(&[2.0, 0.0, 6.0], &[3.0, 1.0, 5.0]);
        let mut values = [1.0, 77.0, 2.0];
        combination.apply(&mut values);
        let mean = values.iter().sum::<f64>() / 3.0;
        let (ratio, b) = ((2.0 * 1.0 + 6.0 * 2.0) / 8.0, 3.0);
        assert!((mean - ratio * b).abs() < 1e-12, "{mean}");
    }

    #[test]
    fn equal_groups_keep_their_own_values() {
        let combination = Combination::new(&[2.0; 4], &[2.0; 4]);
        let mut values = [1.0, 2.0, 3.0, 4.0];
        combination.apply(&mut values);
        assert_eq!(values, [2.0, 4.0, 6.0, 8.0]);
    }

    /// Groups of different b whose states all say the same differ in b alone.
    #[test]
    fn noise_of_bootstraps_cancels_where_states_agree() {
        let combination = Combination::new(&[1.0, 3.0, 2.0], &[2.0, 2.1, 1.9]);
        let mut values = [5.0; 3];
        combination.apply(&mut values);
        for (value, b) in values.iter().zip([2.0, 2.1, 1.9]) {
            assert!((value - 5.0 * b).abs() < 1e-12);
        }
    }

    #[test]
    fn no_light_is_black() {
        let combination = Combination::new(&[0.0; 2], &[0.0, 0.5]);
        let mut values = [1.0, 3.0];
        combination.apply(&mut values);
        assert_eq!(values, [0.0, 0.0]);
    }
}
