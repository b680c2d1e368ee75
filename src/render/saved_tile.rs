//! Saving a tile, byte for byte: its columns are its state.
//!
//! Tables that hold state are written column by column in the order of the plan, with the depth that they have grown to,
//! and with what the tile has counted. Tables that nothing outlives a step in are not.

use super::bytes::{CutOff, Reader, Writer};
use super::tile_world::TileWorld;
use crate::plan::TilePlan;
use crate::systems::chains::{ChainStatistics, ProposalCount, WeightTally};
use crate::systems::tile::{Counters, Depths, grow_tables};

/// The tile's state.
pub(super) fn save(tile: &mut TileWorld, plan: &TilePlan) -> Vec<u8> {
    let mut out = Writer::default();
    let world = tile.world_mut();
    out.number(u64::from(world.resource::<Depths>().held()));
    save_counters(&mut out, *world.resource::<Counters>());
    save_statistics(&mut out, world.resource::<ChainStatistics>());
    for table in plan.tables.iter().filter(|table| table.is_state) {
        let Some(marker) = table.id.marker(world) else { continue };
        for column in &table.columns {
            (column.spec.bytes_of)(world, marker, &mut |bytes| out.list(bytes));
        }
    }
    out.bytes
}

/// Puts a saved state into a tile that was built from the same plan.
pub(super) fn restore(tile: &mut TileWorld, plan: &TilePlan, bytes: &[u8]) -> Result<(), CutOff> {
    let mut saved = Reader { bytes };
    let world = tile.world_mut();
    let held = u32::try_from(saved.number()?).map_err(|_| CutOff)?;
    if held > world.resource::<Depths>().most() {
        return Err(CutOff);
    }
    grow_tables(world, held);
    if world.resource::<Depths>().held() != held {
        return Err(CutOff);
    }
    let counters = restore_counters(&mut saved)?;
    world.insert_resource(counters);
    let mut statistics = world.resource::<ChainStatistics>().clone();
    restore_statistics(&mut saved, &mut statistics)?;
    world.insert_resource(statistics);
    for table in plan.tables.iter().filter(|table| table.is_state) {
        let Some(marker) = table.id.marker(world) else { continue };
        for column in &table.columns {
            let mut outcome = Ok(());
            (column.spec.bytes_of)(world, marker, &mut |bytes| match saved.list() {
                Ok(list) if list.len() == bytes.len() => bytes.copy_from_slice(list),
                _ => outcome = Err(CutOff),
            });
            outcome?;
        }
    }
    saved.bytes.is_empty().then_some(()).ok_or(CutOff)
}

fn save_counters(out: &mut Writer, counters: Counters) {
    let Counters {
        steps,
        decisions,
        rays,
        segments,
        vertices,
        non_finite,
        first_non_finite,
    } = counters;
    for number in [steps, decisions, rays, segments, vertices, non_finite] {
        out.number(number);
    }
    out.number(u64::from(first_non_finite.is_some()));
    let (chain, step) = first_non_finite.unwrap_or_default();
    out.number(u64::from(chain));
    out.number(step);
}

fn restore_counters(saved: &mut Reader<'_>) -> Result<Counters, CutOff> {
    let mut next = || saved.number();
    let mut counters = Counters {
        steps: next()?,
        decisions: next()?,
        rays: next()?,
        segments: next()?,
        vertices: next()?,
        non_finite: next()?,
        first_non_finite: None,
    };
    let (known, chain, step) = (next()?, next()?, next()?);
    if known != 0 {
        counters.first_non_finite = u32::try_from(chain).ok().map(|chain| (chain, step));
    }
    Ok(counters)
}

fn save_statistics(out: &mut Writer, statistics: &ChainStatistics) {
    for count in &statistics.proposals {
        for number in [count.proposed, count.accepted, count.impossible] {
            out.number(number);
        }
    }
    statistics.visits.iter().for_each(|&visits| out.number(visits));
    let WeightTally { sum, count } = statistics.independent;
    out.number(sum as u64);
    out.number((sum >> 64) as u64);
    out.number(count);
}

fn restore_statistics(saved: &mut Reader<'_>, statistics: &mut ChainStatistics) -> Result<(), CutOff> {
    for count in &mut statistics.proposals {
        *count = ProposalCount {
            proposed: saved.number()?,
            accepted: saved.number()?,
            impossible: saved.number()?,
        };
    }
    for visits in &mut statistics.visits {
        *visits = saved.number()?;
    }
    let (low, high) = (saved.number()?, saved.number()?);
    statistics.independent = WeightTally {
        sum: (u128::from(low) | u128::from(high) << 64) as i128,
        count: saved.number()?,
    };
    Ok(())
}
