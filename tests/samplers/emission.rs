//! Light sent into the scene by emitters against the densities that their table states: a million rays per emitter,
//! counted in 20 x 20 cells of place and direction together. Places have coordinates in which area is area, directions
//! those in which cos θ times solid angle is.

use super::emitters::{SPHERES, TRIANGLES, cylinder_light, disk_light, sphere_light, triangle_light};
use crate::support::cells::{Grid, angle};
use crate::support::draws::stream;
use crate::support::verdict::Family;
use chainlight::color::Rgb;
use chainlight::light::{Emitted, Emitter, EmitterShape, Endpoint, LightTable};
use chainlight::stats::z_test::Estimate;
use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

const SAMPLES: usize = 1_000_000;
/// Emitters, and three channels of a power.
const FAMILY: Family = Family { tests: 8 };
const SEES: f64 = 0.016;

fn emitters() -> Vec<(&'static str, Emitter)> {
    let (far, corners, _) = TRIANGLES[6];
    let (_, center, radius, _) = SPHERES[0];
    let aslant = Vec3::new(0.6, 0.0, 0.8);
    vec![
        ("unit triangle", triangle_light(TRIANGLES[0].1, Rgb::ONE)),
        (far, triangle_light(corners, Rgb::ONE)),
        ("sphere", sphere_light(center, radius, Rgb::ONE)),
        ("disk", disk_light(Vec3::new(3.0, -2.0, 1.0), aslant, 0.25, Rgb::ONE)),
        (
            "cylinder",
            cylinder_light(Vec3::X, Vec3::new(2.0, 1.0, 3.0), 0.5, Rgb::ONE),
        ),
    ]
}

fn emitted(case: usize, table: &LightTable) -> impl Iterator<Item = Emitted> {
    let mut stream = stream(700 + case);
    (0..SAMPLES).filter_map(move |_| {
        let choice = stream.next_f64();
        let point = stream.next_pair();
        table.emit(choice, point, stream.next_pair())
    })
}

/// Coordinates in the unit square of a point on an emitter, uniform where points are uniform in area.
pub fn place(shape: EmitterShape, position: Vec3) -> [f64; 2] {
    let p = position.as_dvec3();
    match shape {
        EmitterShape::Triangle(corners) => {
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            let (ab, ac) = (b - a, c - a);
            let normal = ab.cross(ac);
            let of = |v: DVec3| (v.dot(normal) / normal.length_squared()).clamp(0.0, 1.0);
            let (b1, b2) = (of((p - a).cross(ac)), of(ab.cross(p - a)));
            let sum = (b1 + b2).min(1.0);
            [sum * sum, if sum > 0.0 { (b2 / sum).min(1.0) } else { 0.0 }]
        }
        EmitterShape::Sphere { center, radius } => {
            let d = (p - center.as_dvec3()) / f64::from(radius);
            [(0.5 + 0.5 * d.z).clamp(0.0, 1.0), angle(d.x, d.y) / TAU]
        }
        EmitterShape::Disk { center, normal, radius } => {
            let d = axes(normal.as_dvec3()) * ((p - center.as_dvec3()) / f64::from(radius));
            let r2 = d.x * d.x + d.y * d.y;
            [if r2 < 1.0 + 1e-3 { r2.min(1.0) } else { r2 }, angle(d.x, d.y) / TAU]
        }
        EmitterShape::Cylinder { from, to, .. } => {
            let axis = to.as_dvec3() - from.as_dvec3();
            let d = p - from.as_dvec3();
            let t = d.dot(axis) / axis.length_squared();
            let round = axes(axis.normalize()) * d;
            [t.clamp(0.0, 1.0), angle(round.x, round.y) / TAU]
        }
    }
}

/// A rotation that takes `z` to the third axis.
pub fn axes(z: DVec3) -> DMat3 {
    let (x, y) = z.any_orthonormal_pair();
    DMat3::from_cols(x, y, z).transpose()
}

/// 5 x 4 cells of place and as many of direction, in one grid of 20 x 20.
fn cell_of(shape: EmitterShape, ray: &Emitted) -> [f64; 2] {
    let local = axes(ray.normal.as_dvec3().normalize()) * ray.direction.as_dvec3();
    let [x, y] = place(shape, ray.position);
    let direction = [(local.z * local.z).clamp(0.0, 1.0), angle(local.x, local.y) / TAU];
    let join = |a: f64, cells: f64, b: f64| ((a * cells).floor().min(cells - 1.0) + b.min(1.0 - 1e-12)) / cells;
    [join(x, 5.0, direction[0]), join(y, 4.0, direction[1])]
}

#[test]
fn rays_from_emitters_follow_the_stated_densities() {
    let grid = Grid::unit_square();
    for (case, (name, emitter)) in emitters().into_iter().enumerate() {
        let table = LightTable::new(vec![emitter]);
        let counts = grid.count(emitted(case, &table).map(|ray| cell_of(emitter.shape, &ray)));
        assert!(counts.iter().sum::<u64>() as usize > SAMPLES - 20, "{name}");
        // Per unit of both coordinates of place and of direction: the area, and dω = dφ d(cos² θ) / (2 cos θ).
        let expected = |direction: &dyn Fn(f64, f64) -> f64| {
            grid.midpoint(1, |x, _| {
                let cos = (x * 5.0).fract().sqrt();
                let towards = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos).as_vec3();
                let stated = table.emission_densities(0, Vec3::Z, towards);
                let area = f64::from(emitter.area) * f64::from(stated.position);
                area * direction(f64::from(stated.direction), cos) * TAU / (2.0 * cos)
            })
        };
        let probabilities = expected(&|stated, _| stated);
        FAMILY.follows(name, &counts, &probabilities, SEES);
        let uniform = expected(&|_, _| 1.0 / TAU);
        FAMILY.refuses(&format!("{name}, uniform over the hemisphere"), &counts, &uniform);
    }
}

#[test]
fn rays_state_the_densities_of_where_they_leave() {
    for (case, (name, emitter)) in emitters().into_iter().enumerate() {
        let table = LightTable::new(vec![emitter]);
        for ray in emitted(case, &table).take(20_000) {
            let stated = table.emission_densities(ray.light, ray.normal, ray.direction);
            assert_eq!(ray.densities, stated, "{name}");
            assert_eq!((ray.light, ray.endpoint), (0, Endpoint::Surface));
            let above = (ray.origin - ray.position).as_dvec3().dot(ray.normal.as_dvec3());
            assert!(above > 0.0 && ray.normal.dot(ray.direction) > 0.0, "{name}: {ray:?}");
            let power = PI * f64::from(emitter.area);
            assert!((f64::from(ray.ratio.g) / power - 1.0).abs() < 1e-5, "{name}: {ray:?}");
        }
        let behind = table.emission_densities(0, Vec3::Z, Vec3::NEG_Z);
        assert_eq!(behind.direction, 0.0);
        assert!(!table.is_delta(0));
        assert_eq!(table.infinite().count(), 0);
    }
}

/// Emitters of unlike colours, so that the estimate varies: its mean is the power, in every channel.
#[test]
fn the_mean_of_what_is_sent_is_the_power() {
    let mut emitters: Vec<Emitter> = emitters().into_iter().map(|(_, emitter)| emitter).collect();
    // The triangle far away is so large that it would be chosen alone.
    emitters.remove(1);
    let colors = [[3.0, 2.0, 1.0], [0.0, 1.0, 9.0], [5.0, 0.5, 0.5], [0.2, 0.0, 7.0]];
    for (emitter, color) in emitters.iter_mut().zip(colors) {
        emitter.radiance = color.into();
    }
    let table = LightTable::new(emitters.clone());
    for channel in 0..3 {
        let of = |color: Rgb| f64::from(color.to_array()[channel]);
        let power: f64 = emitters.iter().map(|e| PI * f64::from(e.area) * of(e.radiance)).sum();
        let values: Vec<f64> = emitted(50, &table).map(|ray| of(ray.ratio)).collect();
        assert_eq!(values.len(), SAMPLES);
        FAMILY.is(
            &format!("power of channel {channel}"),
            Estimate::of(&values),
            power,
            1e-5 * power,
            0.02,
        );
    }
}
