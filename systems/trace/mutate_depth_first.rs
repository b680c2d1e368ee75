//! Chains run depth first: one step of one chain after another, as most renderers work. It is the oracle of the staged
//! chains (the same draws give the same states, bit for bit) and the honest baseline of their benchmark.

use super::super::chains::{ChainStatistics, GroupPlace, Mutations, global_chain};
use super::super::evaluate::normalized;
use super::super::tile::{Counters, FilmBlocks, GroupFilmRef, SceneRef, TilePlace};
use super::depth_first::{OneRay, Tracer};
use super::draws::CoordinatesMut;
use crate::chain::{
    Acceptance, Booking, Class, LongestRejections, Rejections, StateClass, Target, decide_with, metropolis,
};
use crate::color::Rgb;
use crate::film::Splat;
use crate::path::{
    BookedWeight, ChainTable, CoordinateColumns, CoordinateColumnsMut, Decisions, FilmCoordinates, LightDraw,
    PathDraws, PrimaryDepth, PrimaryFilm, PrimaryTable, ProposedPrimaryTable, SplatColor, SplatCount, SplatPixel,
    SplatTable, VertexCoordinates, target_of,
};
use crate::plan::MovesVertices;
use crate::sampling::{Purpose, StreamKey};
use crate::table::{Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};
use std::sync::PoisonError;

/// Splats handed to the film at a time: enough to share its lock, few enough for the stack.
const BATCH: usize = 256;

/// What a whole render or tile has in common.
#[derive(SystemParam)]
pub struct Shared<'w> {
    scene: Res<'w, SceneRef>,
    mutations: Res<'w, Mutations>,
    blocks: Res<'w, FilmBlocks>,
    film: Res<'w, GroupFilmRef>,
    place: Res<'w, TilePlace>,
    group: Res<'w, GroupPlace>,
    counters: ResMut<'w, Counters>,
    statistics: ResMut<'w, ChainStatistics>,
}

/// The chains' states, and what their decisions leave.
#[derive(SystemParam)]
pub struct States<'w, 's> {
    films: Write<'w, 's, PrimaryFilm, ChainTable>,
    depths: Write<'w, 's, PrimaryDepth, ChainTable>,
    targets: Write<'w, 's, Target, ChainTable>,
    classes: Write<'w, 's, Class, ChainTable>,
    splat_counts: Write<'w, 's, SplatCount, ChainTable>,
    splat_pixels: Write<'w, 's, SplatPixel, SplatTable>,
    splat_colors: Write<'w, 's, SplatColor, SplatTable>,
    acceptances: Write<'w, 's, Acceptance, ChainTable>,
    weights: Write<'w, 's, BookedWeight, ChainTable>,
    decisions: Write<'w, 's, Decisions, ChainTable>,
    rejections: Write<'w, 's, Rejections, ChainTable>,
    longest: Write<'w, 's, LongestRejections, ChainTable>,
}

/// The coordinates of a proposal, moved from those of the current state as the path reaches their vertices.
struct MovedDraws<'a, 'b> {
    mutation: &'a dyn MovesVertices,
    key: StreamKey,
    place: &'a TilePlace,
    chain: usize,
    current: CoordinateColumns<'a>,
    /// Where the current path's coordinates end.
    current_depth: u32,
    proposed: &'a mut CoordinateColumnsMut<'b>,
    /// The depth reached, and the coordinates there.
    depth: u32,
    here: VertexCoordinates,
}

impl PathDraws for MovedDraws<'_, '_> {
    #[inline]
    fn lens(&mut self) -> [f32; 2] {
        self.reach(0);
        self.here.scatter_draw()
    }

    #[inline]
    fn reach(&mut self, depth: u32) {
        let vertex = self.place.coordinate(self.chain, depth);
        self.here = if depth <= self.current_depth {
            self.mutation.vertex(self.current.at(vertex), self.key, depth)
        } else {
            VertexCoordinates::independent(self.key, depth)
        };
        self.proposed.put(vertex, self.here);
        self.depth = depth;
    }

    #[inline]
    fn light(&mut self, _: u32) -> LightDraw {
        self.here.light_draw()
    }

    #[inline]
    fn scatter(&mut self, _: u32) -> [f32; 2] {
        self.here.scatter_draw()
    }

    #[inline]
    fn lobe(&mut self, _: u32) -> f32 {
        self.here.lobe_draw()
    }

    #[inline]
    fn roulette(&mut self, _: u32) -> f32 {
        self.here.roulette_draw()
    }
}

/// Runs one step of every chain in turn: chooses a mutation, traces the proposal's whole path, decides (one decision a chain
/// and step, whatever the proposal), adds both states to the film by expectation, and takes an accepted proposal over.
pub fn mutate_depth_first(
    mut shared: Shared,
    mut states: States,
    mut current: CoordinatesMut<PrimaryTable>,
    mut proposed: CoordinatesMut<ProposedPrimaryTable>,
    mut ray: OneRay,
) {
    let Shared {
        scene,
        mutations,
        blocks,
        film,
        place,
        group,
        counters,
        statistics,
    } = &mut shared;
    let scene = &*scene.0;
    let mut states = states.columns();
    let (mut current, mut proposed) = (current.columns(), proposed.columns());
    let mut splats = Batch::new(film);
    for chain in 0..place.chains as usize {
        let global = global_chain(place, chain);
        let key = StreamKey::new(place.seed, global, place.step);
        let left = StateClass(states.classes.at(chain));
        let number = mutations.choose(left, key.stream(Purpose::MUTATION, 0).next_f64());
        // A plan has none that cannot.
        let Some(mutation) = mutations.depth_first(number) else {
            continue;
        };
        let start = mutation.film(FilmCoordinates(states.films.at(chain)), key);
        let (pixel, position) = start.on_film(scene);
        let mut draws = MovedDraws {
            mutation,
            key,
            place,
            chain,
            current: current.shared(),
            current_depth: states.depths.at(chain),
            proposed: &mut proposed,
            depth: 0,
            here: VertexCoordinates::default(),
        };
        let (light, class) = Tracer::new(scene, place.heuristic, counters, &mut ray).trace(position, &mut draws);
        let depth = draws.depth;
        let block = blocks.0.block_of(pixel).unwrap_or(0) as u32;
        let proposal = Proposal {
            target: target_of(light),
            class: class.in_block(block),
            light,
            pixel,
        };
        if !proposal.target.is_finite() {
            counters.note_non_finite(global, place.step);
        }
        if number == mutations.independent() {
            statistics.independent.add(f64::from(proposal.target), group.unit);
        }
        let (mut there, mut back) = (0.0, 0.0);
        if mutations.is_selective() {
            there += libm::log(mutations.probability(number, left));
            back += libm::log(mutations.probability(number, proposal.class));
        }
        let rule = metropolis(states.targets.at(chain), proposal.target, there, back);
        let booking = Booking::of(rule.acceptance);
        let accepted =
            booking.is_certain() || decide_with(booking.accepted, || key.stream(Purpose::ACCEPT, 0).next_f64());
        statistics.book(number, left, accepted, booking.accepted == 0.0);
        counters.decisions += 1;
        states.splat(place, chain, &booking, &proposal, &mut splats);
        states.book(chain, &booking, accepted);
        if accepted {
            states.films.put(chain, start.0);
            states.depths.put(chain, depth);
            for vertex in (place.first_coordinate..=depth).map(|d| place.coordinate(chain, d)) {
                current.put(vertex, proposed.shared().at(vertex));
            }
            states.take(chain, &proposal);
        }
        if states.targets.at(chain) > 0.0 {
            statistics.visit(group.batch(global), StateClass(states.classes.at(chain)));
        }
    }
    splats.flush();
    counters.steps += 1;
}

/// What a path from the camera came to.
struct Proposal {
    target: f32,
    class: StateClass,
    light: Rgb,
    pixel: u32,
}

impl Proposal {
    /// Its one splat, if it has light that can be counted.
    fn splat(&self) -> Option<Splat> {
        (self.target > 0.0 && self.target.is_finite()).then(|| Splat {
            pixel: self.pixel,
            value: normalized(self.light, self.target),
        })
    }
}

/// [`States`] as slices.
struct StateColumns<'a> {
    films: &'a mut [PrimaryFilm],
    depths: &'a mut [PrimaryDepth],
    targets: &'a mut [Target],
    classes: &'a mut [Class],
    splat_counts: &'a mut [SplatCount],
    splat_pixels: &'a mut [SplatPixel],
    splat_colors: &'a mut [SplatColor],
    acceptances: &'a mut [Acceptance],
    weights: &'a mut [BookedWeight],
    decisions: &'a mut [Decisions],
    rejections: &'a mut [Rejections],
    longest: &'a mut [LongestRejections],
}

impl States<'_, '_> {
    fn columns(&mut self) -> StateColumns<'_> {
        StateColumns {
            films: self.films.rows(),
            depths: self.depths.rows(),
            targets: self.targets.rows(),
            classes: self.classes.rows(),
            splat_counts: self.splat_counts.rows(),
            splat_pixels: self.splat_pixels.rows(),
            splat_colors: self.splat_colors.rows(),
            acceptances: self.acceptances.rows(),
            weights: self.weights.rows(),
            decisions: self.decisions.rows(),
            rejections: self.rejections.rows(),
            longest: self.longest.rows(),
        }
    }
}

impl StateColumns<'_> {
    /// Adds both states of a decision, each with its expected weight.
    fn splat(&self, place: &TilePlace, chain: usize, booking: &Booking, proposal: &Proposal, splats: &mut Batch<'_>) {
        let (kept, accepted) = (booking.kept as f32, booking.accepted as f32);
        if kept > 0.0 {
            for splat in (0..self.splat_counts.at(chain)).map(|k| place.vertex(chain, k)) {
                splats.put(Splat {
                    pixel: self.splat_pixels.at(splat),
                    value: self.splat_colors.at(splat) * kept,
                });
            }
        }
        if accepted > 0.0
            && let Some(splat) = proposal.splat()
        {
            splats.put(Splat {
                pixel: splat.pixel,
                value: splat.value * accepted,
            });
        }
    }

    /// Keeps what was decided.
    fn book(&mut self, chain: usize, booking: &Booking, accepted: bool) {
        self.acceptances.put(chain, booking.accepted);
        self.weights.put(chain, booking.total() as f32);
        self.decisions.put(chain, self.decisions.at(chain).wrapping_add(1));
        if accepted {
            self.rejections.put(chain, 0);
        } else {
            let run = self.rejections.at(chain) + 1;
            self.rejections.put(chain, run);
            self.longest.put(chain, self.longest.at(chain).max(run));
        }
    }

    /// Makes a proposal the current state, but for its coordinates.
    fn take(&mut self, chain: usize, proposal: &Proposal) {
        self.targets.put(chain, proposal.target);
        self.classes.put(chain, proposal.class.0);
        let splat = proposal.splat();
        self.splat_counts.put(chain, u32::from(splat.is_some()));
        if let Some(splat) = splat {
            self.splat_pixels.put(chain, splat.pixel);
            self.splat_colors.put(chain, splat.value);
        }
    }
}

/// Splats on their way to the film.
struct Batch<'a> {
    film: &'a GroupFilmRef,
    splats: [Splat; BATCH],
    filled: usize,
}

impl<'a> Batch<'a> {
    const fn new(film: &'a GroupFilmRef) -> Self {
        let none = Splat {
            pixel: 0,
            value: Rgb::BLACK,
        };
        Self {
            film,
            splats: [none; BATCH],
            filled: 0,
        }
    }

    #[inline]
    fn put(&mut self, splat: Splat) {
        if self.filled == BATCH {
            self.flush();
        }
        self.splats[self.filled] = splat;
        self.filled += 1;
    }

    fn flush(&mut self) {
        let mut film = self.film.0.lock().unwrap_or_else(PoisonError::into_inner);
        film.add(&self.splats[..self.filled]);
        self.filled = 0;
    }
}
