//! The tables and schedules of a tile are exactly those of the plan.

use super::{inline, shipped};
use chainlight::plan::{Effect, Plan, TableId, Technique};
use chainlight::render::{Built, TileWorld, short};
use chainlight::scene::{Scene, read_scene};
use chainlight::table::LANES;
use std::collections::BTreeSet;
use std::sync::Arc;

fn built(scene: &Arc<Scene>, technique: Technique) -> (Plan, Built) {
    let plan = Plan::new(scene, technique, None);
    let built = Built::read(&TileWorld::new(&plan.tile, 0, |_| {}), &plan.tile);
    (plan, built)
}

fn systems(built: &Built) -> BTreeSet<String> {
    built
        .step
        .iter()
        .chain(&built.trace_loop)
        .map(|name| short(name).to_owned())
        .collect()
}

fn columns(built: &Built) -> BTreeSet<String> {
    built
        .tables
        .iter()
        .flat_map(|table| &table.columns)
        .map(|column| short(&column.type_name).to_owned())
        .collect()
}

fn box_with(material: &str, emission: &str, max_depth: u32) -> Arc<Scene> {
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: {max_depth}),
                camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
                film: (width: 8, height: 8),
                materials: {{ "m": {material} }},
                shapes: [(shape: Box(min: (-1, -1, -1), max: (1, 1, 1)), material: "m"{emission})])"#
        ),
        8,
    )
}

#[test]
fn what_is_built_is_what_was_planned() {
    for technique in Technique::ALL {
        for scene in ["cornell-box.ron", "cornell-glass.ron"] {
            let (plan, built) = built(&shipped(scene, 8), technique);
            assert_eq!(built.matches(&plan.tile), Ok(()), "{scene} {technique}");
        }
        for emission in ["", ", emission: (1, 1, 1)"] {
            for max_depth in [1, 2, 5, 6, 64] {
                let scene = box_with("Diffuse(reflectance: (1, 1, 1))", emission, max_depth);
                let (plan, built) = built(&scene, technique);
                assert_eq!(built.matches(&plan.tile), Ok(()), "{emission} {max_depth} {technique}");
            }
        }
    }
}

#[test]
fn a_world_that_differs_from_its_plan_is_noticed() {
    let (mut plan, built) = built(&shipped("cornell-glass.ron", 8), Technique::Pt);
    plan.tile.tables[1].columns.pop();
    assert!(built.matches(&plan.tile).is_err());
    let (mut plan, built) = self::built(&shipped("cornell-glass.ron", 8), Technique::Pt);
    plan.tile.systems.swap(3, 4);
    assert!(built.matches(&plan.tile).is_err());
}

#[test]
fn no_column_owns_heap_memory_and_no_resource_is_a_table() {
    let (_, built) = built(&shipped("cornell-glass.ron", 8), Technique::Pt);
    for column in built.tables.iter().flat_map(|table| &table.columns) {
        assert!(!column.needs_drop, "{} owns memory", column.type_name);
    }
    let ours = built
        .resources
        .iter()
        .filter(|name| name.starts_with("chainlight"))
        .map(|name| short(name));
    // The profile has one entry per system, the depths one per table that grows; the rest is plain.
    let known = ["Profile", "Queues", "Counters", "TilePlace", "Depths"];
    assert_eq!(ours.collect::<BTreeSet<_>>(), BTreeSet::from(known));
    fn is_plain<T: Copy>() {}
    is_plain::<chainlight::systems::tile::TilePlace>();
    is_plain::<chainlight::systems::tile::Queues>();
    is_plain::<chainlight::systems::tile::Counters>();
}

/// The glass box without the shapes of one material.
fn glass_box_without(material: &str) -> Arc<Scene> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/cornell-glass.ron");
    let mut source = read_scene(&path).expect("a shipped scene");
    let before = source.description.shapes.len();
    source
        .description
        .shapes
        .retain(|shape| shape.material.as_deref() != Some(material));
    assert_eq!(source.description.shapes.len(), before - 1);
    super::compile(&source, 8)
}

#[test]
fn removing_glass_removes_its_system_and_its_columns() {
    let emission = ", emission: (1, 1, 1)";
    let (planned, with) = built(&shipped("cornell-glass.ron", 8), Technique::Pt);
    let (plan, without) = built(&glass_box_without("glass"), Technique::Pt);
    assert!(!plan.has(Effect::Refraction));
    let gone = |a: BTreeSet<String>, b: BTreeSet<String>| a.difference(&b).cloned().collect::<Vec<_>>();
    assert_eq!(gone(systems(&with), systems(&without)), ["scatter_dielectric"]);
    assert_eq!(gone(columns(&with), columns(&without)), ["RadianceScale"]);
    // A list of chains for each model of the scene: diffuse, conductor, and no longer glass.
    let lists = |built: &Built, tile: u32| {
        let table = built.tables.iter().find(|table| table.id == TableId::SCATTER);
        table.map(|table| table.rows * LANES / tile as usize)
    };
    assert_eq!(lists(&with, planned.tile.size), Some(3));
    assert_eq!(lists(&without, plan.tile.size), Some(2));
    assert!(gone(systems(&without), systems(&with)).is_empty());
    assert!(gone(columns(&without), columns(&with)).is_empty());

    let mirror = box_with("Conductor(eta: (0, 0, 0), k: (1, 1, 1))", emission, 8);
    let (_, mirror) = built(&mirror, Technique::Pt);
    for absent in [
        "connect_lights",
        "transmit_segments",
        "scatter_diffuse",
        "scatter_dielectric",
    ] {
        assert!(!systems(&mirror).contains(absent), "{absent}");
    }
    for absent in [
        "VertexConnection",
        "SegmentTarget",
        "SegmentTransmittance",
        "ConnectList",
    ] {
        assert!(!columns(&mirror).contains(absent), "{absent}");
    }
}

#[test]
fn a_scene_without_light_traces_nothing() {
    let scene = box_with("Diffuse(reflectance: (1, 1, 1))", "", 8);
    let (plan, built) = built(&scene, Technique::Pt);
    assert!(Effect::ALL.iter().all(|effect| !plan.has(*effect)));
    assert_eq!(
        systems(&built),
        BTreeSet::from(["accept_always", "assign_pixels", "splat_samples"].map(String::from))
    );
    assert_eq!(built.tables.len(), 1);
    let picture = super::picture(&scene, Technique::Pt, 0, 4);
    assert!(picture.rgb.iter().all(|rgb| rgb.is_black()) && picture.weight.iter().all(|&w| w == 4.0));
}

#[test]
fn emitters_seen_directly_need_no_scattering() {
    let scene = box_with("Diffuse(reflectance: (1, 1, 1))", ", emission: (1, 2, 3)", 1);
    let (_, built) = built(&scene, Technique::Pt);
    assert!(!systems(&built).contains("scatter_diffuse") && !columns(&built).contains("VertexMaterial"));
    let picture = super::picture(&scene, Technique::Pt, 0, 4);
    assert_eq!(picture.rgb[8 * 4 + 4].to_array(), [1.0, 2.0, 3.0]);
    assert!(picture.rgb[0].is_black());
}
