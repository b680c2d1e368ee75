//! What Metropolis light transport in path space needs: states are whole paths, and a proposal is made of two subpaths, joined by
//! one edge.

use super::chains::StateSystems;
use super::effect::{EffectPlan, is_on};
use super::path_tracing::{ray_columns, scatter_lists, scatters, surface_columns, walks};
use super::table::{Extent, TableId, TablePlan};
use super::tile::Subpaths;
use super::{Effect, SystemPlan};
use crate::geometry::{SegmentTarget, SegmentTransmittance};
use crate::path::whole::*;
use crate::path::*;
use crate::scene::Scene;
use crate::systems::list::*;

/// The systems and tables of states that are whole paths.
pub(super) fn states(scene: &Scene, effects: &[EffectPlan]) -> StateSystems {
    StateSystems {
        before: vec![SystemPlan::new(EVALUATE_PATHS, "chains sample in proportion to it")],
        systems: systems(scene, effects),
        tables: tables(scene, effects),
        subpaths: Subpaths::Both,
    }
}

fn systems(scene: &Scene, effects: &[EffectPlan]) -> Vec<SystemPlan> {
    let mut systems = Vec::new();
    // Without light there is no path that brings any.
    if is_on(effects, Effect::Emission) {
        systems.extend([
            SystemPlan::new(MAKE_ROOM, "kept subpaths can be deep from the start"),
            SystemPlan::new(START_PATHS, "mutations keep parts of paths"),
        ]);
        systems.extend(walks(scene, effects, scene.max_depth));
        if let Some(goes_on) = systems.iter_mut().find(|system| system.spec == CONTINUE_PATHS) {
            *goes_on = SystemPlan::new(CONTINUE_TO_STOP, "mutations say how long subpaths are");
        }
        systems.extend([
            SystemPlan::new(JOIN_PATHS, "one edge completes a path"),
            SystemPlan::new(TRANSMIT_PATHS, "what stands in between has to be known"),
            SystemPlan::new(TAKE_PATHS, "accepted proposals become states"),
        ]);
    }
    systems.extend([
        SystemPlan::new(SPLAT_STATES, "both states of a decision go to the film"),
        SystemPlan::new(TAKE_SPLATS, "accepted proposals become states"),
    ]);
    systems
}

fn tables(scene: &Scene, effects: &[EffectPlan]) -> Vec<TablePlan> {
    let lists = [
        splats(TableId::SPLATS).holding_state(),
        splats(TableId::PROPOSED_SPLATS),
    ];
    let mut tables = vec![chains(effects)];
    if !is_on(effects, Effect::Emission) {
        tables.extend(lists);
        return tables;
    }
    let mut rays = ray_columns();
    rays.column::<SegmentTarget>("a segment joins subpaths")
        .column::<SegmentTransmittance>("what passes along it");
    tables.extend([
        proposals(scene),
        paths(scene, TableId::PATHS).holding_state(),
        paths(scene, TableId::PROPOSED_PATHS),
        rays,
    ]);
    tables.extend(lists);
    if scatters(effects) {
        tables.push(scatter_lists(scene));
    }
    tables
}

fn chains(effects: &[EffectPlan]) -> TablePlan {
    let mut table = TablePlan::new(TableId::CHAINS, Extent::PerChain(1));
    table
        .column::<FilmPixel>("the pixel that the proposal counts for")
        .column::<SplatCount>("splats of the current state")
        .column::<ProposedSplatCount>("splats of the proposal")
        .column::<Direction>("rays are emitted along it")
        .column::<PathLength>("subpaths have different lengths")
        .column::<StopDepth>("mutations say how long subpaths are")
        .column::<ActiveList>("subpaths that wait for a ray")
        .column::<KeptFromCamera>("mutations keep parts of paths")
        .column::<KeptFromLight>("mutations keep parts of paths")
        .column::<CameraVertices>("mutations say how long subpaths are")
        .column::<LightVertices>("mutations say how long subpaths are")
        .column::<PathEdges>("how long the current path is")
        .column::<ProposedEdges>("how long the proposed path is")
        .column::<PathLight>("the light that the current path ends on")
        .column::<ProposedLight>("the light that the proposed path ends on")
        .column::<PathPixel>("the pixel that the current path counts for")
        .column::<PathFilm>("where the current path is seen")
        .column::<ProposedPathFilm>("where the proposed path is seen")
        .column::<PathFilter>("one of several pixels is chosen there")
        .column::<ProposedFilter>("one of several pixels is chosen there")
        .column::<PathKeptLight>("a light that is kept is not chosen")
        .column::<ProposedKeptLight>("a light that is kept is not chosen");
    if scatters(effects) {
        table.column::<ScatteredList>("subpaths that go on");
    }
    table
}

fn proposals(scene: &Scene) -> TablePlan {
    let mut table = TablePlan::new(TableId::PROPOSALS, Extent::vertices(scene.max_depth));
    vertex_columns(&mut table, scene);
    table
        .column::<VertexRatio>("whether a subpath goes on")
        .column::<VertexDensity>("whether a subpath goes on")
        .column::<VertexLight>("light met by camera subpaths, and where light subpaths start");
    table
}

/// A table of whole paths: two vertices to a row.
fn paths(scene: &Scene, id: TableId) -> TablePlan {
    let mut table = TablePlan::new(id, Extent::from_depth(0, scene.max_depth / 2));
    vertex_columns(&mut table, scene);
    table
        .column::<PathShare>("mutations are weighed by how likely strategies are")
        .column::<PathOnward>("mutations are weighed by how likely directions are")
        .column::<PathBack>("mutations are weighed by how likely directions are");
    table
}

fn vertex_columns(table: &mut TablePlan, scene: &Scene) {
    table
        .column::<VertexKind>("lens, light, surface, discrete, infinite")
        .column::<VertexPosition>("rays and segments start there")
        .column::<VertexNormal>("sides and offsets")
        .column::<VertexOffset>("rays start off the surface")
        .column::<VertexArrival>("materials are evaluated for it");
    surface_columns(table, scene);
}

fn splats(id: TableId) -> TablePlan {
    let mut table = TablePlan::new(id, Extent::PerChain(1));
    table
        .column::<SplatPixel>("where on the film")
        .column::<SplatColor>("the share of the target, by colour");
    table
}
