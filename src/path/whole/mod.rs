//! Whole paths x₀ … xₖ, as chains in path space keep them: what they bring, and how likely every strategy finds them.
//!
//! **The measure of path space is that of bidirectional path tracing.** A mutation accepts by
//! f(y) T(y→x) / (f(x) T(x→y)), with f and T in the same measure, whatever it is (Veach 1997, §11.2.1). Per area f is a product of
//! as many geometry terms as a path has edges, and T another one: numbers without a scale, where what matters is their ratio. So
//! both are taken relative to r = Σ p₍ₛ,ₜ₎, the sum of the densities of all strategies of bidirectional path tracing (Veach's
//! balance heuristic, §9.2.2):
//!
//! - the target f / r is what one path brings to the picture, weighed; its integral is the picture's light, and all its values are
//!   of that order;
//! - what a strategy draws has the density p₍ₛ,ₜ₎ / r: its [weight](Measured::share), between 0 and 1. A mutation that keeps the
//!   first t₀ and the last s₀ vertices and draws those between them anew in several ways has the sum of their weights, times the
//!   chances of choosing them; the densities of the vertices that are kept are the same both ways, and cancel.
//!
//! No product of densities ever stands alone: ratios are made of [`Scaled`] numbers.

mod columns;
mod film_place;
mod form;
mod joint;
mod jumps;
mod lengths;
mod replacement;
mod scaled;
mod starts;
mod strategies;
mod vertex;

pub use columns::*;
pub use film_place::FilmPlace;
pub use form::{CAUSTIC_TRAIT, CHAIN_TRAIT, LENS_TRAIT, PathForm};
pub(crate) use form::{camera_vertices, light_vertices};
pub use joint::{complete, joining, segment};
pub use jumps::{Sizes, aside, jump, tilt};
pub use lengths::{Lengths, StrategyChoice};
pub use replacement::{Deletion, Growth, Replacement};
pub use scaled::Scaled;
pub use starts::{CameraStart, LightStart};
pub use strategies::{Measured, WholePath};
pub use vertex::{Passage, WholeVertex};
