//! What primary-sample-space Metropolis light transport needs: path tracing's own trace stage, fed with the coordinates of
//! chains.

use super::chains::StateSystems;
use super::effect::{EffectPlan, is_on};
use super::path_tracing;
use super::table::{Extent, TableId, TablePlan};
use super::{Effect, SystemPlan};
use crate::path::*;
use crate::scene::Scene;
use crate::systems::list::*;

/// The systems and tables of states in primary sample space.
pub(super) fn states(scene: &Scene, effects: &[EffectPlan]) -> StateSystems {
    StateSystems {
        systems: systems(scene, effects),
        tables: tables(scene, effects),
    }
}

fn systems(scene: &Scene, effects: &[EffectPlan]) -> Vec<SystemPlan> {
    let of_samples = [ASSIGN_PIXELS, ACCEPT_ALWAYS, SPLAT_SAMPLES];
    let mut systems = path_tracing::systems(scene, effects);
    systems.retain(|system| !of_samples.contains(&system.spec));
    systems.extend([
        SystemPlan::new(EVALUATE_TARGETS, "chains sample in proportion to it"),
        SystemPlan::new(TAKE_COORDINATES, "accepted proposals become states"),
        SystemPlan::new(SPLAT_STATES, "both states of a decision go to the film"),
        SystemPlan::new(TAKE_SPLATS, "accepted proposals become states"),
    ]);
    systems
}

fn tables(scene: &Scene, effects: &[EffectPlan]) -> Vec<TablePlan> {
    let mut tables = path_tracing::tables(scene, effects);
    let chains = &mut tables[0];
    chains
        .column::<FilmPixel>("the pixel that the proposal reaches")
        .column::<Contribution>("the proposal's light")
        .column::<PrimaryFilm>("where the current path starts")
        .column::<ProposedFilm>("where the proposal starts")
        .column::<PrimaryDepth>("where the current path's coordinates end")
        .column::<ProposedDepth>("where the proposal's coordinates end")
        .column::<SplatCount>("splats of the current state")
        .column::<ProposedSplatCount>("splats of the proposal");
    let scatters = path_tracing::scatters(effects);
    if scatters {
        chains.column::<DrawList>("vertices that wait for coordinates");
    }
    let splats = |id| {
        let mut table = TablePlan::new(id, Extent::PerChain(1));
        table
            .column::<SplatPixel>("where on the film")
            .column::<SplatColor>("the share of the target, by colour");
        table
    };
    tables.push(splats(TableId::SPLATS).holding_state());
    tables.push(splats(TableId::PROPOSED_SPLATS));
    if scatters {
        tables.push(coordinates(TableId::PRIMARY, scene, effects).holding_state());
        tables.push(coordinates(TableId::PROPOSED_PRIMARY, scene, effects));
    }
    tables
}

/// A table of vertex coordinates: for every vertex that may scatter.
fn coordinates(id: TableId, scene: &Scene, effects: &[EffectPlan]) -> TablePlan {
    let last = scene.max_depth - 1;
    let mut table = TablePlan::new(id, Extent::from_depth(1, last));
    table.column::<PrimaryScatter>("where the vertex scatters to");
    if is_on(effects, Effect::DirectLight) {
        table
            .column::<PrimaryChoice>("which light it is connected to")
            .column::<PrimaryLight>("where on the light");
    }
    if scene.materials.choose_lobes() {
        table.column::<PrimaryLobe>("which lobe of a material it scatters into");
    }
    if last >= roulette::FIRST_DEPTH {
        table.column::<PrimaryRoulette>("whether the path goes on");
    }
    table
}
