//! What is not asked for is not there, and what is asked for in vain is refused.

use super::{TECHNIQUES, plan, standard_layers};
use crate::support::scenes::shipped;
use chainlight::layer::{LayerError, Layers, REST, standard};
use chainlight::plan::{ChainPlanError, Plan, PlanOptions, Technique};
use std::collections::BTreeSet;

/// The names of systems, tables and columns of a plan.
fn parts(plan: &Plan) -> BTreeSet<String> {
    let tiles = [Some(&plan.tile), plan.direct.as_ref().map(|direct| &direct.tile)];
    let mut parts = BTreeSet::new();
    for tile in tiles.into_iter().flatten() {
        parts.extend(tile.systems.iter().map(|system| system.spec.name().to_owned()));
        for table in &tile.tables {
            parts.insert(table.id.name().to_owned());
            parts.extend(table.columns.iter().map(|column| column.spec.name.to_owned()));
        }
    }
    parts
}

#[test]
fn without_layers_nothing_of_them_is_there() {
    let scene = shipped("cornell-glass.ron", 16);
    let of_layers = |part: &&String| part.to_lowercase().contains("layer") || *part == "VertexConnectionEnd";
    for technique in TECHNIQUES {
        let (without, with) = (
            plan(&scene, technique, None),
            plan(&scene, technique, standard_layers(&scene)),
        );
        assert_eq!(parts(&without).iter().filter(of_layers).count(), 0, "{technique:?}");
        let more: BTreeSet<String> = parts(&with).difference(&parts(&without)).cloned().collect();
        assert!(more.len() >= 3, "{technique:?}: {more:?}");
        assert_eq!(
            more.iter().filter(of_layers).count(),
            more.len(),
            "{technique:?}: {more:?}"
        );
        assert!(with.film_bytes > without.film_bytes);
    }
}

#[test]
fn standard_layers_are_those_that_a_scene_has_paths_for() {
    let names = |name: &str| standard().within(&shipped(name, 16)).names().join(" ");
    assert_eq!(names("cornell-box.ron"), "emitted direct diffuse other");
    assert_eq!(
        names("cornell-glass.ron"),
        "emitted specular direct diffuse sds caustic seen_specular other"
    );
    assert_eq!(names("veach-plates.ron"), "emitted direct diffuse glossy other");
}

#[test]
fn baselines_have_no_layers() {
    let scene = shipped("cornell-box.ron", 16);
    for technique in Technique::ALL {
        let options = PlanOptions {
            layers: standard_layers(&scene),
            ..PlanOptions::default()
        };
        let refused = matches!(
            Plan::with(&scene, technique, &options),
            Err(ChainPlanError::Layers { .. })
        );
        assert_eq!(refused, technique.staged().is_some(), "{technique}");
    }
}

#[test]
fn layers_that_would_be_black_are_refused_in_words() {
    let scene = shipped("cornell-box.ron", 16);
    let refusal = |expression: &str| {
        let layers = Layers::new([("first", "CL"), ("asked", expression)]).expect("an expression");
        layers.refuse_black(&scene).err()
    };
    for black in ["CSL", "C.*B", "CDP", "CL", "CD", "C<TD>L", "C.{16}L"] {
        let Some(LayerError::Black { name, reason, .. }) = refusal(black) else {
            panic!("{black} is not refused");
        };
        assert_eq!(name, "asked");
        assert!(reason.contains("scatter by <RD>, its lights are O"), "{reason}");
    }
    for lit in ["CDL", "C.*O", "C.{15}L", "CD*L"] {
        assert_eq!(refusal(lit), None, "{lit}");
    }
    assert_eq!(standard().names().last().map(String::as_str), Some(REST));
}
