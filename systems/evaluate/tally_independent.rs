//! What a run itself tells of the normalization.

use super::super::chains::{ChainStatistics, GroupPlace, MutationLists, Mutations};
use crate::chain::{ForwardDensity, MutationList, ProposedTarget};
use crate::path::ChainTable;
use crate::table::{Read, Rows};
use bevy_ecs::system::{Res, ResMut};

/// Adds f(y)/T(y) of every independent proposal up: they are samples as a bootstrap's are, and without them the error of b
/// would stay what it was at the start, however long chains run (Kelemen et al. 2002, section 5, use them likewise).
pub fn tally_independent(
    mutations: Res<Mutations>,
    lists: Res<MutationLists>,
    group: Res<GroupPlace>,
    mut statistics: ResMut<ChainStatistics>,
    list: Read<MutationList, ChainTable>,
    targets: Read<ProposedTarget, ChainTable>,
    densities: Read<ForwardDensity, ChainTable>,
) {
    let (list, targets, densities) = (list.rows(), targets.rows(), densities.rows());
    for entry in lists.entries(mutations.independent()) {
        let chain = list.at(entry) as usize;
        let density = densities.at(chain);
        let weight = if density == 0.0 {
            f64::from(targets.at(chain))
        } else {
            f64::from(targets.at(chain)) * libm::exp(-density)
        };
        statistics.independent.add(weight, group.unit);
    }
}
