//! Materials: how surfaces scatter light. One file per model, whose head is its manual; one table per model.
//!
//! **Spaces and signs.** A model works in the local frame of the shading normal ([`Frame`]): z is the normal. `wi`
//! points from the surface towards where the path comes from, `wo` towards where it goes on; both point away from the
//! surface. Values are radiance transport from the camera: light that arrives along `wo` leaves along `wi`.
//!
//! **Measures.** A model either has a density per solid angle (and is evaluated for any pair of directions), or it is
//! discrete: it scatters into a few directions alone, has no value for a given pair, and its `density` is the
//! probability of the direction it took. Models may have lobes of both kinds.

pub mod conductor;
pub mod dielectric;
pub mod diffuse;
mod event;
mod frame;
pub mod fresnel;
mod list;
pub mod metals;
pub mod microfacet;
mod model;
pub mod plastic;
pub mod rough_conductor;
pub mod rough_dielectric;
mod table;
pub mod two_sided;

pub use event::{Event, Lobe};
pub use frame::Frame;
pub(crate) use list::for_each_material;
pub use model::{DiscreteLobe, Evaluated, Model, ScatterDraw, Scattered, Transport};
pub use table::{InTable, KINDS, MaterialKind, MaterialTable, Needs};
