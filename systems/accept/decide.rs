//! The decision of a chain.

use super::super::chains::{ChainStatistics, KeyColumns, Keys};
use super::super::tile::{Counters, Queues, TilePlace};
use crate::chain::{
    Acceptance, AcceptedList, Booking, ChosenMutation, Class, ForwardDensity, LongestRejections, ProposedClass,
    ProposedTarget, Rejections, ReverseDensity, StateClass, Target, decide_with, metropolis,
};
use crate::path::{BookedWeight, ChainTable, Decisions};
use crate::sampling::Purpose;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};

/// What a decision is made of.
#[derive(SystemParam)]
pub struct Offers<'w, 's> {
    chosen: Read<'w, 's, ChosenMutation, ChainTable>,
    targets: Read<'w, 's, ProposedTarget, ChainTable>,
    classes: Read<'w, 's, ProposedClass, ChainTable>,
    forward: Read<'w, 's, ForwardDensity, ChainTable>,
    reverse: Read<'w, 's, ReverseDensity, ChainTable>,
}

/// What a decision changes.
#[derive(SystemParam)]
pub struct States<'w, 's> {
    targets: Write<'w, 's, Target, ChainTable>,
    classes: Write<'w, 's, Class, ChainTable>,
    acceptances: Write<'w, 's, Acceptance, ChainTable>,
    weights: Write<'w, 's, BookedWeight, ChainTable>,
    decisions: Write<'w, 's, Decisions, ChainTable>,
    rejections: Write<'w, 's, Rejections, ChainTable>,
    longest: Write<'w, 's, LongestRejections, ChainTable>,
    accepted: Write<'w, 's, AcceptedList, ChainTable>,
}

/// Decides for every chain whether it takes its proposal (Metropolis et al. 1953, Hastings 1970). One dense pass: a proposal
/// that failed is turned down, never passed over, and every chain decides exactly once a step. Chains that accept are
/// listed; those with a target that is not finite are counted.
pub fn decide(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    mut counters: ResMut<Counters>,
    mut statistics: ResMut<ChainStatistics>,
    keys: Keys,
    offers: Offers,
    mut states: States,
) {
    let keys: KeyColumns<'_> = keys.columns();
    let (chosen, proposed_targets, proposed_classes) =
        (offers.chosen.rows(), offers.targets.rows(), offers.classes.rows());
    let (forward, reverse) = (offers.forward.rows(), offers.reverse.rows());
    let (targets, classes) = (states.targets.rows(), states.classes.rows());
    let (acceptances, weights, decisions) = (
        states.acceptances.rows(),
        states.weights.rows(),
        states.decisions.rows(),
    );
    let (rejections, longest, accepted_list) =
        (states.rejections.rows(), states.longest.rows(), states.accepted.rows());
    let mut accepted_chains = 0;
    for chain in 0..place.chains as usize {
        let proposed = proposed_targets.at(chain);
        if !proposed.is_finite() {
            counters.note_non_finite(place.first_chain + chain as u32, place.step);
        }
        let rule = metropolis(targets.at(chain), proposed, forward.at(chain), reverse.at(chain));
        let booking = Booking::of(rule.acceptance);
        let accepted = booking.is_certain()
            || decide_with(booking.accepted, || {
                keys.at(chain).stream(Purpose::ACCEPT, 0).next_f64()
            });
        let left = StateClass(classes.at(chain));
        statistics.book(chosen.at(chain) as usize, left, accepted, booking.accepted == 0.0);
        acceptances.put(chain, booking.accepted);
        weights.put(chain, booking.total() as f32);
        decisions.put(chain, decisions.at(chain).wrapping_add(1));
        if accepted {
            targets.put(chain, proposed);
            classes.put(chain, proposed_classes.at(chain));
            rejections.put(chain, 0);
            accepted_list.put(accepted_chains, chain as u32);
            accepted_chains += 1;
        } else {
            let run = rejections.at(chain) + 1;
            rejections.put(chain, run);
            longest.put(chain, longest.at(chain).max(run));
        }
    }
    queues.accepted = accepted_chains;
    counters.decisions += u64::from(place.chains);
}
