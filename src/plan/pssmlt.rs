//! What primary-sample-space Metropolis light transport needs: the trace stage of the technique that it runs over, fed with the
//! coordinates of chains.

use super::bidirectional::BothEnds;
use super::chains::StateSystems;
use super::effect::{EffectPlan, is_on};
use super::path_tracing;
use super::table::{Extent, TableId, TablePlan};
use super::tile::Subpaths;
use super::{Effect, SystemPlan};
use crate::path::*;
use crate::scene::Scene;
use crate::systems::list::*;

/// The systems and tables of states over path tracing.
pub(super) fn over_path_tracing(scene: &Scene, effects: &[EffectPlan]) -> StateSystems {
    let of_samples = [ASSIGN_PIXELS, ACCEPT_ALWAYS, SPLAT_SAMPLES];
    let mut systems = path_tracing::systems(scene, effects, scene.max_depth);
    systems.retain(|system| !of_samples.contains(&system.spec));
    systems.push(SystemPlan::new(EVALUATE_TARGETS, "chains sample in proportion to it"));
    let mut tables = path_tracing::tables(scene, effects, scene.max_depth);
    tables[0]
        .column::<FilmPixel>("the pixel that the proposal reaches")
        .column::<Contribution>("the proposal's light")
        .column::<ProposedSplatCount>("splats of the proposal");
    let splats = |id| {
        let mut table = TablePlan::new(id, Extent::PerChain(1));
        table
            .column::<SplatPixel>("where on the film")
            .column::<SplatColor>("the share of the target, by colour");
        table
    };
    tables.push(splats(TableId::PROPOSED_SPLATS));
    tables.push(splats(TableId::SPLATS).holding_state());
    let set = CoordinateTables {
        scene,
        subpaths: Subpaths::Camera,
        lights: is_on(effects, Effect::DirectLight),
        starts: scene.camera.has_aperture(),
        exists: path_tracing::scatters(effects) || scene.camera.has_aperture(),
    };
    states(set, systems, tables)
}

/// The systems and tables of states over bidirectional path tracing: a state is a pair of subpaths, and what it brings a list
/// of splats.
pub(super) fn over_bidirectional(both: &BothEnds<'_>) -> StateSystems {
    let mut systems = both.tracing();
    systems.push(SystemPlan::new(EVALUATE_LISTS, "chains sample in proportion to it"));
    let chains = TablePlan::new(TableId::CHAINS, Extent::PerChain(1));
    let mut tables = both.with_tracing(chains);
    tables[0].column::<BrightestLight>("a state's classes are those of its brightest path");
    if let Some(rays) = tables.iter_mut().find(|table| table.id == TableId::RAYS) {
        rays.column::<SegmentClass>("a state's classes are those of its brightest path");
    }
    tables.push(both.lists(TableId::SPLATS).holding_state());
    let set = CoordinateTables {
        scene: both.scene,
        subpaths: both.subpaths,
        lights: true,
        starts: true,
        exists: true,
    };
    states(set, systems, tables)
}

/// Which primary coordinates states have.
struct CoordinateTables<'a> {
    scene: &'a Scene,
    subpaths: Subpaths,
    /// Whether vertices have those that choose points on lights.
    lights: bool,
    /// Whether subpaths have some before their first vertex.
    starts: bool,
    /// Whether there are any beside those of the film.
    exists: bool,
}

/// Adds what states need, whatever they are traced with.
fn states(set: CoordinateTables<'_>, mut systems: Vec<SystemPlan>, mut tables: Vec<TablePlan>) -> StateSystems {
    systems.extend([
        SystemPlan::new(TAKE_COORDINATES, "accepted proposals become states"),
        SystemPlan::new(SPLAT_STATES, "both states of a decision go to the film"),
        SystemPlan::new(TAKE_SPLATS, "accepted proposals become states"),
    ]);
    if set.starts {
        // Behind those that end paths: in the first round there are none.
        for (early, drawn) in [
            (START_CAMERA_PATHS, START_CAMERA_PATHS_DRAWN),
            (START_LIGHT_PATHS, START_LIGHT_PATHS_DRAWN),
        ] {
            if let Some(place) = systems.iter().position(|system| system.spec == early) {
                let reason = systems.remove(place).reason;
                systems.push(SystemPlan::new(drawn, reason));
            }
        }
        if systems.iter().any(|system| system.spec == TRACE_LOOP) {
            systems.push(SystemPlan::new(
                LIST_STARTS,
                "subpaths start where their coordinates say",
            ));
        }
    }
    let chains = &mut tables[0];
    chains
        .column::<PrimaryFilm>("where the current path starts")
        .column::<ProposedFilm>("where the proposal starts")
        .column::<PrimaryDepth>("where the current path's coordinates end")
        .column::<ProposedDepth>("where the proposal's coordinates end")
        .column::<SplatCount>("splats of the current state");
    if set.exists {
        chains.column::<DrawList>("vertices that wait for coordinates");
        tables.push(set.table(TableId::PRIMARY).holding_state());
        tables.push(set.table(TableId::PROPOSED_PRIMARY));
    }
    StateSystems {
        before: Vec::new(),
        systems,
        tables,
        subpaths: set.subpaths,
    }
}

impl CoordinateTables<'_> {
    /// A table of coordinates: for every vertex that may scatter, and for starts.
    fn table(&self, id: TableId) -> TablePlan {
        let last = self.scene.max_depth - 1;
        let mut table = TablePlan::new(id, Extent::from_depth(u32::from(!self.starts), last));
        table.column::<PrimaryScatter>("where the vertex scatters to");
        if self.lights {
            table
                .column::<PrimaryChoice>("which light it is connected to")
                .column::<PrimaryLight>("where on the light");
        }
        if self.scene.materials.choose_lobes() {
            table.column::<PrimaryLobe>("which lobe of a material it scatters into");
        }
        if last >= roulette::FIRST_DEPTH {
            table.column::<PrimaryRoulette>("whether the path goes on");
        }
        table
    }
}
