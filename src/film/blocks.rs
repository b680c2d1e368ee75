//! A film in blocks: nearly equal rectangles, over which chains are judged.
//!
//! Single pixels of a chain are mostly black, and what is left is far from normal; means over blocks are near enough to it
//! for intervals and tests.

use super::tally::FilmError;
use std::ops::Range;

/// How a film is split into rectangles: columns of blocks times rows of blocks, row-major, the first at the top left.
///
/// # Example
/// ```
/// use chainlight::film::BlockGrid;
///
/// let grid = BlockGrid::new(128, 96, 8);
/// assert_eq!((grid.blocks(), grid.block_of(0), grid.block_of(128 * 96)), (64, Some(0), None));
/// assert_eq!(grid.name(35), "block (3, 4): x 48..64, y 48..60");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockGrid {
    width: u32,
    height: u32,
    columns: u32,
    rows: u32,
}

impl BlockGrid {
    /// The grid over a film of `width` by `height` pixels with as many blocks a side as `at_most_per_side` allows, never
    /// fewer than one nor more than pixels. Sides of blocks differ by one pixel at most. There are no blocks where
    /// there can be no film: without pixels, or with more than 32 bits count.
    #[must_use]
    pub fn new(width: u32, height: u32, at_most_per_side: u32) -> Self {
        let film = u32::try_from(u64::from(width) * u64::from(height)).is_ok_and(|pixels| pixels > 0);
        let most = if film { at_most_per_side.max(1) } else { 0 };
        Self {
            width,
            height,
            columns: most.min(width),
            rows: most.min(height),
        }
    }

    /// Width and height of the film, in pixels.
    #[must_use]
    pub const fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The number of blocks.
    #[must_use]
    pub const fn blocks(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// The block that a pixel, a row-major index, lies in; none where the film has no such pixel.
    #[must_use]
    pub fn block_of(&self, pixel: u32) -> Option<usize> {
        if self.blocks() == 0 {
            return None;
        }
        let (x, y) = (pixel % self.width, pixel / self.width);
        let (column, row) = (
            part_of(x, self.width, self.columns)?,
            part_of(y, self.height, self.rows)?,
        );
        Some(row as usize * self.columns as usize + column as usize)
    }

    /// The columns and rows of pixels that a block spans: x, then y; empty for a block that there is not.
    #[must_use]
    pub fn bounds(&self, block: usize) -> (Range<u32>, Range<u32>) {
        let Some((column, row)) = self.place(block) else {
            return (0..0, 0..0);
        };
        (
            part(column, self.width, self.columns),
            part(row, self.height, self.rows),
        )
    }

    /// The pixels of a block, as row-major indices in order; none for a block that there is not.
    pub fn pixels_in(&self, block: usize) -> impl Iterator<Item = u32> + use<> {
        let (columns, rows) = self.bounds(block);
        let width = self.width;
        rows.flat_map(move |y| columns.clone().map(move |x| y * width + x))
    }

    /// The number of pixels of a block.
    #[must_use]
    pub fn pixel_count(&self, block: usize) -> u32 {
        let (columns, rows) = self.bounds(block);
        columns.len() as u32 * rows.len() as u32
    }

    /// A block's name for reports: its column and row, and the pixels it spans.
    #[must_use]
    pub fn name(&self, block: usize) -> String {
        let Some((column, row)) = self.place(block) else {
            return format!("no block {block} of {}", self.blocks());
        };
        let (x, y) = self.bounds(block);
        format!(
            "block ({column}, {row}): x {}..{}, y {}..{}",
            x.start, x.end, y.start, y.end
        )
    }

    /// Refuses a film or picture of another size.
    pub(super) fn check(&self, size: (u32, u32)) -> Result<(), FilmError> {
        if size == self.size() {
            return Ok(());
        }
        Err(FilmError::SizesDiffer {
            first: size,
            second: self.size(),
        })
    }

    fn place(&self, block: usize) -> Option<(u32, u32)> {
        let columns = self.columns as usize;
        (block < self.blocks()).then(|| ((block % columns) as u32, (block / columns) as u32))
    }
}

/// What part `i` of `n` nearly equal ones spans of `length`.
fn part(i: u32, length: u32, n: u32) -> Range<u32> {
    // At most `length`, so it fits.
    let start = |i: u32| (u64::from(i) * u64::from(length) / u64::from(n)) as u32;
    start(i)..start(i + 1)
}

/// The part that `x` lies in: the last one that starts at `x` or before.
fn part_of(x: u32, length: u32, n: u32) -> Option<u32> {
    (x < length).then(|| (((u64::from(x) + 1) * u64::from(n) - 1) / u64::from(length)) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: [(u32, u32, u32); 9] = [
        (1, 1, 16),
        (128, 96, 16),
        (97, 53, 7),
        (5, 300, 16),
        (300, 5, 16),
        (17, 16, 16),
        (31, 33, 16),
        (40, 40, 1),
        (3, 2, 0),
    ];

    #[test]
    fn blocks_cover_every_pixel_once() {
        for (width, height, most) in SIZES {
            let grid = BlockGrid::new(width, height, most);
            let mut owner = vec![None; (width * height) as usize];
            for block in 0..grid.blocks() {
                let pixels: Vec<u32> = grid.pixels_in(block).collect();
                assert!(pixels.is_sorted() && pixels.len() == grid.pixel_count(block) as usize);
                for pixel in pixels {
                    assert_eq!(owner[pixel as usize].replace(block), None);
                }
            }
            for (pixel, owner) in (0..).zip(owner) {
                assert!(
                    owner.is_some() && grid.block_of(pixel) == owner,
                    "pixel {pixel} of {width} x {height}"
                );
            }
        }
    }

    #[test]
    fn blocks_are_nearly_equal_and_as_many_as_allowed() {
        for (width, height, most) in SIZES {
            let grid = BlockGrid::new(width, height, most);
            let most = most.max(1);
            assert_eq!(grid.blocks(), (most.min(width) * most.min(height)) as usize);
            for side in [0, 1] {
                let lengths = (0..grid.blocks()).map(|block| {
                    let (x, y) = grid.bounds(block);
                    [x, y][side].len()
                });
                let (least, largest) = lengths.fold((usize::MAX, 0), |(a, b), l| (a.min(l), b.max(l)));
                assert!(least > 0 && largest - least <= 1, "{width} x {height} by {most}");
            }
        }
    }

    #[test]
    fn names_say_where_a_block_lies() {
        let grid = BlockGrid::new(256, 320, 16);
        assert_eq!(grid.name(4 * 16 + 3), "block (3, 4): x 48..64, y 80..100");
        assert_eq!(grid.name(256), "no block 256 of 256");
    }

    #[test]
    fn what_is_not_there_is_in_no_block() {
        let grid = BlockGrid::new(7, 3, 4);
        assert_eq!(
            (grid.block_of(20), grid.block_of(21), grid.block_of(u32::MAX)),
            (Some(11), None, None)
        );
        assert_eq!((grid.pixels_in(12).count(), grid.pixel_count(usize::MAX)), (0, 0));
        for (width, height) in [(0, 5), (5, 0), (0, 0), (1 << 16, 1 << 16), (u32::MAX, u32::MAX)] {
            let grid = BlockGrid::new(width, height, 4);
            assert_eq!((grid.blocks(), grid.block_of(0), grid.pixel_count(0)), (0, None, 0));
        }
    }

    #[test]
    fn the_largest_films_do_not_overflow() {
        let grid = BlockGrid::new(u32::MAX, 1, u32::MAX);
        assert_eq!(grid.block_of(u32::MAX - 1), Some(u32::MAX as usize - 1));
        assert_eq!(grid.bounds(u32::MAX as usize - 1), (u32::MAX - 1..u32::MAX, 0..1));
    }
}
