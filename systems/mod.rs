//! Systems: what happens. One folder per stage, one file per system; this page is the schedule.
//!
//! A **step** runs the stages over a whole tile, each over all of its chains before the next begins:
//!
//! 1. **propose**: [`assign_pixels`](propose::assign_pixels), [`start_camera_paths`](propose::start_camera_paths);
//! 2. **trace**: [`trace_loop`](trace::trace_loop), which repeats, until no chain waits for a ray,
//!    1. emit: [`emit_rays`](trace::emit_rays),
//!    2. intersect: [`intersect_rays`](trace::intersect_rays),
//!    3. extend: [`extend_paths`](trace::extend_paths),
//!    4. connect: [`connect_lights`](trace::connect_lights),
//!    5. transmit: [`transmit_segments`](trace::transmit_segments),
//!    6. scatter: [`scatter_diffuse`](trace::scatter_diffuse), [`scatter_conductor`](trace::scatter_conductor),
//!       [`scatter_dielectric`](trace::scatter_dielectric),
//!    7. continue: [`continue_paths`](trace::continue_paths);
//!
//!    or, for the depth-first baseline, [`trace_depth_first`](trace::trace_depth_first) alone;
//! 3. **evaluate**: [`gather_contribution`](evaluate::gather_contribution);
//! 4. **accept**: [`accept_always`](accept::accept_always);
//! 5. **splat**: [`splat_samples`](splat::splat_samples).
//!
//! Which of them run is the plan's choice; their order is the plan's order. A system walks whole columns and holds no
//! mathematics of its own: that stands in `src/`, where tests call it.

pub mod accept;
pub mod evaluate;
pub mod propose;
pub mod splat;
pub mod tile;
mod timing;
pub mod trace;

pub use timing::{Profile, Span, SystemCost};

use crate::plan::{Place, Plan, SystemId};
use bevy_ecs::schedule::{IntoScheduleConfigs, Schedule, ScheduleLabel, SystemSet};
use bevy_ecs::world::World;
use timing::TimingExecutor;

/// The schedule of one step of a tile.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step;

/// The schedule that [`trace::trace_loop`] repeats.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TraceLoop;

/// Every system is in a set of its own, by which the plan's order is kept, and in the set of its place.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InPlan {
    /// The systems of a stage, or of a step of the trace loop.
    At(Place),
    /// The one system of this name.
    System(SystemId),
}

/// Builds the schedules that `plan` asks for into `world`, and the profile that their executors keep.
///
/// # Panics
/// Never for a plan of [`Plan::new`]: its systems form one chain.
pub fn build_schedules(plan: &Plan, world: &mut World) {
    let mut step = Schedule::new(Step);
    let mut trace_loop = Schedule::new(TraceLoop);
    let (mut last_in_step, mut last_in_loop) = (None, None);
    for system in &plan.systems {
        let (schedule, last) = match system.id.place() {
            Place::Stage(_) => (&mut step, &mut last_in_step),
            Place::Loop(_) => (&mut trace_loop, &mut last_in_loop),
        };
        add(schedule, system.id);
        if let Some(previous) = last.replace(system.id) {
            schedule.configure_sets(InPlan::System(system.id).after(InPlan::System(previous)));
        }
    }
    // The plan's order is the schedules' order, so a system's place in the plan is its place in the profile.
    let mut profile = Profile::default();
    for (mut schedule, in_loop) in [(trace_loop, true), (step, false)] {
        schedule.set_executor(TimingExecutor::new(profile.systems.len()));
        let planned = plan.systems.iter().map(|system| system.id);
        let here = planned.filter(|id| matches!(id.place(), Place::Loop(_)) == in_loop);
        profile.systems.extend(here.map(SystemCost::new));
        // Built now rather than at the first run, so that it can be read back.
        if let Err(error) = schedule.initialize(world) {
            panic!("the plan's systems are one chain, which always builds: {error}");
        }
        world.add_schedule(schedule);
    }
    world.insert_resource(profile);
}

/// The one list of systems: adding one adds its line here and in [`SystemId`].
fn add(schedule: &mut Schedule, id: SystemId) {
    match id {
        SystemId::AssignPixels => place(schedule, id, propose::assign_pixels),
        SystemId::StartCameraPaths => place(schedule, id, propose::start_camera_paths),
        SystemId::TraceLoop => place(schedule, id, trace::trace_loop),
        SystemId::EmitRays => place(schedule, id, trace::emit_rays),
        SystemId::IntersectRays => place(schedule, id, trace::intersect_rays),
        SystemId::ExtendPaths => place(schedule, id, trace::extend_paths),
        SystemId::ConnectLights => place(schedule, id, trace::connect_lights),
        SystemId::TransmitSegments => place(schedule, id, trace::transmit_segments),
        SystemId::ScatterDiffuse => place(schedule, id, trace::scatter_diffuse),
        SystemId::ScatterConductor => place(schedule, id, trace::scatter_conductor),
        SystemId::ScatterDielectric => place(schedule, id, trace::scatter_dielectric),
        SystemId::ContinuePaths => place(schedule, id, trace::continue_paths),
        SystemId::TraceDepthFirst => place(schedule, id, trace::trace_depth_first),
        SystemId::GatherContribution => place(schedule, id, evaluate::gather_contribution),
        SystemId::AcceptAlways => place(schedule, id, accept::accept_always),
        SystemId::SplatSamples => place(schedule, id, splat::splat_samples),
    }
}

fn place<M>(
    schedule: &mut Schedule,
    id: SystemId,
    system: impl IntoScheduleConfigs<bevy_ecs::system::ScheduleSystem, M>,
) {
    schedule.add_systems(system.in_set(InPlan::At(id.place())).in_set(InPlan::System(id)));
}
