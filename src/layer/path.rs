//! The layer of a path, from its vertices.

use super::{End, LayerState, Layers};
use crate::light::Endpoint;
use crate::material::Event;
use crate::path::VERTEX_DISCRETE;
use crate::path::measure::Site;
use crate::scene::Scene;
use glam::Vec3;

impl From<Endpoint> for End {
    fn from(endpoint: Endpoint) -> Self {
        match endpoint {
            Endpoint::Surface => Self::Shape,
            Endpoint::Point => Self::Point,
            Endpoint::Infinite => Self::Infinity,
        }
    }
}

/// A vertex of a path, as far as layers need to know.
#[derive(Clone, Copy, Debug)]
pub struct Stop {
    /// Where it is, and of which kind.
    pub site: Site,
    /// Its material; of ends without meaning.
    pub material: u32,
}

/// The direction from one vertex to the next, of any length.
fn direction(from: &Site, to: &Site) -> Vec3 {
    if to.is_infinite() {
        -to.normal
    } else if from.is_infinite() {
        from.normal
    } else {
        to.position - from.position
    }
}

/// What scattering at `here` is, of a path that comes from `before` and goes on to `after`.
#[must_use]
pub fn event(scene: &Scene, before: &Site, here: &Stop, after: &Site) -> Event {
    let normal = here.site.normal;
    let (arriving, leaving) = (
        normal.dot(direction(before, &here.site)),
        normal.dot(direction(&here.site, after)),
    );
    let transmits = (arriving > 0.0) == (leaving > 0.0);
    let discrete = here.site.kind == VERTEX_DISCRETE;
    scene.materials.kind(here.material).event(discrete, transmits)
}

impl Layers {
    /// The layer of the path x₀ … xₖ, k being `edges`, that ends on a light of this kind.
    #[must_use]
    pub fn of_path(&self, scene: &Scene, edges: usize, end: End, vertex: impl Fn(usize) -> Stop) -> usize {
        let mut state = LayerState::CAMERA;
        for i in 1..edges {
            let (before, here, after) = (vertex(i - 1), vertex(i), vertex(i + 1));
            state = self.then(state, event(scene, &before.site, &here, &after.site));
        }
        self.end(state, end)
    }
}
