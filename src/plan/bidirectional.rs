//! What techniques need that start paths at lights: light tracing, and bidirectional path tracing.

use super::effect::{EffectPlan, is_on};
use super::path_tracing::{ray_columns, scatter_lists, scatters, surface_columns, walks};
use super::table::{Extent, TableId, TablePlan};
use super::tile::Subpaths;
use super::{Effect, SystemPlan};
use crate::geometry::{SegmentTarget, SegmentTransmittance};
use crate::path::bidirectional::{Strategies, Weights};
use crate::path::*;
use crate::scene::Scene;
use crate::systems::list::*;

/// What is asked of a technique with both ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct BothEnds<'a> {
    pub(super) scene: &'a Scene,
    pub(super) effects: &'a [EffectPlan],
    pub(super) subpaths: Subpaths,
    pub(super) strategies: Strategies,
}

impl BothEnds<'_> {
    /// Whether weights compare strategies, and so need the densities of all.
    fn weighs(&self) -> bool {
        self.strategies.weights == Weights::All
    }

    fn has_camera_paths(&self) -> bool {
        self.subpaths != Subpaths::Light
    }

    fn is_lit(&self) -> bool {
        is_on(self.effects, Effect::Emission)
    }

    /// The systems that trace subpaths and join them.
    pub(super) fn tracing(&self) -> Vec<SystemPlan> {
        if !self.is_lit() {
            return Vec::new();
        }
        let mut systems = Vec::new();
        if self.has_camera_paths() {
            systems.push(SystemPlan::new(START_CAMERA_PATHS, "a subpath starts at the camera"));
        }
        systems.push(SystemPlan::new(START_LIGHT_PATHS, "a subpath starts at a light"));
        systems.extend(walks(self.scene, self.effects, self.scene.max_depth));
        systems.extend([
            SystemPlan::new(JOIN_LOOP, "every strategy joins the subpaths in its own way"),
            SystemPlan::new(OFFER_CONNECTIONS, "what each would bring"),
            SystemPlan::new(TRANSMIT_CONNECTIONS, "what stands in between has to be known"),
            SystemPlan::new(BOOK_CONNECTIONS, "light goes to the pixels that it reaches"),
        ]);
        systems
    }

    /// The systems of independent samples.
    pub(super) fn systems(&self) -> Vec<SystemPlan> {
        let mut systems = vec![SystemPlan::new(ASSIGN_PIXELS, "each chain samples one pixel per step")];
        systems.extend(self.tracing());
        systems.push(SystemPlan::new(
            ACCEPT_LISTS,
            "samples are independent: every proposal is taken",
        ));
        systems.push(SystemPlan::new(
            SPLAT_LISTS,
            "light subpaths are seen anywhere on the film",
        ));
        systems
    }

    /// The tables of independent samples.
    pub(super) fn tables(&self) -> Vec<TablePlan> {
        let mut chains = TablePlan::new(TableId::CHAINS, Extent::PerChain(1));
        chains
            .column::<ChainKey>("draws are keyed by it")
            .column::<BookedWeight>("what the decision booked")
            .column::<Decisions>("every chain decides exactly once a step");
        self.with_tracing(chains)
    }

    /// `chains` with the columns that tracing needs, and all other tables.
    pub(super) fn with_tracing(&self, mut chains: TablePlan) -> Vec<TablePlan> {
        chains.column::<ProposedSplatCount>("light goes to the pixels that it reaches");
        if self.has_camera_paths() {
            chains.column::<FilmPixel>("the pixel that the camera subpath starts at");
        }
        let mut tables = vec![chains];
        if self.is_lit() {
            let chains = &mut tables[0];
            chains
                .column::<Direction>("rays are emitted along it")
                .column::<PathLength>("paths have different lengths")
                .column::<ActiveList>("subpaths that wait for a ray");
            if scatters(self.effects) {
                chains
                    .column::<Throughput>("roulette judges paths by it")
                    .column::<ScatteredList>("scattered subpaths wait for roulette");
                if super::path_tracing::refracts(self.effects) {
                    chains.column::<RadianceScale>("roulette must not take the scale of refraction for a loss");
                }
            }
            tables.push(self.vertices());
            tables.push(self.rays());
            if scatters(self.effects) {
                tables.push(scatter_lists(self.scene));
            }
        }
        tables.push(self.lists(TableId::PROPOSED_SPLATS));
        tables
    }

    fn vertices(&self) -> TablePlan {
        let mut table = TablePlan::new(TableId::PROPOSALS, Extent::vertices(self.scene.max_depth));
        table
            .column::<VertexKind>("lens, light, surface, discrete, infinite")
            .column::<VertexPosition>("rays and segments start there")
            .column::<VertexNormal>("sides and offsets")
            .column::<VertexOffset>("rays start off the surface")
            .column::<VertexRatio>("f/p of scattering")
            .column::<VertexDensity>("densities of vertices follow from it")
            .column::<VertexLight>("light met by camera subpaths, and where light subpaths start")
            .column::<VertexArrival>("materials are evaluated for it when subpaths are joined");
        surface_columns(&mut table, self.scene);
        if self.weighs() {
            table
                .column::<VertexForward>("strategies are weighed by it")
                .column::<VertexReverse>("strategies are weighed by it")
                .column::<VertexTail>("what shorter subpaths would have found");
        }
        table
    }

    fn rays(&self) -> TablePlan {
        let mut table = ray_columns();
        table
            .column::<SegmentTarget>("segments join subpaths")
            .column::<SegmentTransmittance>("what passes along a segment")
            .column::<SegmentLight>("what a segment would bring")
            .column::<SegmentPixel>("where it would bring it");
        table
    }

    /// A table of lists of splats: one for the chain's own pixel, and one for each vertex of its light subpath.
    pub(super) fn lists(&self, id: TableId) -> TablePlan {
        let mut table = TablePlan::new(id, Extent::vertices(self.scene.max_depth));
        table
            .column::<SplatPixel>("where on the film")
            .column::<SplatColor>("how much, by colour");
        table
    }
}
