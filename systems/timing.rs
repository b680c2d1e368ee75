//! What every system costs: an executor that reads the clock between systems, always on.
//!
//! bevy's own single-threaded executor keeps no times, and its tracing spans need a subscriber and string names per run.
//! One clock reading per system run (20 to 40 ns) is all that this costs.

use crate::plan::SystemSpec;
use bevy_ecs::error::{BevyError, ErrorContext};
use bevy_ecs::resource::Resource;
use bevy_ecs::schedule::{FixedBitSet, SystemExecutor, SystemSchedule};
use bevy_ecs::system::{RunSystemError, System};
use bevy_ecs::world::World;
use std::time::Instant;

/// What a system has cost so far in one tile world.
#[derive(Clone, Copy, Debug)]
pub struct SystemCost {
    /// Which system.
    pub spec: SystemSpec,
    /// How often it ran.
    pub runs: u64,
    /// Wall time over all runs, in nanoseconds. The trace loop's own time includes its inner systems.
    pub nanoseconds: u64,
}

impl SystemCost {
    pub(super) const fn new(spec: SystemSpec) -> Self {
        Self {
            spec,
            runs: 0,
            nanoseconds: 0,
        }
    }
}

/// One run of a system, for a trace of events.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// Which system.
    pub spec: SystemSpec,
    /// When it began.
    pub start: Instant,
    /// How long it ran, in nanoseconds.
    pub nanoseconds: u64,
}

/// Costs of a tile world's systems, and the single runs if they are recorded.
#[derive(Resource, Default)]
pub struct Profile {
    /// One entry per system: first those of the trace loop, then those of the step, each in the order they run.
    pub systems: Vec<SystemCost>,
    /// Single runs, recorded up to the vector's capacity; nothing is recorded by default.
    pub spans: Vec<Span>,
}

/// Runs a schedule's systems one after another and adds up their times in [`Profile`].
///
/// Run conditions and deferred buffers are not supported: no system here has any, since rows never move.
pub(super) struct TimingExecutor {
    /// Index of the schedule's first system in [`Profile::systems`].
    first: usize,
}

impl TimingExecutor {
    pub(super) const fn new(first: usize) -> Self {
        Self { first }
    }
}

impl SystemExecutor for TimingExecutor {
    fn init(&mut self, _schedule: &SystemSchedule) {}

    #[expect(
        unsafe_code,
        reason = "bevy's only way to run a schedule's systems from an executor of one's own"
    )]
    fn run(
        &mut self,
        schedule: &mut SystemSchedule,
        world: &mut World,
        _skip: Option<&FixedBitSet>,
        error_handler: fn(BevyError, ErrorContext),
    ) {
        // SAFETY: systems are only run, which is a method of the `System` trait; none is replaced, moved or removed.
        let systems = unsafe { schedule.systems_mut() };
        let mut start = Instant::now();
        for (offset, system) in systems.iter_mut().enumerate() {
            let failure = match system.run_without_applying_deferred((), world) {
                Ok(()) => None,
                Err(RunSystemError::Failed(error)) => Some(error),
                // A system whose parameters are missing would leave its tables stale: never pass over it.
                Err(RunSystemError::Skipped(error)) => Some(error.into()),
            };
            if let Some(error) = failure {
                let context = ErrorContext::System {
                    name: system.name(),
                    last_run: system.get_last_run(),
                };
                error_handler(error, context);
            }
            let end = Instant::now();
            if let Some(mut profile) = world.get_resource_mut::<Profile>() {
                let profile = &mut *profile;
                let nanoseconds = end.duration_since(start).as_nanos() as u64;
                if let Some(cost) = profile.systems.get_mut(self.first + offset) {
                    cost.runs += 1;
                    cost.nanoseconds += nanoseconds;
                    if profile.spans.len() < profile.spans.capacity() {
                        profile.spans.push(Span {
                            spec: cost.spec,
                            start,
                            nanoseconds,
                        });
                    }
                }
            }
            start = end;
        }
    }

    fn set_apply_final_deferred(&mut self, _value: bool) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_ecs::prelude::*;
    use bevy_ecs::schedule::ScheduleLabel;

    #[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
    struct Label;

    #[derive(Resource, Default)]
    struct Trail(Vec<u32>);

    fn timed(schedule: &mut Schedule, systems: usize) -> World {
        let mut world = World::new();
        world.init_resource::<Trail>();
        let costs = vec![SystemCost::new(crate::systems::list::ASSIGN_PIXELS); systems];
        world.insert_resource(Profile {
            systems: costs,
            spans: Vec::with_capacity(3),
        });
        schedule.set_executor(TimingExecutor::new(0));
        world
    }

    #[test]
    fn systems_run_in_order_and_every_run_is_counted() {
        let mut schedule = Schedule::new(Label);
        let push = |n: u32| move |mut trail: ResMut<Trail>| trail.0.push(n);
        schedule.add_systems(
            (push(1), push(2), |world: &mut World| {
                world.resource_mut::<Trail>().0.push(3)
            })
                .chain(),
        );
        let mut world = timed(&mut schedule, 3);
        for _ in 0..2 {
            schedule.run(&mut world);
        }
        assert_eq!(world.resource::<Trail>().0, [1, 2, 3, 1, 2, 3]);
        let profile = world.resource::<Profile>();
        assert!(profile.systems.iter().all(|cost| cost.runs == 2));
        assert!(!profile.spans.is_empty() && profile.spans.len() <= profile.spans.capacity());
    }

    #[derive(Resource)]
    struct Absent;

    #[test]
    #[should_panic(expected = "Absent")]
    fn a_system_that_cannot_run_is_never_passed_over() {
        let mut schedule = Schedule::new(Label);
        schedule.add_systems(|_absent: Res<Absent>| {});
        let mut world = timed(&mut schedule, 1);
        schedule.run(&mut world);
    }
}
