//! What a walk through the tree has left for later.

use super::node::{Reference, WIDTH};
use bytemuck::{Pod, Zeroable};

/// A box left for later: where the ray enters it in the upper half, what it holds in the lower. Distances are not negative, so that
/// entries are ordered as their distances are.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub struct Entry(pub u64);

impl Entry {
    /// The root, entered at once.
    pub const ROOT: Self = Self(0);
    /// What lies at the bottom of a stack: nothing is left.
    pub const END: Self = Self(Reference::END.0 as u64);

    /// A box that is entered at `distance`.
    #[inline(always)]
    pub const fn new(distance: f32, reference: Reference) -> Self {
        Self((distance.to_bits() as u64) << 32 | reference.0 as u64)
    }

    /// Where the ray enters it, in units of the direction's length.
    #[inline(always)]
    pub const fn distance(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    /// What it holds.
    #[inline(always)]
    pub const fn reference(self) -> Reference {
        Reference(self.0 as u32)
    }
}

/// Boxes still to visit, in memory that has room for all that a tree can leave, the end, and a node's boxes more.
pub struct Stack<'a> {
    entries: &'a mut [Entry],
    len: usize,
}

impl<'a> Stack<'a> {
    /// How much more memory a stack takes than entries it has.
    pub const SLACK: usize = WIDTH + 1;

    /// Nothing is left.
    #[inline(always)]
    pub fn empty(entries: &'a mut [Entry]) -> Self {
        entries[0] = Entry::END;
        Self { entries, len: 1 }
    }

    /// As it was when it had `len` entries.
    #[inline(always)]
    pub const fn resume(entries: &'a mut [Entry], len: usize) -> Self {
        Self { entries, len }
    }

    /// How many there are, the end included.
    #[inline(always)]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// Room for a node's boxes.
    #[inline(always)]
    pub fn room(&mut self) -> &mut [Entry; WIDTH] {
        let room = &mut self.entries[self.len..self.len + WIDTH];
        room.try_into().expect("as long as asked for")
    }

    /// Keeps so many of what was written to the room.
    #[inline(always)]
    pub const fn keep(&mut self, count: usize) {
        self.len += count;
    }

    /// Takes back what was left last and is not farther than `limit`; the end is always near.
    #[inline(always)]
    pub fn pop(&mut self, limit: f32) -> Entry {
        loop {
            self.len -= 1;
            let entry = self.entries[self.len];
            if entry.distance() <= limit {
                return entry;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_ordered_as_their_distances_are() {
        let distances = [0.0, f32::MIN_POSITIVE, 0.5, 1.0, 1e30, f32::INFINITY];
        let entries = distances.map(|distance| Entry::new(distance, Reference(7)));
        assert!(entries.is_sorted() && entries.map(Entry::distance) == distances);
        assert_eq!(entries[3].reference(), Reference(7));
    }

    #[test]
    fn what_is_too_far_is_dropped_down_to_the_end() {
        let mut memory = [Entry::ROOT; 4 + Stack::SLACK];
        let mut stack = Stack::empty(&mut memory);
        let left = [1.0, 3.0, 2.0, 5.0].map(|distance| Entry::new(distance, Reference(9)));
        stack.room()[..4].copy_from_slice(&left);
        stack.keep(4);
        assert_eq!(stack.pop(2.5), left[2]);
        assert_eq!(stack.pop(2.5), left[0]);
        assert_eq!((stack.pop(0.0), stack.len()), (Entry::END, 0));
    }
}
