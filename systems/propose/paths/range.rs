//! What a mutation of whole paths says of its proposal: which ends of the current path it keeps, and how many vertices the two
//! subpaths are to have.

use super::super::super::tile::Queues;
use crate::path::ChainTable;
use crate::path::whole::{CameraVertices, KeptFromCamera, KeptFromLight, LightVertices, STEERED, StopDepth};
use crate::table::{Rows, Write};
use bevy_ecs::system::{ResMut, SystemParam};

use super::super::super::tile::TilePlace;

/// The ends of a path x₀ … xₖ that a proposal keeps, and the subpaths that it is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathRange {
    /// t₀ and s₀: vertices that are kept from the camera, and from the light.
    pub kept: [u32; 2],
    /// t and s: vertices of the subpaths, at least as many as are kept. Where s is 1 and nothing is kept from the light, the light
    /// is chosen as seen from the last vertex of the camera subpath; where it is 0, the camera subpath is to meet one.
    pub made: [u32; 2],
    /// Whether the mutation says in which directions the subpath from the camera goes, or that from the light; else materials draw
    /// them.
    pub steered: [bool; 2],
}

/// The columns of ranges.
#[derive(SystemParam)]
pub struct Ranges<'w, 's> {
    queues: ResMut<'w, Queues>,
    camera_kept: Write<'w, 's, KeptFromCamera, ChainTable>,
    light_kept: Write<'w, 's, KeptFromLight, ChainTable>,
    camera_made: Write<'w, 's, CameraVertices, ChainTable>,
    light_made: Write<'w, 's, LightVertices, ChainTable>,
    stops: Write<'w, 's, StopDepth, ChainTable>,
}

impl Ranges<'_, '_> {
    /// Writes the range of a chain's proposal.
    pub fn put(&mut self, place: &TilePlace, chain: usize, range: PathRange) {
        let [camera, light] = range.made;
        self.camera_kept.rows().put(chain, range.kept[0]);
        self.light_kept.rows().put(chain, range.kept[1]);
        self.camera_made.rows().put(chain, camera);
        self.light_made.rows().put(chain, light);
        let stops = self.stops.rows();
        for (path, made, steered) in [
            (chain, camera, range.steered[0]),
            (place.lights_from as usize + chain, light, range.steered[1]),
        ] {
            let depth = made.saturating_sub(1);
            self.queues.deepest = self.queues.deepest.max(depth);
            stops.put(path, if steered { depth | STEERED } else { depth });
        }
    }

    /// Says that the mutation proposes nothing for a chain: its state is none that it can start from.
    pub fn none(&mut self, chain: usize) {
        self.camera_made.rows().put(chain, 0);
    }
}
