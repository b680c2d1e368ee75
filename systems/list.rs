//! The systems of this crate as plans name them: one line each, in the order of the stages.

use super::{accept, bootstrap, evaluate, propose, splat, trace};
use crate::plan::{JoinStep, Phases, Place, Stage, SystemSpec, TraceStep, Traces};
use crate::system;

const PROPOSE: Place = Place::Stage(Stage::Propose);
const TRACE: Place = Place::Stage(Stage::Trace);
const EVALUATE: Place = Place::Stage(Stage::Evaluate);
const ACCEPT: Place = Place::Stage(Stage::Accept);
const SPLAT: Place = Place::Stage(Stage::Splat);
const DRAW: Place = Place::Loop(TraceStep::Draw);

/// Phases that draw independent proposals.
const DRAWS: Phases = Phases::BOOTSTRAP.and(Phases::SEED);
/// Phases that take proposals over.
const TAKES: Phases = Phases::SEED.and(Phases::STEP);

macro_rules! list {
    ($($(#[$doc:meta])* $name:ident = $place:expr, $module:ident :: $function:ident $(, $method:ident ($argument:expr))*;)*) => {
        $($(#[$doc])* pub const $name: SystemSpec = system!($place, $module, $function)$(.$method($argument))*;)*
    };
}

list! {
    /// Gives every chain the key of its sample in a round of the bootstrap.
    KEY_SAMPLES = PROPOSE, bootstrap::key_samples, in_phases(Phases::BOOTSTRAP);
    /// Lists every chain for the independent mutation.
    START_INDEPENDENT = PROPOSE, bootstrap::start_independent, in_phases(DRAWS);
    /// Writes f(y)/T(y) of every sample of a bootstrap.
    WEIGH_SAMPLES = EVALUATE, bootstrap::weigh_samples, in_phases(Phases::BOOTSTRAP);

    /// Gives every chain the key of a new step.
    KEY_CHAINS = PROPOSE, propose::key_chains;
    /// Chooses a mutation for every chain.
    CHOOSE_MUTATION = PROPOSE, propose::choose_mutation;
    /// Draws where chains that take a large step start.
    PROPOSE_LARGE_STEPS = PROPOSE, propose::propose_large_steps, in_phases(Phases::ALL);
    /// Draws the coordinates of their vertices.
    DRAW_LARGE_STEPS = DRAW, propose::draw_large_steps;
    /// Moves where chains that take a small step start.
    PROPOSE_SMALL_STEPS = PROPOSE, propose::propose_small_steps;
    /// Moves the coordinates of their vertices.
    DRAW_SMALL_STEPS = DRAW, propose::draw_small_steps;
    /// Draws where on the film small steps can lead, uniformly.
    PROPOSE_SMALL_SUPPORTS = PROPOSE, propose::propose_small_supports;
    /// Draws where the coordinates of their vertices can be led, uniformly.
    DRAW_SMALL_SUPPORTS = DRAW, propose::draw_small_supports;
    /// Writes the density of those draws.
    WEIGH_SMALL_SUPPORTS = EVALUATE, propose::weigh_small_supports, in_phases(Phases::STEP);
    /// Starts chains that stay where they are.
    PROPOSE_IDENTITIES = PROPOSE, propose::propose_identities;
    /// Copies the coordinates of their vertices.
    DRAW_IDENTITIES = DRAW, propose::draw_identities;

    /// Makes room for the subpaths that mutations ask for.
    MAKE_ROOM = PROPOSE, propose::make_room, in_phases(Phases::ALL);
    /// Copies what proposals keep of paths, and starts what is new.
    START_PATHS = PROPOSE, propose::start_paths, in_phases(Phases::ALL);

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
    /// Plays Russian roulette and lists who goes on.
    CONTINUE_PATHS = Place::Loop(TraceStep::Continue), trace::continue_paths;
    /// Lists who goes on, where subpaths end as mutations say.
    CONTINUE_TO_STOP = Place::Loop(TraceStep::Continue), trace::continue_to_stop;
    /// Writes the segments that complete whole paths.
    JOIN_PATHS = TRACE, trace::join_paths;
    /// Traces those segments.
    TRANSMIT_PATHS = TRACE, trace::transmit_connections, tracing(Traces::Segments);
    /// Writes what whole paths bring, and their densities.
    EVALUATE_PATHS = EVALUATE, evaluate::evaluate_paths, in_phases(Phases::ALL);
    /// Starts a subpath on a light for every chain.
    START_LIGHT_PATHS = PROPOSE, propose::start_light_paths, in_phases(Phases::ALL);
    /// Lists every subpath for the coordinates of its start.
    LIST_STARTS = PROPOSE, propose::list_starts, in_phases(Phases::ALL);
    /// [`START_CAMERA_PATHS`] where starts have primary coordinates: in the first round of the trace loop.
    START_CAMERA_PATHS_DRAWN = Place::Loop(TraceStep::Continue), propose::start_camera_paths;
    /// [`START_LIGHT_PATHS`] likewise.
    START_LIGHT_PATHS_DRAWN = Place::Loop(TraceStep::Continue), propose::start_light_paths;
    /// Runs the loop of [`JoinStep`]s.
    JOIN_LOOP = TRACE, trace::join_loop;
    /// Offers the next strategies that join subpaths.
    OFFER_CONNECTIONS = Place::Join(JoinStep::Offer), trace::offer_connections;
    /// Traces the segments that they offer.
    TRANSMIT_CONNECTIONS = Place::Join(JoinStep::Transmit), trace::transmit_connections, tracing(Traces::Segments);
    /// Adds what arrived to the chains' lists.
    BOOK_CONNECTIONS = Place::Join(JoinStep::Book), trace::book_connections;
    /// Writes the target of every proposal's list.
    EVALUATE_LISTS = EVALUATE, evaluate::evaluate_lists;
    /// Takes every proposal's list.
    ACCEPT_LISTS = ACCEPT, accept::accept_lists;
    /// Adds each chain's list to the film.
    SPLAT_LISTS = SPLAT, splat::splat_lists;
    /// Adds its layers to theirs.
    SPLAT_LIST_LAYERS = SPLAT, splat::splat_list_layers;

    /// Traces whole paths, one after another.
    TRACE_DEPTH_FIRST = TRACE, trace::trace_depth_first, tracing(Traces::Both);

    /// Runs one step of one chain after another, its path traced whole.
    MUTATE_DEPTH_FIRST = TRACE, trace::mutate_depth_first, in_phases(Phases::STEP), tracing(Traces::Both);
    /// Makes the proposals of whole paths, one chain after another.
    PROPOSE_PATHS_DEPTH_FIRST = TRACE, trace::propose_paths_depth_first, in_phases(Phases::STEP), tracing(Traces::Both);

    /// Sums a path's light from its vertices.
    GATHER_CONTRIBUTION = EVALUATE, evaluate::gather_contribution;
    /// Splits it among layers.
    SPLIT_LAYERS = EVALUATE, evaluate::split_layers;
    /// Writes the target and the splats of every proposal.
    EVALUATE_TARGETS = EVALUATE, evaluate::evaluate_targets;
    /// Adds up what independent proposals tell of the normalization.
    TALLY_INDEPENDENT = EVALUATE, evaluate::tally_independent, in_phases(Phases::STEP);
    /// Adds the choice of the mutation to the densities.
    WEIGH_CHOICES = EVALUATE, evaluate::weigh_choices, in_phases(Phases::STEP);

    /// Decides for every chain whether it takes its proposal.
    DECIDE = ACCEPT, accept::decide;
    /// Takes the coordinates of accepted proposals over.
    TAKE_COORDINATES = ACCEPT, accept::take_coordinates;
    /// Takes the paths of accepted proposals over.
    TAKE_PATHS = ACCEPT, accept::take_paths, in_phases(TAKES);
    /// Counts where chains are.
    COUNT_VISITS = ACCEPT, accept::count_visits, in_phases(Phases::STEP);
    /// Adds both states of every decision to the film, by expectation.
    SPLAT_STATES = SPLAT, splat::splat_states;
    /// Adds the layers of both states to theirs.
    SPLAT_STATE_LAYERS = SPLAT, splat::splat_state_layers;
    /// Takes the layers of accepted proposals over.
    TAKE_LAYERS = SPLAT, splat::take_layers, in_phases(TAKES);
    /// Takes the splats of accepted proposals over.
    TAKE_SPLATS = SPLAT, splat::take_splats, in_phases(TAKES);

    /// Takes every proposal.
    ACCEPT_ALWAYS = ACCEPT, accept::accept_always;
    /// Adds each chain's sample to the film.
    SPLAT_SAMPLES = SPLAT, splat::splat_samples;
    /// Adds its layers to theirs.
    SPLAT_SAMPLE_LAYERS = SPLAT, splat::splat_sample_layers;
}
