//! Direct light beside chains in path space: chains leave out exactly what path tracing renders, and the picture, its errors and
//! what is saved of it are those of both parts.

use crate::support::chains::Chains;
use crate::support::scenes::{compile, inline, shipped};
use chainlight::chain::StateClass;
use chainlight::film::Picture;
use chainlight::path::whole::{PathEdges, PathLight, PathTable};
use chainlight::path::{ChainTable, VERTEX_DISCRETE, VertexKind, is_direct};
use chainlight::plan::{Direct, Plan, PlanOptions, StateSpace, Technique};
use chainlight::render::{
    Budget, ChainRender, DirectLight, Findings, Render, RenderError, Rendering, SavedRenderError, drive, error_blocks,
    resume,
};
use chainlight::sampling::StreamKey;
use chainlight::scene::{Scene, SceneOverrides, flatten, read_scene};
use chainlight::systems::tile::TilePlace;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

const SIZE: u32 = 10;

/// Chains of `mlt`: two groups of fifty, one for each pixel, so that a step is a mutation per pixel.
fn chains(direct: Direct) -> Chains {
    let mut chains = Chains {
        technique: Technique::Mlt,
        ..Chains::new(2, 50, 400)
    };
    chains.options.direct = Some(direct);
    chains
}

fn run(scene: &Arc<Scene>, direct: Direct, steps: u64) -> ChainRender {
    let mut render = chains(direct).start(scene);
    render.burst(steps, &|_| {});
    render
}

/// Of every chain's state, whether its light is direct.
fn are_direct(render: &ChainRender) -> Vec<bool> {
    let mut all = Vec::new();
    render.run.for_each_tile(&mut |chains, tile| {
        let place = *tile.world().resource::<TilePlace>();
        let edges = tile.all::<PathEdges, ChainTable>();
        let kinds = tile.all::<VertexKind, PathTable>();
        all.extend((0..chains.len()).map(|chain| {
            is_direct(edges[chain] as usize, |i| {
                kinds[place.path_vertex(chain, i)] == VERTEX_DISCRETE
            })
        }));
    });
    all
}

#[test]
fn chains_are_in_no_state_of_direct_light_unless_it_is_left_to_them() {
    for name in ["cornell-glass.ron", "island.ron"] {
        let scene = shipped(name, SIZE);
        let apart = run(&scene, Direct::default(), 16);
        assert!(are_direct(&apart).into_iter().all(|direct| !direct), "{name}");
        let statistics = apart.run.statistics();
        for visits in statistics
            .visits
            .chunks_exact(chainlight::systems::chains::VISIT_CLASSES)
        {
            let by_length = &visits[StateClass::BLOCKS..StateClass::BLOCKS + StateClass::LENGTHS];
            assert_eq!(by_length[..3], [0; 3], "{name}");
        }
        let all = run(&scene, Direct::Chains, 16);
        assert!(all.direct().is_none());
        assert!(are_direct(&all).into_iter().any(|direct| direct), "{name}");
    }
}

fn direct(render: &ChainRender) -> &DirectLight {
    render.direct().expect("rendered apart")
}

/// The picture of path tracing in a scene whose paths have two edges at most.
fn path_traced(name: &str, seed: u64, steps: u64) -> Picture {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    let source = read_scene(&path).expect("a shipped scene");
    let flattened = flatten(&source).expect("a shipped scene");
    let overrides = SceneOverrides {
        size: Some((SIZE, SIZE)),
        max_depth: Some(2),
    };
    let scene = Arc::new(Scene::compile(&source.description, &flattened, overrides).expect("a shipped scene"));
    let plan = Plan::new(&scene, Technique::Pt, None);
    let mut render = Render::new(scene, plan, seed, 1).expect("a small film");
    render.burst(steps, &|_| {});
    render.picture()
}

/// To the last bit, by a seed of its own: where nothing is a mirror or clear.
#[test]
fn direct_light_is_that_of_path_tracing_of_two_edges() {
    for name in [
        "cornell-box.ron",
        "cornell-window.ron",
        "island.ron",
        "depth-of-field.ron",
    ] {
        let render = run(&shipped(name, SIZE), Direct::Apart(50), 120);
        assert_eq!(direct(&render).samples_per_pixel(), 60.0);
        let seed = StreamKey::new(render.run.seed(), 0, 1 << 61).bits();
        assert_eq!(direct(&render).picture(), path_traced(name, seed, 60), "{name}");
    }
}

/// The same chains without direct light beside them.
fn without(scene: &Arc<Scene>, steps: u64) -> ChainRender {
    let chains = chains(Direct::default());
    let mut plan = chains.plan(scene);
    plan.direct = None;
    let mut render = chains.start_as(scene, plan);
    render.burst(steps, &|_| {});
    render
}

#[test]
fn the_picture_and_its_variance_are_the_sum_of_both_parts() {
    const STEPS: u64 = 32;
    let scene = shipped("cornell-glass.ron", SIZE);
    let (both, chains) = (run(&scene, Direct::default(), STEPS), without(&scene, STEPS));
    let [sum, indirect, direct_alone] = [both.picture(), chains.picture(), direct(&both).picture()];
    for pixel in 0..sum.rgb.len() {
        assert_eq!(sum.rgb[pixel], indirect.rgb[pixel] + direct_alone.rgb[pixel]);
        let errors = [&sum, &indirect, &direct_alone].map(|picture| picture.error[pixel].to_array());
        for channel in 0..3 {
            let [sum, a, b] = errors.map(|error| f64::from(error[channel]));
            assert!((sum - (a * a + b * b).sqrt()).abs() <= 1e-6 * sum, "{sum} {a} {b}");
        }
    }
    assert_eq!(sum.weight, indirect.weight);
    assert_ne!(indirect.rgb, direct_alone.rgb);
    // Of blocks, in the units of the picture.
    let stated = |render: &ChainRender, mean: f64| render.error().expect("light and groups").rms * mean;
    let mean = |picture: &Picture| {
        let channels = picture.rgb.iter().flat_map(|rgb| rgb.to_array());
        channels.map(f64::from).sum::<f64>() / (3 * picture.rgb.len()) as f64
    };
    let [with, alone] = [stated(&both, mean(&sum)), stated(&chains, mean(&indirect))];
    let variances = chainlight::film::block_variances(&direct_alone, &error_blocks(&scene)).expect("the same size");
    let own = variances.iter().sum::<f64>() / variances.len() as f64;
    assert!(
        (with * with / (alone * alone + own) - 1.0).abs() < 1e-4,
        "{with} {alone} {own}"
    );
    let findings = Findings::of(&both);
    let layered = both.with_layers(both.picture(), &findings);
    let plain = chains.with_layers(chains.picture(), &Findings::of(&chains));
    assert_ne!(layered.layers[0], plain.layers[0]);
    assert_eq!(layered.layers[1], plain.layers[1]);
}

#[test]
fn samples_follow_the_steps_whatever_bursts_they_came_in() {
    let scene = shipped("cornell-box.ron", SIZE);
    let taken = |render: &ChainRender| direct(render).samples_per_pixel();
    let mut render = chains(Direct::Apart(3)).start(&scene);
    assert_eq!(taken(&render), 3.0);
    let counted = |render: &ChainRender| direct(render).counters().decisions;
    for (more, samples) in [(1, 3.0), (99, 3.0), (1, 3.03), (19, 3.6), (80, 6.0), (10, 6.3)] {
        render.burst(more, &|_| {});
        assert_eq!(
            (taken(&render), counted(&render)),
            (samples, (samples * 100.0_f64).round() as u64)
        );
    }
    let tiled = {
        let mut chains = chains(Direct::Apart(3));
        (chains.options.tile_size, chains.threads) = (Some(16), 3);
        let mut render = chains.start(&scene);
        let order: Vec<usize> = (0..render.tile_count()).rev().collect();
        render.burst_in_order(210, &order, &|_| {});
        render
    };
    assert_eq!(direct(&tiled).picture(), direct(&render).picture());
    assert_eq!(tiled.picture(), render.picture());
}

#[test]
fn time_limits_end_at_a_picture_that_steps_reproduce() {
    let scene = shipped("cornell-box.ron", SIZE);
    let mut timed = chains(Direct::default()).start(&scene);
    let outcome = drive(
        &mut timed,
        Budget::Time(Duration::from_millis(50)),
        &AtomicBool::new(false),
        &|_| {},
    );
    let again = run(&scene, Direct::default(), outcome.steps);
    assert_eq!(timed.picture(), again.picture());
}

#[test]
fn what_was_saved_goes_on_and_what_no_render_saves_is_refused() {
    let scene = shipped("cornell-glass.ron", SIZE);
    let taken_up = |direct: Direct, saved: &[u8]| {
        let plan = chains(direct).plan(&scene);
        resume(Arc::clone(&scene), plan, 1, 2, saved)
    };
    let mut whole = run(&scene, Direct::default(), 107);
    let saved = whole.save();
    whole.burst(13, &|_| {});
    let mut resumed = taken_up(Direct::default(), &saved).expect("what was just saved");
    resumed.burst(13, &|_| {});
    assert_eq!(resumed.picture(), whole.picture());
    assert!(resumed.save() == whole.save());
    assert_eq!(
        resumed.direct().map(DirectLight::samples_per_pixel),
        Some(direct(&whole).samples_per_pixel())
    );
    for other in [Direct::Chains, Direct::Apart(17)] {
        let Err(RenderError::Saved(SavedRenderError::Other { name, saved, own })) = taken_up(other, &saved) else {
            panic!("{other} goes on");
        };
        assert_eq!(
            (name.as_str(), saved.as_str(), own),
            ("--direct", "64", other.to_string())
        );
    }
    // States that are longer than paths are, or end on lights that there are not.
    let spoilt: [fn(&ChainRender); 3] = [
        |render| {
            render.run.for_each_tile(&mut |chains, tile| {
                tile.write::<PathEdges, ChainTable>(&vec![1 << 20; chains.len()]);
            });
        },
        |render| {
            render.run.for_each_tile(&mut |chains, tile| {
                tile.write::<PathLight, ChainTable>(&vec![77; chains.len()]);
            });
        },
        |render| {
            render.run.for_each_tile(&mut |_, tile| {
                let vertices = tile.all::<chainlight::path::VertexMaterial, chainlight::path::whole::PathTable>();
                tile.write::<chainlight::path::VertexMaterial, chainlight::path::whole::PathTable>(&vec![
                    1 << 16;
                    vertices.len()
                ]);
            });
        },
    ];
    for (number, spoil) in spoilt.into_iter().enumerate() {
        let render = run(&scene, Direct::default(), 2);
        spoil(&render);
        let outcome = taken_up(Direct::default(), &render.save());
        assert!(
            matches!(outcome, Err(RenderError::Saved(SavedRenderError::Damaged))),
            "number {number}"
        );
    }
}

/// A lamp in the void, or in glass: there is no other light than what is seen of it.
const LAMP: &str = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 30),
    film: (width: 10, height: 10), materials: {"m": Diffuse(reflectance: (0, 0, 0))},
    shapes: [(shape: Sphere(radius: 1), material: "m", emission: (3, 2, 1))])"#;

#[test]
fn light_that_is_all_direct_needs_no_chains() {
    let in_glass = LAMP
        .replace("materials: {", "materials: { \"g\": Dielectric(interior_ior: 1.5),")
        .replace("shapes: [", "shapes: [(shape: Sphere(radius: 1.2), material: \"g\"),");
    for (text, longest) in [(LAMP, 2), (&in_glass, 16)] {
        let scene = inline(text, SIZE);
        let render = run(&scene, Direct::default(), 8);
        let plan = render.plan().direct.as_ref().expect("rendered apart");
        assert_eq!(plan.longest(), longest);
        let picture = render.picture();
        assert_eq!(picture.rgb, direct(&render).picture().rgb);
        let [r, g, _] = picture.rgb[5 * SIZE as usize + 5].to_array();
        assert!((r / g - 1.5).abs() < 1e-5 && (longest > 2 || r == 3.0), "{r} {g}");
        assert!(render.error().is_some_and(|error| error.rms.is_finite()));
        let warnings = Findings::of(&render).warnings();
        assert!(
            matches!(&warnings[..], [only] if only.contains("found light that is not direct") && !only.contains("black")),
            "{warnings:?}"
        );
    }
}

/// Two rooms with a door ajar between them: hardly any light is direct.
#[test]
fn direct_light_that_is_rare_is_no_trouble() {
    let scene = shipped("door-ajar.ron", SIZE);
    let render = run(&scene, Direct::default(), 8);
    assert_eq!(direct(&render).samples_per_pixel(), 16.0);
    assert!(direct(&render).picture().error.iter().all(|error| error.is_finite()));
    assert!(render.picture().rgb.iter().any(|rgb| !rgb.is_black()));
}

/// Where there is no other light, chains look for it; planning says so.
#[test]
fn direct_light_is_left_to_chains_where_it_is_all_there_can_be() {
    for max_depth in [1, 2, 3] {
        let text = LAMP.replace(
            "(version: 1,",
            &format!("(version: 1, settings: (max_depth: {max_depth}),"),
        );
        let scene = inline(&text, SIZE);
        let plan = chains(Direct::default()).plan(&scene);
        assert_eq!(plan.direct.is_some(), max_depth == 3);
        assert_eq!(plan.tile.shortest, if max_depth == 3 { 3 } else { 1 });
        let render = run(&scene, Direct::default(), 8);
        assert!(render.picture().rgb.iter().any(|rgb| !rgb.is_black()), "{max_depth}");
    }
}

/// Other techniques have no such part, and no option of it shows in them.
#[test]
fn no_other_technique_renders_direct_light_apart() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/cornell-box.ron");
    let scene = compile(&read_scene(&path).expect("a shipped scene"), SIZE);
    for technique in Technique::ALL {
        for direct in [Direct::default(), Direct::Chains] {
            let options = PlanOptions {
                direct: Some(direct),
                ..PlanOptions::default()
            };
            let plan = Plan::with(&scene, technique, &options).expect("the defaults make a plan");
            let apart = technique.space() == Some(StateSpace::PATH) && direct == Direct::default();
            assert_eq!(plan.direct.is_some(), apart, "{technique}");
            assert_eq!(plan.tile.shortest, if apart { 3 } else { 1 }, "{technique}");
        }
    }
}
