//! Environments from pictures: which way they are hung, what stands between texels, and what is refused.

use chainlight::color::Rgb;
use chainlight::geometry::BoundingSphere;
use chainlight::light::{Image, ImageError, Light, LightTable};
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

fn environment(width: usize, height: usize, up: DVec3, rotate: f32) -> LightTable {
    let texels = (0..width * height).map(|i| texel(i % width, i / width)).collect();
    let image = Image::new((width, height), texels, up, rotate).expect("an environment");
    LightTable::with_lights(
        Vec::new(),
        vec![Light::Image(Arc::new(image))],
        BoundingSphere::default(),
    )
}

/// Tells columns and rows.
fn texel(column: usize, row: usize) -> Rgb {
    Rgb::new(1.0 + column as f32, 1.0 + row as f32, 1.0)
}

fn seen(table: &LightTable, to: Vec3) -> Rgb {
    table.radiance(0, -to, -to)
}

/// The direction of a place in the picture, in columns and rows, as the manual says.
fn place(width: usize, height: usize, column: f64, row: f64) -> Vec3 {
    let (around, down) = (TAU * column / width as f64, PI * row / height as f64);
    let r = libm::sin(down);
    DVec3::new(libm::sin(around) * r, libm::cos(down), -libm::cos(around) * r).as_vec3()
}

fn near(a: Rgb, b: Rgb) -> bool {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    pairs.into_iter().all(|(a, b)| (a - b).abs() < 2e-4)
}

#[test]
fn texels_stand_where_the_manual_says() {
    let (width, height) = (8, 4);
    let table = environment(width, height, DVec3::Y, 0.0);
    for row in 0..height {
        for column in 0..width {
            let to = place(width, height, column as f64 + 0.5, row as f64 + 0.5);
            assert!(
                near(seen(&table, to), texel(column, row)),
                "{column} {row}: {:?}",
                seen(&table, to)
            );
        }
    }
    // The middle is +Z, a quarter from the left +X: between four columns of texels there.
    assert!(near(seen(&table, Vec3::Z), Rgb::new(4.5, 2.5, 1.0)));
    assert!(near(seen(&table, Vec3::X), Rgb::new(2.5, 2.5, 1.0)));
    // The seam joins the last column to the first.
    assert!(near(seen(&table, Vec3::NEG_Z), Rgb::new(4.5, 2.5, 1.0)));
}

#[test]
fn up_and_rotate_turn_the_light() {
    let plain = environment(8, 4, DVec3::Y, 0.0);
    let turned = environment(8, 4, DVec3::Y, 90.0);
    // Counter-clockwise seen from +Y: what was at +Z is at +X now.
    let to = Vec3::new(0.1, 0.3, 0.9).normalize();
    let moved = Vec3::new(to.z, to.y, -to.x);
    assert!(near(seen(&plain, to), seen(&turned, moved)));
    for up in [DVec3::Z, DVec3::NEG_Y, DVec3::new(2.0, -1.0, 0.5)] {
        let tilted = environment(8, 4, up, 0.0);
        let row = |to: DVec3| seen(&tilted, to.normalize().as_vec3()).g;
        assert!((row(up) - 1.0).abs() < 1e-6 && (row(-up) - 4.0).abs() < 1e-6, "{up}");
        assert!((row(up.any_orthogonal_vector()) - 2.5).abs() < 1e-5, "{up}");
    }
}

#[test]
fn light_is_continuous_across_rows_columns_and_the_seam() {
    let table = environment(8, 4, DVec3::Y, 0.0);
    let mut previous = seen(&table, place(8, 4, 0.0, 1.3));
    for step in 1..=8000 {
        let next = seen(&table, place(8, 4, f64::from(step) / 1000.0, 1.3));
        // At the seam it falls by seven within a column.
        assert!((next.r - previous.r).abs() < 0.008, "{step}: {previous:?} {next:?}");
        previous = next;
    }
    let mut previous = seen(&table, place(8, 4, 2.2, 0.0));
    for step in 1..=4000 {
        let next = seen(&table, place(8, 4, 2.2, f64::from(step) / 1000.0));
        assert!((next.g - previous.g).abs() < 0.003, "{step}: {previous:?} {next:?}");
        previous = next;
    }
}

#[test]
fn densities_are_finite_at_poles_and_seam() {
    let table = environment(16, 8, DVec3::Y, 0.0);
    let tiny = f32::MIN_POSITIVE;
    for to in [
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::new(tiny, 1.0, 0.0),
        Vec3::new(-tiny, -1.0, tiny),
        Vec3::NEG_Z,
        Vec3::new(-tiny, 0.0, -1.0),
        Vec3::new(tiny, 0.0, -1.0),
        Vec3::new(-0.0, 0.0, -1.0),
    ] {
        let density = table.density(0, Vec3::ZERO, Vec3::ZERO, -to);
        let radiance = seen(&table, to);
        assert!(
            density > 0.0 && density.is_finite() && radiance.is_finite(),
            "{to}: {density}"
        );
    }
}

#[test]
fn pictures_that_are_no_radiance_are_refused() {
    let with = |bad: Rgb| {
        let mut texels = vec![Rgb::ONE; 12];
        texels[7] = bad;
        Image::new((4, 3), texels, DVec3::Y, 0.0).map(|_| ())
    };
    for bad in [
        Rgb::new(f32::NAN, 1.0, 1.0),
        Rgb::new(1.0, -1e-9, 1.0),
        Rgb::new(1.0, 1.0, f32::INFINITY),
    ] {
        let error = with(bad).expect_err("no radiance");
        assert!(matches!(error, ImageError::Texel { column: 3, row: 1, .. }), "{error}");
    }
    let sizes = Image::new((4, 3), vec![Rgb::ONE; 11], DVec3::Y, 0.0);
    assert!(matches!(sizes, Err(ImageError::Size { found: 11, .. })));
    assert!(matches!(
        Image::new((0, 0), Vec::new(), DVec3::Y, 0.0),
        Err(ImageError::Size { .. })
    ));
}

#[test]
fn a_black_picture_sends_no_light() {
    let image = Image::new((4, 2), vec![Rgb::BLACK; 8], DVec3::Y, 0.0).expect("an environment");
    let lights = vec![Light::Image(Arc::new(image))];
    let table = LightTable::with_lights(Vec::new(), lights, BoundingSphere::default());
    assert!(table.is_empty());
    assert_eq!(table.sample(Vec3::ZERO, 0.5, [0.5; 2]), None);
    assert_eq!(table.emit(0.5, [0.5; 2], [0.5; 2]), None);
    assert_eq!(table.len(), 1);
}
