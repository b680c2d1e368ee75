//! Ways to make a picture, and runs of them.

use super::family::BlockMeans;
use chainlight::film::{BlockGrid, block_means_of};
use chainlight::plan::{Base, ChainSettings, Direct, Plan, PlanOptions, Technique};
use chainlight::render::{Rendering, start};
use chainlight::scene::Scene;
use miette::{IntoDiagnostic, Result};
use rayon::prelude::*;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A technique, and what it runs over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contender {
    /// The technique.
    pub technique: Technique,
    /// What its chains run over.
    pub base: Base,
    /// Who renders direct light beside chains of whole paths, if not as the scene says.
    pub direct: Option<Direct>,
}

impl Contender {
    /// Every technique that is not the depth-first twin of another.
    pub const ALL: [Self; 6] = [
        Self::of(Technique::Pt, Base::Pt),
        Self::of(Technique::Lt, Base::Pt),
        Self::of(Technique::Bdpt, Base::Pt),
        Self::of(Technique::Pssmlt, Base::Pt),
        Self::of(Technique::Pssmlt, Base::Bdpt),
        Self::of(Technique::Mlt, Base::Pt),
    ];

    /// A technique over a base, which counts for chains alone.
    pub const fn of(technique: Technique, base: Base) -> Self {
        Self {
            technique,
            base,
            direct: None,
        }
    }

    /// The same with all light left to chains.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests alone compare it"))]
    pub const fn by_chains_alone(self) -> Self {
        Self {
            direct: Some(Direct::Chains),
            ..self
        }
    }

    /// How many of its samples take about the time of one of bidirectional path tracing with its noise: path tracing needs many
    /// for the rare light that only it does not look for.
    pub const fn samples(self) -> u64 {
        match (self.technique, self.base) {
            (Technique::Pt, _) => 8,
            (Technique::Lt | Technique::Pssmlt | Technique::Mlt, Base::Pt) => 4,
            _ => 1,
        }
    }

    /// Options of its plan. A run has one group of chains: its error is told by other runs.
    pub fn options(self) -> PlanOptions {
        PlanOptions {
            base: self.base,
            direct: self.direct,
            chains: ChainSettings {
                groups: 1,
                chains: Some(64),
                bootstrap: Some(16_384),
                ..ChainSettings::default()
            },
            ..PlanOptions::default()
        }
    }
}

impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.technique {
            Technique::Pssmlt => write!(f, "{} over {}", self.technique, self.base),
            Technique::Mlt if self.direct == Some(Direct::Chains) => write!(f, "{} by chains alone", self.technique),
            technique => write!(f, "{technique}"),
        }
    }
}

/// What pictures runs make.
#[derive(Clone, Copy, Debug)]
pub struct Pictures {
    /// Runs.
    pub runs: u64,
    /// Samples, or mutations, per pixel of each.
    pub samples: u64,
    /// Seed of the first run; the others follow it.
    pub first_seed: u64,
    /// Blocks along a side of the film.
    pub blocks_per_side: u32,
}

/// The block means of independent runs.
pub fn runs(scene: &Arc<Scene>, technique: Technique, options: &PlanOptions, pictures: Pictures) -> Result<BlockMeans> {
    let grid = BlockGrid::new(scene.width, scene.height, pictures.blocks_per_side);
    let run = |number| {
        let plan = Plan::with(scene, technique, options)?;
        let steps = plan.chains.as_ref().map_or(pictures.samples, |chains| {
            chains.counts.steps_for(pictures.samples as f64, scene.pixel_count())
        });
        let seed = pictures.first_seed + number;
        let mut render: Box<dyn Rendering> = start(Arc::clone(scene), plan, seed, 1, &AtomicBool::new(false), &|_| {})?;
        render.burst(steps, &|_| {});
        block_means_of(render.picture().view(), &grid).into_diagnostic()
    };
    let rows = (0..pictures.runs)
        .into_par_iter()
        .map(run)
        .collect::<Result<Vec<_>>>()?;
    Ok(BlockMeans { rows })
}
