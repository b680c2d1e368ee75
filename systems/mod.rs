//! Systems: what happens. One folder per stage, one file per system; this page is the schedule.
//!
//! A **step** runs the stages over a whole tile, each over all of its chains before the next begins:
//!
//! 1. **propose**: independent samples: [`assign_pixels`](propose::assign_pixels); chains:
//!    [`key_chains`](propose::key_chains), [`choose_mutation`](propose::choose_mutation), and what each mutation brings, such
//!    as [`propose_large_steps`](propose::propose_large_steps); then
//!    [`start_camera_paths`](propose::start_camera_paths);
//! 2. **trace**: [`trace_loop`](trace::trace_loop), which repeats, until no chain waits for a ray,
//!    1. emit: [`emit_rays`](trace::emit_rays),
//!    2. intersect: [`intersect_rays`](trace::intersect_rays),
//!    3. extend: [`extend_paths`](trace::extend_paths),
//!    4. draw: for chains, the coordinates of the new vertices, one system per mutation, such as
//!       [`draw_small_steps`](propose::draw_small_steps),
//!    5. connect: [`connect_lights`](trace::connect_lights),
//!    6. transmit: [`transmit_segments`](trace::transmit_segments),
//!    7. scatter: a system per material model of the scene ([`scatter_system`](trace::scatter_system)), such as
//!       [`scatter_diffuse`](trace::scatter_diffuse),
//!    8. continue: [`continue_paths`](trace::continue_paths);
//!
//!    or, for the depth-first baseline, [`trace_depth_first`](trace::trace_depth_first) alone (for chains,
//!    [`mutate_depth_first`](trace::mutate_depth_first) in place of a whole step);
//! 3. **evaluate**: [`gather_contribution`](evaluate::gather_contribution); for chains
//!    [`evaluate_targets`](evaluate::evaluate_targets), [`tally_independent`](evaluate::tally_independent), and, where the
//!    choice of a mutation depends on the state, [`weigh_choices`](evaluate::weigh_choices);
//! 4. **accept**: [`accept_always`](accept::accept_always); for chains [`decide`](accept::decide),
//!    [`take_coordinates`](accept::take_coordinates), [`count_visits`](accept::count_visits);
//! 5. **splat**: [`splat_samples`](splat::splat_samples); for chains [`splat_states`](splat::splat_states), and only then
//!    [`take_splats`](splat::take_splats), which overwrites what was splatted.
//!
//! Chains start with a **bootstrap**: [`key_samples`](bootstrap::key_samples),
//! [`start_independent`](bootstrap::start_independent), the proposal of the independent mutation, the trace and evaluate
//! stages of a step, and [`weigh_samples`](bootstrap::weigh_samples). The seeds that are resampled are drawn again by the
//! same systems and taken by those of the accept stage. Which of these [`Run`]s a system takes part in is in its
//! [`Phases`](crate::plan::Phases).
//!
//! Which of them run is the plan's choice; their order is the plan's order. A system walks whole columns and holds no
//! mathematics of its own: that stands in `src/`, where tests call it.

pub mod accept;
pub mod bootstrap;
pub mod chains;
pub mod evaluate;
pub mod layers;
pub mod list;
pub mod paths;
pub mod propose;
pub mod splat;
pub mod tile;
mod timing;
pub mod trace;

pub use timing::{Profile, Span, SystemCost};

use crate::plan::{InPlan, Phases, Repeated, SystemSpec, TilePlan};
use bevy_ecs::schedule::{IntoScheduleConfigs, Schedule, ScheduleLabel};
use bevy_ecs::world::World;
use timing::TimingExecutor;

/// The schedules of a tile's runs, by their phase.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Run {
    /// Draws independent proposals and evaluates them.
    Bootstrap,
    /// Draws the chosen seeds again and takes them.
    Seed,
    /// One step of every chain.
    Step,
}

impl Run {
    /// Every run.
    pub const ALL: [Self; 3] = [Self::Bootstrap, Self::Seed, Self::Step];

    /// Its phase, as systems name it.
    #[must_use]
    pub const fn phase(self) -> Phases {
        match self {
            Self::Bootstrap => Phases::BOOTSTRAP,
            Self::Seed => Phases::SEED,
            Self::Step => Phases::STEP,
        }
    }
}

/// The schedule that [`trace::trace_loop`] repeats.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TraceLoop;

/// The schedule that [`trace::join_loop`] repeats.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct JoinLoop;

/// Builds the schedules that `plan` asks for into `world`, and the profile that their executors keep.
///
/// # Panics
/// Never for a plan of [`Plan::new`]: its systems form one chain.
pub fn build_schedules(plan: &TilePlan, world: &mut World) {
    let mut profile = Profile::default();
    let systems = || plan.systems.iter().map(|system| system.spec);
    let repeated = |which| systems().filter(move |s| s.repeated() == Some(which));
    build(TraceLoop, repeated(Repeated::Trace), &mut profile, world);
    if repeated(Repeated::Join).next().is_some() {
        build(JoinLoop, repeated(Repeated::Join), &mut profile, world);
    }
    for run in Run::ALL {
        // Independent estimators have neither bootstrap nor seeds.
        if run == Run::Step || systems().any(|s| s.phases() != Phases::STEP && s.phases().has(run.phase())) {
            let here = systems().filter(|s| s.repeated().is_none() && s.phases().has(run.phase()));
            build(run, here, &mut profile, world);
        }
    }
    world.insert_resource(profile);
}

/// Builds one schedule of `systems` in their order.
fn build(
    label: impl ScheduleLabel,
    systems: impl Iterator<Item = SystemSpec>,
    profile: &mut Profile,
    world: &mut World,
) {
    let mut schedule = Schedule::new(label);
    // The profile's order is the schedules' order, so that the executor finds its entries by counting.
    schedule.set_executor(TimingExecutor::new(profile.systems.len()));
    let mut last = None;
    for spec in systems {
        spec.add_to(&mut schedule);
        if let Some(previous) = last.replace(spec) {
            schedule.configure_sets(InPlan::System(spec).after(InPlan::System(previous)));
        }
        profile.systems.push(SystemCost::new(spec));
    }
    // Built now rather than at the first run, so that it can be read back.
    if let Err(error) = schedule.initialize(world) {
        panic!("the plan's systems are one chain, which always builds: {error}");
    }
    world.add_schedule(schedule);
}
