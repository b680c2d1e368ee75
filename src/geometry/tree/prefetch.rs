//! Asking for memory before it is needed.
#![expect(
    unsafe_code,
    reason = "prefetching is an instruction: twice as many rays a second where a tree is larger than the caches"
)]

/// Lines of memory that a step needs at most.
const LINES: usize = 4;

/// Asks for what steps will need: the items of some tables, by the number of the table and that of the item, without a branch on either.
#[derive(Clone, Copy)]
pub struct Prefetch<const TABLES: usize> {
    /// Where each table begins, as a number: it is never read from.
    starts: [usize; TABLES],
    /// Bytes of an item of each.
    sizes: [usize; TABLES],
}

impl<const TABLES: usize> Prefetch<TABLES> {
    /// Tables, all empty.
    pub const fn new() -> Self {
        Self {
            starts: [0; TABLES],
            sizes: [0; TABLES],
        }
    }

    /// With `items` as one of the tables.
    #[must_use]
    pub fn with<T>(mut self, table: usize, items: &[T]) -> Self {
        self.starts[table] = items.as_ptr().addr();
        self.sizes[table] = size_of::<T>();
        self
    }

    /// Asks for an item.
    #[inline(always)]
    pub fn fetch(&self, table: usize, item: usize) {
        #[cfg(target_arch = "x86_64")]
        {
            use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
            let start = self.starts[table].wrapping_add(self.sizes[table].wrapping_mul(item));
            for line in 0..LINES {
                let address = std::ptr::without_provenance::<i8>(start.wrapping_add(64 * line));
                // SAFETY: the instruction is part of every x86_64, and may be given any address: the program sees nothing of it.
                unsafe { _mm_prefetch::<_MM_HINT_T0>(address) };
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        let _ = (table, item);
    }
}
