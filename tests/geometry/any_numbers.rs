//! Any finite numbers: no panic, no NaN, no hit behind the origin.

use super::world::{World, closest, free};
use glam::Vec3;
use proptest::prelude::*;

/// All magnitudes up to 1e9, zeros of both signs and denormals.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -1e9_f32..1e9,
        4 => -2.0_f32..2.0,
        2 => prop::num::f32::ANY.prop_map(|x| if x.abs() <= 1e9 { x } else { 1.0 }),
        1 => prop::num::f32::SUBNORMAL,
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 1e9, -1e9, f32::MIN_POSITIVE]),
    ]
}

fn vector() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(number()).prop_map(Vec3::from_array)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(81), ..ProptestConfig::default() })]

    #[test]
    fn any_finite_numbers_are_harmless(
        triangles in prop::collection::vec(prop::array::uniform3(vector()), 0..20),
        spheres in prop::collection::vec((vector(), number()), 0..4),
        lines in prop::collection::vec((vector(), vector()), 1..20),
    ) {
        let mut world = World::default().mesh(&triangles);
        for (center, radius) in spheres {
            world = world.sphere(center, radius);
        }
        let geometry = world.compile().geometry;
        for found in closest(&geometry, &lines) {
            prop_assert!(found.distance >= 0.0, "{found:?}");
            if let Some(hit) = found.hit() {
                prop_assert!(hit.uv.is_finite(), "{found:?}");
                let point = geometry.surface_point(hit);
                prop_assert!(point.position.is_finite() && point.offset > 0.0, "{point:?}");
                prop_assert!((point.geometric_normal.length() - 1.0).abs() < 1e-5, "{point:?}");
            } else {
                prop_assert!(found.distance == f32::INFINITY);
            }
        }
        free(&geometry, &lines);
    }
}
