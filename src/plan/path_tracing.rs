//! What path tracing in stages needs.

use super::effect::{EffectPlan, is_on};
use super::table::{Extent, sampling_chains};
use super::{Effect, SystemPlan, TableId, TablePlan};
use crate::geometry::{
    HitDistance, HitInstance, HitPrimitive, HitUv, RayDirection, RayOrigin, SegmentTarget, SegmentTransmittance,
};
use crate::material::MaterialKind;
use crate::path::*;
use crate::scene::Scene;
use crate::systems::list::*;
use crate::systems::trace::scatter_system;

/// Whether paths go beyond the first surface they meet.
pub(super) fn scatters(effects: &[EffectPlan]) -> bool {
    MaterialKind::ALL.iter().any(|&kind| is_on(effects, Effect::of(kind)))
}

/// Whether some paths cross interfaces between media.
pub(super) fn refracts(effects: &[EffectPlan]) -> bool {
    is_on(effects, Effect::Refraction)
}

/// The lists of chains that wait to be scattered: one per model.
pub(super) fn scatter_lists(scene: &Scene) -> TablePlan {
    let models = scene.materials.kinds().len() as u32;
    let mut table = TablePlan::new(TableId::SCATTER, Extent::PerChain(models));
    table.column::<ScatterList>("one scatter system per material model");
    table
}

/// The systems of the trace loop that walk paths of at most `max_depth` edges, whichever end they start at.
pub(super) fn walks(scene: &Scene, effects: &[EffectPlan], max_depth: u32) -> Vec<SystemPlan> {
    let mut systems = vec![
        SystemPlan::new(TRACE_LOOP, "paths are traced until none waits for a ray"),
        SystemPlan::new(EMIT_RAYS, "active chains wait for a ray"),
        SystemPlan::new(INTERSECT_RAYS, "rays have to meet something"),
        SystemPlan::new(EXTEND_PATHS, "what rays meet becomes path vertices"),
    ];
    for &kind in scene.materials.kinds() {
        let effect = Effect::of(kind);
        if is_on(effects, effect) {
            systems.push(SystemPlan::new(scatter_system(kind), effect.reason()));
        }
    }
    if scatters(effects) {
        let reason = if max_depth > roulette::FIRST_DEPTH {
            "paths go on, beyond depth 5 by roulette"
        } else {
            "paths go on until max_depth, before roulette"
        };
        systems.push(SystemPlan::new(CONTINUE_PATHS, reason));
    }
    systems
}

/// The systems of paths of at most `max_depth` edges.
pub(super) fn systems(scene: &Scene, effects: &[EffectPlan], max_depth: u32) -> Vec<SystemPlan> {
    let mut systems = vec![SystemPlan::new(ASSIGN_PIXELS, "each chain samples one pixel per step")];
    if is_on(effects, Effect::Emission) {
        systems.push(SystemPlan::new(START_CAMERA_PATHS, "paths start at the camera"));
        systems.extend(walks(scene, effects, max_depth));
        if is_on(effects, Effect::DirectLight) {
            systems.push(SystemPlan::new(
                CONNECT_LIGHTS,
                "lights are sampled from vertices that scatter with a density",
            ));
            systems.push(SystemPlan::new(
                TRANSMIT_SEGMENTS,
                "what stands between vertex and light has to be known",
            ));
        }
        systems.push(SystemPlan::new(
            GATHER_CONTRIBUTION,
            "a path's light is the sum over its vertices",
        ));
    }
    systems.push(SystemPlan::new(
        ACCEPT_ALWAYS,
        "samples are independent: every proposal is taken",
    ));
    systems.push(SystemPlan::new(SPLAT_SAMPLES, "samples go to the film"));
    systems
}

/// The tables of the same.
pub(super) fn tables(scene: &Scene, effects: &[EffectPlan], max_depth: u32) -> Vec<TablePlan> {
    let emission = is_on(effects, Effect::Emission);
    let mut tables = vec![chains(effects)];
    if emission {
        tables.push(proposals(scene, effects, max_depth));
        tables.push(rays(effects));
    }
    if scatters(effects) {
        tables.push(scatter_lists(scene));
    }
    tables
}

fn chains(effects: &[EffectPlan]) -> TablePlan {
    let mut table = sampling_chains();
    if is_on(effects, Effect::Emission) {
        table
            .column::<Direction>("rays are emitted along it")
            .column::<PathLength>("paths have different lengths")
            .column::<ActiveList>("chains that wait for a ray");
    }
    if is_on(effects, Effect::DirectLight) {
        table.column::<ConnectList>("vertices that wait for a light");
    }
    if refracts(effects) {
        table.column::<RadianceScale>("roulette must not take the scale of refraction for a loss");
    }
    if scatters(effects) {
        table
            .column::<Throughput>("roulette judges paths by it")
            .column::<ScatteredList>("scattered chains wait for roulette");
    }
    table
}

fn proposals(scene: &Scene, effects: &[EffectPlan], max_depth: u32) -> TablePlan {
    let mut table = TablePlan::new(TableId::PROPOSALS, Extent::vertices(max_depth));
    table
        .column::<VertexKind>("lens, surface, discrete")
        .column::<VertexPosition>("rays and segments start there")
        .column::<VertexNormal>("sides and offsets")
        .column::<VertexOffset>("rays start off the surface")
        .column::<VertexRatio>("f/p of scattering")
        .column::<VertexDensity>("weights light met by chance against light sampled")
        .column::<VertexEmission>("light met by scattering");
    if scatters(effects) {
        surface_columns(&mut table, scene);
        table
            .column::<VertexInstance>("the path is kept by its surfaces, for what will change or replay it")
            .column::<VertexPrimitive>("the path is kept by its surfaces, for what will change or replay it")
            .column::<VertexUv>("the path is kept by its surfaces, for what will change or replay it");
    }
    if is_on(effects, Effect::DirectLight) {
        table.column::<VertexConnection>("light connected to");
    }
    table
}

/// Adds what materials are evaluated with.
pub(super) fn surface_columns(table: &mut TablePlan, scene: &Scene) {
    table
        .column::<VertexShadingNormal>("materials scatter about it")
        .column::<VertexMaterial>("which material scatters");
    let needs = scene.materials.needs();
    if needs.textures {
        table.column::<VertexTexture>("some material has a texture");
    }
    if needs.tangents {
        table.column::<VertexTangent>("some material is not the same all around");
    }
}

/// The ray table without segments.
pub(super) fn ray_columns() -> TablePlan {
    let mut table = TablePlan::new(TableId::RAYS, Extent::PerChain(1));
    table
        .column::<RayChain>("whose ray it is")
        .column::<RayOrigin>("where it starts")
        .column::<RayDirection>("where it goes")
        .column::<HitDistance>("the nearest hit wins")
        .column::<HitInstance>("what was hit")
        .column::<HitPrimitive>("what was hit")
        .column::<HitUv>("where on it");
    table
}

fn rays(effects: &[EffectPlan]) -> TablePlan {
    let mut table = ray_columns();
    if is_on(effects, Effect::DirectLight) {
        table
            .column::<SegmentTarget>("segments end on a light")
            .column::<SegmentTransmittance>("what passes along a segment");
    }
    table
}
