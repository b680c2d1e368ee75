//! The columns of any Markov chain, whatever its states are.

use crate::columns;

columns! {
    /// The target function of the current state, f(x): what the chain samples in proportion to. 0 before the first state.
    pub Target: f32;
    /// The target function of the proposal, f(y).
    pub ProposedTarget: f32;
    /// Classes of the current state, see [`StateClass`](super::StateClass).
    pub Class: u32;
    /// Classes of the proposal.
    pub ProposedClass: u32;
    /// Number of the mutation that was chosen in this step, in the order of the plan.
    pub ChosenMutation: u32;
    /// ln T(x→y): the density of proposing y from x, the probability of choosing the mutation there included; up to a term
    /// that both ways have in common ([`CommonDensity`]).
    pub ForwardDensity: f64;
    /// ln T(y→x), likewise.
    pub ReverseDensity: f64;
    /// The logarithm of what both densities have in common and the acceptance does not need. Exists where densities are
    /// looked at: in tests and replays.
    pub CommonDensity: f64;
    /// ln q(x→y): the density with which the support of the chosen mutation is drawn, see
    /// [`Support`](crate::plan::Support). Exists where densities are tested.
    pub SupportDensity: f64;
    /// The probability a(x→y) of taking the proposal. 1 − a is exact: a is a multiple of 2⁻⁵³.
    pub Acceptance: f64;
    /// Steps since the last proposal was taken.
    pub Rejections: u32;
    /// The most steps in a row without one.
    pub LongestRejections: u32;
    /// f(y)/T(y) of an independent proposal, while a group bootstraps.
    pub BootstrapWeight: f64;
    /// The chain whose random streams are drawn from: the chain itself in steps, the one that drew the seed before.
    pub KeyChain: u32;

    /// Chains in the order of their mutations: those of one mutation are neighbours, see
    /// [`MutationLists`](crate::systems::tile::MutationLists).
    pub MutationList: u32;
    /// Chains that took their proposal.
    pub AcceptedList: u32;
}
