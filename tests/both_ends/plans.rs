//! What techniques build: an effect that a scene does without costs no column and no system, whatever the technique.

use super::agreement::Contender;
use crate::support::scenes::{inline, shipped};
use chainlight::plan::{Base, ChainSettings, Effect, Plan, PlanOptions, Technique};
use chainlight::render::{Built, Rendering, TileWorld, short, start};
use chainlight::scene::Scene;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const SIZE: u32 = 8;
const WHITE: &str = "Diffuse(reflectance: (0.7, 0.7, 0.7))";

/// A box of one material on a matt floor, and lights.
fn scene(material: &str, lights: &str, emission: &str, max_depth: u32) -> Arc<Scene> {
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: {max_depth}),
                camera: Perspective(origin: (0, 1, 5), target: (0, 0, 0), fov: 40),
                film: (width: {SIZE}, height: {SIZE}),
                textures: {{ "checks": Checkerboard(scale: (4, 4)) }},
                materials: {{ "floor": {WHITE}, "m": {material} }},
                lights: [{lights}],
                shapes: [
                    (shape: Quad(corner: (-4, -1, 4), edge_u: (8, 0, 0), edge_v: (0, 0, -8)), material: "floor"),
                    (shape: Box(min: (-1, -0.9, -1), max: (1, 1, 1)), material: "m"),
                    (shape: Quad(corner: (-1.5, 1.2, -2.2), edge_u: (3, 0, 0), edge_v: (0, 0.6, 1)), material: "floor"{emission}),
                ])"#
        ),
        SIZE,
    )
}

fn lit(material: &str) -> Arc<Scene> {
    scene(material, "", ", emission: (5, 5, 5)", 8)
}

/// Every technique, the depth-first ones too, and every base.
fn all() -> Vec<Contender> {
    let depth_first = [
        Technique::PtReference,
        Technique::PssmltReference,
        Technique::MltReference,
    ];
    let depth_first = depth_first.map(|technique| Contender::of(technique, Base::Pt));
    Contender::ALL.into_iter().chain(depth_first).collect()
}

fn plan(scene: &Scene, contender: Contender) -> Plan {
    let options = PlanOptions {
        base: contender.base,
        chains: ChainSettings {
            groups: 2,
            chains: Some(16),
            bootstrap: Some(64),
            ..ChainSettings::default()
        },
        ..PlanOptions::default()
    };
    Plan::with(scene, contender.technique, &options).expect("the mutations there are make a plan")
}

/// The names of all systems and columns of a tile.
fn names(scene: &Scene, contender: Contender) -> BTreeSet<String> {
    let plan = plan(scene, contender);
    let built = Built::read(&TileWorld::new(&plan.tile, 0, |_| {}), &plan.tile);
    assert_eq!(built.matches(&plan.tile), Ok(()), "{contender}");
    let columns = built.tables.iter().flat_map(|table| &table.columns);
    let columns = columns.map(|column| &column.type_name);
    let systems = built.step.iter().chain(&built.trace_loop).chain(&built.join_loop);
    systems.chain(columns).map(|name| short(name).to_owned()).collect()
}

/// What the first has that the second does without.
fn gone<'a>(with: &'a BTreeSet<String>, without: &'a BTreeSet<String>) -> Vec<&'a str> {
    with.difference(without).map(String::as_str).collect()
}

#[test]
fn what_is_built_is_what_was_planned() {
    for name in [
        "cornell-box.ron",
        "cornell-glass.ron",
        "cornell-glossy.ron",
        "cornell-window.ron",
        "depth-of-field.ron",
        "island.ron",
        "materials/showcase.ron",
    ] {
        let scene = shipped(name, SIZE);
        for contender in all() {
            assert!(!names(&scene, contender).is_empty(), "{name}, {contender}");
        }
    }
}

#[test]
fn a_plain_box_has_nothing_of_what_it_does_without() {
    let plain = lit(WHITE);
    for contender in all() {
        let names = names(&plain, contender);
        for absent in [
            "VertexTexture",
            "VertexTangent",
            "RadianceScale",
            "PrimaryLobe",
            "scatter_dielectric",
            "scatter_rough_dielectric",
            "scatter_rough_conductor",
            "scatter_conductor",
            "scatter_plastic",
        ] {
            assert!(!names.contains(absent), "{contender}: {absent}");
        }
    }
    // Of paths from lights, path tracing knows nothing.
    for base in [Technique::Pt, Technique::Pssmlt] {
        let names = names(&plain, Contender::of(base, Base::Pt));
        for absent in [
            "VertexForward",
            "VertexReverse",
            "VertexTail",
            "VertexLight",
            "VertexArrival",
            "SegmentLight",
            "SegmentPixel",
            "SegmentClass",
            "BrightestLight",
            "start_light_paths",
            "join_loop",
            "offer_connections",
            "transmit_connections",
            "book_connections",
            "evaluate_lists",
            "accept_lists",
            "splat_lists",
        ] {
            assert!(!names.contains(absent), "{base}: {absent}");
        }
    }
    // Nor bidirectional path tracing of what path tracing alone keeps.
    for contender in [
        Contender::of(Technique::Lt, Base::Pt),
        Contender::of(Technique::Bdpt, Base::Pt),
    ] {
        let names = names(&plain, contender);
        for absent in [
            "VertexEmission",
            "VertexConnection",
            "ConnectList",
            "Contribution",
            "connect_lights",
        ] {
            assert!(!names.contains(absent), "{contender}: {absent}");
        }
    }
    // Light tracing weighs nothing, and starts nothing at the camera.
    let names = names(&plain, Contender::of(Technique::Lt, Base::Pt));
    for absent in [
        "VertexForward",
        "VertexReverse",
        "VertexTail",
        "FilmPixel",
        "start_camera_paths",
    ] {
        assert!(!names.contains(absent), "lt: {absent}");
    }
}

#[test]
fn removing_an_effect_removes_its_columns_and_systems() {
    let textured = r#"Diffuse(reflectance: "checks")"#;
    let round = r#"RoughConductor(metal: "Au", alpha: 0.2)"#;
    let brushed = r#"RoughConductor(metal: "Au", alpha_u: 0.1, alpha_v: 0.3)"#;
    let coated = "Plastic(diffuse_reflectance: (0.5, 0.5, 0.5))";
    let mirror = r#"Conductor(metal: "Au")"#;
    let glass = "Dielectric(interior_ior: 1.5)";
    let frosted = "RoughDielectric(interior_ior: 1.5, alpha: 0.2)";
    // A material, one without the effect, and the effect's columns and systems; those of primary sample space apart.
    type Names = &'static [&'static str];
    let cases: [(&str, &str, Effect, Names, Names); 7] = [
        (textured, WHITE, Effect::Textures, &["VertexTexture"], &[]),
        (
            round,
            WHITE,
            Effect::GlossyReflection,
            &["scatter_rough_conductor"],
            &[],
        ),
        (brushed, round, Effect::Textures, &["VertexTangent"], &[]),
        (
            coated,
            WHITE,
            Effect::CoatedReflection,
            &["scatter_plastic"],
            &["PrimaryLobe"],
        ),
        (mirror, WHITE, Effect::SpecularReflection, &["scatter_conductor"], &[]),
        (
            glass,
            WHITE,
            Effect::Refraction,
            &["RadianceScale", "scatter_dielectric"],
            &[],
        ),
        (
            frosted,
            WHITE,
            Effect::Refraction,
            &["RadianceScale", "scatter_rough_dielectric"],
            &["PrimaryLobe"],
        ),
    ];
    for (with, without, effect, expected, of_chains) in cases {
        let (with, without) = (lit(with), lit(without));
        for contender in Contender::ALL {
            assert!(!plan(&without, contender).has(effect), "{contender}, {effect:?}");
            let (with, without) = (names(&with, contender), names(&without, contender));
            let mut expected = expected.to_vec();
            match contender.technique {
                Technique::Pssmlt => expected.extend(of_chains),
                // How long its subpaths are is decided beforehand, and no roulette asks how bright they are.
                Technique::Mlt | Technique::MltReference => expected.retain(|&name| name != "RadianceScale"),
                _ => {}
            }
            expected.sort_unstable();
            let mut found = gone(&with, &without);
            found.sort_unstable();
            assert_eq!(found, expected, "{contender}, {effect:?}");
            assert!(gone(&without, &with).is_empty(), "{contender}, {effect:?}");
        }
    }
}

/// Light at infinity is met without a column of its own.
#[test]
fn surroundings_that_shine_bring_no_columns() {
    let lamp = ", emission: (5, 5, 5)";
    let without = scene(WHITE, "", lamp, 8);
    let with = scene(WHITE, "Environment(radiance: (1, 1, 1))", lamp, 8);
    for contender in all() {
        assert!(plan(&with, contender).has(Effect::Environment) && !plan(&without, contender).has(Effect::Environment));
        assert_eq!(names(&with, contender), names(&without, contender), "{contender}");
    }
}

/// A small render, whole.
fn rendered(scene: &Arc<Scene>, contender: Contender) -> Box<dyn Rendering> {
    let never = AtomicBool::new(false);
    let mut render = start(Arc::clone(scene), plan(scene, contender), 1, 1, &never, &|_| {}).expect("a small film");
    render.burst(3, &|_| {});
    render
}

#[test]
fn a_scene_without_light_traces_nothing() {
    let dark = scene(WHITE, "", "", 8);
    for contender in all() {
        let effects = plan(&dark, contender).effects;
        assert!(effects.iter().all(|effect| !effect.on), "{contender}");
        for absent in [
            "trace_loop",
            "join_loop",
            "start_camera_paths",
            "start_light_paths",
            "VertexPosition",
        ] {
            assert!(!names(&dark, contender).contains(absent), "{contender}: {absent}");
        }
        let render = rendered(&dark, contender);
        let counters = render.counters();
        assert_eq!(
            (counters.rays, counters.segments, counters.vertices),
            (0, 0, 0),
            "{contender}"
        );
        assert!(render.picture().rgb.iter().all(|rgb| rgb.is_black()), "{contender}");
    }
}

#[test]
fn paths_may_be_as_short_and_as_long_as_scenes_say() {
    let lamp = ", emission: (5, 5, 5)";
    let around = "Environment(radiance: (1, 1, 1)), Point(position: (0, 2, 2), intensity: (1, 1, 1))";
    for max_depth in [1, 2, 3, 64] {
        for (lights, emission) in [("", lamp), (around, lamp), (around, "")] {
            for material in [WHITE, "Dielectric(interior_ior: 1.5)", "Plastic()"] {
                let scene = scene(material, lights, emission, max_depth);
                for contender in all() {
                    let render = rendered(&scene, contender);
                    let case = format!("{contender}, {max_depth}, {lights}{emission}, {material}");
                    let picture = render.picture();
                    assert!(picture.rgb.iter().all(|rgb| rgb.is_finite()), "{case}");
                    // What is at infinity or at a point the lens sees by way of surfaces alone.
                    let dark = max_depth == 1 && emission.is_empty() && contender.technique == Technique::Lt;
                    assert_eq!(picture.rgb.iter().all(|rgb| rgb.is_black()), dark, "{case}");
                    assert_eq!(render.counters().non_finite, 0, "{case}");
                }
            }
        }
    }
}
