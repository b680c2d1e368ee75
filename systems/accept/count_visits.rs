//! Where chains are.

use super::super::chains::{ChainStatistics, GroupPlace};
use super::super::tile::TilePlace;
use crate::chain::{Class, StateClass, Target};
use crate::path::ChainTable;
use crate::table::{Read, Rows};
use bevy_ecs::system::{Res, ResMut};

/// Counts the classes of every chain's state after its decision, by batches of chains: the spread inside a group, against
/// which groups are compared.
pub fn count_visits(
    place: Res<TilePlace>,
    group: Res<GroupPlace>,
    mut statistics: ResMut<ChainStatistics>,
    targets: Read<Target, ChainTable>,
    classes: Read<Class, ChainTable>,
) {
    let (targets, classes) = (targets.rows(), classes.rows());
    for chain in 0..place.chains as usize {
        if targets.at(chain) > 0.0 {
            let batch = group.batch(place.first_chain + chain as u32);
            statistics.visit(batch, StateClass(classes.at(chain)));
        }
    }
}
