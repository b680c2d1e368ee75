//! Films as bytes, so that an interrupted render goes on as if nothing had happened.
//!
//! A saved film is a row of 64-bit words, least significant byte first on every machine: eight bytes that say what it is
//! and of which version, the number of words in its body, the body, and a checksum over all of these. One changed word is
//! always found; any other damage but once in 2⁶⁴ times.

mod film;
mod group_film;

use super::tally::{FilmError, Tally};

/// Why saved bytes are not the film they should be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum SavedFilmError {
    /// The bytes begin as no film of this kind and version does.
    #[error("these bytes are no saved film of the kind and version that is read here")]
    #[diagnostic(help("take it up with the version of chainlight that saved it, or render anew"))]
    Kind,
    /// Too few bytes or too many.
    #[error("the saved film has {found} bytes, where it should have {expected}")]
    #[diagnostic(help("the file was cut off, or something was written after it: render anew"))]
    Length {
        /// Bytes that there should be; the least number of them where even that is cut off.
        expected: u64,
        /// Bytes that there are.
        found: u64,
    },
    /// The checksum does not fit.
    #[error("the saved film is damaged: its checksum does not fit")]
    #[diagnostic(help("the file changed after it was written: render anew"))]
    Checksum,
    /// Contents that no film has.
    #[error("the saved film is damaged: {what}")]
    #[diagnostic(help("the file changed after it was written: render anew"))]
    Damaged {
        /// What it says that cannot be.
        what: &'static str,
    },
    /// A film of another size or unit than the one to go on with.
    #[error("the saved film is of another render: {saved}, not {own}")]
    #[diagnostic(help("go on with the same scene and the same size"))]
    Other {
        /// Size and unit of the saved film.
        saved: String,
        /// Size and unit of the film that was to take it up.
        own: String,
    },
    /// There is no such film, or no memory for it.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Film(#[from] FilmError),
}

const WORD: usize = size_of::<u64>();
/// Words around the body: kind, length, checksum.
const FRAME: usize = 3;
/// Counts beyond this are those of no render; it keeps sums of counts in range.
const MOST_COUNTED: u64 = 1 << 62;

/// Each step is a bijection of the state for a given word, and of the word for a given state.
fn mix(state: u64, word: u64) -> u64 {
    let product = (state ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    product ^ (product >> 32)
}

/// Appends a frame to bytes, word by word.
struct Writer<'a> {
    out: &'a mut Vec<u8>,
    checksum: u64,
}

impl<'a> Writer<'a> {
    /// Begins a film with `body` words to come.
    fn begin(out: &'a mut Vec<u8>, kind: [u8; WORD], body: usize) -> Self {
        out.reserve((body + FRAME) * WORD);
        let mut writer = Self { out, checksum: 0 };
        writer.words([u64::from_le_bytes(kind), body as u64]);
        writer
    }

    fn words(&mut self, words: impl IntoIterator<Item = u64>) {
        for word in words {
            self.checksum = mix(self.checksum, word);
            self.out.extend_from_slice(&word.to_le_bytes());
        }
    }

    fn wide(&mut self, value: i128) {
        self.words([value as u64, (value >> 64) as u64]);
    }

    fn header(&mut self, width: u32, height: u32, tally: Tally) {
        self.words([u64::from(width) | u64::from(height) << 32]);
        self.words([tally.non_finite, tally.outside, tally.saturated, tally.vanished]);
    }

    fn finish(self) {
        self.out.extend_from_slice(&self.checksum.to_le_bytes());
    }
}

/// Words of the header: sides and tally.
const HEADER: usize = 5;

/// What every saved film begins with.
struct Header {
    width: u32,
    height: u32,
    tally: Tally,
}

impl Header {
    const fn pixels(&self) -> usize {
        (self.width as usize).saturating_mul(self.height as usize)
    }
}

/// The words of a body whose frame is sound.
#[derive(Clone)]
struct Reader<'a> {
    words: std::slice::Iter<'a, [u8; WORD]>,
}

impl<'a> Reader<'a> {
    /// Checks the frame. Nothing is read of the body, and nothing allocated.
    fn open(bytes: &'a [u8], kind: [u8; WORD]) -> Result<Self, SavedFilmError> {
        let length = |words: u64| SavedFilmError::Length {
            expected: words.saturating_add(FRAME as u64).saturating_mul(WORD as u64),
            found: bytes.len() as u64,
        };
        let (words, rest) = bytes.as_chunks::<WORD>();
        let Some((&found, words)) = words.split_first() else {
            return Err(length(0));
        };
        if found != kind {
            return Err(SavedFilmError::Kind);
        }
        let Some((&count, words)) = words.split_first() else {
            return Err(length(0));
        };
        let Some((&checksum, body)) = words.split_last() else {
            return Err(length(u64::from_le_bytes(count)));
        };
        if body.len() as u64 != u64::from_le_bytes(count) || !rest.is_empty() {
            return Err(length(u64::from_le_bytes(count)));
        }
        let summed = [found, count].into_iter().chain(body.iter().copied());
        if summed.fold(0, |state, word| mix(state, u64::from_le_bytes(word))) != u64::from_le_bytes(checksum) {
            return Err(SavedFilmError::Checksum);
        }
        Ok(Self { words: body.iter() })
    }

    fn left(&self) -> usize {
        self.words.len()
    }

    fn word(&mut self) -> Result<u64, SavedFilmError> {
        let word = self.words.next().ok_or(SavedFilmError::Damaged {
            what: "it ends before its last pixel",
        })?;
        Ok(u64::from_le_bytes(*word))
    }

    fn wide(&mut self) -> Result<i128, SavedFilmError> {
        let low = self.word()?;
        Ok((u128::from(low) | u128::from(self.word()?) << 64) as i128)
    }

    fn count(&mut self) -> Result<u64, SavedFilmError> {
        let count = self.word()?;
        (count <= MOST_COUNTED).then_some(count).ok_or(SavedFilmError::Damaged {
            what: "it counts more than any render can",
        })
    }

    fn header(&mut self) -> Result<Header, SavedFilmError> {
        let sides = self.word()?;
        Ok(Header {
            width: sides as u32,
            height: (sides >> 32) as u32,
            tally: Tally {
                non_finite: self.count()?,
                outside: self.count()?,
                saturated: self.count()?,
                vanished: self.count()?,
            },
        })
    }

    /// Refuses a body that has not exactly `words` words left, before memory is taken for what it claims to hold.
    fn expect(&self, words: usize) -> Result<(), SavedFilmError> {
        (self.left() == words).then_some(()).ok_or(SavedFilmError::Damaged {
            what: "its length does not fit the size it claims",
        })
    }
}

/// `bytes` with one word changed, and a checksum that fits.
#[cfg(test)]
fn forged(bytes: &[u8], word: usize, value: u64) -> Vec<u8> {
    let words = bytes.as_chunks::<WORD>().0.iter();
    let mut words: Vec<u64> = words.map(|w| u64::from_le_bytes(*w)).collect();
    words[word] = value;
    let last = words.len() - 1;
    words[last] = words[..last].iter().fold(0, |state, &w| mix(state, w));
    words.into_iter().flat_map(u64::to_le_bytes).collect()
}
