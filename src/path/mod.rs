//! Paths: the columns they are stored in, and the weights by which techniques share them.
//!
//! A path is x₀ x₁ … xₖ with k edges. **x₀ is on the lens**, xₖ on a light: a vertex's depth is the number of edges
//! between it and the camera.

pub mod bidirectional;
mod columns;
mod direct;
mod draws;
mod film_position;
pub mod measure;
pub mod mis;
mod primary;
pub mod roulette;
mod scatterer;
mod states;
pub mod whole;

pub use columns::*;
pub use direct::{Sought, is_direct};
pub use draws::{
    CoordinateSet, FilmCoordinates, KeyedDraws, LENS_CENTER, LIGHT_SUBPATH, LightDraw, PathDraws, VertexCoordinates,
};
pub use film_position::{film_position, pixel_of};
pub use primary::*;
pub use scatterer::{Connection, Scatterer};
pub use states::*;
