//! Mutations of whole paths: each alone, and mixed with the one that draws seeds, leaves the light unchanged in three scenes; each
//! kind of mistake in their densities is found.

use super::spoiled::Spoiled;
use super::verdicts::quick;
use crate::support::scenes::shipped;
use crate::support::verdict::say;
use bevy_ecs::system::Res;
use chainlight::chain::{ForwardDensity, MutationList, ReverseDensity};
use chainlight::check::{Options, Report, built_in_scene, run};
use chainlight::path::ChainTable;
use chainlight::path::whole::*;
use chainlight::plan::{Place, Registered, Registry, Stage, StateSpace, SystemPlan, SystemSpec};
use chainlight::scene::Scene;
use chainlight::stats::normal::sidak;
use chainlight::system;
use chainlight::systems::chains::MutationLists;
use chainlight::systems::propose::paths::weighing::Weighing;
use chainlight::systems::propose::{Bidirectional, CausticPerturbation, LensPerturbation, mutations};
use chainlight::systems::tile::TilePlace;
use chainlight::table::{Read, Rows, Write};
use std::sync::Arc;

fn check(registry: &Registry, name: &str, scene: &Arc<Scene>, options: &Options) -> Report {
    let report = run(registry, name, scene, options).unwrap_or_else(|error| panic!("{name}: {error}"));
    say(&report.to_string());
    report
}

/// A registry with `name` spoiled by a system that runs behind its own.
fn spoiled(name: &str, system: SystemSpec) -> Registry {
    let mut registry = mutations();
    let inner = Arc::clone(registry.get(name).expect("a mutation"));
    registry.put(Arc::new(Spoiled {
        inner,
        systems: vec![SystemPlan::new(system, "a twin")],
    }));
    registry
}

#[test]
fn every_mutation_of_paths_passes_in_three_scenes() {
    let scenes = [("cornell-box.ron", 12), ("cornell-glass.ron", 12), ("door-ajar.ron", 8)];
    let registry = mutations();
    let paths = || registry.iter().filter(|m| m.space() == StateSpace::PATH);
    let options = Options {
        replicas: 1 << 14,
        significance: sidak(0.01, scenes.len() * paths().count()),
        ..quick()
    };
    for (name, size) in scenes {
        let scene = shipped(name, size);
        for mutation in paths() {
            let report = check(&registry, mutation.name(), &scene, &options);
            let failures = report.failures().0;
            assert!(failures.is_empty(), "{name}: {report}");
        }
    }
}

const EVALUATE: Place = Place::Stage(Stage::Evaluate);

/// Writes T as if only the strategy that has drawn the proposal could have done so, and one for the way back.
fn count_one_strategy(
    mutation: Res<Registered<Bidirectional>>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    made: Read<CameraVertices, ChainTable>,
    kept: Read<KeptFromCamera, ChainTable>,
    edges: Read<PathEdges, ChainTable>,
    shares: Read<PathShare, PathTable>,
    proposed_edges: Read<ProposedEdges, ChainTable>,
    proposed_shares: Read<PathShare, ProposedPathTable>,
    light_kept: Read<KeptFromLight, ChainTable>,
    mut forward: Write<ForwardDensity, ChainTable>,
    mut reverse: Write<ReverseDensity, ChainTable>,
) {
    let (list, made, kept, light_kept) = (list.rows(), made.rows(), kept.rows(), light_kept.rows());
    let (edges, shares, proposed_edges, proposed_shares) = (
        edges.rows(),
        shares.rows(),
        proposed_edges.rows(),
        proposed_shares.rows(),
    );
    let (forward, reverse) = (forward.rows(), reverse.rows());
    for chain in lists.entries(mutation.number).map(|entry| list.at(entry) as usize) {
        let (k, to) = (edges.at(chain), proposed_edges.at(chain));
        if k == 0 || to == 0 || made.at(chain) == 0 {
            continue;
        }
        let (first, rest) = (kept.at(chain).max(1), light_kept.at(chain));
        let share = |of: &[PathShare], t: u32| of.at(place.path_vertex(chain, t as usize - 1));
        let one = |of: &[PathShare], edges: u32| {
            let last = edges + 1 - rest;
            let all: f64 = (first..=last).map(|t| share(of, t)).sum();
            libm::log(share(of, made.at(chain).clamp(first, last)) / all)
        };
        forward.put(chain, forward.at(chain) + one(proposed_shares, to));
        reverse.put(chain, reverse.at(chain) + one(shares, k));
    }
}

#[test]
fn a_density_of_one_strategy_alone_fails() {
    let registry = spoiled("bidirectional", system!(EVALUATE, count_one_strategy));
    let options = Options {
        replicas: 1 << 17,
        steps: vec![1],
        ..quick()
    };
    let report = check(&registry, "bidirectional", &shipped("cornell-box.ron", 12), &options);
    assert!(!report.passed(), "{report}");
}

/// Writes T of lens perturbations without the share of their strategy, in which the geometry of the edge is that they join.
fn forget_geometry(
    mutation: Res<Registered<LensPerturbation>>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    mut weighing: Weighing,
) {
    let list = list.rows();
    let chains = lists.entries(mutation.number).map(|entry| list.at(entry) as usize);
    weighing.weigh(&place, chains, |_, _| 1.0);
}

#[test]
fn a_lens_perturbation_that_forgets_the_geometry_of_its_edge_fails() {
    let registry = spoiled("lens", system!(EVALUATE, forget_geometry));
    let scene = built_in_scene().expect("a scene");
    let options = Options {
        replicas: 1 << 17,
        steps: vec![1],
        ..quick()
    };
    let report = check(&registry, "lens", &scene, &options);
    assert!(!report.passed(), "{report}");
}

/// Writes T of caustic perturbations without the densities of the directions that they do not draw.
fn forget_directions(
    mutation: Res<Registered<CausticPerturbation>>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    mut weighing: Weighing,
) {
    let list = list.rows();
    let chains = lists.entries(mutation.number).map(|entry| list.at(entry) as usize);
    weighing.weigh(&place, chains, |_, way| way.to.share(1));
}

#[test]
fn a_caustic_perturbation_that_forgets_the_density_of_directions_fails() {
    let registry = spoiled("caustic", system!(EVALUATE, forget_directions));
    let scene = built_in_scene().expect("a scene");
    let options = Options {
        replicas: 1 << 17,
        ..quick()
    };
    let report = check(&registry, "caustic", &scene, &options);
    assert!(!report.passed(), "{report}");
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
