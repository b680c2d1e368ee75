//! Systems as a plan lists them: by name and reason, not yet by function.

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
    /// Samples a light for every new vertex that can be connected to one.
    Connect,
    /// Finds what passes along the segments to the lights.
    Transmit,
    /// Samples the directions in which paths go on, one system per material model.
    Scatter,
    /// Ends paths at random, and lists the chains that wait for the next ray.
    Continue,
}

/// Where in a step a system runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// In a stage.
    Stage(Stage),
    /// In a step of the trace stage's loop.
    Loop(TraceStep),
}

/// Every system that a plan can ask for. Its function stands in `systems/`, in the folder of its stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SystemId {
    /// Gives every chain its pixel and its random streams.
    AssignPixels,
    /// Starts a path on the lens of every chain.
    StartCameraPaths,
    /// Runs the loop of [`TraceStep`]s.
    TraceLoop,
    /// Writes the next ray of every active chain.
    EmitRays,
    /// Finds the closest hits of the ray queue.
    IntersectRays,
    /// Turns hits into path vertices.
    ExtendPaths,
    /// Samples a light at every connectable vertex.
    ConnectLights,
    /// Traces the segments to the sampled lights.
    TransmitSegments,
    /// Scatters chains that stand on diffuse materials.
    ScatterDiffuse,
    /// Scatters chains that stand on conductors.
    ScatterConductor,
    /// Scatters chains that stand on dielectrics.
    ScatterDielectric,
    /// Plays Russian roulette and lists who goes on.
    ContinuePaths,
    /// Traces whole paths, one after another.
    TraceDepthFirst,
    /// Sums a path's light from its vertices.
    GatherContribution,
    /// Takes every proposal.
    AcceptAlways,
    /// Adds each chain's sample to the film.
    SplatSamples,
}

impl SystemId {
    /// The system's name: that of its function.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AssignPixels => "assign_pixels",
            Self::StartCameraPaths => "start_camera_paths",
            Self::TraceLoop => "trace_loop",
            Self::EmitRays => "emit_rays",
            Self::IntersectRays => "intersect_rays",
            Self::ExtendPaths => "extend_paths",
            Self::ConnectLights => "connect_lights",
            Self::TransmitSegments => "transmit_segments",
            Self::ScatterDiffuse => "scatter_diffuse",
            Self::ScatterConductor => "scatter_conductor",
            Self::ScatterDielectric => "scatter_dielectric",
            Self::ContinuePaths => "continue_paths",
            Self::TraceDepthFirst => "trace_depth_first",
            Self::GatherContribution => "gather_contribution",
            Self::AcceptAlways => "accept_always",
            Self::SplatSamples => "splat_samples",
        }
    }

    /// Where in a step the system runs.
    #[must_use]
    pub const fn place(self) -> Place {
        match self {
            Self::AssignPixels | Self::StartCameraPaths => Place::Stage(Stage::Propose),
            Self::TraceLoop | Self::TraceDepthFirst => Place::Stage(Stage::Trace),
            Self::EmitRays => Place::Loop(TraceStep::Emit),
            Self::IntersectRays => Place::Loop(TraceStep::Intersect),
            Self::ExtendPaths => Place::Loop(TraceStep::Extend),
            Self::ConnectLights => Place::Loop(TraceStep::Connect),
            Self::TransmitSegments => Place::Loop(TraceStep::Transmit),
            Self::ScatterDiffuse | Self::ScatterConductor | Self::ScatterDielectric => Place::Loop(TraceStep::Scatter),
            Self::ContinuePaths => Place::Loop(TraceStep::Continue),
            Self::GatherContribution => Place::Stage(Stage::Evaluate),
            Self::AcceptAlways => Place::Stage(Stage::Accept),
            Self::SplatSamples => Place::Stage(Stage::Splat),
        }
    }

    /// The stage that the system's time counts for.
    #[must_use]
    pub const fn stage(self) -> Stage {
        match self.place() {
            Place::Stage(stage) => stage,
            Place::Loop(_) => Stage::Trace,
        }
    }
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
    pub id: SystemId,
    /// Why it runs.
    pub reason: &'static str,
}

impl SystemPlan {
    pub(super) const fn new(id: SystemId, reason: &'static str) -> Self {
        Self { id, reason }
    }
}
