//! Films that the steps of independent samples take turns among: step s goes to film s modulo their number. A film that has n of the N
//! steps counts by n/N, and the films' spread is the picture's error, as with groups of chains.

/// How many of the steps each film has; those that have any.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Turns {
    counts: Vec<f64>,
    all: f64,
}

impl Turns {
    /// Of so many films, after `steps` steps and a part of one more.
    pub(super) fn new(films: usize, steps: u64, part: f64) -> Self {
        let films = films.max(1) as u64;
        let of_film = |number: u64| {
            let whole = (steps + films - 1 - number) / films;
            whole as f64 + if steps % films == number { part } else { 0.0 }
        };
        let counts: Vec<f64> = (0..films).map(of_film).filter(|&count| count > 0.0).collect();
        Self {
            all: counts.iter().sum(),
            counts,
        }
    }

    /// What the sums of each film are divided by.
    pub(super) fn counts(&self) -> &[f64] {
        &self.counts
    }

    /// Makes of the films' means v those values whose plain mean is the mean over all steps M, and whose spread is its error:
    /// M + (v − M) · (films · share).
    pub(super) fn combine(&self, values: &mut [f64]) {
        let films = values.len() as f64;
        let share = |count: &f64| count / self.all;
        let mean: f64 = values
            .iter()
            .zip(&self.counts)
            .map(|(value, count)| value * share(count))
            .sum();
        for (value, count) in values.iter_mut().zip(&self.counts) {
            *value = mean + (*value - mean) * (films * share(count));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_count_by_their_steps() {
        let turns = Turns::new(3, 5, 0.0);
        assert_eq!(turns.counts(), [2.0, 2.0, 1.0]);
        let mut values = [1.0, 2.0, 6.0];
        turns.combine(&mut values);
        let mean = values.iter().sum::<f64>() / 3.0;
        assert!((mean - (0.4 + 0.8 + 1.2)).abs() < 1e-12, "{mean}");
        assert_eq!(Turns::new(16, 2, 0.0).counts().len(), 2);
        assert_eq!(Turns::new(4, 5, 0.25).counts(), [2.0, 1.25, 1.0, 1.0]);
        assert!(Turns::new(4, 0, 0.0).counts().is_empty());
    }
}
