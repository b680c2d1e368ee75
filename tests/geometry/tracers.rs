//! Every way to trace gives the same answers.

use super::dice::Dice;
use super::world::{Line, Triangle, World, closest, closest_and_free_by_all_ways};
use crate::support::ways::ways;
use chainlight::geometry::{Instructions, Tracer};
use chainlight::math;
use glam::Vec3;

fn soup(dice: &mut Dice, count: usize, size: f32) -> Vec<Triangle> {
    let triangle = |_| {
        let center = dice.point(1.0);
        [0; 3].map(|_| center + dice.point(size))
    };
    (0..count).map(triangle).collect()
}

fn lines(dice: &mut Dice, count: usize) -> Vec<Line> {
    (0..count).map(|_| (dice.point(1.2), dice.direction())).collect()
}

#[test]
fn queues_of_any_length_are_answered_in_their_order() {
    let mut dice = Dice::new(31);
    let world = World::default()
        .mesh(&soup(&mut dice, 3000, 0.1))
        .sphere(Vec3::ZERO, 0.3);
    let geometry = world.compile().geometry;
    for count in [0, 1, 2, 6, 7, 8, 63, 64, 65, 500] {
        let rays = lines(&mut dice, count);
        let (found, _) = closest_and_free_by_all_ways(&geometry, &rays, &rays);
        for (ray, found) in rays.iter().zip(found) {
            assert_eq!(closest(&geometry, &[*ray])[0].bits(), found.bits());
        }
    }
}

/// Sheets one behind the other, each much larger than the one before: the tree is about as deep as it has nodes, and a ray from the
/// smallest side enters all of the boxes.
#[test]
fn trees_as_deep_as_they_have_primitives_are_walked_in_full() {
    let sheet = |number: i32| {
        let size = math::exp2((number - 60) as f32);
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x * size, y * size, size))
    };
    let sheets: Vec<Triangle> = (0..120).map(sheet).collect();
    let geometry = World::default().mesh(&sheets).compile().geometry;
    let rays: Vec<Line> = (0..119)
        .map(|number| {
            let z = sheets[number][0].z;
            // From just behind a sheet, where only those above it are left, along the edge that all have in common and beside it.
            (Vec3::new(1e-3 * z, 1e-3 * z, 1.5 * z), Vec3::Z)
        })
        .collect();
    let (found, _) = closest_and_free_by_all_ways(&geometry, &rays, &rays);
    for (number, found) in found.iter().enumerate() {
        assert_eq!(found.name(), (0, number as u32 + 1));
    }
}

#[test]
fn what_a_machine_lacks_is_not_used() {
    let mut dice = Dice::new(32);
    let mut geometry = World::default().mesh(&soup(&mut dice, 200, 0.2)).compile().geometry;
    let rays = lines(&mut dice, 100);
    let found = closest(&geometry, &rays);
    for instructions in Instructions::ALL {
        // Also those that are not here.
        geometry.trace_with(Tracer::OneByOne, instructions);
        let other = closest(&geometry, &rays);
        assert!(found.iter().zip(other).all(|(a, b)| a.bits() == b.bits()));
    }
    assert!(Instructions::best().are_here() && ways().len() >= 5);
}
