//! What chains in primary sample space need when they are run depth first: one system in place of all that make a step.
//!
//! Bootstrap and seeding are those of [`super::pssmlt`], system for system, so both start from the same states; what differs
//! is how a step is run, and nothing else may. Tables that grow with depth are built for every depth, since a system that
//! traces whole paths cannot append rows on the way. Transition densities are not kept, whatever the settings say: nothing
//! but the acceptance reads them.

use super::Effect;
use super::chains::{ChainCounts, ChainPlanError, StateSystems, chain_tile};
use super::effect::{EffectPlan, is_on};
use super::mutation::MutationPlan;
use super::system::{Phases, SystemPlan};
use super::table::Extent;
use super::tile::TilePlan;
use crate::systems::list::MUTATE_DEPTH_FIRST;

/// A tile of chains over `states`, whose steps are run one chain after another.
///
/// # Errors
/// A mutation that cannot move one path after another.
pub(super) fn tile(
    mut states: StateSystems,
    mutations: &[MutationPlan],
    counts: ChainCounts,
    effects: &[EffectPlan],
    size: Option<u32>,
) -> Result<TilePlan, ChainPlanError> {
    if let Some(staged) = mutations.iter().find(|m| m.mutation.depth_first().is_none()) {
        return Err(ChainPlanError::NotDepthFirst {
            mutation: staged.mutation.name(),
        });
    }
    for table in &mut states.tables {
        if let Extent::PerDepth { held, most, .. } = &mut table.extent {
            *held = *most;
        }
    }
    let mut tile = chain_tile(states, mutations, counts, false, size);
    // Without light there is no path to trace, and no chain ever has a state.
    if is_on(effects, Effect::Emission) {
        replace_step(&mut tile);
    }
    Ok(tile)
}

/// Takes every system out of the step, and puts the one in.
fn replace_step(tile: &mut TilePlan) {
    for system in &mut tile.systems {
        let spec = system.spec;
        system.spec = spec.in_phases(spec.phases().without(Phases::STEP));
    }
    tile.systems.retain(|system| !system.spec.phases().is_empty());
    let step = SystemPlan::new(MUTATE_DEPTH_FIRST, "whole steps, one chain after another");
    // Where it stands does not matter: it is alone in its phase.
    tile.systems.push(step);
    tile.systems.sort_by_key(|system| system.spec.place());
}
