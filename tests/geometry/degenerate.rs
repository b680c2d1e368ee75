//! Scenes with nothing to hit: none at all, without area, or with broken numbers.

use super::dice::Dice;
use super::world::{Line, Triangle, World, closest, free};
use glam::Vec3;

#[test]
fn primitives_without_area_or_with_broken_numbers_change_nothing() {
    let mut dice = Dice::new(4);
    let sound: Vec<Triangle> = (0..200)
        .map(|_| {
            let center = dice.point(1.0);
            [0; 3].map(|_| center + dice.point(0.3))
        })
        .collect();
    let p = Vec3::new(0.5, -0.25, 0.125);
    let mut broken = vec![
        [p, p, p],
        [p, p, -p],
        [p, -p, p],
        [-p, p, p],
        [p, p * 2.0, p * 4.0],
        [Vec3::ZERO; 3],
        [Vec3::INFINITY, Vec3::ZERO, Vec3::X],
        [Vec3::NEG_INFINITY, Vec3::INFINITY, Vec3::X],
    ];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for entry in 0..9 {
            let mut triangle = [p, Vec3::Y, Vec3::Z];
            triangle[entry / 3][entry % 3] = bad;
            broken.push(triangle);
        }
    }
    let mut with = World::default().mesh(&sound).mesh(&broken);
    for bad in [f32::NAN, f32::INFINITY, 0.0, -1.0] {
        with = with.sphere(Vec3::ZERO, bad);
    }
    for bad in [f32::NAN, f32::INFINITY] {
        with = with.sphere(Vec3::new(0.0, bad, 0.0), 1.0);
    }
    let (with, without) = (
        with.compile().geometry,
        World::default().mesh(&sound).compile().geometry,
    );
    assert_eq!(with.bounds(), without.bounds());
    let rays: Vec<Line> = (0..20_000).map(|_| (dice.point(1.5), dice.direction())).collect();
    assert_eq!(closest(&with, &rays), closest(&without, &rays));
    let segments: Vec<Line> = (0..20_000).map(|_| (dice.point(1.5), dice.point(1.5))).collect();
    assert_eq!(free(&with, &segments), free(&without, &segments));
    let alone = World::default().mesh(&broken).compile().geometry;
    assert_eq!(alone.bounds(), None);
    assert!(closest(&alone, &rays).iter().all(|found| found.hit().is_none()));
}

#[test]
fn an_empty_scene_is_never_hit_and_lets_all_light_through() {
    let geometry = World::default().compile().geometry;
    let found = closest(&geometry, &[(Vec3::ZERO, Vec3::X), (Vec3::ONE, Vec3::NEG_Z)]);
    assert!(found.iter().all(|f| f.hit().is_none() && f.distance == f32::INFINITY));
    assert_eq!(free(&geometry, &[(Vec3::ZERO, Vec3::X)]), [true]);
    assert_eq!((geometry.bounds(), geometry.primitive_count()), (None, 0));
}
