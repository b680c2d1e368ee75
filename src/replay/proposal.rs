//! What was proposed in a step, how likely that was, and what was decided.

use super::number::number;
use super::path::{Vertex, vertices};
use super::state::{
    Classes, Coordinates, FilmStart, SplatAt, State, camera_path, classes, column_and_row, coordinates, film_start,
    light_path, splats,
};
use crate::chain::{
    Acceptance, Booking, ChosenMutation, CommonDensity, ForwardDensity, KeyChain, ProposedClass, ProposedTarget,
    Reason, ReverseDensity, StateClass, metropolis,
};
use crate::color::Rgb;
use crate::path::*;
use crate::plan::Plan;
use crate::render::{LoneChain, TileWorld};
use crate::sampling::{Purpose, StreamKey};
use crate::scene::Scene;
use crate::systems::chains::Mutations;
use crate::systems::list::WEIGH_CHOICES;
use crate::systems::tile::TilePlace;
use serde::{Serialize, Serializer};

/// The mutation that was tried.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chosen {
    /// Its number in the plan.
    #[serde(skip)]
    pub number: usize,
    /// Its name.
    pub name: &'static str,
    /// The probability of choosing it in the state before.
    pub probability: f64,
    /// The probability of choosing it in the proposal, for the way back.
    pub probability_back: f64,
    /// The uniform number that chose it.
    pub uniform: f64,
}

/// What was proposed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Proposal {
    /// Where its path starts.
    pub film: Option<FilmStart>,
    /// The primary coordinates of its vertices; none where random numbers are drawn and not kept.
    pub coordinates: Vec<Coordinates>,
    /// Those of its light subpath, where it has one.
    pub light_coordinates: Vec<Coordinates>,
    /// Its vertices, the lens first.
    pub vertices: Vec<Vertex>,
    /// Those of its light subpath, the light first.
    pub light_vertices: Vec<Vertex>,
    /// Its light, summed from its vertices: f/p, W sr⁻¹ m⁻². None where subpaths are joined: then it is in the splats alone.
    #[serde(serialize_with = "number")]
    pub contribution: Option<Rgb>,
    /// What the film is given of it where samples are independent: black if it is not finite.
    #[serde(serialize_with = "number")]
    pub booked: Option<Rgb>,
    /// The target f(y), in chains.
    #[serde(serialize_with = "number")]
    pub target: Option<f32>,
    /// Its classes, in chains.
    pub class: Option<Classes>,
    /// What it adds to the film for a weight of one, in chains and where subpaths are joined.
    pub splats: Vec<SplatAt>,
    /// How likely it was, in chains.
    pub densities: Option<Densities>,
}

/// Transition densities in logarithms, whole and in parts: ln T = choice + own + common.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Densities {
    /// ln T(x→y).
    #[serde(serialize_with = "number")]
    pub forward: f64,
    /// ln T(y→x).
    #[serde(serialize_with = "number")]
    pub reverse: f64,
    /// ln of the probability of choosing the mutation, in x and in y.
    #[serde(serialize_with = "pair")]
    pub choice: [f64; 2],
    /// What the mutation's density there has of its own, and that of its way back.
    #[serde(serialize_with = "pair")]
    pub own: [f64; 2],
    /// What the mutation's densities have in common.
    #[serde(serialize_with = "number")]
    pub common: f64,
}

/// A decision, and what it rests on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// The acceptance a(x→y).
    pub acceptance: f64,
    /// The uniform number in [0, 1) that it was compared with; none where there was nothing to decide.
    pub uniform: Option<f64>,
    /// Whether the proposal was taken.
    pub accepted: bool,
    /// What the acceptance rests on.
    #[serde(serialize_with = "reason")]
    pub reason: Reason,
}

fn pair<S: Serializer>(values: &[f64; 2], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct One(#[serde(serialize_with = "number")] f64);
    values.map(One).serialize(serializer)
}

fn reason<S: Serializer>(reason: &Reason, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(reason.text())
}

/// The key of the random numbers of the step that was taken last.
fn key(world: &mut TileWorld) -> Option<StreamKey> {
    let bits = world.at::<ChainKey, ChainTable>(0)?;
    let chain = world.at::<KeyChain, ChainTable>(0);
    let chain = chain.unwrap_or_else(|| world.world().resource::<TilePlace>().first_chain);
    Some(StreamKey::from_bits(bits, chain))
}

/// The mutation that was tried in the step from `before`.
pub(super) fn chosen(lone: &mut LoneChain, plan: &Plan, before: &State) -> Option<Chosen> {
    let world = &mut lone.world;
    let number = world.at::<ChosenMutation, ChainTable>(0)? as usize;
    let proposed = world.at::<ProposedClass, ChainTable>(0)?;
    let uniform = key(world)?.stream(Purpose::MUTATION, 0).next_f64();
    let mutations = Mutations::new(&plan.chains.as_ref()?.mutations);
    Some(Chosen {
        number,
        name: mutations.get(number)?.name(),
        probability: mutations.probability(number, StateClass(before.class.number)),
        probability_back: mutations.probability(number, StateClass(proposed)),
        uniform,
    })
}

/// What was proposed in the step that was taken last.
pub(super) fn proposal(lone: &mut LoneChain, scene: &Scene, plan: &Plan, chosen: Option<&Chosen>) -> Proposal {
    let world = &mut lone.world;
    let (camera, light) = (camera_path(world), light_path(world));
    let (vertices, contribution) = self::vertices(world, scene, camera);
    let (light_vertices, _) = self::vertices(world, scene, light);
    let count = world.at::<ProposedSplatCount, ChainTable>(0).unwrap_or(0);
    let class = world.at::<ProposedClass, ChainTable>(0);
    Proposal {
        film: film(world, scene),
        coordinates: coordinates::<ProposedDepth, ProposedPrimaryTable>(world, camera),
        light_coordinates: coordinates::<ProposedDepth, ProposedPrimaryTable>(world, light),
        vertices,
        light_vertices,
        contribution: plan.strategies.is_none().then_some(contribution),
        booked: world
            .at::<Contribution, ChainTable>(0)
            .filter(|_| plan.chains.is_none()),
        target: world.at::<ProposedTarget, ChainTable>(0),
        class: class.map(|number| classes(number, &lone.blocks)),
        splats: splats::<ProposedSplatTable>(world, count, scene),
        densities: chosen.and_then(|chosen| densities(world, plan, chosen)),
    }
}

/// Where the path starts: by its coordinates, or through a film position drawn from the filter about its pixel.
fn film(world: &mut TileWorld, scene: &Scene) -> Option<FilmStart> {
    if let Some(bits) = world.at::<ProposedFilm, ChainTable>(0) {
        return Some(film_start(FilmCoordinates(bits), scene));
    }
    let pixel = world.at::<FilmPixel, ChainTable>(0)?;
    let position = film_position(scene, key(world)?, pixel);
    Some(FilmStart {
        coordinates: None,
        bits: None,
        pixel: column_and_row(pixel, scene),
        position: position.to_array(),
    })
}

/// The densities of the step that was taken last. The plan's systems add the choice of the mutation to them where it
/// depends on the state; it is shown apart in any case.
fn densities(world: &mut TileWorld, plan: &Plan, chosen: &Chosen) -> Option<Densities> {
    let common = world.at::<CommonDensity, ChainTable>(0).unwrap_or(0.0);
    let written = [
        world.at::<ForwardDensity, ChainTable>(0)?,
        world.at::<ReverseDensity, ChainTable>(0)?,
    ];
    let choice = [chosen.probability, chosen.probability_back].map(libm::log);
    let weighed = plan.tile.systems.iter().any(|system| system.spec == WEIGH_CHOICES);
    let of_way = |way: usize| {
        if weighed {
            // An impossible choice leaves nothing to be taken apart.
            let own = if choice[way].is_finite() {
                written[way] - choice[way]
            } else {
                0.0
            };
            (own, written[way])
        } else {
            (written[way], written[way] + choice[way])
        }
    };
    let ((own_there, there), (own_back, back)) = (of_way(0), of_way(1));
    Some(Densities {
        forward: there + common,
        reverse: back + common,
        choice,
        own: [own_there, own_back],
        common,
    })
}

/// The decision between `before` and the proposal. What it rests on is found again from what it read.
pub(super) fn verdict(lone: &mut LoneChain, before: &State, after: &State) -> Option<Verdict> {
    let world = &mut lone.world;
    let rule = metropolis(
        before.target,
        world.at::<ProposedTarget, ChainTable>(0)?,
        world.at::<ForwardDensity, ChainTable>(0)?,
        world.at::<ReverseDensity, ChainTable>(0)?,
    );
    let booking = Booking::of(rule.acceptance);
    let decided = !booking.is_certain() && booking.accepted > 0.0;
    let uniform = key(world)?.stream(Purpose::ACCEPT, 0).next_f64();
    Some(Verdict {
        acceptance: world.at::<Acceptance, ChainTable>(0)?,
        uniform: decided.then_some(uniform),
        accepted: after.rejections == 0,
        reason: rule.reason,
    })
}
