//! The bounds of single values, each once: validation holds scenes against them, and the schema tells editors.
//!
//! Bounds of coordinates are [`MAX_COORDINATE`](super::mesh::MAX_COORDINATE), those of films and depths stand with their
//! descriptions, that of roughness in [`crate::tolerance`].

/// The largest radiance, and the largest factor of one: with it, the power of an emitter of any allowed size stays finite
/// in `f32`. It bounds intensities and irradiances too.
pub(super) const MAX_RADIANCE: f32 = 1.0e12;
/// The smallest cutoff of a spot in degrees: narrower, a direction in `f32` does not tell its centre from its rim.
pub(super) const MIN_CUTOFF: f32 = 1.0e-3;
/// The largest cutoff of a spot in degrees.
pub(super) const MAX_CUTOFF: f32 = 90.0;
/// The largest turn of a picture in degrees, either way.
pub(super) const MAX_TURN: f32 = 36_000.0;
/// The largest angle of a rotation in degrees, either way.
pub(super) const MAX_ROTATION: f32 = 1.0e6;
/// The least and the largest index of refraction of a clear medium.
pub(super) const IOR: [f32; 2] = [0.1, 10.0];
/// The largest index of refraction or absorption coefficient of a conductor.
pub(super) const MAX_CONDUCTOR_INDEX: f32 = 1000.0;
/// How near to 0 and to 180 degrees an angle of view may come.
pub(super) const FOV_MARGIN: f32 = 1.0e-4;
/// The smallest radius of a lens, distance of its focus, or height of a film's image: the area of a film of 65536 x 1
/// pixels and one over it stay in the range of `f32`.
pub(super) const MIN_LENS_LENGTH: f32 = 1.0e-9;
/// The least and the largest radius of a reconstruction filter, in pixels: a smaller one would lose light between them.
pub(super) const FILTER_RADIUS: [f32; 2] = [0.5, 16.0];
/// The least and the largest standard deviation of a Gaussian filter, in pixels.
pub(super) const FILTER_SIGMA: [f32; 2] = [0.05, 16.0];
/// The largest number of cells or pictures per unit of texture coordinates.
pub(super) const MAX_TEXTURE_SCALE: f32 = 1.0e6;
/// The least and the largest number of segments of a torus in one direction.
pub(super) const SEGMENTS: [u32; 2] = [3, 16_384];
/// The fewest rows of a height field, and heights in a row.
pub(super) const MIN_HEIGHTS: usize = 2;
