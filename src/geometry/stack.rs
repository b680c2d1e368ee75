//! What a walk through the tree has left for later.

/// A box that the ray enters.
#[derive(Clone, Copy, Default)]
pub struct Entry {
    /// First primitive of a leaf, or the pair of an inner box.
    pub first: u32,
    /// Primitives of a leaf; 0 for an inner box.
    pub count: u32,
    /// Where the ray enters it, in units of the direction's length.
    pub distance: f32,
}

/// Boxes still to visit: a fixed array, and the heap for the rare tree that is deeper. One serves all rays of a queue.
pub struct Stack {
    fixed: [Entry; Self::FIXED],
    len: usize,
    spill: Vec<Entry>,
}

impl Default for Stack {
    #[inline]
    fn default() -> Self {
        Self {
            fixed: [Entry::default(); Self::FIXED],
            len: 0,
            spill: Vec::new(),
        }
    }
}

impl Stack {
    const FIXED: usize = 48;

    /// Forgets everything.
    #[inline]
    pub fn clear(&mut self) {
        self.len = 0;
        self.spill.clear();
    }

    /// Leaves a box for later.
    #[inline]
    pub fn push(&mut self, entry: Entry) {
        if self.len < Self::FIXED {
            self.fixed[self.len] = entry;
        } else {
            self.spill.push(entry);
        }
        self.len += 1;
    }

    /// Takes back the box that was left last.
    #[inline]
    pub fn pop(&mut self) -> Option<Entry> {
        self.len = self.len.checked_sub(1)?;
        if self.len < Self::FIXED {
            Some(self.fixed[self.len])
        } else {
            self.spill.pop()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_pushed_last_is_popped_first_beyond_the_fixed_part_too() {
        let mut stack = Stack::default();
        let entry = |first| Entry {
            first,
            ..Entry::default()
        };
        for count in [1, 47, 48, 49, 50, 200] {
            (0..count).for_each(|first| stack.push(entry(first)));
            stack.push(entry(count));
            let popped: Vec<u32> = std::iter::from_fn(|| stack.pop().map(|entry| entry.first)).collect();
            assert!(popped.into_iter().eq((0..=count).rev()));
        }
    }
}
