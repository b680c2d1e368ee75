//! Techniques that start paths at both ends: light tracing, bidirectional path tracing, and chains over it.
//!
//! The runs and comparisons are those of the example `agreement`, which holds all techniques against each other on every shipped
//! scene at length.

mod adjoint;
mod agree;
mod agree_paths;
mod bytes;
mod densities;
mod errors;
mod film;
mod index_one;
mod plans;
mod range;
mod strategies;
mod weights;
mod whole;

#[path = "../../examples/agreement/mod.rs"]
mod agreement;

use crate::support::verdict::say;
use agreement::{BlockMeans, Contender, Pictures, compare};
use chainlight::color::Rgb;
use chainlight::geometry::NOT_EMITTING;
use chainlight::path::bidirectional::EndVertex;
use chainlight::path::*;
use chainlight::plan::PlanOptions;
use chainlight::render::TileWorld;
use chainlight::scene::Scene;
use chainlight::systems::tile::TilePlace;
use glam::Vec3;
use std::sync::Arc;

/// Runs of a technique that cannot fail on a test's scene.
#[track_caller]
fn block_means(scene: &Arc<Scene>, contender: Contender, options: &PlanOptions, pictures: Pictures) -> BlockMeans {
    agreement::runs(scene, contender.technique, options, pictures).expect("a small film and a plan")
}

/// Holds that two sets of runs show the same light in the counted blocks, as part of a family of `tests` tests, by a comparison
/// that sees the mean of those blocks off by the fraction `sees`, and that it refuses light that is off by twice as much.
#[track_caller]
fn assert_same_light(case: &str, a: &BlockMeans, b: &BlockMeans, counted: &[bool], tests: usize, sees: f64) {
    let verdict = compare(a, b, counted, tests);
    say(&format!(
        "{case}: {} of {} differ, largest |t| {:.2}, sees {:.2} % of the mean",
        verdict.failures,
        verdict.statistics,
        verdict.largest,
        100.0 * verdict.visible
    ));
    assert_eq!(verdict.failures, 0, "{case}: {verdict:?}");
    assert!(verdict.visible < sees, "{case}: would not see {sees}, {verdict:?}");
    for factor in [1.0 + 2.0 * sees, 1.0 - 2.0 * sees] {
        let planted = compare(&a.scaled(factor), b, counted, tests);
        assert!(planted.failures > 0, "{case}: light times {factor} goes unnoticed");
    }
}

/// A subpath of a world after a step of bidirectional path tracing, read from its columns.
fn subpath(world: &mut TileWorld, path: usize) -> Vec<EndVertex> {
    let place = *world.world().resource::<TilePlace>();
    let length = world.at::<PathLength, ChainTable>(path).unwrap_or(NO_SUBPATH);
    if length == NO_SUBPATH {
        return Vec::new();
    }
    let mut throughput = Rgb::ONE;
    let read = |depth| {
        let v = place.vertex(path, depth);
        let vector = |value: Option<Vec3>| value.unwrap_or_default();
        let arrival = vector(world.at::<VertexArrival, ProposalTable>(v));
        let here = throughput;
        throughput *= world.at::<VertexRatio, ProposalTable>(v).unwrap_or(Rgb::BLACK);
        EndVertex {
            surface: Scatterer {
                position: vector(world.at::<VertexPosition, ProposalTable>(v)),
                normal: vector(world.at::<VertexNormal, ProposalTable>(v)),
                shading_normal: vector(world.at::<VertexShadingNormal, ProposalTable>(v)),
                offset: world.at::<VertexOffset, ProposalTable>(v).unwrap_or_default(),
                material: world.at::<VertexMaterial, ProposalTable>(v).unwrap_or_default(),
                uv: glam::Vec2::ZERO,
                tangent: Vec3::ZERO,
                direction: if depth == 0 { Vec3::ZERO } else { arrival },
            },
            kind: world.at::<VertexKind, ProposalTable>(v).unwrap_or_default(),
            light: world.at::<VertexLight, ProposalTable>(v).unwrap_or(NOT_EMITTING),
            forward: world
                .at::<VertexForward, ProposalTable>(v)
                .expect("weights compare strategies"),
            tail: world
                .at::<VertexTail, ProposalTable>(v)
                .expect("weights compare strategies"),
            throughput: here,
        }
    };
    (0..=length).map(read).collect()
}
