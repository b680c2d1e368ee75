//! Cameras: from a point on the film to a ray into the scene. One file per model.

mod perspective;

pub use perspective::Perspective;
