//! Where systems write what a proposal keeps of a path, and how its subpaths begin.

use super::super::super::tile::{Queues, TilePlace};
use super::moves_paths::PathProposal;
use super::view::PathView;
use crate::path::whole::{
    CameraVertices, KeptFromCamera, KeptFromLight, LightVertices, ProposedPathFilm, STEERED, SteeredOrigin, StopDepth,
    TO_JOINT,
};
use crate::path::{ChainTable, Direction};
use crate::scene::Scene;
use crate::table::{Rows, Write};
use bevy_ecs::system::{ResMut, SystemParam};

/// The columns that say what proposals keep.
#[derive(SystemParam)]
pub struct Ranges<'w, 's> {
    queues: ResMut<'w, Queues>,
    camera_kept: Write<'w, 's, KeptFromCamera, ChainTable>,
    light_kept: Write<'w, 's, KeptFromLight, ChainTable>,
    camera_made: Write<'w, 's, CameraVertices, ChainTable>,
    light_made: Write<'w, 's, LightVertices, ChainTable>,
    stops: Write<'w, 's, StopDepth, ChainTable>,
    directions: Write<'w, 's, Direction, ChainTable>,
    film: Write<'w, 's, ProposedPathFilm, ChainTable>,
    origins: Write<'w, 's, SteeredOrigin, ChainTable>,
}

/// [`Ranges`] as slices.
pub struct RangeColumns<'a> {
    queues: &'a mut Queues,
    camera_kept: &'a mut [KeptFromCamera],
    light_kept: &'a mut [KeptFromLight],
    camera_made: &'a mut [CameraVertices],
    light_made: &'a mut [LightVertices],
    stops: &'a mut [StopDepth],
    directions: &'a mut [Direction],
    film: &'a mut [ProposedPathFilm],
    origins: &'a mut [SteeredOrigin],
}

impl Ranges<'_, '_> {
    /// The columns as slices.
    pub fn columns(&mut self) -> RangeColumns<'_> {
        RangeColumns {
            queues: &mut self.queues,
            camera_kept: self.camera_kept.rows(),
            light_kept: self.light_kept.rows(),
            camera_made: self.camera_made.rows(),
            light_made: self.light_made.rows(),
            stops: self.stops.rows(),
            directions: self.directions.rows(),
            film: self.film.rows(),
            origins: self.origins.rows(),
        }
    }
}

impl RangeColumns<'_> {
    /// Writes a chain's proposal, and the path that it is made of; `None` where its mutation proposes nothing.
    ///
    /// # Panics
    /// A proposal that does not [fit](PathProposal::fits) the path.
    pub fn put(
        &mut self,
        scene: &Scene,
        place: &TilePlace,
        chain: usize,
        proposal: Option<(PathProposal, PathView<'_>)>,
    ) {
        let Some((proposal, path)) = proposal else {
            self.camera_made.put(chain, 0);
            return;
        };
        assert!(
            proposal.fits(path.edges, path.longest()),
            "a mutation proposes {proposal:?} of a path with {} edges, where paths have up to {}",
            path.edges,
            path.longest()
        );
        let light_path = place.lights_from as usize + chain;
        let PathProposal {
            kept,
            made,
            to_joint,
            film,
            light,
        } = proposal;
        self.camera_kept.put(chain, kept[0]);
        self.light_kept.put(chain, kept[1]);
        self.camera_made.put(chain, made[0]);
        self.light_made.put(chain, made[1]);
        let steered = |steered: bool| if steered { STEERED } else { 0 };
        let flags = [
            steered(film.is_some()) | if to_joint { TO_JOINT } else { 0 },
            steered(light.is_some()),
        ];
        for (end, number) in [chain, light_path].into_iter().enumerate() {
            let depth = made[end].saturating_sub(1);
            // What seldom gets so deep makes room as it goes.
            let sure = if flags[end] & TO_JOINT != 0 { kept[end] } else { depth };
            self.queues.deepest = self.queues.deepest.max(sure);
            self.stops.put(number, depth | flags[end]);
        }
        if let Some(film) = film {
            self.film.put(chain, film);
            let ray = scene.camera.ray_from(path.position(0), film);
            self.directions.put(chain, ray.direction);
        }
        if let Some(light) = light {
            self.directions.put(light_path, light.direction);
            if !self.origins.is_empty() {
                self.origins.put(chain, light.origin);
            }
        }
    }
}
