//! Vertices that scatter into one direction and into all at once: a coat over a colour. Which of the two a path did is part of the
//! state; a density by area where a probability belongs, or the other way round, would show in how much light has which signature.
//!
//! The oracle is path tracing of the same scene with one of the two switched off, and fewer edges.

use super::paths;
use crate::support::chains::column;
use crate::support::render::{mean, picture};
use crate::support::scenes::as_written;
use crate::support::verdict::Family;
use chainlight::chain::{Class, StateClass};
use chainlight::plan::{Direct, Technique};
use chainlight::render::{ChainRender, Rendering};
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use std::sync::Arc;

const RUNS: u64 = 60;
const DEPTH: u32 = 3;

/// A coated floor and a coated wall under a lamp; coat and colour scaled by these.
fn scene(max_depth: u32, coat: f32, base: f32) -> Arc<Scene> {
    as_written(&format!(
        "(version: 1, settings: (max_depth: {max_depth}),
          camera: Perspective(origin: (0, 1.5, 4), target: (0, 0.6, 0), fov: 50),
          film: (width: 4, height: 4),
          materials: {{
              \"coat\": Plastic(
                  interior_ior: 2.2, diffuse_reflectance: ({base}, {base}, {base}), specular_reflectance: ({coat}, {coat}, {coat})),
              \"lamp\": Diffuse(reflectance: (0, 0, 0)),
          }},
          shapes: [
              (shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -6)), material: \"coat\"),
              (shape: Quad(corner: (-3, 0, -2), edge_u: (6, 0, 0), edge_v: (0, 4, 0)), material: \"coat\"),
              (shape: Quad(corner: (-1, 3, 1), edge_u: (0, 0, -2), edge_v: (2, 0, 0)), material: \"lamp\", emission: (2, 2, 2)),
          ])"
    ))
}

/// Light by what happened at the surfaces: at one, D or S; at two, twice the same, or one of each.
const KINDS: [&str; 5] = ["D", "S", "DD", "SS", "DS and SD"];

fn kind(class: u32) -> Option<usize> {
    let class = StateClass(class);
    let name = class.signature().name();
    match name.as_str() {
        "EDL" => Some(0),
        "ESL" => Some(1),
        "EDDL" => Some(2),
        "ESSL" => Some(3),
        "EDSL" | "ESDL" => Some(4),
        _ => None,
    }
}

/// The light of every one of so many kinds that chains in path space say there is.
fn by_chains(kinds: usize, kind: impl Fn(u32) -> Option<usize>) -> Vec<Estimate> {
    let scene = scene(DEPTH, 1.0, 0.6);
    let mut values = vec![Vec::new(); kinds];
    for seed in 1..=RUNS {
        let render = paths(1, 2048, 1 << 16).seeded(seed).run(&scene, 20);
        let classes = column::<Class>(&render);
        let mut counts = vec![0_u32; kinds];
        for kind in classes.iter().filter_map(|&class| kind(class)) {
            counts[kind] += 1;
        }
        for (values, count) in values.iter_mut().zip(counts) {
            values.push(all_light(&render) * f64::from(count) / classes.len() as f64);
        }
    }
    values.iter().map(|values| Estimate::of(values)).collect()
}

/// The mean over the film and its channels of the light that one group of chains looks for.
fn all_light(render: &ChainRender) -> f64 {
    // Targets count all three channels.
    render.run.normalizations().iter().sum::<f64>() / 3.0
}

/// The light of every kind as differences of pictures: with coat or base alone, with one edge less.
fn by_path_tracing() -> Vec<Estimate> {
    let light = |max_depth, coat, base| {
        mean(
            &picture(&scene(max_depth, coat, base), Technique::Pt, 1, 40_000),
            0,
            |_, _| true,
        )
    };
    let less = |a: Estimate, b: Estimate| Estimate {
        mean: a.mean - b.mean,
        error: libm::hypot(a.error, b.error),
    };
    let seen = light(1, 1.0, 0.6);
    let [diffuse, mirrored, both] = [(0.0, 0.6), (1.0, 0.0), (1.0, 0.6)];
    let upto = |depth, (coat, base)| light(depth, coat, base);
    let [d, s] = [diffuse, mirrored].map(|of| less(upto(2, of), seen));
    let [dd, ss] = [diffuse, mirrored].map(|of| less(upto(3, of), upto(2, of)));
    let two = less(upto(3, both), upto(2, both));
    vec![d, s, dd, ss, less(less(two, dd), ss)]
}

#[test]
fn light_by_what_coated_surfaces_did_is_what_it_is_without_chains() {
    let family = Family { tests: KINDS.len() };
    for ((name, chains), traced) in KINDS
        .into_iter()
        .zip(by_chains(KINDS.len(), kind))
        .zip(by_path_tracing())
    {
        let both = Estimate {
            error: libm::hypot(chains.error, traced.error),
            ..chains
        };
        family.is(name, both, traced.mean, 0.0, 0.3);
        family.is_not(&format!("{name}, 40 % off"), both, 1.4 * traced.mean, 0.0);
    }
}

/// On which side of the line between direct light and other light a path is depends on what it did at coated surfaces.
#[test]
fn direct_light_apart_is_that_of_direct_paths_and_chains_have_the_rest() {
    let name = |class: u32| StateClass(class).signature().name();
    let sides = by_chains(3, |class| match name(class).as_str() {
        "EL" | "EDL" | "ESL" | "ESSL" => Some(0),
        "ESDL" => Some(1),
        "EDDL" | "EDSL" => Some(2),
        other => panic!("{other}"),
    });
    let scene = scene(DEPTH, 1.0, 0.6);
    let mut chains = paths(1, 2048, 1 << 16);
    let mut indirect = Vec::new();
    for seed in RUNS + 1..=2 * RUNS {
        chains.options.direct = Some(Direct::Apart(100));
        let render = chains.seeded(seed).run(&scene, 20);
        assert!(
            column::<Class>(&render)
                .into_iter()
                .all(|class| matches!(name(class).as_str(), "EDDL" | "EDSL"))
        );
        indirect.push(all_light(&render));
    }
    chains.options.direct = Some(Direct::Apart(40_000));
    let apart = chains.run(&scene, 1);
    let direct = mean(&apart.direct().expect("rendered apart").picture(), 0, |_, _| true);
    let rest = Estimate::of(&indirect);
    // The errors of both.
    let held = |of: Estimate, by: &[Estimate]| Estimate {
        error: by.iter().fold(of.error, |error, by| libm::hypot(error, by.error)),
        ..of
    };
    let sum = |of: &[Estimate]| of.iter().map(|of| of.mean).sum::<f64>();
    let family = Family { tests: 2 };
    for (name, of, by) in [("direct", direct, 0..2), ("the rest", rest, 2..3)] {
        family.is(name, held(of, &sides[by.clone()]), sum(&sides[by]), 0.0, 0.1);
    }
    for (name, of, by) in [
        ("direct on the first surface alone", direct, 0..1),
        ("what mirrors show left to chains", rest, 1..3),
    ] {
        family.is_not(name, held(of, &sides[by.clone()]), sum(&sides[by]), 0.0);
    }
}
