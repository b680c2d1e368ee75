//! What the depth-first path tracer needs: no vertex table, and a ray queue of one lane group.

use super::effect::{EffectPlan, is_on};
use super::table::{Extent, sampling_chains};
use super::{Effect, SystemPlan, TableId, TablePlan};
use crate::geometry::{
    HitDistance, HitInstance, HitPrimitive, HitUv, RayDirection, RayOrigin, SegmentTarget, SegmentTransmittance,
};
use crate::systems::list::*;

pub(super) fn systems(effects: &[EffectPlan]) -> Vec<SystemPlan> {
    let mut systems = vec![SystemPlan::new(ASSIGN_PIXELS, "each chain samples one pixel per step")];
    if is_on(effects, Effect::Emission) {
        systems.push(SystemPlan::new(TRACE_DEPTH_FIRST, "whole paths, one after another"));
    }
    systems.push(SystemPlan::new(
        ACCEPT_ALWAYS,
        "samples are independent: every proposal is taken",
    ));
    systems.push(SystemPlan::new(SPLAT_SAMPLES, "samples go to the film"));
    systems
}

pub(super) fn tables(effects: &[EffectPlan]) -> Vec<TablePlan> {
    let chains = sampling_chains();
    if !is_on(effects, Effect::Emission) {
        return vec![chains];
    }
    let mut rays = TablePlan::new(TableId::RAYS, Extent::OneGroup);
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
