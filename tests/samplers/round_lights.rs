//! Directions to disks and tubes against the density that their table states: a million samples per place in 20 x 20 cells of
//! the emitter's area, the density integrated over the solid angle of each.

use super::emission::{axes, place};
use super::emitters::{cylinder_light, disk_light};
use crate::support::cells::Grid;
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::light::{Emitter, EmitterShape, LightTable};
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

const SAMPLES: usize = 1_000_000;
const FAMILY: Family = Family { tests: 6 };
const SEES: f64 = 0.02;

fn cases() -> Vec<(&'static str, Emitter, Vec3)> {
    let aslant = Vec3::new(0.6, 0.0, 0.8);
    let disk = disk_light(Vec3::new(3.0, -2.0, 1.0), aslant, 0.5, Rgb::ONE);
    let tiny = disk_light(Vec3::new(3e2, -2e2, 1e2), Vec3::Z, 0.25, Rgb::ONE);
    let tube = cylinder_light(Vec3::X, Vec3::new(2.0, 1.0, 3.0), 0.5, Rgb::ONE);
    let needle = cylinder_light(Vec3::ZERO, Vec3::new(0.0, 4.0, 0.0), 0.01, Rgb::ONE);
    vec![
        ("disk ahead", disk, Vec3::new(4.0, -2.0, 3.0)),
        ("disk grazing", disk, Vec3::new(-2.0, -2.0, 4.77)),
        ("disk far from the origin", tiny, Vec3::new(301.0, -200.0, 100.5)),
        ("tube aside", tube, Vec3::new(4.0, -3.0, 2.0)),
        ("tube from its end", tube, Vec3::new(4.0, 0.4, 5.0)),
        ("needle", needle, Vec3::new(1.0, 2.0, -0.5)),
    ]
}

/// The point at coordinates, and the normal there.
fn point(shape: EmitterShape, [x, y]: [f64; 2]) -> (DVec3, DVec3) {
    let around = DVec3::new(libm::cos(TAU * y), libm::sin(TAU * y), 0.0);
    match shape {
        EmitterShape::Disk { center, normal, radius } => {
            let world = axes(normal.as_dvec3()).transpose();
            (
                center.as_dvec3() + world * (around * x.sqrt() * f64::from(radius)),
                normal.as_dvec3(),
            )
        }
        EmitterShape::Cylinder { from, to, radius } => {
            let axis = to.as_dvec3() - from.as_dvec3();
            let normal = axes(axis.normalize()).transpose() * around;
            (from.as_dvec3() + axis * x + normal * f64::from(radius), normal)
        }
        EmitterShape::Triangle(_) | EmitterShape::Sphere { .. } => unreachable!("disks and tubes"),
    }
}

#[test]
fn directions_to_disks_and_tubes_follow_the_stated_density() {
    let grid = Grid::unit_square();
    for (case, (name, emitter, from)) in cases().into_iter().enumerate() {
        let table = LightTable::new(vec![emitter]);
        let per_area = |x: f64, y: f64, weigh: &dyn Fn(f64) -> f64| {
            let (position, normal) = point(emitter.shape, [x, y]);
            let to = from.as_dvec3() - position;
            let cosine = normal.dot(to) / to.length();
            if cosine <= 0.0 {
                return 0.0;
            }
            let density = f64::from(table.density(0, from, position.as_vec3(), normal.as_vec3()));
            density * cosine / to.length_squared() * f64::from(emitter.area) * weigh(cosine)
        };
        let probabilities = |weigh: &dyn Fn(f64) -> f64| {
            let mut all = grid.midpoint(64, |x, y| per_area(x, y, weigh));
            // Those that look away are drawn too, and nothing comes of them.
            all.iter_mut().for_each(|p| *p = p.max(1e-12));
            let seen: f64 = all.iter().sum();
            all.extend([0.0, (1.0 - seen).max(1e-12)]);
            all
        };
        let mut stream = stream(650 + case);
        let mut counts = vec![0_u64; grid.len() + 2];
        for _ in 0..SAMPLES {
            let choice = stream.next_f64();
            let Some(sample) = table.sample(from, choice, stream.next_pair()) else {
                counts[grid.len() + 1] += 1;
                continue;
            };
            counts[grid.cell(place(emitter.shape, sample.position))] += 1;
            let stated = table.density(0, from, sample.position, sample.normal);
            assert_eq!(sample.density, stated, "{name}");
            assert!((sample.target - sample.position).dot(sample.normal) > 0.0, "{name}");
        }
        let expected = probabilities(&|_| 1.0);
        assert!(expected.iter().sum::<f64>() < 1.0 + 1e-3, "{name}");
        FAMILY.follows(name, &counts, &expected, SEES);
        if name != "disk far from the origin" {
            FAMILY.refuses(
                &format!("{name}, cosine forgotten"),
                &counts,
                &probabilities(&|cosine| cosine),
            );
        }
    }
}
