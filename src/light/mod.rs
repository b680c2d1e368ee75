//! Lights: what emits, how a light and a point on it are chosen, and with what density.
//!
//! One row per emitting primitive (a triangle or a sphere), chosen in proportion to its power. Emission is one-sided:
//! along the geometric normal's side, the same radiance in every direction.

mod sphere;
mod table;
mod triangle;

pub use table::{Emitter, LightSample, LightTable};
