//! What the harness says of mutations that are right, and of their twins that are not. All in the scene that is built in.

use super::twins::*;
use crate::support::verdict::say;
use chainlight::check::{CheckError, Options, Report, TestKind, Tested, built_in_scene, run};
use chainlight::plan::{Base, Registry, StateSpace};
use chainlight::stats::normal::sidak;
use chainlight::systems::propose::mutations;

/// Few replicas, for mistakes that are large.
pub(super) fn quick() -> Options {
    Options {
        replicas: 1 << 15,
        density_replicas: 1 << 15,
        steps: vec![1, 3],
        seed: 7,
        threads: 2,
        ..Options::default()
    }
}

fn check(registry: &Registry, name: &str, options: &Options) -> Report {
    let scene = built_in_scene().expect("a scene");
    let report = run(registry, name, &scene, options).unwrap_or_else(|error| panic!("{name}: {error}"));
    say(&report.to_string());
    report
}

/// Holds that the tests of `kinds` refuse the twin, each with a replica that shows it, and returns the name of the clearest
/// failure of the first kind.
#[track_caller]
fn refused(report: &Report, kinds: &[TestKind]) -> String {
    let found: Vec<TestKind> = report.failures().0.into_iter().map(|(kind, _)| kind).collect();
    for &kind in kinds {
        let failure = report.clearest(kind);
        let failure = failure.unwrap_or_else(|| panic!("{} passes {}: {found:?}", report.mutation, kind.name()));
        assert!(failure.witness.is_some(), "nobody shows that {failure}");
    }
    assert!(!report.passed());
    report
        .clearest(kinds[0])
        .map(|failure| failure.name.clone())
        .unwrap_or_default()
}

#[test]
fn every_registered_mutation_passes() {
    let registry = mutations();
    for mutation in registry.iter().filter(|m| m.space() == StateSpace::PRIMARY) {
        let report = check(&registry, mutation.name(), &quick());
        assert!(report.passed(), "{report}");
        assert_ne!(report.density, Tested::NoSupport, "{}", mutation.name());
        assert_eq!(report.replicas, 1 << 15);
    }
}

#[test]
fn reports_do_not_depend_on_threads() {
    let tests = |threads| {
        let options = Options { threads, ..quick() };
        let report = check(&mutations(), "small_step", &options);
        serde_json::to_string(&report.tests).expect("JSON")
    };
    assert_eq!(tests(1), tests(3));
}

#[test]
fn a_large_step_that_is_not_uniform_fails_by_target_density_and_uniformity() {
    let options = Options {
        replicas: 1 << 17,
        ..quick()
    };
    let report = check(&mutations().with(Cornered::default()), "cornered", &options);
    let bin = refused(&report, &[TestKind::Uniform, TestKind::Density, TestKind::Target]);
    assert!(bin.starts_with("film coordinates, cell ("), "{bin}");
}

#[test]
fn a_small_step_that_drifts_fails_by_flow() {
    let report = check(&mutations().with(Drifting::default()), "drifting", &quick());
    let bin = refused(&report, &[TestKind::Flow]);
    assert!(bin.starts_with("film coordinates") || bin.starts_with("block"), "{bin}");
}

#[test]
fn a_density_that_is_wrong_where_paths_grow_fails_by_flow() {
    let options = Options {
        replicas: 1 << 20,
        steps: vec![1],
        ..quick()
    };
    let report = check(&mutations().with(Growing::default()), "growing", &options);
    let bin = refused(&report, &[TestKind::Flow]);
    assert!(bin.starts_with("last coordinates at depth"), "{bin}");
    assert_eq!(report.density, Tested::NoSupport);
    assert!(report.to_string().contains("NOT TESTED"), "{report}");
}

#[test]
fn a_constant_factor_fails_by_density_alone() {
    let registry = mutations().with(Inflated::default()).with(Sound::default());
    let options = Options {
        density_replicas: 1 << 17,
        ..quick()
    };
    let report = check(&registry, "inflated", &options);
    assert_eq!(refused(&report, &[TestKind::Density]), "all states");
    let other = report
        .failures()
        .0
        .into_iter()
        .find(|(kind, _)| *kind != TestKind::Density);
    assert_eq!(other, None);
    assert!(check(&registry, "sound", &options).passed());
}

/// Over both ends, where a state has twenty coordinates and more: one of `runs` runs, which all pass with a probability of
/// 99 % when nothing is wrong.
fn over_both_ends(seed: u64, runs: usize) -> Options {
    Options {
        base: Base::Bdpt,
        steps: vec![1],
        seed,
        significance: sidak(0.01, runs),
        ..quick()
    }
}

#[test]
fn every_registered_mutation_passes_over_both_ends_whatever_the_seed() {
    let registry = mutations();
    let primary = || registry.iter().filter(|m| m.space() == StateSpace::PRIMARY);
    let seeds = 1..=3;
    let runs = primary().count() * seeds.clone().count();
    for seed in seeds {
        for mutation in primary() {
            let report = check(&registry, mutation.name(), &over_both_ends(seed, runs));
            assert!(report.passed(), "{report}");
            if let Tested::Region { judged, sees, .. } = report.density {
                assert!(judged > 50 && sees.is_some_and(|sees| sees < 0.03), "{report}");
            }
        }
    }
}

#[test]
fn a_constant_factor_fails_by_density_over_both_ends_whatever_the_seed() {
    let registry = mutations().with(Inflated::default()).with(Sound::default());
    for seed in 1..=3 {
        let report = check(&registry, "inflated", &over_both_ends(seed, 4));
        assert_eq!(refused(&report, &[TestKind::Density]), "all states");
        assert_eq!(report.failures().0.len(), 1, "{report}");
    }
    assert!(check(&registry, "sound", &over_both_ends(4, 4)).passed());
}

/// A coordinate too many in T, and the wrong law of steps in it: in a mutation that moves dozens of coordinates.
#[test]
fn a_density_that_is_wrong_in_one_coordinate_fails_over_both_ends() {
    let registry = mutations().with(Miscounted::default()).with(Misjudged::default());
    for name in ["miscounted", "misjudged"] {
        let report = check(&registry, name, &over_both_ends(1, 2));
        assert_eq!(refused(&report, &[TestKind::Density]), "all states");
    }
}

#[test]
fn a_large_step_that_is_not_uniform_fails_over_both_ends() {
    let options = Options {
        replicas: 1 << 16,
        ..over_both_ends(1, 1)
    };
    let report = check(&mutations().with(Cornered::default()), "cornered", &options);
    let bin = refused(&report, &[TestKind::Uniform, TestKind::Density]);
    assert!(bin.starts_with("film coordinates, cell ("), "{bin}");
}

/// Of a region so uneven that no sum can be near normal, nothing is judged, and the report says that.
#[test]
fn cells_whose_sums_are_not_normal_are_not_judged() {
    let options = Options {
        replicas: 1 << 12,
        density_replicas: 1 << 12,
        ..quick()
    };
    let report = check(&mutations().with(Uneven::default()), "uneven", &options);
    assert_eq!(report.of_kind(TestKind::Density).count(), 0);
    assert!(matches!(report.density, Tested::Region { judged: 0, cells, sees: None } if cells > 0));
    assert!(report.to_string().contains("NOT TESTED: in none of"), "{report}");
}

#[test]
fn coordinates_that_are_not_drawn_again_fail_by_target() {
    let options = Options {
        replicas: 1 << 17,
        ..quick()
    };
    let report = check(&mutations().with(Forgetful::default()), "forgetful", &options);
    let bin = refused(&report, &[TestKind::Target]);
    assert!(bin.contains("cell (2, 2)"), "{bin}");
}

#[test]
fn an_identity_that_moves_fails_by_its_support() {
    let report = check(&mutations().with(Restless::default()), "restless", &quick());
    refused(&report, &[TestKind::Support]);
    assert_eq!(report.density, Tested::PointMass);
    assert_eq!(report.failures().0.len(), 1, "{report}");
}

#[test]
fn a_choice_that_depends_on_the_state_passes_only_with_its_probability() {
    let registry = mutations().with(Choosy::default()).with(Biased::default());
    let options = Options {
        replicas: 1 << 17,
        ..quick()
    };
    let sound = check(&registry, "choosy", &options);
    assert!(sound.passed(), "{sound}");
    assert!(sound.tests.iter().any(|test| test.run == "mixed with large_step"));
    let biased = check(&registry, "biased", &options);
    refused(&biased, &[TestKind::Flow]);
    let clearest = biased.clearest(TestKind::Flow).expect("a failure");
    assert_eq!(clearest.run, "mixed with large_step");
}

#[test]
fn a_mutation_that_there_is_not_is_answered_with_the_nearest() {
    let scene = built_in_scene().expect("a scene");
    let error = run(&mutations(), "smal_step", &scene, &quick()).expect_err("no such mutation");
    assert!(matches!(error, CheckError::Unknown(_)));
    assert!(error.to_string().contains("did you mean `small_step`?"), "{error}");
}
