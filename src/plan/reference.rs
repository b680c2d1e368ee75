//! What the depth-first path tracer needs: no vertex table, and a ray queue of one lane group.

use super::effect::{EffectPlan, is_on};
use super::table::{Extent, sampling_chains};
use super::{Effect, SystemId, SystemPlan, TableKind, TablePlan};
use crate::geometry::{
    HitDistance, HitInstance, HitPrimitive, HitUv, RayDirection, RayOrigin, SegmentTarget, SegmentTransmittance,
};

pub(super) fn systems(effects: &[EffectPlan]) -> Vec<SystemPlan> {
    use SystemId::*;
    let mut systems = vec![SystemPlan::new(AssignPixels, "each chain samples one pixel per step")];
    if is_on(effects, Effect::Emission) {
        systems.push(SystemPlan::new(TraceDepthFirst, "whole paths, one after another"));
    }
    systems.push(SystemPlan::new(
        AcceptAlways,
        "samples are independent: every proposal is taken",
    ));
    systems.push(SystemPlan::new(SplatSamples, "samples go to the film"));
    systems
}

pub(super) fn tables(effects: &[EffectPlan]) -> Vec<TablePlan> {
    let chains = sampling_chains();
    if !is_on(effects, Effect::Emission) {
        return vec![chains];
    }
    let mut rays = TablePlan::new(TableKind::Rays, Extent::OneGroup);
    rays.column::<RayOrigin>("where it starts")
        .column::<RayDirection>("where it goes")
        .column::<HitDistance>("the nearest hit wins")
        .column::<HitInstance>("what was hit")
        .column::<HitPrimitive>("what was hit")
        .column::<HitUv>("where on it");
    if is_on(effects, Effect::DirectLight) {
        rays.column::<SegmentTarget>("segments end on a light")
            .column::<SegmentTransmittance>("what passes along a segment");
    }
    vec![chains, rays]
}
