//! Physics: closed forms and conservation laws that materials, cameras and whole renders must meet. Statistical tests of a
//! file share a chance of a false alarm of one in a hundred; each prints what it could have seen, and is shown to fail on
//! an expectation that is off by 2 %.

mod camera;
mod direct_light;
mod discrete_light;
pub mod enclosure;
mod energy;
mod environment;
mod fresnel;
mod furnace;
mod furnace_smooth;
mod lights;
mod other_renderer;
mod rough;
mod surroundings;
mod textures;
