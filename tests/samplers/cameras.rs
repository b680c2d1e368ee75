//! Rays of cameras against the density that the cameras state, and lens points against the disk: a million samples each in
//! 20 x 20 cells. Directions from one lens point are counted by where they cross the focal plane, in coordinates of the
//! test's own; the density is per solid angle.

use crate::support::cells::{Grid, angle};
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::camera::Camera;
use chainlight::scene::{CameraDescription, FovAxis};
use glam::{DVec3, Vec2, Vec3};
use std::f64::consts::TAU;

const SAMPLES: usize = 1_000_000;
/// Angles of view of pinholes, lenses, and the lens itself.
const FAMILY: Family = Family { tests: 3 + 2 + 1 };
const SEES: f64 = 0.016;
const SIZE: (u32, u32) = (200, 100);
const ORIGIN: Vec3 = Vec3::new(0.3, -0.2, 0.5);
const RADIUS: f32 = 0.4;

/// Cameras look along -x with +z up, so that the film's right is +y.
fn camera(fov: f32, focus_distance: Option<f32>) -> Camera {
    let (origin, target) = (ORIGIN.to_array(), (ORIGIN - Vec3::X).to_array());
    let (up, fov_axis) = ([0.0, 0.0, 2.0], FovAxis::Vertical);
    let description = match focus_distance {
        None => CameraDescription::Perspective {
            origin,
            target,
            up,
            fov,
            fov_axis,
        },
        Some(_) => CameraDescription::ThinLens {
            origin,
            target,
            up,
            fov,
            fov_axis,
            aperture_radius: RADIUS,
            focus_distance,
        },
    };
    Camera::new(&description, SIZE.0, SIZE.1)
}

#[test]
fn directions_follow_the_density_that_cameras_state() {
    let grid = Grid::unit_square();
    let cases = [
        ("narrow", 5.0, None),
        ("usual", 60.0, None),
        ("wide", 150.0, None),
        ("lens", 60.0, Some(2.0)),
        ("near lens", 60.0, Some(0.3)),
    ];
    for (case, (name, fov, focus_distance)) in cases.into_iter().enumerate() {
        let camera = camera(fov, focus_distance);
        let mut stream = stream(720 + case);
        // All directions from one point of the lens, near its rim.
        let lens = [0.9, 0.2];
        let from = camera.lens_point(lens).as_dvec3() - ORIGIN.as_dvec3();
        let focus = f64::from(focus_distance.unwrap_or(1.0));
        let half = focus * libm::tan(0.5 * f64::from(fov).to_radians());
        // From a direction to where it crosses the film's image on the focal plane.
        let crossing = |direction: Vec3| {
            let d = direction.as_dvec3();
            let at = from + d * ((-focus - from.x) / d.x);
            let polite = |x: f64| {
                if (-1e-4..1.0001).contains(&x) {
                    x.clamp(0.0, 1.0)
                } else {
                    x
                }
            };
            [polite(0.5 + 0.25 * at.y / half), polite(0.5 + 0.5 * at.z / half)]
        };
        // And back, with the solid angle of a unit of the square.
        let seen = |x: f64, y: f64| {
            let at = DVec3::new(-focus, (x - 0.5) * 4.0 * half, (y - 0.5) * 2.0 * half) - from;
            let distance = at.length();
            let cosine = -at.x / distance;
            (
                (at / distance).as_vec3(),
                cosine,
                8.0 * half * half * cosine / (distance * distance),
            )
        };
        let stated = |x: f64, y: f64| {
            let (direction, _, solid_angle) = seen(x, y);
            f64::from(camera.density(direction)) * solid_angle
        };
        let probabilities = grid.simpson(4, stated);
        let total: f64 = probabilities.iter().sum();
        assert!((total - 1.0).abs() < 1e-5, "{name}: {total}");
        let film = |u: [f32; 2]| Vec2::new(u[0] * SIZE.0 as f32, u[1] * SIZE.1 as f32);
        let counts = grid.count((0..SAMPLES).map(|_| crossing(camera.ray(film(stream.next_pair()), lens).direction)));
        FAMILY.follows(name, &counts, &probabilities, SEES);
        // Per area of a plane at a right angle to the direction; over a narrow film a cosine is nearly constant.
        if fov > 10.0 {
            let forgotten = grid.simpson(4, |x, y| {
                let (_, cosine, _) = seen(x, y);
                stated(x, y) * cosine
            });
            let all: f64 = forgotten.iter().sum();
            let forgotten: Vec<f64> = forgotten.into_iter().map(|p| p / all).collect();
            FAMILY.refuses(&format!("{name}, a cosine too many"), &counts, &forgotten);
        }
    }
}

#[test]
fn points_of_the_lens_are_uniform() {
    let grid = Grid::around([0.0, 1.0]);
    let camera = camera(60.0, Some(2.0));
    let on_lens = |u: [f32; 2]| {
        let p = (camera.lens_point(u) - ORIGIN).as_dvec3() / f64::from(RADIUS);
        assert!(p.x.abs() < 1e-6, "{p} is off the lens");
        let r2 = p.y * p.y + p.z * p.z;
        [if r2 < 1.0 + 1e-5 { r2.min(1.0) } else { r2 }, angle(p.y, p.z)]
    };
    let mut numbers = stream(730);
    let counts = grid.count((0..SAMPLES).map(|_| on_lens(numbers.next_pair())));
    let probabilities = grid.simpson(2, |_, _| 1.0 / TAU);
    FAMILY.follows("lens", &counts, &probabilities, SEES);
    let mut numbers = stream(730);
    let bunched = grid.count((0..SAMPLES).map(|_| {
        let [r2, phi] = on_lens(numbers.next_pair());
        [libm::pow(r2, 1.02), phi]
    }));
    FAMILY.refuses("lens bunched by 2 %", &bunched, &probabilities);
}
