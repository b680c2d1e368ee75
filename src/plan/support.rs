//! Supports: where a mutation's proposals can be. A mutation that says so can have its transition density T(x→y) tested:
//! proposals weighted by 1/T must then spread over the support as known draws do.

use super::system::SystemPlan;

/// Where the proposals of a mutation can be.
#[derive(Clone, Debug)]
pub enum Support {
    /// The current state alone: a point mass, which has no density. Every proposal must be the current state, bit for bit.
    State,
    /// The whole state space, whatever the state: T is the density of bootstraps' samples where it is 1, and coordinates
    /// that are uniform in bootstraps must be uniform in proposals weighted by 1/T.
    Space,
    /// A region about the current state.
    Region(Region),
}

/// A region that can be drawn from with a density q(x→y) which is known without T. It must be positive where T is, and zero
/// elsewhere; the flatter q/T, the more a test sees. Uniform over the region will do where it is of few coordinates; of many,
/// hardly any draw is where T is large, and [`KnownDraws`](crate::chain::KnownDraws) do better.
#[derive(Clone, Debug)]
pub struct Region {
    /// Systems that propose with the density q, in place of the mutation's own: they find their chains, and the mutation's
    /// settings, where those do.
    pub draw: Vec<SystemPlan>,
    /// Systems of the evaluate stage, where they run before the proposal's light is gathered, that write ln q(x→y) to [`SupportDensity`](crate::chain::SupportDensity), whichever
    /// systems proposed y.
    pub weigh: Vec<SystemPlan>,
    /// A bound on E[(q/T)⁴] over the mutation's proposals from any state, at least 1. It follows from how the mutation should
    /// draw, and says how many known draws have to be in a cell for its sums to be near normal: cells with fewer are not
    /// judged, whatever their sums are.
    pub fourth_moment: f64,
}
