//! Directions to a single light against the density that its table states: a million samples per place in 20 x 20 cells,
//! the density integrated over the solid angle of each. Cells lie on the emitter as the reference point sees it: by area
//! on a triangle, by solid angle on a sphere.

use super::emitters::{SPHERES, SeenTriangle, TRIANGLES, sphere_light, triangle_light};
use crate::support::cells::{Grid, angle, direction, one_minus_cos};
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::light::{LightSample, LightTable};
use glam::{DMat3, Vec3};
use std::f64::consts::PI;

const SAMPLES: usize = 1_000_000;
const FAMILY: Family = Family { tests: 14 };
const SEES: f64 = 0.016;

fn samples(case: usize, table: &LightTable, from: Vec3) -> impl Iterator<Item = LightSample> {
    let mut stream = stream(500 + case);
    (0..SAMPLES).filter_map(move |_| {
        let choice = stream.next_f64();
        table.sample(from, choice, stream.next_pair())
    })
}

#[test]
fn directions_to_triangles_follow_the_stated_density() {
    let grid = Grid::unit_square();
    for (case, (name, corners, from)) in TRIANGLES.into_iter().enumerate() {
        let table = LightTable::new(vec![triangle_light(corners, Rgb::ONE)]);
        let seen = SeenTriangle::new(corners, from);
        let normal = seen.normal.normalize().as_vec3();
        let probabilities = grid.simpson(2, |x, y| {
            let (point, solid_angle) = seen.point(x, y);
            f64::from(table.density(0, from, point, normal)) * solid_angle
        });
        let total: f64 = probabilities.iter().sum();
        assert!((total - 1.0).abs() < 1e-3, "{name}: {total}");
        let counts = grid.count(samples(case, &table, from).map(|s| seen.coordinates(s.direction)));
        assert_eq!(counts.iter().sum::<u64>() as usize, SAMPLES, "{name}");
        FAMILY.follows(name, &counts, &probabilities, SEES);
        // cos θ left out of the density. Far away it is a constant, which no count of directions shows.
        let forgotten = grid.simpson(2, |x, y| {
            let (point, solid_angle) = seen.point(x, y);
            let to = (from - point).as_dvec3();
            let cosine = normal.as_dvec3().dot(to) / to.length();
            f64::from(table.density(0, from, point, normal)) * solid_angle * cosine
        });
        if name == "triangle far" {
            assert!(forgotten.iter().sum::<f64>() < 0.9);
        } else {
            FAMILY.refuses(&format!("{name}, cosine forgotten"), &counts, &forgotten);
        }
    }
}

#[test]
fn directions_to_spheres_follow_the_stated_density() {
    let grid = Grid::around([0.0, 1.0]);
    for (case, (name, center, radius, from)) in SPHERES.into_iter().enumerate() {
        let table = LightTable::new(vec![sphere_light(center, radius, Rgb::ONE)]);
        let axis = center.as_dvec3() - from.as_dvec3();
        let sin2 = f64::from(radius) * f64::from(radius) / axis.length_squared();
        let rim = sin2 / (1.0 + (1.0 - sin2).sqrt());
        let (x, y) = axis.normalize().any_orthonormal_pair();
        let local = DMat3::from_cols(x, y, axis.normalize()).transpose();
        let density = f64::from(table.density(0, from, center, Vec3::Z)) * rim;
        let probabilities = grid.simpson(2, |_, _| density);
        let total: f64 = probabilities.iter().sum();
        assert!((total - 1.0).abs() < 1e-5, "{name}: {total}");
        let seen = |sample: LightSample| {
            let d = local * sample.direction.as_dvec3();
            let t = one_minus_cos(d) / rim;
            // The point on the sphere is rounded, which moves its direction about the rim.
            [if t < 1.02 { t.min(1.0) } else { t }, angle(d.x, d.y)]
        };
        let counts = grid.count(samples(20 + case, &table, from).map(seen));
        assert_eq!(counts.iter().sum::<u64>() as usize, SAMPLES, "{name}");
        FAMILY.follows(name, &counts, &probabilities, SEES);
        // Points uniform over the area that is seen, as if they were uniform in solid angle.
        let by_area = grid.simpson(2, |t, _| t / PI);
        FAMILY.refuses(&format!("{name}, by area"), &counts, &by_area);
    }
}

#[test]
fn samples_state_the_density_of_the_point_they_found() {
    for (case, (name, corners, from)) in TRIANGLES.into_iter().enumerate() {
        let table = LightTable::new(vec![triangle_light(corners, Rgb::ONE)]);
        let seen = SeenTriangle::new(corners, from);
        let normal = seen.normal.normalize();
        for sample in samples(case, &table, from).take(10_000) {
            let [x, y] = seen.coordinates(sample.direction);
            let (point, solid_angle) = seen.point(x, y);
            let stated = table.density(0, from, point, normal.as_vec3());
            assert!(
                (sample.density / stated - 1.0).abs() < 2e-3,
                "{name}: {sample:?} {stated}"
            );
            assert!((f64::from(sample.density) * solid_angle - 1.0).abs() < 2e-3, "{name}");
            let above = normal.dot(sample.target.as_dvec3() - seen.corner);
            assert!(above > 0.0, "{name}: the target is {above} above its light");
        }
    }
    for (case, (name, center, radius, from)) in SPHERES.into_iter().enumerate() {
        let table = LightTable::new(vec![sphere_light(center, radius, Rgb::ONE)]);
        for sample in samples(20 + case, &table, from).take(10_000) {
            assert_eq!(sample.density, table.density(0, from, sample.target, Vec3::Z), "{name}");
            let above = (sample.target.as_dvec3() - center.as_dvec3()).length() - f64::from(radius);
            assert!(above > 0.0, "{name}: the target is {above} above its light");
        }
    }
}

#[test]
fn nothing_is_sampled_from_behind_or_inside() {
    for (_, corners, from) in TRIANGLES {
        let [a, b, c] = corners;
        let table = LightTable::new(vec![triangle_light([a, c, b], Rgb::ONE)]);
        assert_eq!(samples(40, &table, from).next(), None);
        let normal = (c - a).cross(b - a).normalize();
        assert_eq!(table.density(0, from, a, normal), 0.0);
    }
    for (_, center, radius, _) in SPHERES {
        let table = LightTable::new(vec![sphere_light(center, radius, Rgb::ONE)]);
        for from in [center, center + direction(0.3, 1.0).as_vec3() * (0.99 * radius)] {
            assert_eq!(samples(41, &table, from).next(), None);
            assert_eq!(table.density(0, from, center, Vec3::Z), 0.0);
        }
    }
}
