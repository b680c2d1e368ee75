//! What the systems of a tile share: where the tile stands, what it reads, how long its lists are, what it counts.
//!
//! None of it is a table: tables are columns.

use crate::film::{BlockGrid, Film, GroupFilm};
use crate::material::KINDS;
use crate::path::bidirectional::Strategies;
use crate::path::mis::Heuristic;
use crate::path::{LIGHT_SUBPATH, Sought, VERTEX_DISCRETE, VERTEX_INFINITE, VERTEX_LENS};
use crate::plan::{Extent, TablePlan, TilePlan};
use crate::sampling::StreamKey;
use crate::scene::Scene;
use crate::table::LANES;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use std::sync::{Arc, Mutex};

/// The scene, shared by all tiles.
#[derive(Resource, Clone)]
pub struct SceneRef(pub Arc<Scene>);

/// The film, shared by all tiles.
#[derive(Resource, Clone)]
pub struct FilmRef(pub Arc<Film>);

/// The film of the tile's group.
#[derive(Resource, Clone)]
pub struct GroupFilmRef(pub Arc<Mutex<GroupFilm>>);

/// Films that steps take turns among, for independent samples that bring light to many pixels.
#[derive(Resource, Clone)]
pub struct SplatFilms {
    /// The films: step s goes to number s modulo their number.
    pub films: Arc<[Mutex<GroupFilm>]>,
    /// What light is multiplied with on its way to them.
    pub scale: f32,
}

/// The blocks of the film that states are classed by.
#[derive(Resource, Clone)]
pub struct FilmBlocks(pub Arc<BlockGrid>);

/// The strategies by which subpaths are joined, for techniques with both ends.
#[derive(Resource, Clone, Copy, Debug)]
pub struct StrategiesRef(pub Strategies);

/// Which chains and which step the tile is at.
#[derive(Resource, Clone, Copy, Debug)]
pub struct TilePlace {
    /// Seed of the render.
    pub seed: u64,
    /// Global number of the tile's first chain.
    pub first_chain: u32,
    /// Chains in use; the last tile of a render may have fewer than it has room for.
    pub chains: u32,
    /// Subpaths that the tables have room for, one or two a chain: the distance between a vertex and the next of the same
    /// subpath.
    pub capacity: u32,
    /// The first subpath that starts at a light: that of chain c has number `lights_from` + c. Subpath c starts at the
    /// camera, if `lights_from` is beyond it.
    pub lights_from: u32,
    /// The first depth whose vertices have primary coordinates: 0 where the numbers that start subpaths are among them.
    pub first_coordinate: u32,
    /// How weights are made of densities where light that is met is weighed against sampling it.
    pub heuristic: Heuristic,
    /// The light that paths look for; other light is left to another technique.
    pub sought: Sought,
    /// The fewest edges of a path that chains look for.
    pub shortest: u32,
    /// The most edges of a path, where they are fewer than the scene's.
    pub longest: u32,
    /// The step about to run, counted from 0 over the whole render.
    pub step: u64,
}

impl TilePlace {
    /// Number of the vertex at `depth` of subpath `path` in a vertex table.
    #[inline]
    #[must_use]
    pub const fn vertex(&self, path: usize, depth: u32) -> usize {
        depth as usize * self.capacity as usize + path
    }

    /// Number of vertex `depth` of a chain's whole path in a table of paths: even ones where the chain's camera subpath would have
    /// rows, odd ones where its light subpath would.
    #[inline]
    #[must_use]
    pub const fn path_vertex(&self, chain: usize, depth: usize) -> usize {
        self.vertex(chain + (depth & 1) * self.lights_from as usize, (depth >> 1) as u32)
    }

    /// Number of the primary coordinates of the vertex at `depth` of subpath `path`.
    #[inline]
    #[must_use]
    pub const fn coordinate(&self, path: usize, depth: u32) -> usize {
        self.vertex(path, depth - self.first_coordinate)
    }

    /// Whether a subpath starts at a light.
    #[inline]
    #[must_use]
    pub const fn starts_at_light(&self, path: usize) -> bool {
        path >= self.lights_from as usize
    }

    /// Whether no subpath starts at a light.
    #[inline]
    #[must_use]
    pub const fn is_camera_only(&self) -> bool {
        self.lights_from >= self.capacity
    }

    /// The subpaths of a chain: from the camera, from a light, or both.
    pub fn subpaths(&self, chain: usize) -> impl Iterator<Item = usize> + use<> {
        let from_light = chain
            .checked_add(self.lights_from as usize)
            .filter(|&path| path < self.capacity as usize);
        let from_camera = (self.lights_from > 0).then_some(chain);
        from_camera.into_iter().chain(from_light)
    }

    /// The chain of a subpath.
    #[inline]
    #[must_use]
    pub const fn chain(&self, path: usize) -> usize {
        if self.starts_at_light(path) {
            path - self.lights_from as usize
        } else {
            path
        }
    }

    /// The depth under which draws for the vertex at `depth` of subpath `path` are keyed: the two subpaths of a chain share no
    /// numbers.
    #[inline]
    #[must_use]
    pub const fn stream_depth(&self, path: usize, depth: u32) -> u32 {
        if self.starts_at_light(path) {
            depth | LIGHT_SUBPATH
        } else {
            depth
        }
    }

    /// The key of the chain's random streams, from the bits that its column keeps.
    #[inline]
    #[must_use]
    pub const fn key(&self, chain: usize, bits: u64) -> StreamKey {
        StreamKey::from_bits(bits, self.first_chain + chain as u32)
    }
}

/// Lengths of the dense lists and queues.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct Queues {
    /// Chains in [`ActiveList`](crate::path::ActiveList).
    pub active: usize,
    /// Chains in [`ConnectList`](crate::path::ConnectList).
    pub connect: usize,
    /// Whether the subpaths in [`DrawList`](crate::path::DrawList) are yet to be started.
    pub starting: bool,
    /// Chains in [`DrawList`](crate::path::DrawList).
    pub draw: usize,
    /// Chains in each list of [`ScatterList`](crate::path::ScatterList), by the scene's model number.
    pub scatter: [usize; KINDS],
    /// Chains in [`ScatteredList`](crate::path::ScatteredList).
    pub scattered: usize,
    /// Chains in [`AcceptedList`](crate::chain::AcceptedList).
    pub accepted: usize,
    /// Rays in the ray table.
    pub rays: usize,
    /// Segments in the ray table.
    pub segments: usize,
    /// The most edges of a subpath that was asked for in this step.
    pub deepest: u32,
}

/// How deep the tables that grow with depth are, and what a deeper row is made of.
#[derive(Resource, Clone, Debug)]
pub struct Depths {
    held: u32,
    most: u32,
    groups: u32,
    tables: Arc<[TablePlan]>,
}

impl Depths {
    /// The depths of the tables of `plan` as they are built.
    #[must_use]
    pub fn new(plan: &TilePlan) -> Self {
        let growing = |table: &&TablePlan| matches!(table.extent, Extent::PerDepth { .. });
        let tables: Arc<[TablePlan]> = plan.tables.iter().filter(growing).cloned().collect();
        let bounds = |pick: fn(u32, u32) -> u32| {
            let picked = tables.iter().filter_map(move |table| match table.extent {
                Extent::PerDepth { held, most, .. } => Some(pick(held, most)),
                _ => None,
            });
            picked.max().unwrap_or(0)
        };
        Self {
            held: bounds(|held, _| held),
            most: bounds(|_, most| most),
            groups: plan.capacity() / LANES as u32,
            tables: Arc::clone(&tables),
        }
    }

    /// The last depth that there can ever be.
    #[must_use]
    pub const fn most(&self) -> u32 {
        self.most
    }

    /// The last depth that every table has room for.
    #[must_use]
    pub const fn held(&self) -> u32 {
        self.held
    }
}

/// Appends rows to the tables that grow with depth, until they have room for `depth`; twice as much as before, so that it
/// seldom happens. Earlier rows keep their addresses, since tables are bounce-major.
pub fn grow_tables(world: &mut World, depth: u32) {
    let Depths {
        held,
        most,
        groups,
        tables,
    } = world.resource::<Depths>().clone();
    if depth <= held {
        return;
    }
    let new = depth.max(2 * held).min(most);
    for table in tables.iter() {
        let Extent::PerDepth {
            held: first_room,
            most: last,
            ..
        } = table.extent
        else {
            continue;
        };
        let (from, to) = (held.max(first_room).min(last), new.min(last));
        for _ in 0..(to - from) * groups {
            let mut row = table.id.spawn(world);
            for column in &table.columns {
                (column.spec.insert)(&mut row);
            }
        }
    }
    world.resource_mut::<Depths>().held = new;
}

/// What a tile world has counted since it was built.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Steps that the tile has run.
    pub steps: u64,
    /// Decisions taken: one per chain and step.
    pub decisions: u64,
    /// Rays traced to their closest hit.
    pub rays: u64,
    /// Segments traced for their transmittance.
    pub segments: u64,
    /// Surface vertices appended to paths.
    pub vertices: u64,
    /// Contributions that were infinite or not a number, and were booked as black.
    pub non_finite: u64,
    /// The first chain, and its step, with such a contribution.
    pub first_non_finite: Option<(u32, u64)>,
}

impl Counters {
    /// Counts a contribution that is not finite, and keeps the first of them in the order of steps, then chains: an order
    /// that does not depend on how tiles are dealt.
    pub fn note_non_finite(&mut self, chain: u32, step: u64) {
        self.non_finite += 1;
        self.first_non_finite = earlier(self.first_non_finite, Some((chain, step)));
    }

    /// The sum of two tiles' counts.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            decisions: self.decisions + other.decisions,
            rays: self.rays + other.rays,
            segments: self.segments + other.segments,
            vertices: self.vertices + other.vertices,
            non_finite: self.non_finite + other.non_finite,
            first_non_finite: earlier(self.first_non_finite, other.first_non_finite),
        }
    }
}

/// The earlier of two (chain, step), by step first.
fn earlier(a: Option<(u32, u64)>, b: Option<(u32, u64)>) -> Option<(u32, u64)> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if (b.1, b.0) < (a.1, a.0) { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// Whether light met after a vertex of this kind could have been found by sampling lights there.
#[inline]
#[must_use]
pub const fn connectable(kind: u32) -> bool {
    kind != VERTEX_LENS && kind != VERTEX_DISCRETE && kind != VERTEX_INFINITE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_non_finite_contribution_does_not_depend_on_the_order_of_tiles() {
        let seen = [(7, 9), (3000, 0), (5, 0), (1, 2)];
        let mut in_order = Counters::default();
        seen.iter()
            .for_each(|&(chain, step)| in_order.note_non_finite(chain, step));
        let mut backwards = Counters::default();
        seen.iter()
            .rev()
            .for_each(|&(chain, step)| backwards.note_non_finite(chain, step));
        assert_eq!(in_order, backwards);
        assert_eq!((in_order.non_finite, in_order.first_non_finite), (4, Some((5, 0))));
        let apart = seen.map(|(chain, step)| {
            let mut counters = Counters::default();
            counters.note_non_finite(chain, step);
            counters
        });
        assert_eq!(apart.into_iter().fold(Counters::default(), Counters::plus), in_order);
    }
}
