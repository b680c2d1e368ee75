//! The steps of perturbations: on the film, and between directions: their sizes have a uniform logarithm, and they go all around.

use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::path::whole::{Sizes, jump, tilt};
use glam::{Vec2, Vec3};

const SAMPLES: usize = 1_000_000;
const CELLS: usize = 64;
const SIZES: Sizes = Sizes {
    smallest: 0.1,
    largest: 40.0,
};
const ANGLES: Sizes = Sizes {
    smallest: 1e-4,
    largest: 1.0,
};
const FAMILY: Family = Family { tests: 6 };

/// The cell of a size by its logarithm, and of an angle around.
fn cells(sizes: Sizes, size: f64, around: f64) -> [usize; 2] {
    let share = libm::log(size / sizes.smallest) / libm::log(sizes.largest / sizes.smallest);
    let turn = around / std::f64::consts::TAU + 0.5;
    [share, turn].map(|place| ((place * CELLS as f64) as usize).min(CELLS - 1))
}

/// Counts of sizes and of ways around, and of sizes as if they themselves were uniform: what a test must refuse.
fn assert_spread(name: &str, sizes: Sizes, case: usize, draw: impl Fn(f64, f64) -> (f64, f64)) {
    let mut stream = stream(case);
    let (mut by_size, mut by_turn) = (vec![0; CELLS], vec![0; CELLS]);
    for _ in 0..SAMPLES {
        let (size, around) = draw(sizes.sample(stream.next_f64()), stream.next_f64());
        let [size, turn] = cells(sizes, size, around);
        by_size[size] += 1;
        by_turn[turn] += 1;
    }
    let uniform = vec![1.0 / CELLS as f64; CELLS];
    FAMILY.follows(&format!("{name}, sizes"), &by_size, &uniform, 0.02);
    FAMILY.follows(&format!("{name}, around"), &by_turn, &uniform, 0.02);
    let mut tilted = uniform;
    for (cell, probability) in tilted.iter_mut().enumerate() {
        *probability *= 1.0 + 0.04 * (cell as f64 / (CELLS - 1) as f64 - 0.5);
    }
    FAMILY.refuses(&format!("{name}, larger sizes 4 % more often"), &by_size, &tilted);
}

#[test]
fn steps_on_the_film_are_of_every_order_of_magnitude_alike() {
    assert_spread("film", SIZES, 1, |size, u| {
        let step = jump(Vec2::new(100.0, 70.0), size, u).as_dvec2() - glam::DVec2::new(100.0, 70.0);
        (step.length(), libm::atan2(step.y, step.x))
    });
}

#[test]
fn changes_of_directions_are_of_every_order_of_magnitude_alike() {
    let from = Vec3::new(0.36, 0.48, -0.8);
    let axis = from.as_dvec3().normalize();
    let (across, along) = axis.any_orthonormal_pair();
    assert_spread("direction", ANGLES, 2, |size, u| {
        let to = tilt(from, size, u).as_dvec3();
        let angle = libm::atan2(axis.cross(to).length(), axis.dot(to));
        (angle, libm::atan2(to.dot(along), to.dot(across)))
    });
}
