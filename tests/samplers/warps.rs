//! Every warp against its density: nine tests of a million samples in 20 x 20 cells. Directions are counted in
//! coordinates in which their solid angle is area, scaled to the cone where there is one, so that narrow cones are seen
//! as well as wide ones.

use crate::support::cells::{Grid, angle, height_and_angle, one_minus_cos};
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::sampling::warp;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

const SAMPLES: usize = 1_000_000;
/// Half angles of cones, in radians: from the hemisphere to a lamp far away.
const HALF_ANGLES: [f64; 5] = [FRAC_PI_2, FRAC_PI_3, 0.2, 0.02, 1e-3];
const FAMILY: Family = Family {
    tests: 4 + HALF_ANGLES.len(),
};
/// Cells off by this much, in the root mean square, are seen.
const SEES: f64 = 0.016;

fn uniform(_: f64, _: f64) -> f64 {
    1.0 / TAU
}

/// Coordinates of a disk point in which area is area: r² and the angle. The density 1/π becomes 1/2π.
fn on_disk(u: [f32; 2]) -> [f64; 2] {
    let p = warp::disk(u).as_dvec2();
    // Rounding may put a rim point outside by a few parts in 10⁸.
    [polite(p.length_squared()), angle(p.x, p.y)]
}

/// Forgives a rounding beyond 1.
fn polite(x: f64) -> f64 {
    if x < 1.0 + 1e-6 { x.min(1.0) } else { x }
}

/// (1 − cos) over that of the rim, and the angle: the density becomes 1/2π whatever the cone.
fn in_cone(sample: impl Fn([f32; 2]) -> glam::Vec3, half_angle: f64) -> impl Fn([f32; 2]) -> [f64; 2] {
    // 1 − cos θ = 2 sin²(θ/2)
    let half_sine = libm::sin(0.5 * half_angle);
    let rim = 2.0 * half_sine * half_sine;
    move |u| {
        let d = sample(u).as_dvec3();
        [polite(one_minus_cos(d) / rim), angle(d.x, d.y)]
    }
}

fn rim(half_angle: f64) -> f32 {
    let half_sine = libm::sin(0.5 * half_angle);
    (2.0 * half_sine * half_sine) as f32
}

/// Coordinates of a point of a triangle in which area is area: (b₁ + b₂)², and how far along from the second corner to
/// the third. The density 2 becomes 1.
fn on_triangle([b1, b2]: [f32; 2]) -> [f64; 2] {
    let (b1, b2) = (f64::from(b1), f64::from(b2));
    let sum = b1 + b2;
    [polite(sum * sum), if sum > 0.0 { b2 / sum } else { 0.0 }]
}

fn counts(case: usize, grid: &Grid, sample: impl Fn([f32; 2]) -> [f64; 2]) -> Vec<u64> {
    let mut stream = stream(case);
    grid.count((0..SAMPLES).map(|_| sample(stream.next_pair())))
}

#[test]
fn points_of_the_disk_are_uniform() {
    let grid = Grid::around([0.0, 1.0]);
    FAMILY.follows("disk", &counts(1, &grid, on_disk), &grid.simpson(2, uniform), SEES);
    // A radius that is not square-rooted, half of it.
    let bunched = |u: [f32; 2]| {
        let [r2, phi] = on_disk(u);
        [libm::pow(r2, 1.02), phi]
    };
    FAMILY.refuses(
        "disk bunched by 2 %",
        &counts(1, &grid, bunched),
        &grid.simpson(2, uniform),
    );
}

#[test]
fn directions_of_the_hemisphere_follow_the_cosine() {
    let grid = Grid::around([0.0, 1.0]);
    let counts = counts(2, &grid, |u| height_and_angle(warp::cosine_hemisphere(u)));
    let density = |z: f64, _| f64::from(warp::cosine_hemisphere_density(z as f32));
    let probabilities = grid.simpson(4, density);
    assert!((probabilities.iter().sum::<f64>() - 1.0).abs() < 1e-6);
    FAMILY.follows("cosine hemisphere", &counts, &probabilities, SEES);
    FAMILY.refuses("the cosine forgotten", &counts, &grid.simpson(4, uniform));
}

#[test]
fn directions_of_the_sphere_are_uniform() {
    let grid = Grid::around([-1.0, 1.0]);
    let density = |_, _| 0.5 / TAU;
    let sphere = |u| height_and_angle(warp::uniform_sphere(u));
    FAMILY.follows("sphere", &counts(3, &grid, sphere), &grid.simpson(2, density), SEES);
    // The polar angle uniform instead of the height: too dense at the poles.
    let bunched = |[u, v]: [f32; 2]| [libm::cos(PI * f64::from(u)), TAU * f64::from(v)];
    FAMILY.refuses(
        "sphere bunched at the poles",
        &counts(3, &grid, bunched),
        &grid.simpson(2, density),
    );
}

#[test]
fn directions_of_cones_are_uniform() {
    let grid = Grid::around([0.0, 1.0]);
    let probabilities = grid.simpson(2, uniform);
    for (i, half_angle) in HALF_ANGLES.into_iter().enumerate() {
        let cone = |scale: f32| {
            let sample = in_cone(move |u| warp::uniform_cone(u, scale * rim(half_angle)), half_angle);
            counts(4 + i, &grid, sample)
        };
        let name = format!("cone of {half_angle:.3} rad");
        FAMILY.follows(&name, &cone(1.0), &probabilities, SEES);
        FAMILY.refuses(&format!("{name}, 2 % too narrow"), &cone(0.98), &probabilities);
        FAMILY.refuses(&format!("{name}, 2 % too wide"), &cone(1.02), &probabilities);
    }
}

#[test]
fn points_of_the_triangle_are_uniform() {
    let grid = Grid::unit_square();
    let probabilities = grid.simpson(2, |_, _| 1.0);
    let sampled = counts(20, &grid, |u| on_triangle(warp::triangle(u)));
    FAMILY.follows("triangle", &sampled, &probabilities, SEES);
    // The second weight scaled into what the first leaves: too dense near the second corner.
    let bunched = |[u, v]: [f32; 2]| on_triangle([u, v * (1.0 - u)]);
    FAMILY.refuses("triangle bunched", &counts(20, &grid, bunched), &probabilities);
}
