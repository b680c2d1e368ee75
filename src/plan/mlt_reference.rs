//! What chains in path space need whose proposals are made depth first: one system in place of all that propose, trace, join and
//! weigh.
//!
//! Bootstrap and seeding are those of [`super::mlt`], system for system, and so are the choice of the mutation, the decision, and
//! what goes to the film: what differs is how a proposal is made. Tables that grow with depth are built for every depth, since a
//! system that traces whole paths cannot append rows on the way.

use super::Effect;
use super::chains::{ChainCounts, ChainPlanError, StateSystems, chain_tile};
use super::effect::{EffectPlan, is_on};
use super::mutation::MutationPlan;
use super::system::{Phases, Place, Stage, SystemPlan};
use super::table::Extent;
use super::tile::TilePlan;
use crate::systems::list::{CHOOSE_MUTATION, EVALUATE_PATHS, KEY_CHAINS, PROPOSE_PATHS_DEPTH_FIRST};

/// A tile of chains over `states`, whose proposals are made one chain after another.
///
/// # Errors
/// A mutation that does not move paths one by one.
pub(super) fn tile(
    mut states: StateSystems,
    mutations: &[MutationPlan],
    counts: ChainCounts,
    effects: &[EffectPlan],
    size: Option<u32>,
) -> Result<TilePlan, ChainPlanError> {
    if let Some(staged) = mutations.iter().find(|m| m.mutation.moves_paths().is_none()) {
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
    // Without light there is no path that brings any.
    if is_on(effects, Effect::Emission) {
        replace_proposals(&mut tile, mutations);
    }
    Ok(tile)
}

/// Takes every system that makes proposals out of the step, and puts the one in.
fn replace_proposals(tile: &mut TilePlan, mutations: &[MutationPlan]) {
    let of_mutations: Vec<&str> = mutations
        .iter()
        .flat_map(|planned| planned.mutation.systems())
        .map(|system| system.spec.name())
        .collect();
    for system in &mut tile.systems {
        let spec = system.spec;
        let makes_proposals = match spec.place() {
            Place::Stage(Stage::Propose) => ![KEY_CHAINS, CHOOSE_MUTATION].contains(&spec),
            Place::Stage(Stage::Trace) | Place::Loop(_) | Place::Join(_) => true,
            Place::Stage(_) => spec == EVALUATE_PATHS || of_mutations.contains(&spec.name()),
        };
        if makes_proposals {
            system.spec = spec.in_phases(spec.phases().without(Phases::STEP));
        }
    }
    tile.systems.retain(|system| !system.spec.phases().is_empty());
    let proposals = SystemPlan::new(PROPOSE_PATHS_DEPTH_FIRST, "whole proposals, one chain after another");
    tile.systems.push(proposals);
    tile.systems.sort_by_key(|system| system.spec.place());
}
