//! Staged chains against chains run depth first. With the same seed both draw the same numbers for the same purposes, so
//! they must be in the same states after every step, bit for bit: films, statistics, counters, coordinates.

use crate::support::chains::{Chains, column, films};
use crate::support::scenes::{inline, shipped};
use chainlight::chain::{Class, LongestRejections, Rejections, Target};
use chainlight::path::{BookedWeight, Decisions, PrimaryDepth, PrimaryFilm};
use chainlight::plan::{ChainPlanError, Mutation, Plan, PlanOptions, StateSpace, SystemPlan, Technique};
use chainlight::render::{ChainRender, Rendering};
use chainlight::scene::Scene;
use chainlight::systems::tile::Counters;
use serde::{Deserialize, Serialize};
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
    assert_eq!(
        staged.run.statistics_by_group(),
        depth_first.run.statistics_by_group(),
        "{case}"
    );
    let starts = |render: &ChainRender| -> Vec<_> {
        let starts = render.run.starts().iter();
        starts.map(|s| (s.normalization, s.distinct_seeds)).collect()
    };
    assert_eq!(starts(staged), starts(depth_first), "{case}");
    let targets =
        |render: &ChainRender| -> Vec<u32> { column::<Target>(render).into_iter().map(f32::to_bits).collect() };
    assert_eq!(targets(staged), targets(depth_first), "{case}: targets");
    macro_rules! same {
        ($($column:ident),*) => {
            $(assert_eq!(column::<$column>(staged), column::<$column>(depth_first), "{case}: {}", stringify!($column));)*
        };
    }
    same!(
        Class,
        PrimaryFilm,
        PrimaryDepth,
        BookedWeight,
        Decisions,
        Rejections,
        LongestRejections
    );
}

/// Runs both over a few bursts, with tiles of `tiles` chains, and compares them after each.
fn both(case: &str, scene: &Arc<Scene>, chains: &Chains, tiles: [Option<u32>; 2]) {
    let [mut staged, mut depth_first] = [Technique::Pssmlt, Technique::PssmltReference].map(|technique| {
        let mut chains = Chains {
            technique,
            ..chains.clone()
        };
        chains.options.tile_size = tiles[usize::from(technique == Technique::PssmltReference)];
        chains.start(scene)
    });
    assert_same(&format!("{case}, bootstrapped"), &staged, &depth_first);
    for steps in [1, 2, 13] {
        staged.run.burst(steps, &|_| {});
        depth_first.run.burst(steps, &|_| {});
        assert_same(&format!("{case}, {} steps", staged.steps()), &staged, &depth_first);
    }
    let statistics = staged.run.statistics();
    for number in 0..staged.run.chains().mutations.len() {
        let counts = (0..64).map(|length| statistics.of_length(number, length));
        let sum = counts.reduce(|a, b| a.plus(b)).expect("lengths");
        assert!(
            sum.accepted > 0 && sum.accepted <= sum.proposed,
            "{case}: mutation {number}: {sum:?}"
        );
    }
}

#[test]
fn staged_and_depth_first_chains_are_the_same_bit_for_bit() {
    for name in ["cornell-box.ron", "cornell-glass.ron"] {
        let scene = shipped(name, 24);
        for seed in [1, 2, u64::MAX] {
            let chains = Chains::new(2, 72, 288).seeded(seed).set("identity:weight=0.1");
            for tiles in [[None, None], [Some(16), Some(48)], [Some(64), Some(16)]] {
                both(&format!("{name}, seed {seed}, tiles {tiles:?}"), &scene, &chains, tiles);
            }
        }
    }
}

/// The planted mistake: steps that are a hair larger in one of the two.
#[test]
fn a_kernel_that_differs_shows_in_the_films() {
    let scene = shipped("cornell-box.ron", 24);
    let chains = Chains::new(2, 72, 288);
    let staged = chains.run(&scene, 3);
    let planted = Chains {
        technique: Technique::PssmltReference,
        ..chains.set("small_step:largest=0.0157")
    };
    assert!(films(&staged) != films(&planted.run(&scene, 3)));
}

/// Scenes without some effect have fewer columns, and paths of one edge no coordinates but those of the film.
#[test]
fn they_are_the_same_where_effects_are_missing() {
    let room = |depth: u32, material: &str| {
        inline(
            &format!(
                r#"(version: 1, settings: (max_depth: {depth}),
                camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40), film: (width: 8, height: 8),
                materials: {{ "m": {material} }},
                shapes: [(shape: Box(min: (-1, -1, -1), max: (1, 1, 1)), material: "m", emission: (1, 2, 3)),
                    (shape: Sphere(center: (0, 0, 0), radius: 9), material: "m")])"#
            ),
            8,
        )
    };
    let (mirror, glass) = (
        "Conductor(eta: (0, 0, 0), k: (1, 1, 1))",
        "Dielectric(interior_ior: 1.5)",
    );
    let matt = "Diffuse(reflectance: (0.5, 0.5, 0.5))";
    for (depth, material) in [(1, matt), (2, matt), (5, matt), (6, matt), (12, mirror), (12, glass)] {
        let chains = Chains::new(2, 40, 400);
        let scene = room(depth, material);
        both(
            &format!("{material} to depth {depth}"),
            &scene,
            &chains,
            [None, Some(16)],
        );
    }
}

#[test]
fn without_light_neither_traces_a_path() {
    let scene = inline(
        r#"(version: 1, settings: (max_depth: 6),
            camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40), film: (width: 8, height: 8),
            materials: { "m": Diffuse(reflectance: (1, 1, 1)) },
            shapes: [(shape: Box(min: (-1, -1, -1), max: (1, 1, 1)), material: "m")])"#,
        8,
    );
    let [staged, depth_first] = [Technique::Pssmlt, Technique::PssmltReference].map(|technique| {
        let chains = Chains {
            technique,
            ..Chains::new(2, 16, 64)
        };
        chains.run(&scene, 4)
    });
    assert_same("no light", &staged, &depth_first);
    assert_eq!(
        (staged.run.counters().rays, staged.run.counters().decisions),
        (0, 4 * 32)
    );
}

/// A mutation with systems of its own, and no way to move one path after another.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct StagedOnly;

impl Mutation for StagedOnly {
    const NAME: &'static str = "staged_only";
    const ABOUT: &'static str = "nothing";
    const SPACE: StateSpace = StateSpace::PRIMARY;

    fn weight(&self) -> f32 {
        1.0
    }

    fn systems(&self) -> Vec<SystemPlan> {
        Vec::new()
    }
}

#[test]
fn a_mutation_that_needs_stages_is_refused_by_name() {
    let mut options = PlanOptions::default();
    options.mutations = options.mutations.with(StagedOnly);
    let scene = shipped("cornell-box.ron", 8);
    assert!(Plan::with(&scene, Technique::Pssmlt, &options).is_ok());
    let error = Plan::with(&scene, Technique::PssmltReference, &options).expect_err("it cannot run");
    assert_eq!(
        error,
        ChainPlanError::NotDepthFirst {
            mutation: "staged_only"
        }
    );
    assert_eq!(error.to_string(), "`staged_only` cannot run one chain after another");
}
