//! Every strategy (s, t) alone, with weight one, makes the picture of all paths of s + t − 1 edges.
//!
//! The rooms are spheres: where two surfaces meet at an edge, an edge of a path that joins two of their points has infinite
//! variance, and no test of means says anything. On a sphere's inside cos θ cos θ′ / d² is the same for every pair of points.
//! Comparisons of a room are one family with a significance of 1 %.

use super::agreement::{BlockMeans, Contender, Pictures, statistics};
use super::{assert_same_light, block_means};
use crate::support::scenes::inline;
use chainlight::plan::{Base, PlanOptions, Technique};
use chainlight::scene::Scene;
use std::sync::Arc;

const SIZE: u32 = 24;
const BLOCKS_PER_SIDE: u32 = 6;
const LONGEST: u32 = 4;
/// Comparisons of a room: for k edges k + 1 strategies, each with the next.
const PAIRS: u32 = LONGEST * (LONGEST + 1) / 2;

/// A matt room with a box in it, under a lamp of twelve triangles.
const TRIANGLES: &str = r#"
    materials: {"white": Diffuse(reflectance: (0.8, 0.7, 0.6)), "blue": Diffuse(reflectance: (0.3, 0.4, 0.8))},
    shapes: [
        (shape: Sphere(center: (0, 0, 0), radius: 3), material: "white"),
        (shape: Box(min: (-0.7, -1.1, -0.9), max: (0.5, -0.1, 0.2)), material: "blue"),
        (shape: Box(min: (-0.5, 0.8, -1.1), max: (0.6, 1.5, -0.1)), material: "blue", emission: (3, 4, 5)),
    ],"#;

/// A matt room with a wall of rough metal and a round lamp.
const ROUND: &str = r#"
    materials: {"white": Diffuse(reflectance: (0.8, 0.7, 0.6)), "gold": RoughConductor(metal: "Au", alpha: 0.4)},
    shapes: [
        (shape: Sphere(center: (0, 0, 0), radius: 3), material: "white"),
        (shape: Quad(corner: (-1.6, -1.4, -1.6), edge_u: (3, 0, 0.8), edge_v: (0, 2.2, -0.3)), material: "gold"),
        (shape: Sphere(center: (0.7, 1.0, -0.2), radius: 0.7), material: "white", emission: (5, 4, 3)),
    ],"#;

fn room(inside: &str, longest: u32) -> Arc<Scene> {
    inline(
        &format!(
            "(version: 1, settings: (max_depth: {longest}),
            camera: Perspective(origin: (0.2, 0.1, 2.4), target: (0, 0, 0), fov: 70),
            film: (width: {SIZE}, height: {SIZE}), {inside})"
        ),
        SIZE,
    )
}

fn alone(inside: &str, s: u32, t: u32) -> BlockMeans {
    // Few paths meet the lamp by chance.
    let samples = if s == 0 { 120 } else { 30 };
    let options = PlanOptions {
        strategy: Some((s, t)),
        ..PlanOptions::default()
    };
    let pictures = Pictures {
        runs: 24,
        samples,
        first_seed: u64::from(1000 * s + 100 * t),
        blocks_per_side: BLOCKS_PER_SIDE,
    };
    let contender = Contender::of(Technique::Bdpt, Base::Pt);
    block_means(&room(inside, s + t - 1), contender, &options, pictures)
}

/// Every strategy against the next one with as many edges.
fn strategies_agree(name: &str, inside: &str, sees: f64) {
    let counted = vec![true; (BLOCKS_PER_SIDE * BLOCKS_PER_SIDE) as usize];
    let tests = PAIRS as usize * statistics(&counted);
    for edges in 1..=LONGEST {
        // Light is not met at the lens: t ≥ 1.
        let all: Vec<BlockMeans> = (0..=edges).map(|s| alone(inside, s, edges + 1 - s)).collect();
        for (s, pair) in (0..).zip(all.windows(2)) {
            let t = edges + 1 - s;
            let case = format!("{name}, ({s}, {t}) and ({}, {})", s + 1, t - 1);
            assert_same_light(&case, &pair[0], &pair[1], &counted, tests, sees);
        }
    }
}

#[test]
fn every_strategy_alone_finds_all_light_of_a_matt_room() {
    strategies_agree("triangles", TRIANGLES, 0.04);
}

#[test]
fn every_strategy_alone_finds_all_light_of_a_room_with_metal_and_a_round_lamp() {
    strategies_agree("round", ROUND, 0.04);
}

/// Light of paths of two edges is none of paths of three: what is compared is told apart.
#[test]
fn paths_of_other_lengths_are_told_apart() {
    let (two, three) = (alone(TRIANGLES, 1, 2), alone(TRIANGLES, 1, 3));
    let counted = vec![true; (BLOCKS_PER_SIDE * BLOCKS_PER_SIDE) as usize];
    let verdict = super::compare(&two, &three, &counted, statistics(&counted));
    assert!(verdict.failures > statistics(&counted) / 2, "{verdict:?}");
}
