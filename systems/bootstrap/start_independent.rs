//! Independent proposals for all.

use super::super::chains::{MutationLists, Mutations};
use super::super::tile::{Queues, TilePlace};
use crate::chain::{ChosenMutation, MutationList};
use crate::path::ChainTable;
use crate::plan::MAX_MUTATIONS;
use crate::table::{Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Lists every chain for the independent mutation.
pub fn start_independent(
    place: Res<TilePlace>,
    mutations: Res<Mutations>,
    mut queues: ResMut<Queues>,
    mut lists: ResMut<MutationLists>,
    mut chosen: Write<ChosenMutation, ChainTable>,
    mut list: Write<MutationList, ChainTable>,
) {
    let (chosen, list) = (chosen.rows(), list.rows());
    let number = mutations.independent();
    for chain in 0..place.chains as usize {
        chosen.put(chain, number as u32);
        list.put(chain, chain as u32);
    }
    let mut counts = [0; MAX_MUTATIONS];
    counts[number] = place.chains;
    *lists = MutationLists::of_counts(&counts);
    *queues = Queues::default();
}
