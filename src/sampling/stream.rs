//! Keyed random streams: every draw of a render is named, so that no state has to be stored or replayed.
//!
//! The key (seed, chain, step, purpose, depth) is mixed to the 64-bit state of a [`Pcg32`]; its increment is a
//! bijective mix of the chain, so two chains never share a stream. (Used raw, step and chain as PCG's state and stream
//! correlate neighbours strongly: PCG streams with related increments are related sequences. The mixing removes it.)
//! Draws of one path happen in different systems and in any order, so each has its own purpose and depth.

use rand_core::Rng;
use rand_pcg::Pcg32;

/// What a draw is for. Every system that draws has a purpose of its own, so that no two draw the same numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Purpose(u32);

impl Purpose {
    /// Where on the film.
    pub const FILM: Self = Self(0);
    /// Choice of a light and of a point on it, for the vertex at the given depth.
    pub const LIGHT: Self = Self(1);
    /// Choice of a scattered direction at the vertex of the given depth.
    pub const SCATTER: Self = Self(2);
    /// Russian roulette after the vertex of the given depth.
    pub const ROULETTE: Self = Self(3);
    /// Choice of a mutation.
    pub const MUTATION: Self = Self(4);
    /// Whether to take a proposal.
    pub const ACCEPT: Self = Self(5);
    /// How far a small step moves the coordinates of the film, at depth 0, and those of vertices at the given depth beyond.
    pub const PERTURB: Self = Self(6);
    /// Choice of the seeds among the samples of a group's bootstrap.
    pub const RESAMPLE: Self = Self(7);

    /// Choice of a lobe at the vertex of the given depth.
    pub const LOBE: Self = Self(8);
    /// Where on the lens a path starts.
    pub const LENS: Self = Self(9);
    /// Choice of a light to start a path at, of a point on it, and of a direction.
    pub const EMISSION: Self = Self(10);
    /// Choice of the pixel that a light path's splat counts for, at the vertex of the given depth.
    pub const SPLAT: Self = Self(11);
    /// How far a small step moves the coordinates of the vertex that a camera subpath starts at: at the depth of the film's.
    pub const PERTURB_LENS: Self = Self(12);

    /// A purpose of a system outside this crate, by a name that no other system uses: a hash of it (FNV-1a), apart from all
    /// of the above.
    #[must_use]
    pub const fn named(name: &str) -> Self {
        let bytes = name.as_bytes();
        let mut hash = 0x811C_9DC5_u32;
        let mut i = 0;
        while i < bytes.len() {
            hash = (hash ^ bytes[i] as u32).wrapping_mul(0x0100_0193);
            i += 1;
        }
        Self(hash | 0x8000_0000)
    }
}

/// The part of a key that one chain's step has in common: (seed, chain, step), mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamKey {
    base: u64,
    chain: u64,
}

/// A bijection of 64-bit integers that flips every output bit with probability near one half for any flipped input bit
/// (the finaliser of SplitMix64; Steele, Lea and Flood 2014, with Stafford's "Mix13" constants).
const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Steps between consecutive inputs of [`mix`]: 2⁶⁴ divided by the golden ratio, odd.
const WEYL: u64 = 0x9E37_79B9_7F4A_7C15;

impl StreamKey {
    /// The key of `step` of `chain` in the render with `seed`. `chain` is the global chain number.
    #[inline]
    #[must_use]
    pub const fn new(seed: u64, chain: u32, step: u64) -> Self {
        let chain = chain as u64;
        let seeded = mix(seed.wrapping_add(WEYL));
        let chained = mix(seeded ^ chain.wrapping_mul(WEYL));
        Self {
            base: mix(chained.wrapping_add(step.wrapping_mul(WEYL))),
            chain,
        }
    }

    /// The key's mixed 64 bits, as they are kept in a column.
    #[inline]
    #[must_use]
    pub const fn bits(self) -> u64 {
        self.base
    }

    /// The key whose [`bits`](Self::bits) were kept in a column for `chain`.
    #[inline]
    #[must_use]
    pub const fn from_bits(base: u64, chain: u32) -> Self {
        Self {
            base,
            chain: chain as u64,
        }
    }

    /// The stream of draws for `purpose` at vertex `depth`.
    #[inline]
    #[must_use]
    pub fn stream(self, purpose: Purpose, depth: u32) -> Stream {
        let named = ((purpose.0 as u64) << 32) | u64::from(depth);
        let state = mix(self.base ^ named.wrapping_add(1).wrapping_mul(WEYL));
        Stream {
            generator: Pcg32::new(state, mix(self.chain ^ WEYL)),
        }
    }
}

/// A stream of random numbers.
#[derive(Clone, Debug)]
pub struct Stream {
    generator: Pcg32,
}

impl Stream {
    /// 32 random bits.
    #[inline]
    pub fn next_u32(&mut self) -> u32 {
        self.generator.next_u32()
    }

    /// 64 random bits.
    #[inline]
    pub fn next_u64(&mut self) -> u64 {
        let high = u64::from(self.generator.next_u32());
        high << 32 | u64::from(self.generator.next_u32())
    }

    /// A uniform number in [0, 1): a multiple of 2⁻²⁴, never 1.
    #[inline]
    pub fn next_f32(&mut self) -> f32 {
        (self.generator.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Two uniform numbers in [0, 1).
    #[inline]
    pub fn next_pair(&mut self) -> [f32; 2] {
        let first = self.next_f32();
        [first, self.next_f32()]
    }

    /// A uniform number in [0, 1), a multiple of 2⁻⁵³: fine enough to choose among millions of unequal lights.
    #[inline]
    pub fn next_f64(&mut self) -> f64 {
        let high = u64::from(self.generator.next_u32() >> 5);
        let low = u64::from(self.generator.next_u32() >> 6);
        ((high << 26) | low) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_numbers_stay_below_one() {
        assert!((u32::MAX >> 8) as f32 * (1.0 / 16_777_216.0) < 1.0);
        assert!(((1_u64 << 53) - 1) as f64 * (1.0 / 9_007_199_254_740_992.0) < 1.0);
    }

    #[test]
    fn every_part_of_the_key_changes_the_stream() {
        let first = |seed, chain, step, purpose, depth| {
            StreamKey::new(seed, chain, step)
                .stream(purpose, depth)
                .generator
                .next_u32()
        };
        let reference = first(1, 2, 3, Purpose::LIGHT, 4);
        assert_eq!(reference, first(1, 2, 3, Purpose::LIGHT, 4));
        assert_ne!(reference, first(2, 2, 3, Purpose::LIGHT, 4));
        assert_ne!(reference, first(1, 3, 3, Purpose::LIGHT, 4));
        assert_ne!(reference, first(1, 2, 4, Purpose::LIGHT, 4));
        assert_ne!(reference, first(1, 2, 3, Purpose::SCATTER, 4));
        assert_ne!(reference, first(1, 2, 3, Purpose::LIGHT, 5));
    }

    #[test]
    fn a_key_survives_its_column() {
        let key = StreamKey::new(9, 77, 5);
        assert_eq!(key, StreamKey::from_bits(key.bits(), 77));
    }
}
