//! Several lights of unequal power: which is chosen, and the density of directions over all of them together.

use super::emitters::{sphere_light, triangle_light};
use crate::support::cells::{Grid, direction, height_and_angle};
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::light::{Emitter, EmitterShape, LightTable};
use glam::{DVec3, Vec3};

const SAMPLES: usize = 1_000_000;
/// Choices; directions.
const FAMILY: Family = Family { tests: 2 };
const FROM: Vec3 = Vec3::new(0.1, -0.2, 0.3);

/// Two triangles and two spheres about the reference point, and a triangle that shows its back. Each is told by its
/// radiance. One sphere is behind another: what is in between is not the sampler's business.
fn emitters() -> Vec<Emitter> {
    let gray = Rgb::splat;
    vec![
        triangle_light(
            [
                Vec3::new(-2.0, -2.0, 2.0),
                Vec3::new(0.0, 2.0, 2.5),
                Vec3::new(2.5, -1.0, 2.0),
            ],
            gray(1.0),
        ),
        triangle_light(
            [
                Vec3::new(-2.0, -2.0, -1.0),
                Vec3::new(-2.0, 2.0, -1.0),
                Vec3::new(-2.0, 0.0, 2.0),
            ],
            gray(2.0),
        ),
        sphere_light(Vec3::new(3.0, 1.0, -1.0), 1.5, gray(0.5)),
        sphere_light(Vec3::new(6.0, 1.0, -2.0), 1.5, gray(0.25)),
        triangle_light(
            [
                Vec3::new(0.0, -3.0, 1.0),
                Vec3::new(-2.0, -3.0, -1.0),
                Vec3::new(0.0, -3.0, -1.0),
            ],
            gray(3.0),
        ),
    ]
}

/// Where a direction meets an emitter, with the normal there.
fn meet(emitter: &Emitter, d: DVec3) -> Option<(Vec3, Vec3)> {
    let from = FROM.as_dvec3();
    match emitter.shape {
        EmitterShape::Triangle(corners) => {
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            let normal = (b - a).cross(c - a);
            let t = normal.dot(a - from) / normal.dot(d);
            let p = from + d * t;
            let inside = |p0: DVec3, p1: DVec3| (p1 - p0).cross(p - p0).dot(normal) > 0.0;
            (t > 0.0 && inside(a, b) && inside(b, c) && inside(c, a))
                .then(|| (p.as_vec3(), normal.normalize().as_vec3()))
        }
        EmitterShape::Sphere { center, radius } => {
            let to = center.as_dvec3() - from;
            let along = to.dot(d);
            let off = to.length_squared() - along * along;
            let half2 = f64::from(radius) * f64::from(radius) - off;
            (half2 > 0.0 && along > 0.0).then(|| {
                let normal = (d * (along - half2.sqrt()) - to).normalize();
                ((from + d * (along - half2.sqrt())).as_vec3(), normal.as_vec3())
            })
        }
        EmitterShape::Disk { .. } | EmitterShape::Cylinder { .. } => None,
    }
}

#[test]
fn lights_are_chosen_in_proportion_to_power() {
    let emitters = emitters();
    let table = LightTable::new(emitters.clone());
    let power = |e: &Emitter| f64::from(e.area) * f64::from(e.radiance.g);
    let total: f64 = emitters.iter().map(power).sum();
    let probabilities: Vec<f64> = emitters.iter().map(|e| power(e) / total).collect();
    let mut stream = stream(600);
    let mut counts = [0_u64; 5];
    for _ in 0..SAMPLES {
        let choice = stream.next_f64();
        let sample = table.sample(FROM, choice, stream.next_pair());
        // The last light shows its back: chosen, and nothing comes of it.
        let which = sample.map_or(Some(4), |s| emitters.iter().position(|e| e.radiance == s.radiance));
        counts[which.expect("the radiance of one of them")] += 1;
    }
    FAMILY.follows("choice of light", &counts, &probabilities, 0.008);
    let mut off = probabilities.clone();
    off[0] *= 1.03;
    FAMILY.refuses("one light off by 3 %", &counts, &off);
}

#[test]
fn directions_to_several_lights_follow_their_combined_density() {
    let emitters = emitters();
    let table = LightTable::new(emitters.clone());
    let grid = Grid::around([-1.0, 1.0]);
    let combined = |weight: &dyn Fn(usize) -> f64| {
        grid.midpoint(64, |z, phi| {
            let d = direction(z, phi);
            let lights = emitters.iter().enumerate();
            let densities = lights.filter_map(|(i, emitter)| {
                let (position, normal) = meet(emitter, d)?;
                Some(weight(i) * f64::from(table.density(i as u32, FROM, position, normal)))
            });
            densities.sum::<f64>()
        })
    };
    let mut probabilities = combined(&|_| 1.0);
    let power = |e: &Emitter| f64::from(e.area) * f64::from(e.radiance.g);
    let total: f64 = emitters.iter().map(power).sum();
    // What faces away is chosen too; nothing comes of it.
    let nothing = power(&emitters[4]) / total;
    let sum: f64 = probabilities.iter().sum();
    assert!((sum + nothing - 1.0).abs() < 2e-3, "{sum} {nothing}");
    let mut stream = stream(601);
    let mut counts = vec![0_u64; grid.len() + 1];
    let mut none = 0;
    for _ in 0..SAMPLES {
        let choice = stream.next_f64();
        match table.sample(FROM, choice, stream.next_pair()) {
            Some(sample) => counts[grid.cell(height_and_angle(sample.direction))] += 1,
            None => none += 1,
        }
    }
    counts.push(none);
    let with_nothing = |mut p: Vec<f64>| {
        p.extend([0.0, nothing]);
        p
    };
    // A cell that a light barely touches is missed by the midpoints: it is given a sliver.
    probabilities.iter_mut().for_each(|p| *p = p.max(1e-9));
    FAMILY.follows(
        "directions to five lights",
        &counts,
        &with_nothing(probabilities),
        0.016,
    );
    // As if all lights were as likely as the first.
    let mut off = combined(&|i| power(&emitters[0]) / power(&emitters[i]));
    off.iter_mut().for_each(|p| *p = p.max(1e-9));
    FAMILY.refuses("powers forgotten", &counts, &with_nothing(off));
}

/// A light so weak beside the others that its probability vanishes is not sampled: it would bring 0/0.
#[test]
fn a_sample_never_has_density_zero() {
    let faint = triangle_light([Vec3::ZERO, Vec3::X, Vec3::Y], Rgb::splat(1e-38));
    let strong = sphere_light(Vec3::new(0.0, 0.0, 20.0), 9.0, Rgb::splat(1e6));
    let table = LightTable::new(vec![faint, strong]);
    for choice in [0.0, 0.5] {
        let sample = table.sample(Vec3::new(100.0, 100.0, 100.0), choice, [0.3, 0.4]);
        assert!(sample.is_none_or(|s| s.density > 0.0), "{choice}: {sample:?}");
    }
}
