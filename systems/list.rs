//! The systems of this crate as plans name them: one line each, in the order of the stages.

use super::{accept, evaluate, propose, splat, trace};
use crate::plan::{Phases, Place, Stage, SystemSpec, TraceStep, Traces};
use crate::system;

const PROPOSE: Place = Place::Stage(Stage::Propose);
const TRACE: Place = Place::Stage(Stage::Trace);
const EVALUATE: Place = Place::Stage(Stage::Evaluate);
const ACCEPT: Place = Place::Stage(Stage::Accept);
const SPLAT: Place = Place::Stage(Stage::Splat);
const SCATTER: Place = Place::Loop(TraceStep::Scatter);

macro_rules! list {
    ($($(#[$doc:meta])* $name:ident = $place:expr, $module:ident :: $function:ident $(, $method:ident ($argument:expr))*;)*) => {
        $($(#[$doc])* pub const $name: SystemSpec = system!($place, $module, $function)$(.$method($argument))*;)*
    };
}

list! {
    /// Gives every chain its pixel and its random streams.
    ASSIGN_PIXELS = PROPOSE, propose::assign_pixels;
    /// Starts a path on the lens of every chain.
    START_CAMERA_PATHS = PROPOSE, propose::start_camera_paths, in_phases(Phases::ALL);

    /// Runs the loop of [`TraceStep`]s.
    TRACE_LOOP = TRACE, trace::trace_loop;
    /// Writes the next ray of every active chain.
    EMIT_RAYS = Place::Loop(TraceStep::Emit), trace::emit_rays;
    /// Finds the closest hits of the ray queue.
    INTERSECT_RAYS = Place::Loop(TraceStep::Intersect), trace::intersect_rays, tracing(Traces::Rays);
    /// Turns hits into path vertices.
    EXTEND_PATHS = Place::Loop(TraceStep::Extend), trace::extend_paths;
    /// Samples a light at every connectable vertex.
    CONNECT_LIGHTS = Place::Loop(TraceStep::Connect), trace::connect_lights;
    /// Traces the segments to the sampled lights.
    TRANSMIT_SEGMENTS = Place::Loop(TraceStep::Transmit), trace::transmit_segments, tracing(Traces::Segments);
    /// Scatters chains that stand on diffuse materials.
    SCATTER_DIFFUSE = SCATTER, trace::scatter_diffuse;
    /// Scatters chains that stand on conductors.
    SCATTER_CONDUCTOR = SCATTER, trace::scatter_conductor;
    /// Scatters chains that stand on dielectrics.
    SCATTER_DIELECTRIC = SCATTER, trace::scatter_dielectric;
    /// Plays Russian roulette and lists who goes on.
    CONTINUE_PATHS = Place::Loop(TraceStep::Continue), trace::continue_paths;
    /// Traces whole paths, one after another.
    TRACE_DEPTH_FIRST = TRACE, trace::trace_depth_first, tracing(Traces::Both);

    /// Sums a path's light from its vertices.
    GATHER_CONTRIBUTION = EVALUATE, evaluate::gather_contribution;
    /// Takes every proposal.
    ACCEPT_ALWAYS = ACCEPT, accept::accept_always;
    /// Adds each chain's sample to the film.
    SPLAT_SAMPLES = SPLAT, splat::splat_samples;
}
