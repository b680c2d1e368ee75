//! Where light counts that arrives somewhere on the film: what pixels give to places by their filters, and what places give to
//! pixels, are one and the same.

use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::path::{film_position, pixel_of};
use chainlight::sampling::StreamKey;
use chainlight::scene::{Format, Scene, SceneOverrides, flatten, parse_scene};
use glam::Vec2;
use proptest::prelude::*;
use std::path::Path;

/// Not square, so that rows are not taken for columns.
const WIDTH: u32 = 5;
const HEIGHT: u32 = 3;
const FILTERS: [&str; 6] = [
    "Box(radius: 0.5)",
    "Box(radius: 1.3)",
    "Tent(radius: 0.7)",
    "Tent(radius: 1.0)",
    "Tent(radius: 2.6)",
    "Gaussian(radius: 1.5, sigma: 0.5)",
];
/// The largest uniform number below 1.
const LAST: f32 = 1.0 - 1.0 / 16_777_216.0;

fn scene(filter: &str) -> Scene {
    let text = format!(
        r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
        film: (width: {WIDTH}, height: {HEIGHT}, filter: {filter}), materials: {{"m": Diffuse(reflectance: (1, 1, 1))}},
        shapes: [(shape: Sphere(center: (0, 0, 0), radius: 1), material: "m")])"#
    );
    let source = parse_scene("film.ron", &text, Format::Ron, Path::new("")).unwrap_or_else(|e| panic!("{}", e.plain()));
    let flattened = flatten(&source).unwrap_or_else(|e| panic!("{}", e.plain()));
    Scene::compile(&source.description, &flattened, SceneOverrides::default()).expect("a valid filter")
}

fn center(pixel: u32) -> Vec2 {
    Vec2::new((pixel % WIDTH) as f32 + 0.5, (pixel / WIDTH) as f32 + 0.5)
}

fn share(scene: &Scene, film: Vec2, pixel: u32) -> f32 {
    scene.filter.density((film - center(pixel)).to_array())
}

/// A filter reaches this far beyond the film, in whole pixels.
const MARGIN: i32 = 3;
/// Cells along each side of a pixel.
const FINE: i32 = 4;
/// Points of a quadrature along each side of a cell.
const POINTS: i32 = 24;

/// Cells of the film and its margin, one row after another.
fn cells() -> usize {
    ((WIDTH as i32 + 2 * MARGIN) * (HEIGHT as i32 + 2 * MARGIN) * FINE * FINE) as usize
}

fn cell(film: Vec2) -> usize {
    let [x, y] = film
        .to_array()
        .map(|x| ((x + MARGIN as f32) * FINE as f32).floor() as usize);
    y * ((WIDTH as i32 + 2 * MARGIN) * FINE) as usize + x
}

/// The chance that a sample of some pixel lies in each cell, as [`pixel_of`] has it; where it is not told of what lies beyond the
/// edges, the mistake of a film whose edges are too dark.
fn chances(scene: &Scene, beyond: bool) -> Vec<f64> {
    let mut chances = vec![0.0; cells()];
    let step = 1.0 / (FINE * POINTS) as f32;
    let along = |pixels: u32| {
        (0..(pixels as i32 + 2 * MARGIN) * FINE * POINTS).map(move |i| (i as f32 + 0.5) * step - MARGIN as f32)
    };
    for y in along(HEIGHT) {
        for x in along(WIDTH) {
            let film = Vec2::new(x, y);
            let inside = (0.0..WIDTH as f32).contains(&x) && (0.0..HEIGHT as f32).contains(&y);
            if let Some((_, sum)) = pixel_of(scene, film, 0.5)
                && (inside || beyond)
            {
                chances[cell(film)] += f64::from(sum) * f64::from(step * step) / f64::from(WIDTH * HEIGHT);
            }
        }
    }
    // What the quadrature leaves.
    let total: f64 = chances.iter().sum();
    chances.iter().map(|chance| chance / total).collect()
}

#[test]
fn places_take_from_pixels_what_pixels_give_to_places() {
    let family = Family { tests: FILTERS.len() };
    for (case, filter) in FILTERS.into_iter().enumerate() {
        let scene = scene(filter);
        let mut counts = vec![0_u64; cells()];
        const SAMPLES: u32 = 40_000;
        for sample in 0..SAMPLES {
            for pixel in 0..WIDTH * HEIGHT {
                let film = film_position(&scene, StreamKey::new(case as u64, pixel, u64::from(sample)), pixel);
                counts[cell(film)] += 1;
            }
        }
        let chances = chances(&scene, true);
        family.follows(filter, &counts, &chances, 0.05);
        if scene.filter.radius() > 0.5 {
            family.refuses(filter, &counts, &self::chances(&scene, false));
        }
    }
}

#[test]
fn light_is_shared_in_proportion_to_filters() {
    const DRAWS: u32 = 8192;
    let mut stream = stream(2);
    for filter in FILTERS {
        let scene = scene(filter);
        for _ in 0..60 {
            let [x, y] = stream.next_pair();
            let film = Vec2::new(x * 9.0 - 2.0, y * 7.0 - 2.0);
            let mut given = vec![0.0; (WIDTH * HEIGHT) as usize];
            for draw in 0..DRAWS {
                if let Some((pixel, sum)) = pixel_of(&scene, film, (draw as f32 + 0.5) / DRAWS as f32) {
                    given[pixel as usize] += sum / DRAWS as f32;
                }
            }
            for pixel in 0..WIDTH * HEIGHT {
                let (given, expected) = (given[pixel as usize], share(&scene, film, pixel));
                // Of one pixel the numbers are a range: no more than one draw too many or too few at each end.
                let slack = 1e-3 * (1.0 + expected);
                assert!(
                    (given - expected).abs() < slack,
                    "{filter}, {film}, {pixel}: {given} {expected}"
                );
            }
        }
    }
}

#[test]
fn places_between_pixels_belong_to_one_of_them() {
    let scene = scene("Box(radius: 0.5)");
    let at = |x: f32, y: f32| pixel_of(&scene, Vec2::new(x, y), 0.0);
    let (right, bottom) = (WIDTH as f32, HEIGHT as f32);
    assert_eq!(at(0.0, 0.0), Some((0, 1.0)));
    assert_eq!(at(2.0, 0.5), Some((2, 1.0)));
    assert_eq!(at(2.0_f32.next_down(), 0.5), Some((1, 1.0)));
    assert_eq!(at(0.5, 1.0), Some((WIDTH, 1.0)));
    assert_eq!(
        at(right.next_down(), bottom.next_down()),
        Some((WIDTH * HEIGHT - 1, 1.0))
    );
    for (x, y) in [(right, 0.5), (0.5, bottom), (-1e-6, 0.5), (0.5, -1e-6)] {
        assert_eq!(at(x, y), None, "({x}, {y})");
    }
}

#[test]
fn places_far_away_belong_to_none() {
    for filter in FILTERS {
        let scene = scene(filter);
        for far in [4.0, 1e3, 1e9, 5e9, f32::MAX, f32::INFINITY] {
            for film in [
                Vec2::new(-far, 1.0),
                Vec2::new(WIDTH as f32 + far, 1.0),
                Vec2::new(1.0, -far),
                Vec2::new(1.0, HEIGHT as f32 + far),
            ] {
                assert_eq!(pixel_of(&scene, film, 0.5), None, "{filter}, {film}");
            }
        }
        for nowhere in [Vec2::NAN, Vec2::new(1.0, f32::NAN)] {
            assert_eq!(pixel_of(&scene, nowhere, 0.5), None, "{filter}");
        }
    }
}

proptest! {
    #[test]
    fn the_pixel_is_on_the_film_and_its_filter_reaches(
        filter in 0..FILTERS.len(), x in -3.0_f32..8.0, y in -3.0_f32..6.0, u in prop_oneof![Just(0.0), Just(LAST), 0.0..LAST]
    ) {
        let scene = scene(FILTERS[filter]);
        let film = Vec2::new(x, y);
        let total: f32 = (0..WIDTH * HEIGHT).map(|pixel| share(&scene, film, pixel)).sum();
        match pixel_of(&scene, film, u) {
            Some((pixel, sum)) => {
                prop_assert!(pixel < WIDTH * HEIGHT);
                prop_assert!(share(&scene, film, pixel) > 0.0);
                prop_assert!((sum - total).abs() <= 1e-5 * total, "{} {}", sum, total);
            }
            None => prop_assert!(total == 0.0, "{} at {}", total, film),
        }
    }
}
