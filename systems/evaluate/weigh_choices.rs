//! The choice of the mutation, as part of T.

use super::super::chains::Mutations;
use super::super::tile::TilePlace;
use crate::chain::{ChosenMutation, Class, ForwardDensity, ProposedClass, ReverseDensity, StateClass};
use crate::path::ChainTable;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::Res;

/// Adds to both densities the logarithm of the probability of choosing the mutation: in the current state for the way there,
/// in the proposal for the way back.
pub fn weigh_choices(
    place: Res<TilePlace>,
    mutations: Res<Mutations>,
    chosen: Read<ChosenMutation, ChainTable>,
    classes: Read<Class, ChainTable>,
    proposed: Read<ProposedClass, ChainTable>,
    mut forward: Write<ForwardDensity, ChainTable>,
    mut reverse: Write<ReverseDensity, ChainTable>,
) {
    let (chosen, classes, proposed) = (chosen.rows(), classes.rows(), proposed.rows());
    let (forward, reverse) = (forward.rows(), reverse.rows());
    for chain in 0..place.chains as usize {
        let number = chosen.at(chain) as usize;
        let log_choice = |class: u32| libm::log(mutations.probability(number, StateClass(class)));
        forward.put(chain, forward.at(chain) + log_choice(classes.at(chain)));
        reverse.put(chain, reverse.at(chain) + log_choice(proposed.at(chain)));
    }
}
