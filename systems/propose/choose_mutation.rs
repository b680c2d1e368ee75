//! Which mutation each chain tries.

use super::super::chains::{Keys, MutationLists, Mutations};
use super::super::tile::TilePlace;
use crate::chain::{ChosenMutation, Class, MutationList, StateClass};
use crate::path::ChainTable;
use crate::plan::MAX_MUTATIONS;
use crate::sampling::Purpose;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Chooses a mutation for every chain, in proportion to weight times suitability in its state, and lists the chains of each.
pub fn choose_mutation(
    place: Res<TilePlace>,
    mutations: Res<Mutations>,
    mut lists: ResMut<MutationLists>,
    keys: Keys,
    classes: Read<Class, ChainTable>,
    mut chosen: Write<ChosenMutation, ChainTable>,
    mut list: Write<MutationList, ChainTable>,
) {
    let (keys, classes) = (keys.columns(), classes.rows());
    let (chosen, list) = (chosen.rows(), list.rows());
    let mut counts = [0; MAX_MUTATIONS];
    for chain in 0..place.chains as usize {
        let u = keys.at(chain).stream(Purpose::MUTATION, 0).next_f64();
        let number = mutations.choose(StateClass(classes.at(chain)), u);
        chosen.put(chain, number as u32);
        counts[number] += 1;
    }
    *lists = MutationLists::of_counts(&counts);
    let mut next: [usize; MAX_MUTATIONS] = std::array::from_fn(|number| lists.entries(number).start);
    for chain in 0..place.chains as usize {
        let entry = &mut next[chosen.at(chain) as usize];
        list.put(*entry, chain as u32);
        *entry += 1;
    }
}
