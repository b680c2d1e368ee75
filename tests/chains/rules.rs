//! The rules that chains keep in every step: each decides exactly once and books a weight of one in all, whatever its
//! proposal; none moves to a state without light; what is not finite is counted with its chain and step, and the render goes
//! on; the current path, traced again, is the same path.
//!
//! These hold exactly, so there is no significance to state: every chain is looked at after every step. Each check has a
//! twin with a planted system that breaks the rule, and must notice it.

use crate::support::chains::{Chains, column, films};
use crate::support::scenes::{inline, shipped};
use bevy_ecs::system::Res;
use chainlight::chain::{Acceptance, LongestRejections, ProposedTarget, Rejections, Target};
use chainlight::path::{BookedWeight, ChainTable, Decisions, ProposedFilm};
use chainlight::plan::{Phases, Place, Plan, Stage, SystemPlan, SystemSpec, Technique};
use chainlight::render::{ChainRender, Rendering};
use chainlight::system;
use chainlight::systems::list::{DECIDE, START_CAMERA_PATHS, WEIGH_SAMPLES};
use chainlight::systems::tile::TilePlace;
use chainlight::table::{Read, Rows, Write};

const EVALUATE: Place = Place::Stage(Stage::Evaluate);
const ACCEPT: Place = Place::Stage(Stage::Accept);
const PROPOSE: Place = Place::Stage(Stage::Propose);

/// `plan` with a system of a test right before or after another.
fn planted(mut plan: Plan, system: SystemSpec, neighbour: SystemSpec, after: bool) -> Plan {
    let place = plan.tile.systems.iter().position(|planned| planned.spec == neighbour);
    let place = place.expect("a system of every plan of chains") + usize::from(after);
    plan.tile.systems.insert(place, SystemPlan::new(system, "planted"));
    plan
}

/// Targets of proposals that fail.
const FAILURES: [f32; 6] = [0.0, -0.0, f32::NAN, f32::INFINITY, -1.0, f32::NEG_INFINITY];

/// What is planted for a chain in a step: in every third chain every proposal fails, in every third after it some do.
fn failure(chain: u32, step: u64) -> Option<f32> {
    let fails = match chain % 3 {
        0 => true,
        1 => (u64::from(chain) + step).is_multiple_of(4),
        _ => false,
    };
    fails.then(|| FAILURES[(u64::from(chain / 3) + step) as usize % FAILURES.len()])
}

/// Makes proposals fail.
fn fail_proposals(place: Res<TilePlace>, mut targets: Write<ProposedTarget, ChainTable>) {
    let targets = targets.rows();
    for chain in 0..place.chains {
        if let Some(target) = failure(place.first_chain + chain, place.step) {
            targets.put(chain as usize, target);
        }
    }
}

/// The planted mistake of chains that pass over proposals that fail.
fn pass_over_failures(
    place: Res<TilePlace>,
    targets: Read<ProposedTarget, ChainTable>,
    mut weights: Write<BookedWeight, ChainTable>,
    mut decisions: Write<Decisions, ChainTable>,
) {
    let (targets, weights, decisions) = (targets.rows(), weights.rows(), decisions.rows());
    for chain in (0..place.chains as usize).filter(|&chain| targets.at(chain) <= 0.0) {
        weights.put(chain, 0.0);
        decisions.put(chain, decisions.at(chain) - 1);
    }
}

/// The planted mistake of chains that take a proposal whatever it is.
fn take_failures(
    place: Res<TilePlace>,
    proposed: Read<ProposedTarget, ChainTable>,
    mut targets: Write<Target, ChainTable>,
) {
    let (proposed, targets) = (proposed.rows(), targets.rows());
    for chain in (0..place.chains as usize).filter(|&chain| proposed.at(chain) == 0.0) {
        targets.put(chain, proposed.at(chain));
    }
}

/// The planted mistake of paths that are not traced again as they were.
fn shift_films(place: Res<TilePlace>, mut films: Write<ProposedFilm, ChainTable>) {
    let films = films.rows();
    for chain in 0..place.chains as usize {
        let [x, y] = films.at(chain);
        films.put(chain, [x.wrapping_add(1 << 50), y]);
    }
}

/// What is wrong with the decisions of `steps` steps, if anything.
fn wrong_decisions(render: &ChainRender, steps: u64) -> Option<String> {
    let weights = column::<BookedWeight>(render);
    if let Some(chain) = weights.iter().position(|&weight| weight != 1.0) {
        return Some(format!("chain {chain} booked {}", weights[chain]));
    }
    let decisions = column::<Decisions>(render);
    if let Some(chain) = decisions.iter().position(|&count| u64::from(count) != steps) {
        return Some(format!(
            "chain {chain} decided {} times in {steps} steps",
            decisions[chain]
        ));
    }
    let counted = render.run.counters().decisions;
    let expected = steps * u64::from(render.chains());
    (counted != expected).then(|| format!("{counted} decisions counted instead of {expected}"))
}

/// What the films hold, in weights of one. A state's splats sum to one over channels, but for the rounding of each channel.
fn booked(render: &ChainRender) -> f64 {
    let pixels = || 0..render.scene.pixel_count();
    let films = films(render);
    films
        .iter()
        .flat_map(|film| pixels().flat_map(|pixel| film.sum(pixel)))
        .sum()
}

#[test]
fn every_chain_decides_once_a_step_and_books_one() {
    for technique in [
        Technique::Pssmlt,
        Technique::PssmltReference,
        Technique::Mlt,
        Technique::MltReference,
    ] {
        let chains = Chains {
            technique,
            ..Chains::new(2, 72, 360).set("identity:weight=0.2")
        };
        let scene = shipped("cornell-glass.ron", 16);
        let mut render = chains.start(&scene);
        for step in 1..=24 {
            render.run.burst(1, &|_| {});
            assert_eq!(wrong_decisions(&render, step), None, "{technique}");
            let expected = (step * u64::from(render.chains())) as f64;
            assert!(
                (booked(&render) / expected - 1.0).abs() < 1e-6,
                "{technique}, step {step}"
            );
        }
        assert!(column::<Acceptance>(&render).iter().all(|a| (0.0..=1.0).contains(a)));
    }
}

#[test]
fn chains_whose_proposals_fail_decide_too_and_stay_where_there_is_light() {
    const STEPS: u64 = 24;
    let scene = shipped("cornell-box.ron", 16);
    let chains = Chains::new(2, 72, 360);
    let plan = planted(
        chains.plan(&scene),
        system!(EVALUATE, fail_proposals).in_phases(Phases::STEP),
        DECIDE,
        false,
    );
    let mut render = chains.start_as(&scene, plan);
    let seeds = column::<Target>(&render);
    let mut before = seeds.clone();
    for step in 1..=STEPS {
        render.run.burst(1, &|_| {});
        assert_eq!(wrong_decisions(&render, step), None);
        let targets = column::<Target>(&render);
        for (chain, (was, is)) in (0..).zip(before.iter().zip(&targets)) {
            assert!(*is > 0.0 && is.is_finite(), "chain {chain} stands where f = {is}");
            let failed = failure(chain, step - 1).is_some();
            assert!(!failed || was == is, "chain {chain} moved to a proposal that failed");
        }
        before = targets;
    }
    let (rejections, longest) = (column::<Rejections>(&render), column::<LongestRejections>(&render));
    for chain in (0..rejections.len()).step_by(3) {
        assert_eq!((rejections[chain], longest[chain]), (STEPS as u32, STEPS as u32));
        assert_eq!(before[chain], seeds[chain]);
    }
    assert!(
        before.iter().zip(&seeds).any(|(is, was)| is != was),
        "no chain moved at all"
    );
    // Their states were splatted all the same, a weight of one a step.
    let expected = (STEPS * u64::from(render.chains())) as f64;
    assert!((booked(&render) / expected - 1.0).abs() < 1e-6);

    // Every failure that is not finite was counted, and the first by chain and step.
    let failures = |step| (0..render.chains()).filter_map(move |chain| Some((chain, step, failure(chain, step)?)));
    let all = || {
        (0..STEPS)
            .flat_map(failures)
            .filter(|(_, _, target)| !target.is_finite())
    };
    let counters = render.run.counters();
    assert_eq!(counters.non_finite, all().count() as u64);
    assert_eq!(
        counters.first_non_finite,
        all().next().map(|(chain, step, _)| (chain, step))
    );
}

#[test]
fn chains_that_pass_over_failures_or_take_them_are_noticed() {
    let scene = shipped("cornell-box.ron", 16);
    let chains = Chains::new(2, 72, 360);
    let plan = planted(
        chains.plan(&scene),
        system!(ACCEPT, pass_over_failures).in_phases(Phases::STEP),
        DECIDE,
        true,
    );
    let mut render = chains.start_as(&scene, plan);
    render.run.burst(4, &|_| {});
    assert!(wrong_decisions(&render, 4).is_some());

    let plan = planted(
        chains.plan(&scene),
        system!(ACCEPT, take_failures).in_phases(Phases::STEP),
        DECIDE,
        true,
    );
    let mut render = chains.start_as(&scene, plan);
    render.run.burst(4, &|_| {});
    assert!(column::<Target>(&render).contains(&0.0));
}

/// Makes every tenth sample of a bootstrap fail.
fn fail_samples(place: Res<TilePlace>, mut targets: Write<ProposedTarget, ChainTable>) {
    let targets = targets.rows();
    for chain in 0..place.chains {
        let sample = u64::from(place.first_chain + chain) + place.step;
        if sample.is_multiple_of(10) {
            targets.put(chain as usize, FAILURES[(sample / 10) as usize % FAILURES.len()]);
        }
    }
}

#[test]
fn samples_of_a_bootstrap_that_are_not_finite_are_counted_and_worth_nothing() {
    let scene = shipped("cornell-box.ron", 16);
    let run = |tile_size| {
        let mut chains = Chains::new(2, 80, 800);
        chains.options.tile_size = tile_size;
        let system = system!(EVALUATE, fail_samples).in_phases(Phases::BOOTSTRAP);
        let render = chains.start_as(&scene, planted(chains.plan(&scene), system, WEIGH_SAMPLES, false));
        let b: Vec<f64> = render.run.starts().iter().map(|start| start.normalization.b).collect();
        assert!(b.iter().all(|b| b.is_finite() && *b > 0.0));
        assert!(column::<Target>(&render).iter().all(|target| target.is_finite()));
        (b, render.run.counters().non_finite)
    };
    let (b, count) = run(None);
    // A tenth of 1600 samples, of which four in six are infinite, not a number, or negative.
    let failures = |sample: u64| FAILURES[(sample / 10) as usize % FAILURES.len()];
    let samples = (0..160).flat_map(|chain| (0..10).map(move |round| chain + round));
    let failed = samples.filter(|sample| sample % 10 == 0).map(failures);
    assert_eq!(count, failed.filter(|f| !(f.is_finite() && *f >= 0.0)).count() as u64);
    assert_eq!(run(Some(16)), (b, count));
}

#[test]
fn without_light_there_is_no_seed_and_a_black_picture() {
    let scene = |emission: &str| {
        inline(
            &format!(
                r#"(version: 1, settings: (max_depth: 4),
                camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40), film: (width: 8, height: 8),
                materials: {{ "m": Diffuse(reflectance: (0.5, 0.5, 0.5)) }},
                shapes: [(shape: Box(min: (-1, -1, -1), max: (1, 1, 1)), material: "m"),
                    (shape: Sphere(center: (0, 0, 0), radius: 0.5), material: "m"{emission})])"#
            ),
            8,
        )
    };
    // No emitter at all, and one that is walled in.
    for scene in [scene(""), scene(", emission: (1, 1, 1)")] {
        for technique in [
            Technique::Pssmlt,
            Technique::PssmltReference,
            Technique::Mlt,
            Technique::MltReference,
        ] {
            let chains = Chains {
                technique,
                ..Chains::new(2, 16, 256)
            };
            let render = chains.run(&scene, 8);
            assert_eq!(wrong_decisions(&render, 8), None);
            for start in render.run.starts() {
                assert_eq!((start.normalization.b, start.distinct_seeds), (0.0, 0));
            }
            let picture = render.picture();
            assert!(picture.rgb.iter().all(|rgb| rgb.is_black()) && picture.error.iter().all(|rgb| rgb.is_black()));
            assert_eq!((booked(&render), render.run.counters().non_finite), (0.0, 0));
        }
    }
}

/// Whether the current paths, traced again, have the targets that they had, after each of some steps of nothing else.
fn traced_again_are_the_same(render: &mut ChainRender) -> bool {
    let bits = |targets: Vec<f32>| -> Vec<u32> { targets.into_iter().map(f32::to_bits).collect() };
    let seeds = bits(column::<Target>(render));
    (0..4).all(|_| {
        render.run.burst(1, &|_| {});
        let (proposed, current) = (column::<ProposedTarget>(render), column::<Target>(render));
        bits(proposed) == seeds && bits(current) == seeds
    })
}

#[test]
fn the_current_path_traced_again_is_the_same_and_always_taken() {
    for name in ["cornell-box.ron", "cornell-glass.ron"] {
        let scene = shipped(name, 24);
        let mut chains = Chains::new(2, 200, 6400);
        chains.options.mutations = chains.options.mutations.only("identity").expect("a mutation");
        let mut render = chains.start(&scene);
        assert!(render.run.starts().iter().all(|start| start.distinct_seeds > 50));
        assert!(traced_again_are_the_same(&mut render), "{name}");
        assert!(column::<Acceptance>(&render).iter().all(|&a| a == 1.0), "{name}");
        assert_eq!(column::<LongestRejections>(&render), vec![0; 400], "{name}");

        let plan = planted(
            chains.plan(&scene),
            system!(PROPOSE, shift_films),
            START_CAMERA_PATHS,
            false,
        );
        let mut shifted = chains.start_as(&scene, plan);
        assert!(
            !traced_again_are_the_same(&mut shifted),
            "{name}: a shift goes unnoticed"
        );
    }
}
