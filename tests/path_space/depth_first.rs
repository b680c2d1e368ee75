//! Proposals of whole paths in stages against proposals made one chain after another. With the same seed both draw the same numbers
//! for the same purposes, so chains must be in the same states after every step, bit for bit.

use super::paths;
use crate::support::chains::{Chains, column, films};
use crate::support::scenes::{inline, shipped};
use chainlight::chain::{Class, LongestRejections, Rejections, Target};
use chainlight::path::whole::{PathEdges, PathFilm, PathFilter, PathLight, PathPixel};
use chainlight::path::{BookedWeight, Decisions};
use chainlight::plan::{Direct, Technique};
use chainlight::render::{ChainRender, Rendering};
use chainlight::scene::Scene;
use chainlight::systems::tile::Counters;
use std::sync::Arc;

/// Everything that chains leave behind, but for what only staging needs.
#[track_caller]
fn assert_same(case: &str, staged: &ChainRender, depth_first: &ChainRender) {
    assert!(films(staged) == films(depth_first), "{case}: films differ");
    // Steps are counted by tile.
    let counters = |render: &ChainRender| Counters {
        steps: 0,
        ..render.run.counters()
    };
    assert_eq!(counters(staged), counters(depth_first), "{case}");
    let statistics = |render: &ChainRender| render.run.statistics_by_group();
    assert_eq!(statistics(staged), statistics(depth_first), "{case}");
    let bits = |render: &ChainRender| -> Vec<u32> { column::<Target>(render).into_iter().map(f32::to_bits).collect() };
    assert_eq!(bits(staged), bits(depth_first), "{case}: targets");
    macro_rules! same {
        ($($column:ident),*) => {
            $(assert_eq!(column::<$column>(staged), column::<$column>(depth_first), "{case}: {}", stringify!($column));)*
        };
    }
    same!(
        Class,
        PathEdges,
        PathLight,
        PathPixel,
        PathFilm,
        PathFilter,
        BookedWeight,
        Decisions,
        Rejections,
        LongestRejections
    );
}

/// Runs both over a few bursts, with tiles of different sizes, and compares them after each. The numbers of mutations that were taken.
fn both(case: &str, scene: &Arc<Scene>, chains: &Chains) -> Vec<u64> {
    let start = |technique, tile_size| {
        let mut chains = Chains {
            technique,
            ..chains.clone()
        };
        chains.options.tile_size = tile_size;
        chains.start(scene)
    };
    let mut staged = start(Technique::Mlt, None);
    let mut depth_first = start(Technique::MltReference, Some(16));
    assert_same(&format!("{case}, bootstrapped"), &staged, &depth_first);
    for steps in [1, 2, 29] {
        staged.burst(steps, &|_| {});
        depth_first.burst(steps, &|_| {});
        assert_same(&format!("{case}, {} steps", staged.steps()), &staged, &depth_first);
    }
    let statistics = staged.run.statistics();
    let taken = |number| {
        (0..64)
            .map(|length| statistics.of_length(number, length).accepted)
            .sum()
    };
    (0..staged.run.chains().mutations.len()).map(taken).collect()
}

/// Lights and a camera of every kind: at infinity and near, points, directions and shapes; parallel rays, a lens, a pinhole.
fn all_kinds(camera: &str) -> Arc<Scene> {
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: 9), camera: {camera}, film: (width: 16, height: 16),
            textures: {{"checks": Checkerboard(even: (0.8, 0.7, 0.6), odd: (0.2, 0.3, 0.6), scale: (6, 6))}},
            materials: {{
                "floor": Diffuse(reflectance: "checks"),
                "white": Diffuse(reflectance: (0.7, 0.7, 0.7)),
                "brushed": RoughConductor(metal: "Cu", alpha_u: 0.4, alpha_v: 0.2),
                "glass": Dielectric(interior_ior: 1.5),
                "coat": Plastic(diffuse_reflectance: (0.2, 0.5, 0.3)),
            }},
            lights: [
                Environment(radiance: (0.2, 0.25, 0.3)),
                Directional(direction: (-0.7, -1, -0.4), irradiance: (2, 1.8, 1.5)),
                Point(position: (1.6, 1.8, 0.8), intensity: (3, 2.5, 2)),
            ],
            shapes: [
                (shape: Quad(corner: (-2, 0, 2), edge_u: (4, 0, 0), edge_v: (0, 0, -4)), material: "floor"),
                (shape: Box(min: (-0.9, 0.01, -0.6), max: (-0.1, 0.9, 0.2)), material: "coat"),
                (shape: Sphere(center: (0.5, 0.5, 0.2), radius: 0.4), material: "glass"),
                (shape: Cylinder(from: (1.1, 0, -0.4), to: (1.1, 0.8, -0.4), radius: 0.25), material: "brushed"),
                (shape: Sphere(center: (-1.2, 1.6, 1), radius: 0.15), material: "white", emission: (30, 28, 25)),
            ])"#
        ),
        16,
    )
}

#[test]
fn proposals_in_stages_and_one_by_one_are_the_same_bit_for_bit() {
    let cameras = [
        "Perspective(origin: (1.5, 3, 4), target: (0, 0.3, 0), fov: 30)",
        "ThinLens(origin: (1.5, 3, 4), target: (0, 0.3, 0), fov: 30, aperture_radius: 0.2, focus_distance: 4.8)",
        "Orthographic(origin: (1.5, 3, 4), target: (0, 0.3, 0), height: 2.4)",
    ];
    let mut scenes: Vec<(&str, Arc<Scene>)> = cameras.map(|camera| (camera, all_kinds(camera))).into();
    scenes.extend(["cornell-glass.ron", "door-ajar.ron"].map(|name| (name, shipped(name, 16))));
    let mut taken = vec![0; 6];
    for (name, scene) in scenes {
        for direct in [Direct::Chains, Direct::Apart(2)] {
            let mut chains = paths(2, 72, 2048);
            chains.options.direct = Some(direct);
            let here = both(&format!("{name}, direct light by {direct}"), &scene, &chains);
            taken.iter_mut().zip(here).for_each(|(sum, here)| *sum += here);
        }
    }
    assert!(taken.iter().all(|&taken| taken > 20), "{taken:?}");
}

/// The planted mistake: steps that are a hair larger in one of the two.
#[test]
fn a_step_that_differs_shows_in_the_films() {
    let scene = shipped("cornell-box.ron", 16);
    let chains = paths(2, 72, 2048);
    let planted = Chains {
        technique: Technique::MltReference,
        ..chains.set("lens:covered=0.0501")
    };
    assert!(films(&chains.run(&scene, 3)) != films(&planted.run(&scene, 3)));
}
