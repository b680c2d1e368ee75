//! Where layers are summed.
//!
//! A film for every group and layer would take G · N times what a film does. So each layer has one film of pixels, to which all groups
//! add, and each group one of block means, which its error is taken from.

use super::Layers;
use crate::color::Rgb;
use crate::film::{BlockGrid, FilmError, GroupFilm, SavedFilmError, Splat};
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Splats handed to films at a time.
const BATCH: usize = 256;

/// The films of all layers.
pub struct LayerFilms {
    /// One layer below the other.
    pixels: Mutex<GroupFilm>,
    /// By group; one layer below the other, and of each a pixel for every block.
    blocks: Box<[Mutex<GroupFilm>]>,
    grid: BlockGrid,
}

impl LayerFilms {
    /// Empty films of pictures of `grid`'s size, for so many groups.
    ///
    /// # Errors
    /// Where they do not fit into memory.
    pub fn new(layers: &Layers, grid: BlockGrid, groups: u32) -> Result<Self, FilmError> {
        let ((width, height), layers) = (grid.size(), layers.len() as u32);
        let too_large = || FilmError::TooLarge {
            width,
            height,
            bytes: Self::bytes(layers as usize, (width, height)),
        };
        let rows = height.checked_mul(layers).ok_or_else(too_large)?;
        let blocks = (0..groups).map(|_| GroupFilm::new(grid.blocks() as u32, layers).map(Mutex::new));
        Ok(Self {
            pixels: Mutex::new(GroupFilm::new(width, rows)?),
            blocks: blocks.collect::<Result<_, _>>()?,
            grid,
        })
    }

    /// The memory that the pixels of so many layers take.
    #[must_use]
    pub const fn bytes(layers: usize, (width, height): (u32, u32)) -> u64 {
        GroupFilm::bytes(width, height).saturating_mul(layers as u64)
    }

    /// Groups that they are for.
    #[must_use]
    pub const fn groups(&self) -> usize {
        self.blocks.len()
    }

    /// To add splats of `group`, each times `weight` where pixels are summed. Others wait until it is dropped.
    pub fn writer(&self, group: usize, weight: f32) -> LayerWriter<'_> {
        LayerWriter {
            pixels: locked(&self.pixels),
            blocks: locked(&self.blocks[group]),
            grid: &self.grid,
            weight,
            batches: [Vec::with_capacity(BATCH), Vec::with_capacity(BATCH)],
        }
    }

    /// The sums of a layer's pixels, row by row.
    pub fn sums(&self, layer: usize) -> impl Iterator<Item = [f64; 3]> + use<'_> {
        let (width, height) = self.grid.size();
        let first = layer as u32 * width * height;
        let film = locked(&self.pixels);
        (first..first + width * height).map(move |pixel| film.sum(pixel))
    }

    /// A group's sums over the pixels of every block and channel (number 3 · block + channel), over the number of the block's pixels, times
    /// `scale`.
    #[must_use]
    pub fn block_means(&self, group: usize, layer: usize, scale: f64) -> Vec<f64> {
        let film = locked(&self.blocks[group]);
        let mean = |block: usize| {
            let count = f64::from(self.grid.pixel_count(block)).max(1.0);
            film.sum((layer * self.grid.blocks() + block) as u32)
                .map(|sum| sum / count * scale)
        };
        (0..self.grid.blocks()).flat_map(mean).collect()
    }

    /// The magnitudes of all channels of a layer, summed over all blocks and groups.
    #[must_use]
    pub fn light(&self, layer: usize) -> f64 {
        let blocks: Range<u32> = 0..self.grid.blocks() as u32;
        let first = layer as u32 * blocks.end;
        let of_film = |film: &Mutex<GroupFilm>| {
            let film = locked(film);
            let sums = blocks.clone().flat_map(|block| film.sum(first + block));
            sums.map(f64::abs).sum::<f64>()
        };
        self.blocks.iter().map(of_film).sum()
    }

    /// All films in bytes, one after another.
    #[must_use]
    pub fn save(&self) -> Vec<Vec<u8>> {
        let films = std::iter::once(&self.pixels).chain(&self.blocks);
        let saved = films.map(|film| {
            let mut bytes = Vec::new();
            locked(film).save(&mut bytes);
            bytes
        });
        saved.collect()
    }

    /// Takes up what [`save`](Self::save) gave; `next` hands over one film after another.
    ///
    /// # Errors
    /// What `next` refuses, films that are damaged, and `E::default()` for films of another size.
    pub fn restore<'a, E: From<SavedFilmError>>(
        &self,
        mut next: impl FnMut() -> Result<&'a [u8], E>,
        damaged: impl Fn() -> E,
    ) -> Result<(), E> {
        for film in std::iter::once(&self.pixels).chain(&self.blocks) {
            let restored = GroupFilm::load(next()?)?;
            let mut film = locked(film);
            if (restored.width(), restored.height()) != (film.width(), film.height()) {
                return Err(damaged());
            }
            *film = restored;
        }
        Ok(())
    }
}

/// A lock that another thread panicked under still holds valid sums.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Adds splats to the films of layers.
pub struct LayerWriter<'a> {
    pixels: MutexGuard<'a, GroupFilm>,
    blocks: MutexGuard<'a, GroupFilm>,
    grid: &'a BlockGrid,
    weight: f32,
    /// What waits to be added to pixels, and to blocks.
    batches: [Vec<Splat>; 2],
}

impl LayerWriter<'_> {
    /// Adds `value` to a layer at a pixel.
    #[inline]
    pub fn put(&mut self, layer: usize, pixel: u32, value: Rgb) {
        let (width, height) = self.grid.size();
        let Some(block) = self.grid.block_of(pixel) else {
            return;
        };
        let block = layer * self.grid.blocks() + block;
        let splats = [
            (layer as u32 * width * height + pixel, value * self.weight),
            (block as u32, value),
        ];
        for (batch, (pixel, value)) in self.batches.iter_mut().zip(splats) {
            batch.push(Splat { pixel, value });
        }
        if self.batches[0].len() == BATCH {
            self.flush();
        }
    }

    fn flush(&mut self) {
        self.pixels.add(&self.batches[0]);
        self.blocks.add(&self.batches[1]);
        self.batches.iter_mut().for_each(Vec::clear);
    }
}

impl Drop for LayerWriter<'_> {
    fn drop(&mut self) {
        self.flush();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splats_reach_their_layer_their_pixel_and_their_block() {
        let layers = Layers::new([("seen", "CL"), ("direct", "CDL")]).expect("expressions");
        let films = LayerFilms::new(&layers, BlockGrid::new(4, 2, 2), 2).expect("small films");
        for (group, weight) in [(0, 1.0), (1, 0.5)] {
            let mut writer = films.writer(group, weight);
            for pixel in 0..8 {
                writer.put(1, pixel, Rgb::splat(pixel as f32));
            }
            writer.put(2, 0, Rgb::new(4.0, 0.0, 0.0));
            writer.put(0, 8, Rgb::ONE);
        }
        let sums = |layer| films.sums(layer).map(|sum| sum[0]).collect::<Vec<_>>();
        assert_eq!(sums(0), [0.0; 8], "no such pixel");
        assert_eq!(sums(1), [0.0, 1.5, 3.0, 4.5, 6.0, 7.5, 9.0, 10.5]);
        assert_eq!(sums(2)[0], 6.0);
        // Blocks of two by one: pixels 0 and 1, 2 and 3, …
        let means = films.block_means(1, 1, 2.0);
        assert_eq!(
            means.iter().step_by(3).copied().collect::<Vec<_>>(),
            [1.0, 5.0, 9.0, 13.0]
        );
        assert_eq!((films.light(0), films.light(1), films.light(2)), (0.0, 168.0, 8.0));
        let again = LayerFilms::new(&layers, BlockGrid::new(4, 2, 2), 2).expect("small films");
        let saved = films.save();
        let mut saved = saved.iter();
        let damaged = || SavedFilmError::Damaged { what: "its size" };
        let next = || saved.next().map(Vec::as_slice).ok_or_else(damaged);
        again.restore(next, damaged).expect("what was saved");
        assert_eq!((again.light(1), again.sums(2).next()), (168.0, Some([6.0, 0.0, 0.0])));
    }
}
