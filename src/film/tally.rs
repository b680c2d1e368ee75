//! What a film had to refuse or bend, and why one cannot be made or used.

/// What a film could not take as it was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Splats that were left out because a channel was infinite or not a number. They count as no sample either.
    pub non_finite: u64,
    /// Splats that were left out because the film has no such pixel.
    pub outside: u64,
    /// Splats with a channel above the film's range, which was brought down to it.
    pub saturated: u64,
    /// Splats with a channel that is not zero but below the film's resolution, and so added nothing.
    pub vanished: u64,
}

impl Tally {
    /// Splats that were left out altogether.
    #[must_use]
    pub const fn rejected(&self) -> u64 {
        self.non_finite + self.outside
    }

    /// Counts what `other` counted too. A count that would pass its range stays at the end of it.
    pub const fn add(&mut self, other: &Self) {
        self.non_finite = self.non_finite.saturating_add(other.non_finite);
        self.outside = self.outside.saturating_add(other.outside);
        self.saturated = self.saturated.saturating_add(other.saturated);
        self.vanished = self.vanished.saturating_add(other.vanished);
    }

    pub(super) const fn is_clean(&self) -> bool {
        self.non_finite | self.outside | self.saturated | self.vanished == 0
    }
}

/// Why a film cannot be made, or films do not go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum FilmError {
    /// A side is zero.
    #[error("a film of {width} x {height} pixels has no pixel")]
    #[diagnostic(help("give it a width and a height of at least 1"))]
    Empty {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// More pixels than an index counts, or than memory holds.
    #[error("a film of {width} x {height} pixels needs {bytes} bytes, more than there are")]
    #[diagnostic(help("render a smaller picture, or leave it more memory"))]
    TooLarge {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// What the film would take.
        bytes: u64,
    },
    /// Two films, or a film and blocks, of different sizes.
    #[error("{} x {} pixels and {} x {} do not go together", first.0, first.1, second.0, second.1)]
    #[diagnostic(help("use films, pictures and blocks of one size"))]
    SizesDiffer {
        /// Width and height of the first.
        first: (u32, u32),
        /// Width and height of the other.
        second: (u32, u32),
    },
    /// No groups, or another number of scales than of groups.
    #[error("{groups} groups of chains with {scales} scales make no picture")]
    #[diagnostic(help("give at least one group, and a scale for each"))]
    Groups {
        /// How many films were given.
        groups: usize,
        /// How many scales were given.
        scales: usize,
    },
    /// A group's scale is infinite or not a number.
    #[error("the scale of group {group} is not a finite number")]
    #[diagnostic(help("a group's scale is its normalization over its number of states: give it states"))]
    Scale {
        /// Which group, from zero.
        group: usize,
    },
}
