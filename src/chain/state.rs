//! Classes of states: what statistics of chains are kept by, whatever the states are.

/// A state's classes packed into one number, as its column keeps them: where it is, how long it is, what kind of path.
///
/// | class | of a light path | most |
/// |---|---|---|
/// | block | the part of the film that it reaches | 255 |
/// | length | edges of the path that carries most of its light | 4095 |
/// | signature | what kind of vertices that path scatters from, see [`Signature`] | 31 |
/// | traits | what mutations ask whether they are suitable; no statistics are kept by them | 127 |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct StateClass(pub u32);

impl StateClass {
    /// Blocks that can be told apart.
    pub const BLOCKS: usize = 256;
    /// Lengths that statistics keep apart; all longer ones are in the last.
    pub const LENGTHS: usize = 64;
    /// Signatures that can be told apart.
    pub const SIGNATURES: usize = Signature::COUNT;
    const MAX_LENGTH: u32 = 4095;
    /// The first bit of the signature.
    const SIGNATURE: u32 = 20;
    /// The first bit of the traits.
    const TRAITS: u32 = Self::SIGNATURE + Signature::KEPT + 1;

    /// The classes of a state. Numbers beyond the last class count as the last.
    #[inline]
    #[must_use]
    pub const fn new(block: u32, length: u32, signature: Signature) -> Self {
        let block = if block < 256 { block } else { 255 };
        let length = if length < Self::MAX_LENGTH {
            length
        } else {
            Self::MAX_LENGTH
        };
        Self(block | length << 8 | signature.0 << Self::SIGNATURE)
    }

    /// The same classes of a state with these traits, of which there are seven: a bit for each.
    #[inline]
    #[must_use]
    pub const fn with_traits(self, traits: u32) -> Self {
        Self(self.0 & ((1 << Self::TRAITS) - 1) | traits << Self::TRAITS)
    }

    /// The traits.
    #[inline]
    #[must_use]
    pub const fn traits(self) -> u32 {
        self.0 >> Self::TRAITS
    }

    /// The same classes in another block.
    #[inline]
    #[must_use]
    pub const fn in_block(self, block: u32) -> Self {
        Self::new(block, self.length(), self.signature()).with_traits(self.traits())
    }

    /// The block.
    #[inline]
    #[must_use]
    pub const fn block(self) -> u32 {
        self.0 & 0xFF
    }

    /// The length.
    #[inline]
    #[must_use]
    pub const fn length(self) -> u32 {
        self.0 >> 8 & 0xFFF
    }

    /// The length as statistics keep it: below [`Self::LENGTHS`].
    #[inline]
    #[must_use]
    pub const fn length_class(self) -> usize {
        let length = self.length() as usize;
        if length < Self::LENGTHS {
            length
        } else {
            Self::LENGTHS - 1
        }
    }

    /// The signature.
    #[inline]
    #[must_use]
    pub const fn signature(self) -> Signature {
        Signature(self.0 >> Self::SIGNATURE & (Self::SIGNATURES as u32 - 1))
    }
}

/// What kind of vertices a path scatters from, in Heckbert's (1990) letters from the eye on: D where it scatters with a
/// density, S where into one of a few directions. The first four are kept: a bit for each, behind a leading one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Signature(u32);

impl Default for Signature {
    fn default() -> Self {
        Self::NONE
    }
}

impl Signature {
    /// The signature of a path that scatters nowhere.
    pub const NONE: Self = Self(1);
    /// Numbers that a signature can have; 0 is not used.
    pub const COUNT: usize = 1 << (Self::KEPT + 1);
    /// Vertices that are kept.
    const KEPT: u32 = 4;

    /// The signature of the path that goes on to scatter at one vertex more.
    #[inline]
    #[must_use]
    pub const fn then(self, discrete: bool) -> Self {
        if self.0 >> Self::KEPT != 0 {
            return self;
        }
        Self(self.0 << 1 | discrete as u32)
    }

    /// The signature's number, below [`Self::COUNT`].
    #[inline]
    #[must_use]
    pub const fn number(self) -> usize {
        self.0 as usize
    }

    /// The signature of this number.
    #[must_use]
    pub const fn of_number(number: usize) -> Self {
        Self(if number == 0 || number >= Self::COUNT {
            1
        } else {
            number as u32
        })
    }

    /// The signature in letters: `E D S … L`.
    #[must_use]
    pub fn name(self) -> String {
        let vertices = self.0.checked_ilog2().unwrap_or(0);
        let letters = (0..vertices)
            .rev()
            .map(|bit| if self.0 >> bit & 1 == 1 { 'S' } else { 'D' });
        let mut name = String::from("E");
        name.extend(letters);
        if vertices == Self::KEPT {
            name.push('*');
        }
        name.push('L');
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn signatures_read_as_letters_from_the_eye() {
        let path = Signature::NONE.then(false).then(true);
        assert_eq!((Signature::NONE.name().as_str(), path.name().as_str()), ("EL", "EDSL"));
        let long = path.then(true).then(false).then(true);
        assert_eq!(long.name(), "EDSSD*L");
        assert_eq!(Signature::of_number(long.number()), long);
    }

    proptest! {
        #[test]
        fn classes_survive_their_column(block in 0_u32..256, length in 0_u32..4096, number in 1_usize..32) {
            let class = StateClass::new(block, length, Signature::of_number(number));
            prop_assert_eq!((class.block(), class.length(), class.signature().number()), (block, length, number));
            prop_assert_eq!(class.in_block(7).length(), length);
        }
    }
}
