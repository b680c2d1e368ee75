//! Paths as mutations see them: their vertices, and what is known of how likely each part of them is.

use super::super::super::paths::{VertexColumns, Vertices};
use super::super::super::tile::TilePlace;
use crate::path::whole::*;
use crate::path::{ChainTable, VERTEX_DISCRETE};
use crate::scene::Scene;
use crate::table::{Read, Rows};
use bevy_ecs::system::SystemParam;
use glam::{Vec2, Vec3};
use std::ops::Deref;

/// A path x₀ … xₖ of a chain: its state, or what is proposed.
#[derive(Clone, Copy)]
pub struct PathView<'a> {
    /// The scene that it is in.
    pub scene: &'a Scene,
    place: &'a TilePlace,
    chain: usize,
    ends: PathEnds,
    rows: &'a PathRows<'a>,
}

/// What is known of a path as a whole.
#[derive(Clone, Copy, Debug)]
pub struct PathEnds {
    /// k; 0 before a chain has its first state.
    pub edges: u32,
    /// The place on the film, in pixels, through which it is seen.
    pub film: Vec2,
    /// The sum of all pixels' filters there.
    pub filter: f32,
    /// See [`Measured::kept_light`].
    pub kept_light: f64,
}

/// The rows of a table of paths.
pub struct PathRows<'a> {
    /// Vertices.
    pub vertices: VertexColumns<'a>,
    /// See [`PathView::share`].
    pub shares: &'a [PathShare],
    /// See [`PathView::onward`].
    pub onwards: &'a [PathOnward],
    /// See [`PathView::back`].
    pub backs: &'a [PathBack],
}

impl Deref for PathView<'_> {
    type Target = PathEnds;

    fn deref(&self) -> &PathEnds {
        &self.ends
    }
}

impl<'a> PathView<'a> {
    /// The path of a chain of the tile at `place`, whose vertices are in `rows`.
    #[must_use]
    pub const fn new(
        scene: &'a Scene,
        place: &'a TilePlace,
        chain: usize,
        ends: PathEnds,
        rows: &'a PathRows<'a>,
    ) -> Self {
        Self {
            scene,
            place,
            chain,
            ends,
            rows,
        }
    }

    #[inline]
    fn row(&self, i: u32) -> usize {
        self.place.path_vertex(self.chain, i as usize)
    }

    /// The fewest edges that a proposal may have.
    #[must_use]
    pub const fn shortest(&self) -> u32 {
        self.place.shortest
    }

    /// The most edges that a proposal may have.
    #[must_use]
    pub const fn longest(&self) -> u32 {
        self.scene.max_depth
    }

    /// Vertex `i`. The direction of its surface is that in which a path from the camera arrives there.
    #[inline]
    #[must_use]
    pub fn vertex(&self, i: u32) -> WholeVertex {
        self.rows.vertices.at(self.row(i))
    }

    /// Where vertex `i` is.
    #[inline]
    #[must_use]
    pub fn position(&self, i: u32) -> Vec3 {
        self.rows.vertices.position(self.row(i))
    }

    /// Whether the path goes through vertex `i` by one of a few directions.
    #[inline]
    #[must_use]
    pub fn is_discrete(&self, i: u32) -> bool {
        self.rows.vertices.kind(self.row(i)) == VERTEX_DISCRETE
    }

    /// Whether vertex `i` is on a surface that can be joined to others.
    #[inline]
    #[must_use]
    pub fn joins(&self, i: u32) -> bool {
        let material = self.rows.vertices.material(self.row(i));
        !self.scene.materials.kind(material).is_discrete()
    }

    /// The share of strategy (s, t) in the path's density; of what the lens sees (t = 1), as if one pixel were chosen among those
    /// whose filters reach there, in proportion to them.
    #[inline]
    #[must_use]
    pub fn share(&self, t: u32) -> f64 {
        let share = self.rows.shares.at(self.row(t - 1));
        if t == 1 { share / f64::from(self.filter) } else { share }
    }

    /// The density of going on towards the light at vertex `i`, see [`Passage::onward`].
    #[inline]
    #[must_use]
    pub fn onward(&self, i: u32) -> f64 {
        f64::from(self.rows.onwards.at(self.row(i)))
    }

    /// The density of going on towards the camera at vertex `i`, see [`Passage::back`].
    #[inline]
    #[must_use]
    pub fn back(&self, i: u32) -> f64 {
        f64::from(self.rows.backs.at(self.row(i)))
    }

    /// t of the subpath from the camera that perturbations re-trace, see [`PathForm::camera_vertices`].
    #[must_use]
    pub fn camera_vertices(&self) -> u32 {
        camera_vertices(self.edges as usize, |i| self.is_discrete(i as u32)) as u32
    }

    /// s of the subpath from the light that the caustic perturbation re-traces, and how many vertices of it that keeps, see
    /// [`PathForm::light_vertices`].
    #[must_use]
    pub fn light_vertices(&self) -> Option<(u32, u32)> {
        let (s, kept) = light_vertices(self.edges as usize, |i| self.is_discrete(i as u32))?;
        Some((s as u32, kept as u32))
    }
}

/// Columns of paths, one set for states and one for proposals.
macro_rules! paths {
    ($(#[$doc:meta])* $name:ident, $columns:ident, $table:ident, $edges:ident, $film:ident, $filter:ident, $kept_light:ident) => {
        $(#[$doc])*
        #[derive(SystemParam)]
        pub struct $name<'w, 's> {
            edges: Read<'w, 's, $edges, ChainTable>,
            film: Read<'w, 's, $film, ChainTable>,
            filters: Read<'w, 's, $filter, ChainTable>,
            kept_lights: Read<'w, 's, $kept_light, ChainTable>,
            vertices: Vertices<'w, 's, $table>,
            shares: Read<'w, 's, PathShare, $table>,
            onwards: Read<'w, 's, PathOnward, $table>,
            backs: Read<'w, 's, PathBack, $table>,
        }

        #[doc = concat!("[`", stringify!($name), "`] as slices.")]
        pub struct $columns<'a> {
            edges: &'a [$edges],
            film: &'a [$film],
            filters: &'a [$filter],
            kept_lights: &'a [$kept_light],
            rows: PathRows<'a>,
        }

        impl $name<'_, '_> {
            /// The columns as slices.
            #[must_use]
            pub fn columns(&self) -> $columns<'_> {
                $columns {
                    edges: self.edges.rows(),
                    film: self.film.rows(),
                    filters: self.filters.rows(),
                    kept_lights: self.kept_lights.rows(),
                    rows: PathRows {
                        vertices: self.vertices.columns(),
                        shares: self.shares.rows(),
                        onwards: self.onwards.rows(),
                        backs: self.backs.rows(),
                    },
                }
            }
        }

        impl<'a> $columns<'a> {
            /// The path of a chain.
            #[inline]
            #[must_use]
            pub fn of(&'a self, scene: &'a Scene, place: &'a TilePlace, chain: usize) -> PathView<'a> {
                let ends = PathEnds {
                    edges: self.edges.at(chain),
                    film: self.film.at(chain),
                    filter: self.filters.at(chain),
                    kept_light: self.kept_lights.at(chain),
                };
                PathView::new(scene, place, chain, ends, &self.rows)
            }
        }
    };
}

paths! {
    /// The paths that are states.
    StatePaths, StatePathColumns, PathTable, PathEdges, PathFilm, PathFilter, PathKeptLight
}
paths! {
    /// The paths that are proposed.
    ProposedPaths, ProposedPathColumns, ProposedPathTable, ProposedEdges, ProposedPathFilm, ProposedFilter, ProposedKeptLight
}
