//! What independent groups of chains say of a picture: one estimate of every statistic from each group.
//!
//! Chains are correlated, with each other inside a group and from step to step; whole groups are not. So the spread of
//! the groups' estimates is the only thing an error is taken from.

use super::student::t_interval;
use super::z_test::Estimate;

/// The estimates that `groups` independent groups of chains give of `statistics` quantities each: means of blocks of the
/// picture per channel, or shares of path lengths. All values are finite.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupMeans {
    groups: usize,
    statistics: usize,
    /// Group-major: statistic i of group g is number g · statistics + i.
    values: Vec<f64>,
}

/// Why values are no table of group means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum GroupMeansError {
    /// There is nothing to take a mean of.
    #[error("a table of group means needs a group and a statistic")]
    Empty,
    /// The number of values does not fit the table.
    #[error("{groups} groups of {statistics} statistics do not make {values} values")]
    Shape {
        /// Groups that were announced.
        groups: usize,
        /// Statistics per group that were announced.
        statistics: usize,
        /// Values that were given.
        values: usize,
    },
    /// A value is infinite or not a number.
    #[error("statistic {statistic} of group {group} is not a finite number")]
    NotFinite {
        /// The group of the first such value.
        group: usize,
        /// Its statistic.
        statistic: usize,
    },
}

impl GroupMeans {
    /// A table from group-major values: all statistics of the first group, then those of the next.
    ///
    /// # Errors
    /// Where the table is empty, `values` are not groups · statistics many, or one of them is not finite.
    pub fn new(groups: usize, statistics: usize, values: Vec<f64>) -> Result<Self, GroupMeansError> {
        if groups == 0 || statistics == 0 {
            return Err(GroupMeansError::Empty);
        }
        if groups.checked_mul(statistics) != Some(values.len()) {
            return Err(GroupMeansError::Shape {
                groups,
                statistics,
                values: values.len(),
            });
        }
        if let Some(at) = values.iter().position(|v| !v.is_finite()) {
            return Err(GroupMeansError::NotFinite {
                group: at / statistics,
                statistic: at % statistics,
            });
        }
        Ok(Self {
            groups,
            statistics,
            values,
        })
    }

    /// The table whose groups have, of every statistic, what `combine` makes of its values; those have to stay finite.
    #[must_use]
    pub fn combined(mut self, combine: impl Fn(&mut [f64])) -> Self {
        let mut values = vec![0.0; self.groups];
        for statistic in 0..self.statistics {
            let entries = || (statistic..).step_by(self.statistics);
            for (value, at) in values.iter_mut().zip(entries()) {
                *value = self.values[at];
            }
            combine(&mut values);
            for (value, at) in values.iter().zip(entries()) {
                self.values[at] = *value;
            }
        }
        self
    }

    /// A table from one row of statistics per group.
    ///
    /// # Errors
    /// As of [`new`](Self::new), and where the rows differ in length.
    pub fn from_rows<R: AsRef<[f64]>>(rows: &[R]) -> Result<Self, GroupMeansError> {
        let statistics = rows.first().map_or(0, |row| row.as_ref().len());
        let values: Vec<f64> = rows.iter().flat_map(|row| row.as_ref()).copied().collect();
        if rows.iter().any(|row| row.as_ref().len() != statistics) {
            return Err(GroupMeansError::Shape {
                groups: rows.len(),
                statistics,
                values: values.len(),
            });
        }
        Self::new(rows.len(), statistics, values)
    }

    /// Number of independent groups, at least one.
    #[must_use]
    pub fn groups(&self) -> usize {
        self.groups
    }

    /// Number of statistics per group, at least one.
    #[must_use]
    pub fn statistics(&self) -> usize {
        self.statistics
    }

    /// All statistics of group `group`, below [`groups`](Self::groups).
    #[must_use]
    pub fn row(&self, group: usize) -> &[f64] {
        &self.values[group * self.statistics..][..self.statistics]
    }

    /// What each group says of statistic `statistic`, below [`statistics`](Self::statistics).
    pub fn column(&self, statistic: usize) -> impl Iterator<Item = f64> {
        self.values.iter().skip(statistic).step_by(self.statistics).copied()
    }

    /// Of every statistic, the mean over the groups and its standard error, which has one degree of freedom less than
    /// there are groups, and is infinite for a single group.
    #[must_use]
    pub fn estimates(&self) -> Vec<Estimate> {
        (0..self.statistics).map(|i| self.estimate(i)).collect()
    }

    /// The mean of statistic `statistic` over the groups, and its standard error.
    #[must_use]
    pub fn estimate(&self, statistic: usize) -> Estimate {
        Estimate::of(&self.column(statistic).collect::<Vec<f64>>())
    }

    /// The interval that holds the true value of statistic `statistic` with probability `confidence`, by Student's t. All
    /// numbers for a single group.
    #[must_use]
    pub fn mean_interval(&self, statistic: usize, confidence: f64) -> [f64; 2] {
        let estimate = self.estimate(statistic);
        t_interval(estimate.mean, estimate.error, (self.groups - 1) as f64, confidence)
    }

    /// The mean over all groups and statistics: what errors are told relative to.
    #[must_use]
    pub fn grand_mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// Every group's differences from the mean over the groups, group-major.
    pub(super) fn centred(&self) -> Vec<f64> {
        let mut means = vec![0.0; self.statistics];
        for row in self.values.chunks_exact(self.statistics) {
            for (mean, value) in means.iter_mut().zip(row) {
                *mean += value / self.groups as f64;
            }
        }
        let rows = self.values.chunks_exact(self.statistics);
        rows.flat_map(|row| row.iter().zip(&means).map(|(value, mean)| value - mean))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> GroupMeans {
        GroupMeans::from_rows(&[[1.0, 10.0], [2.0, 10.0], [3.0, 10.0], [4.0, 10.0]]).expect("a table")
    }

    #[test]
    fn estimates_are_the_columns_means_and_their_errors() {
        let estimates = table().estimates();
        assert_eq!(estimates[0], Estimate::of(&[1.0, 2.0, 3.0, 4.0]));
        assert_eq!((estimates[1].mean, estimates[1].error), (10.0, 0.0));
        assert_eq!((table().row(2), table().grand_mean()), (&[3.0, 10.0][..], 6.25));
        let flat = GroupMeans::new(4, 2, vec![1.0, 10.0, 2.0, 10.0, 3.0, 10.0, 4.0, 10.0]);
        assert_eq!(flat, Ok(table()));
        assert_eq!(table().centred(), [-1.5, 0.0, -0.5, 0.0, 0.5, 0.0, 1.5, 0.0]);
    }

    #[test]
    fn intervals_are_students() {
        let [low, high] = table().mean_interval(0, 0.95);
        let reach = 3.182_446_305_284_26 * (5.0_f64 / 12.0).sqrt();
        assert!((low - (2.5 - reach)).abs() < 1e-9 && (high - (2.5 + reach)).abs() < 1e-9);
        assert_eq!(table().mean_interval(1, 0.95), [10.0, 10.0]);
        let single = GroupMeans::from_rows(&[[1.0]]).expect("a table");
        assert_eq!(single.mean_interval(0, 0.95), [f64::NEG_INFINITY, f64::INFINITY]);
    }

    #[test]
    fn what_is_no_table_is_refused_with_its_reason() {
        assert_eq!(GroupMeans::new(0, 3, vec![]), Err(GroupMeansError::Empty));
        assert_eq!(GroupMeans::from_rows::<[f64; 1]>(&[]), Err(GroupMeansError::Empty));
        let shape = |groups, values| GroupMeansError::Shape {
            groups,
            statistics: 2,
            values,
        };
        assert_eq!(GroupMeans::new(2, 2, vec![0.0; 3]), Err(shape(2, 3)));
        assert_eq!(GroupMeans::new(usize::MAX, 2, vec![0.0; 3]), Err(shape(usize::MAX, 3)));
        // Rows of unequal length whose sum would fit.
        let uneven = [vec![0.0; 2], vec![0.0], vec![0.0; 3]];
        assert_eq!(GroupMeans::from_rows(&uneven), Err(shape(3, 6)));
        let at = GroupMeansError::NotFinite { group: 1, statistic: 0 };
        assert_eq!(GroupMeans::from_rows(&[[1.0, 2.0], [f64::NAN, f64::INFINITY]]), Err(at));
        assert!(at.to_string().contains("statistic 0 of group 1"));
    }
}
