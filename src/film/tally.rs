//! What a film had to refuse or bend, and why one cannot be made.

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

    pub(super) const fn is_clean(&self) -> bool {
        self.non_finite | self.outside | self.saturated | self.vanished == 0
    }
}

/// Why a film cannot be made.
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
    #[diagnostic(help("render a smaller picture: the film keeps 128 bytes a pixel"))]
    TooLarge {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// What the film would take.
        bytes: u64,
    },
}
