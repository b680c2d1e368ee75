//! The film: where light is summed, developed into a picture, and written to disk.
//!
//! [`Film`] adds up what paths bring, in integers, so that the sums depend on no order; [`Film::develop`] turns the sums
//! into a [`Picture`] with its standard errors; [`write_exr`] and [`write_png`] put it on disk. Markov chains, whose error is
//! the spread over independent groups, add to a [`GroupFilm`] per group, which [`develop_groups`] puts together and
//! [`block_means`] compares over a [`BlockGrid`]. Films are saved and restored byte for byte ([`Film::save`],
//! [`GroupFilm::save`]). A [`Filter`] says where around a pixel's centre a sample is taken. Nothing is clamped but what a PNG
//! displays.
//!
//! Pixels are row-major: index `y * width + x`, with (0, 0) at the top left, x to the right and y down.

mod accumulate;
mod blocks;
mod develop;
mod develop_groups;
mod exr_channels;
mod exr_file;
mod exr_read;
mod filter;
mod fixed;
mod group_film;
mod layer;
mod metadata;
mod picture;
mod png_file;
mod saved;
mod tally;
mod wide;
mod write;

pub use accumulate::{Film, Splat};
pub use blocks::BlockGrid;
pub use develop_groups::{block_means, block_means_of, block_variances, develop_combined, develop_groups};
pub use exr_file::{encode_exr, write_exr};
pub use exr_read::{ExrPicture, ReadError, damaged, decode_exr, read_exr};
pub use filter::{Filter, FilterError, SIGMA_PER_RADIUS};
pub use group_film::GroupFilm;
pub use layer::{LayerChannels, PictureLayer};
pub use metadata::PictureMetadata;
pub use picture::{ImageView, Picture};
pub use png_file::{ToneMap, encode_png, write_png};
pub use saved::SavedFilmError;
pub use tally::{FilmError, Tally};
pub use write::{WriteError, write_file};
