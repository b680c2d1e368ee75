//! A box of nothing: an interface whose two sides have the same index of refraction changes no picture, nor, to the noise, one
//! whose sides have nearly the same.
//!
//! A path that crosses the box has two edges more for each crossing, which count where there is an interface: paths through the
//! nearly empty box may be longer. Comparisons with each technique's own picture of the room without the box are one family with
//! a significance of 1 %.

use super::agreement::{Contender, Pictures, seen_by_light_tracing, statistics};
use super::{assert_same_light, block_means};
use crate::support::render::picture_bytes;
use crate::support::scenes::inline;
use chainlight::plan::{Plan, Technique};
use chainlight::render::start;
use chainlight::scene::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const SIZE: u32 = 24;
const BLOCKS_PER_SIDE: u32 = 6;
/// Edges of a path without the box. The room is open: of longer paths there is next to no light.
const EDGES: u32 = 8;

/// A matt room under a lamp, with a box of some material in its middle if one is given.
fn room(glass: Option<&str>, max_depth: u32) -> Arc<Scene> {
    let (material, shape) = glass.map_or_else(Default::default, |glass| {
        (
            format!(r#""glass": {glass},"#),
            r#"(shape: Box(min: (-0.7, 0.5, -0.6), max: (0.5, 1.3, 0.5)), material: "glass"),"#,
        )
    });
    inline(
        &format!(
            r#"(version: 1, settings: (max_depth: {max_depth}),
            camera: Perspective(origin: (0, 1, 4), target: (0, 0.9, 0), fov: 45), film: (width: {SIZE}, height: {SIZE}),
            materials: {{{material} "white": Diffuse(reflectance: (0.7, 0.6, 0.5))}},
            shapes: [
                (shape: Quad(corner: (-2, 0, 2), edge_u: (4, 0, 0), edge_v: (0, 0, -4)), material: "white"),
                (shape: Quad(corner: (-2, 0, -2), edge_u: (4, 0, 0), edge_v: (0, 3, 0)), material: "white"),
                (shape: Quad(corner: (-1, 2.8, -1), edge_u: (2, 0, 0), edge_v: (0, 0, 2)), material: "white",
                    emission: (6, 6, 6)),
                {shape}
            ])"#
        ),
        SIZE,
    )
}

/// Every path meets the same surfaces in the same places: not the light alone, but all numbers are the same.
#[test]
fn a_box_of_nothing_changes_no_picture() {
    for contender in Contender::ALL {
        let with = bytes(contender, room(Some("Dielectric(interior_ior: 1.0)"), EDGES));
        assert!(with == bytes(contender, room(None, EDGES)), "{contender}");
    }
}

/// The picture of a short render.
fn bytes(contender: Contender, scene: Arc<Scene>) -> Vec<u8> {
    let plan = Plan::with(&scene, contender.technique, &contender.options()).expect("a plan");
    let never = AtomicBool::new(false);
    let mut render = start(scene, plan, 1, 1, &never, &|_| {}).expect("a small film");
    render.burst(8, &|_| {});
    picture_bytes(&render.picture())
}

/// Facets between equal indices bend nothing, so that the box is a filter of colour, however rough it is said to be.
#[test]
fn a_rough_filter_between_equal_indices_is_a_smooth_one() {
    let filter = |kind: &str, alpha: &str| {
        let parameters = "interior_ior: 1.5, exterior_ior: 1.5, transmittance: (0.9, 0.5, 0.2)";
        room(Some(&format!("{kind}({parameters}{alpha})")), EDGES)
    };
    for contender in Contender::ALL {
        let rough = bytes(contender, filter("RoughDielectric", ", alpha: 0.2"));
        assert!(rough == bytes(contender, filter("Dielectric", "")), "{contender}");
        assert!(rough != bytes(contender, room(None, EDGES)), "{contender}");
    }
}

/// Light that reflects off a face with an index of 1.00001 is 2.5e-11 of what arrives, and refraction turns it by 1e-5 or so.
#[test]
fn a_box_of_nearly_nothing_changes_no_picture_to_the_noise() {
    // An edge may cross the box: two faces, two edges more.
    let nearly = room(Some("Dielectric(interior_ior: 1.00001)"), 3 * EDGES);
    let without = room(None, EDGES);
    let cases = Contender::ALL.map(|contender| {
        let pictures = |first_seed| Pictures {
            runs: 20,
            samples: 16 * contender.samples(),
            first_seed,
            blocks_per_side: BLOCKS_PER_SIDE,
        };
        let of = |scene, first_seed| block_means(scene, contender, &contender.options(), pictures(first_seed));
        (contender, of(&nearly, 1), of(&without, 1000))
    });
    // Light tracing does not see through smooth interfaces.
    let seen = seen_by_light_tracing(&nearly, BLOCKS_PER_SIDE).expect("a plan");
    assert!(seen.contains(&true) && seen.contains(&false), "{seen:?}");
    let all = vec![true; seen.len()];
    let counted = |contender: Contender| {
        if contender.technique == Technique::Lt {
            &seen
        } else {
            &all
        }
    };
    let tests = Contender::ALL
        .map(|contender| statistics(counted(contender)))
        .iter()
        .sum();
    for (contender, nearly, without) in &cases {
        let case = format!("{contender}, with a box of 1.00001 and without");
        assert_same_light(&case, nearly, without, counted(*contender), tests, 0.1);
    }
}
