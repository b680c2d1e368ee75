//! Layers: which light comes by which paths. Light path expressions name classes of paths, and split a picture into layers, one for
//! each class, that sum to it.
//!
//! # Light path expressions
//!
//! A path is written from the camera to the light, a letter or a pair for each of its vertices (Heckbert 1990, and as production
//! renderers write it). An expression is a regular expression over these, and it stands for whole paths: `CDL` is light that one
//! matt surface scatters to the camera.
//!
//! | written | stands for |
//! |---|---|
//! | `C` | the camera: every expression begins with it |
//! | `D`, `G`, `S` | scattering that is diffuse, glossy, or specular: into one of a few directions |
//! | `R`, `T` | reflection, or transmission through a surface |
//! | `<RD>`, `<TS>`, `<.G>`, `<R.>` | both of these at once |
//! | `.` | any scattering |
//! | `L` | any light |
//! | `O`, `P`, `B` | a shape that emits, a light at a point, light from infinity: the background |
//! | `[DG]`, `[^S]` | one of these scatterings or lights, or none of them |
//! | `x*`, `x+`, `x?`, `x{2}`, `x{2,}`, `x{2,4}` | as often as one likes, at least once, at most once, so often |
//! | `(x\|y)` | one or the other |
//!
//! A plastic's matt base is D and its clear coat S; rough metal and rough glass are G, smooth ones S. Interfaces that do nothing are no
//! vertices.
//!
//! A path belongs to the first layer whose expression it matches, and to [`REST`] if there is none. So layers share no path, and every
//! path is in one of them.

mod automaton;
mod columns;
mod expression;
mod film;
mod layers;
mod path;
mod standard;

pub use columns::{
    ConnectionEnd, LayerColor, LayerTable, OWN_LAYERS, ProposedLayerTable, SegmentLayer, SplatLayer,
    VertexConnectionEnd,
};
pub use expression::ExpressionError;
pub use film::{LayerFilms, LayerWriter};
pub use layers::{End, LayerError, LayerState, Layers, REST};
pub use path::{Stop, event};
pub use standard::standard;
