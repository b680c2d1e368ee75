//! Systems as a plan lists them: by name, place and reason.

use bevy_ecs::schedule::{Schedule, SystemSet};
use std::fmt;
use std::hash::{Hash, Hasher};

/// The stages of a step, in the order in which they run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Chooses what to try and writes the proposal's start.
    Propose,
    /// Traces rays until no chain waits for one.
    Trace,
    /// Computes the proposal's contribution.
    Evaluate,
    /// Takes one decision for every chain.
    Accept,
    /// Adds what was booked to the film.
    Splat,
}

/// The steps of the trace stage's loop, in the order in which they run, until no chain waits for a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TraceStep {
    /// Writes a ray for every chain that waits for one.
    Emit,
    /// Finds what all rays meet.
    Intersect,
    /// Appends the vertices that were met.
    Extend,
    /// Writes the primary coordinates that the new vertices will use.
    Draw,
    /// Samples a light for every new vertex that can be connected to one.
    Connect,
    /// Finds what passes along the segments to the lights.
    Transmit,
    /// Samples the directions in which paths go on, one system per material model.
    Scatter,
    /// Ends paths at random, and lists the chains that wait for the next ray.
    Continue,
}

/// The steps of the loop that joins subpaths, in the order in which they run, until every strategy has been offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum JoinStep {
    /// Writes the segments of the next strategies, and what each would bring.
    Offer,
    /// Finds what passes along them.
    Transmit,
    /// Adds what arrived to the chains' lists.
    Book,
}

/// A schedule that the trace stage repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Repeated {
    /// The trace loop.
    Trace,
    /// The join loop.
    Join,
}

/// Where in a step a system runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// In a stage.
    Stage(Stage),
    /// In a step of the trace stage's loop.
    Loop(TraceStep),
    /// In a step of the loop that joins subpaths, behind it.
    Join(JoinStep),
}

/// In which runs of a tile's stages a system takes part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Phases {
    bits: u8,
}

impl Phases {
    /// Independent proposals are drawn and evaluated, for the normalization and for seeds.
    pub const BOOTSTRAP: Self = Self { bits: 1 };
    /// The chosen seeds are drawn again and become the chains' first states.
    pub const SEED: Self = Self { bits: 2 };
    /// Every chain takes one step.
    pub const STEP: Self = Self { bits: 4 };
    /// In all of them.
    pub const ALL: Self = Self { bits: 7 };

    /// In these and in those of `other`.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self {
            bits: self.bits | other.bits,
        }
    }

    /// In these, but in none of `other`.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self {
            bits: self.bits & !other.bits,
        }
    }

    /// Whether there are none.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.bits == 0
    }

    /// Whether these have all of `other`.
    #[must_use]
    pub const fn has(self, other: Self) -> bool {
        self.bits & other.bits == other.bits
    }

    /// Where systems of a place take part if nothing else is said: what traces and evaluates always, what decides once
    /// there are states, what proposes and splats in steps alone.
    const fn of(place: Place) -> Self {
        match place {
            Place::Stage(Stage::Propose | Stage::Splat) => Self::STEP,
            Place::Stage(Stage::Accept) => Self::SEED.and(Self::STEP),
            Place::Stage(Stage::Trace | Stage::Evaluate) | Place::Loop(_) | Place::Join(_) => Self::ALL,
        }
    }
}

/// What of the counters a system's time is divided by, in profiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Traces {
    /// It traces nothing.
    Nothing,
    /// Rays.
    Rays,
    /// Segments.
    Segments,
    /// Rays and segments.
    Both,
}

/// A system as plans and profiles know it: its function's name, where it runs, and how it comes into a schedule. Two
/// systems of one name are the same. [`system!`](crate::system) makes one from a function, in this crate or any other.
#[derive(Clone, Copy)]
pub struct SystemSpec {
    name: &'static str,
    place: Place,
    phases: Phases,
    traces: Traces,
    add: fn(&mut Schedule, SystemSpec),
}

/// Every system is in a set of its own, by which the plan's order is kept, and in the set of its place.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InPlan {
    /// The systems of a stage, or of a step of the trace loop.
    At(Place),
    /// The one system of this name.
    System(SystemSpec),
}

impl SystemSpec {
    /// The system `name` at `place`, which `add` brings into a schedule. Use [`system!`](crate::system).
    #[must_use]
    pub const fn new(name: &'static str, place: Place, add: fn(&mut Schedule, Self)) -> Self {
        Self {
            name,
            place,
            phases: Phases::of(place),
            traces: Traces::Nothing,
            add,
        }
    }

    /// The same system, taking part in `phases`.
    #[must_use]
    pub const fn in_phases(self, phases: Phases) -> Self {
        Self { phases, ..self }
    }

    /// The same system, whose time profiles divide by what it traces.
    #[must_use]
    pub const fn tracing(self, traces: Traces) -> Self {
        Self { traces, ..self }
    }

    /// The system's name: that of its function.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// Where in a step the system runs.
    #[must_use]
    pub const fn place(self) -> Place {
        self.place
    }

    /// In which phases the system takes part.
    #[must_use]
    pub const fn phases(self) -> Phases {
        self.phases
    }

    /// What the system traces.
    #[must_use]
    pub const fn traces(self) -> Traces {
        self.traces
    }

    /// The loop that the system runs in, if it runs in one.
    #[must_use]
    pub const fn repeated(self) -> Option<Repeated> {
        match self.place {
            Place::Stage(_) => None,
            Place::Loop(_) => Some(Repeated::Trace),
            Place::Join(_) => Some(Repeated::Join),
        }
    }

    /// The stage that the system's time counts for.
    #[must_use]
    pub const fn stage(self) -> Stage {
        match self.place {
            Place::Stage(stage) => stage,
            Place::Loop(_) | Place::Join(_) => Stage::Trace,
        }
    }

    /// Adds the system to `schedule`.
    pub fn add_to(self, schedule: &mut Schedule) {
        (self.add)(schedule, self);
    }
}

impl PartialEq for SystemSpec {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for SystemSpec {}

impl Hash for SystemSpec {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl fmt::Debug for SystemSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({:?})", self.name, self.place)
    }
}

/// Makes a [`SystemSpec`](crate::plan::SystemSpec) of a system function: `system!(Place::Stage(Stage::Accept), decide)`,
/// or `system!(place, module, function)` where the function stands in a module, or `system!(place, "name" => function)` where
/// one function is several systems. The crate needs `bevy_ecs` among its dependencies.
#[macro_export]
macro_rules! system {
    ($place:expr, $function:ident) => {
        $crate::plan::SystemSpec::new(stringify!($function), $place, |schedule, spec| {
            use $crate::bevy_ecs::schedule::IntoScheduleConfigs;
            schedule.add_systems(
                $function
                    .in_set($crate::plan::InPlan::At(spec.place()))
                    .in_set($crate::plan::InPlan::System(spec)),
            );
        })
    };
    ($place:expr, $name:expr => $function:expr) => {
        $crate::plan::SystemSpec::new($name, $place, |schedule, spec| {
            use $crate::bevy_ecs::{schedule::IntoScheduleConfigs, system::IntoSystem};
            schedule.add_systems(
                IntoSystem::into_system($function)
                    .with_name($name)
                    .in_set($crate::plan::InPlan::At(spec.place()))
                    .in_set($crate::plan::InPlan::System(spec)),
            );
        })
    };
    ($place:expr, $module:ident, $function:ident) => {
        $crate::plan::SystemSpec::new(stringify!($function), $place, |schedule, spec| {
            use $crate::bevy_ecs::schedule::IntoScheduleConfigs;
            schedule.add_systems(
                $module::$function
                    .in_set($crate::plan::InPlan::At(spec.place()))
                    .in_set($crate::plan::InPlan::System(spec)),
            );
        })
    };
}

impl Stage {
    /// Every stage, in order.
    pub const ALL: [Self; 5] = [Self::Propose, Self::Trace, Self::Evaluate, Self::Accept, Self::Splat];

    /// The stage's name as reports print it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Propose => "propose",
            Self::Trace => "trace",
            Self::Evaluate => "evaluate",
            Self::Accept => "accept",
            Self::Splat => "splat",
        }
    }
}

/// A system of a plan.
#[derive(Clone, Debug)]
pub struct SystemPlan {
    /// Which.
    pub spec: SystemSpec,
    /// Why it runs.
    pub reason: &'static str,
}

impl SystemPlan {
    /// The system `spec`, and why it runs.
    #[must_use]
    pub const fn new(spec: SystemSpec, reason: &'static str) -> Self {
        Self { spec, reason }
    }
}
