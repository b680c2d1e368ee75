//! Mutations of whole paths: each alone, mixed with the one that draws seeds, and all together leave the light unchanged in four
//! scenes; each kind of mistake in their densities is found, by replicas with which the mutation itself passes.

use super::path_twins::*;
use super::verdicts::quick;
use crate::physics::enclosure::walls;
use crate::support::scenes::{glass_under_wide_lamp, inline, shipped};
use crate::support::verdict::say;
use chainlight::check::{Options, Report, built_in_scene, run};
use chainlight::plan::{Direct, Mutation, Registry, StateSpace};
use chainlight::scene::Scene;
use chainlight::stats::normal::sidak;
use chainlight::systems::propose::mutations;
use std::sync::Arc;

fn check(registry: &Registry, name: &str, scene: &Arc<Scene>, options: &Options) -> Report {
    let report = run(registry, name, scene, options).unwrap_or_else(|error| panic!("{name}: {error}"));
    say(&report.to_string());
    report
}

/// The registry with these settings, and the same with a twin of those settings in place of one mutation.
fn with_twin<M: Mutation>(settings: &[&str], twin: M) -> [Registry; 2] {
    [mutations(), mutations().with(twin)].map(|mut registry| {
        for setting in settings {
            assert_eq!(registry.set(setting), Ok(()));
        }
        registry
    })
}

/// Holds that the harness refuses a twin, and passes the mutation that it is a twin of.
#[track_caller]
fn is_refused<M: Mutation>(settings: &[&str], twin: M, scene: &Arc<Scene>, options: &Options) {
    let [right, wrong] = with_twin(settings, twin).map(|registry| check(&registry, M::NAME, scene, options));
    assert!(right.failures().0.is_empty(), "{right}");
    assert!(!wrong.failures().0.is_empty(), "{wrong}");
}

#[test]
fn every_mutation_of_paths_passes_in_four_scenes() {
    let scenes = [
        ("the box", shipped("cornell-box.ron", 12), Direct::Chains, 16),
        ("the glass box", shipped("cornell-glass.ron", 12), Direct::default(), 16),
        // There replicas weigh about the same, and far smaller biases show than where few have most of the light.
        ("under a wide lamp", glass_under_wide_lamp(12, 6), Direct::Chains, 64),
        ("the door", shipped("door-ajar.ron", 8), Direct::Chains, 64),
    ];
    let registry = mutations();
    let paths = || registry.iter().filter(|m| m.space() == StateSpace::PATH);
    let number = scenes.len();
    for (name, scene, direct, candidates) in scenes {
        let options = Options {
            replicas: 1 << 14,
            significance: sidak(0.01, number * paths().count()),
            direct,
            candidates,
            ..quick()
        };
        for mutation in paths() {
            // All together once, each with its own weight.
            let options = Options {
                among_all: mutation.name() == "bidirectional",
                ..options.clone()
            };
            let report = check(&registry, mutation.name(), &scene, &options);
            let failures = report.failures().0;
            assert!(failures.is_empty(), "{name}: {report}");
        }
    }
}

/// A room whose walls all emit: every path that is proposed brings about as much light, and nearly all are taken.
fn room_of_light() -> Arc<Scene> {
    let text = format!(
        r#"(version: 1, settings: (max_depth: 8),
        camera: Perspective(origin: (0.3, -0.4, 0.5), target: (-0.2, 0.1, -1), fov: 100),
        film: (width: 12, height: 12), materials: {{"wall": Diffuse(reflectance: (0.5, 0.5, 0.5))}},
        shapes: [{}])"#,
        walls()
    );
    inline(&text, 12)
}

/// Replicas that count about equally and take many steps: a factor of a few per cent moves them where it draws chains.
fn patient() -> Options {
    Options {
        replicas: 1 << 15,
        candidates: 64,
        steps: vec![1, 32],
        // Lamps that the lens sees would be most of the light.
        direct: Direct::default(),
        ..quick()
    }
}

#[test]
fn a_density_of_one_strategy_alone_fails() {
    let scene = shipped("cornell-box.ron", 12);
    is_refused(&[], OneStrategy::default(), &scene, &patient());
}

#[test]
fn a_density_that_is_a_little_too_large_where_paths_grow_fails() {
    let options = Options {
        replicas: 1 << 17,
        candidates: 16,
        steps: vec![64],
        direct: Direct::Chains,
        ..patient()
    };
    is_refused(&[], TooMuchGrowth::default(), &room_of_light(), &options);
}

#[test]
fn a_lens_perturbation_that_counts_the_geometry_of_its_edge_fails() {
    let scene = built_in_scene().expect("a scene");
    is_refused(&[], WithGeometry::default(), &scene, &patient());
}

/// A film so small that most of it is near its border, where fewer pixels' filters reach.
#[test]
fn a_lens_perturbation_that_forgets_the_filters_fails() {
    let text = format!(
        r#"(version: 1, settings: (max_depth: 4),
        camera: Perspective(origin: (0.3, -0.4, 0.5), target: (-0.2, 0.1, -1), fov: 100),
        film: (width: 4, height: 4, filter: Tent(radius: 2)),
        materials: {{"wall": Diffuse(reflectance: (0.5, 0.5, 0.5))}}, shapes: [{}])"#,
        walls()
    );
    let options = Options {
        direct: Direct::Chains,
        ..patient()
    };
    let settings = ["lens:covered=1"];
    is_refused(&settings, WithoutFilter::default(), &inline(&text, 4), &options);
}

/// A floor below a mirror, and light at one side: by way of both it is seen the steeper the nearer to it.
#[test]
fn a_multi_chain_perturbation_that_takes_its_directions_for_those_of_materials_fails() {
    let text = r#"(version: 1, settings: (max_depth: 3),
        camera: Perspective(origin: (0, 0.5, 0), target: (0, 0, 0), up: (1, 0, 0), fov: 120),
        film: (width: 12, height: 12),
        materials: {
            "white": Diffuse(reflectance: (0.7, 0.7, 0.7)),
            "mirror": Conductor(metal: "Ag"),
            "lamp": Diffuse(reflectance: (0, 0, 0)),
        },
        shapes: [
            (shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -6)), material: "white"),
            (shape: Quad(corner: (-3, 1, 3), edge_u: (0, 0, -6), edge_v: (6, 0, 0)), material: "mirror"),
            (shape: Quad(corner: (3.2, 0, -4), edge_u: (0, 0, 8), edge_v: (0, 1, 0)), material: "lamp", emission: (1, 1, 1)),
        ])"#;
    let options = Options {
        direct: Direct::Chains,
        ..patient()
    };
    let settings = ["multi_chain:smallest_angle=10,largest_angle=90"];
    is_refused(&settings, WithMaterials::default(), &inline(text, 12), &options);
}

/// The lamp is round: the nearer to it, the smaller is its part that can be chosen.
#[test]
fn a_lens_subpath_that_forgets_how_its_light_is_chosen_fails() {
    let text = r#"(version: 1, settings: (max_depth: 2),
        camera: Perspective(origin: (0, 0.55, 0), target: (0, 0, 0), up: (1, 0, 0), fov: 140),
        film: (width: 12, height: 12), materials: {"white": Diffuse(reflectance: (0.7, 0.7, 0.7))},
        shapes: [
            (shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -6)), material: "white"),
            (shape: Sphere(center: (0, 1, 0), radius: 0.4), material: "white", emission: (1, 1, 1)),
        ])"#;
    let options = Options {
        direct: Direct::Chains,
        ..patient()
    };
    is_refused(&[], WithoutKeptLight::default(), &inline(text, 12), &options);
}

/// A coated floor that is seen from above and along it, where it is a mirror.
#[test]
fn a_lens_subpath_that_forgets_how_likely_it_is_to_stop_fails() {
    let text = r#"(version: 1, settings: (max_depth: 4),
        camera: Perspective(origin: (0, 0.5, 2), target: (0, 0, 0), fov: 100),
        film: (width: 12, height: 12),
        materials: {
            "coat": Plastic(interior_ior: 2.2, diffuse_reflectance: (0.7, 0.7, 0.7)),
            "lamp": Diffuse(reflectance: (0, 0, 0)),
        },
        shapes: [
            (shape: Quad(corner: (-9, 0, 3), edge_u: (18, 0, 0), edge_v: (0, 0, -18)), material: "coat"),
            (shape: Quad(corner: (-9, 4, 3), edge_u: (0, 0, -18), edge_v: (18, 0, 0)), material: "lamp", emission: (1, 1, 1)),
        ])"#;
    let options = Options {
        direct: Direct::Chains,
        ..patient()
    };
    is_refused(&[], WithoutStopping::default(), &inline(text, 12), &options);
}

#[test]
fn a_caustic_perturbation_that_forgets_the_density_of_directions_fails() {
    let options = Options {
        candidates: 4,
        direct: Direct::Chains,
        ..patient()
    };
    let settings = ["caustic:smallest=1,covered=1"];
    is_refused(&settings, WithoutDirections::default(), &room_of_light(), &options);
}

/// A lamp above water and to a side, a floor below, and the camera in it: solid angles shrink where light enters, the more the more
/// slanting.
#[test]
fn a_caustic_perturbation_that_takes_solid_angles_for_probabilities_fails() {
    let text = r#"(version: 1, settings: (max_depth: 3),
        camera: Perspective(origin: (0, -0.2, 0), target: (0, -1, 0), up: (1, 0, 0), fov: 140),
        film: (width: 12, height: 12),
        materials: {
            "water": Dielectric(interior_ior: 1.33),
            "floor": Diffuse(reflectance: (0.7, 0.7, 0.7)),
            "lamp": Diffuse(reflectance: (0, 0, 0)),
        },
        shapes: [
            (shape: Quad(corner: (-20, 0, 20), edge_u: (40, 0, 0), edge_v: (0, 0, -40)), material: "water"),
            (shape: Quad(corner: (-20, -1, 20), edge_u: (40, 0, 0), edge_v: (0, 0, -40)), material: "floor"),
            (shape: Quad(corner: (4, 2, 0.5), edge_u: (0, 0, -1), edge_v: (1, 0, 0)), material: "lamp", emission: (1, 1, 1)),
        ])"#;
    let options = Options {
        replicas: 1 << 16,
        direct: Direct::Chains,
        ..patient()
    };
    let settings = ["caustic:smallest=1,covered=1"];
    is_refused(&settings, WithSolidAngles::default(), &inline(text, 12), &options);
}

#[test]
fn a_caustic_perturbation_whose_steps_do_not_lead_back_fails() {
    let scene = built_in_scene().expect("a scene");
    // Few sizes: what is too large one way is often too small the other.
    let settings = ["caustic:smallest=2,covered=0.0001"];
    is_refused(&settings, WithoutWayBack::default(), &scene, &patient());
}

#[test]
fn a_density_without_the_probability_of_choosing_the_mutation_fails() {
    let options = Options {
        among_all: true,
        direct: Direct::Chains,
        steps: vec![64],
        ..patient()
    };
    // Where there is a caustic, the others are chosen the less often.
    let settings = ["caustic:weight=8"];
    let scene = built_in_scene().expect("a scene");
    is_refused(&settings, WithoutChoices::default(), &scene, &options);
}

#[test]
fn chains_that_try_all_mutations_pass() {
    let scene = built_in_scene().expect("a scene");
    let options = Options {
        replicas: 1 << 15,
        steps: vec![1, 4],
        among_all: true,
        ..quick()
    };
    let report = check(&mutations(), "bidirectional", &scene, &options);
    assert!(report.passed(), "{report}");
    assert!(report.tests.iter().any(|test| test.run == "among all"));
}
