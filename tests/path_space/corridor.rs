//! Long specular chains: a corridor between two ideal mirrors that keep 0.97 of the light, 128 times as long as it is wide, with a
//! lamp at its end. The camera sees the lamp after up to 64 reflections; how many is known for every place on the film, and so are
//! the light of every row of the film and the share of every length.
//!
//! No edge of such a path but its last can be joined, whatever the strategy: chains get from one number of mirrors to the next as
//! their mutations let them.

use super::paths;
use crate::support::chains::column;
use crate::support::scenes::as_written;
use crate::support::verdict::Family;
use chainlight::chain::{Class, StateClass};
use chainlight::render::Rendering;
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use std::sync::Arc;

const KEPT: f64 = 0.97;
const LENGTH: f64 = 128.0;
const ROWS: u32 = 4;
const RUNS: u64 = 40;
const MOST: u32 = 64;

fn scene() -> Arc<Scene> {
    let text = format!(
        "(version: 1, settings: (max_depth: 70),
          camera: Perspective(origin: (0, 0, 0), target: (0, 0, 1), up: (0, 1, 0), fov: 90, fov_axis: Vertical),
          film: (width: 2, height: {ROWS}),
          materials: {{
              \"mirror\": Conductor(eta: (0, 0, 0), k: (1, 1, 1), reflectance: ({KEPT}, {KEPT}, {KEPT})),
              \"lamp\": Diffuse(reflectance: (0, 0, 0)),
          }},
          shapes: [
              (shape: Quad(corner: (-80, -1, -2), edge_u: (160, 0, 0), edge_v: (0, 0, 132)), material: \"mirror\"),
              (shape: Quad(corner: (-80, 1, -2), edge_u: (160, 0, 0), edge_v: (0, 0, 132)), material: \"mirror\"),
              (shape: Quad(corner: (80, -1, 128), edge_u: (-160, 0, 0), edge_v: (0, 2, 0)), material: \"lamp\", emission: (1, 1, 1)),
          ])"
    );
    as_written(&text)
}

/// The share of the film's height between `from` and `to` (tangents of the angle to its middle) that sees the lamp after n mirrors,
/// by n.
fn shares(from: f64, to: f64) -> Vec<f64> {
    let (from, to) = (from.min(to), from.max(to));
    (0..=MOST)
        .map(|n| {
            // The lamp's n-th image is 2 n from the first: it is seen from 2 n − 1 to 2 n + 1, over the length.
            let overlap = |low: f64, high: f64| (high.min(to) - low.max(from)).max(0.0) / (to - from);
            let (low, high) = ((2.0 * f64::from(n) - 1.0) / LENGTH, (2.0 * f64::from(n) + 1.0) / LENGTH);
            if n == 0 {
                overlap(low, high)
            } else {
                overlap(low, high) + overlap(-high, -low)
            }
        })
        .collect()
}

/// What n mirrors leave of light.
fn kept(n: u32) -> f64 {
    libm::pow(KEPT, f64::from(n))
}

fn light(shares: &[f64]) -> f64 {
    shares.iter().zip(0..).map(|(share, n)| share * kept(n)).sum()
}

/// Lengths whose light is looked at by itself, from and to.
const LENGTHS: [(u32, u32); 6] = [(1, 1), (2, 4), (5, 8), (9, 16), (17, 32), (33, 65)];

/// What a run says.
struct Run {
    /// The mean of every row of the film.
    rows: Vec<f64>,
    /// The light of the [`LENGTHS`].
    lengths: Vec<f64>,
}

fn run(scene: &Arc<Scene>, seed: u64) -> Run {
    let chains = paths(1, 1024, 1 << 15).seeded(seed);
    let render = chains.set("new_path:weight=1,exponent=0.5").run(scene, 100);
    let picture = render.picture();
    let rows = picture
        .rgb
        .chunks(2)
        .map(|row| 0.5 * f64::from(row[0].to_array()[0] + row[1].to_array()[0]));
    // Where chains are after their last step is a sample of the target, which counts all three channels.
    let b: f64 = render.run.normalizations().iter().sum();
    let classes = column::<Class>(&render);
    let of_length = |(from, to): (u32, u32)| {
        let here = classes
            .iter()
            .filter(|&&class| (from..=to).contains(&StateClass(class).length()));
        b / 3.0 * here.count() as f64 / classes.len() as f64
    };
    Run {
        rows: rows.collect(),
        lengths: LENGTHS.map(of_length).to_vec(),
    }
}

#[test]
fn long_specular_chains_have_the_light_of_every_length() {
    let scene = scene();
    let family = Family {
        tests: ROWS as usize + LENGTHS.len() + 1,
    };
    let runs: Vec<_> = (1..=RUNS).map(|seed| run(&scene, seed)).collect();
    let estimate = |of: &dyn Fn(&Run) -> f64| Estimate::of(&runs.iter().map(of).collect::<Vec<f64>>());
    for row in 0..ROWS as usize {
        let edge = |row: usize| 1.0 - 2.0 * row as f64 / f64::from(ROWS);
        let expected = light(&shares(edge(row), edge(row + 1)));
        family.is(
            &format!("row {row}"),
            estimate(&|run| run.rows[row]),
            expected,
            0.0,
            0.3,
        );
    }
    let everywhere = shares(-1.0, 1.0);
    for (number, (from, to)) in LENGTHS.into_iter().enumerate() {
        let mirrors = from - 1..to;
        let expected: f64 = mirrors.map(|n| everywhere[n as usize] * kept(n)).sum();
        let estimate = estimate(&|run| run.lengths[number]);
        family.is(&format!("lengths {from} to {to}"), estimate, expected, 0.0, 0.3);
    }
    let all = estimate(&|run| run.rows.iter().sum::<f64>() / f64::from(ROWS));
    family.is("all rows", all, light(&everywhere), 0.0, 0.1);
    family.is_not("all rows, 15 % off", all, 1.15 * light(&everywhere), 0.0);
}
