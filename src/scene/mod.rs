//! The scene: from a file on disk to validated, flattened shapes in world space.

mod at;
mod compile;
mod complaint;
pub mod description;
pub mod error;
pub mod flatten;
mod lex;
mod locate;
pub mod mesh;
pub mod read;
mod shapes;
mod syntax;
#[cfg(test)]
mod testing;
pub mod transform;
pub mod validate;

pub use compile::{Scene, SceneOverrides};
pub use description::{
    CameraDescription, FilmDescription, FilterDescription, FovAxis, MaterialDescription, SceneDescription,
    SettingsDescription, ShapeDescription, ShapeKind, TransformStep,
};
pub use error::{SceneError, SceneWarning};
pub use flatten::{Emission, Flattened, Geometry, Instance, flatten};
pub use mesh::{MAX_COORDINATE, Mesh, triangle_cross};
pub use read::{Format, SceneSource, Step, parse_scene, read_scene};
pub use validate::validate;
