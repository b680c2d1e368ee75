//! A ray that leaves a surface never meets it again by rounding.

use super::dice::Dice;
use super::shapes::point_on;
use super::world::{Line, Triangle, World, closest, free};
use chainlight::geometry::{SurfacePoint, offset_origin};
use glam::{DVec3, Vec3};

/// The least cosine with the geometric normal for which the promise holds. Normal and direction are f32, each up to
/// √3 · 2⁻²⁵ off: below the sum of both, 1.03e-7, a direction may be on the other side of the surface than it says. (At
/// 1.0e-7 this test finds such rays.)
const LEAST_COSINE: f32 = 1.0 / (1 << 22) as f32;

#[derive(Clone, Copy, Debug)]
enum Shape {
    Triangle(Triangle),
    /// Whose points are looked for near the world's origin only.
    Floor(Triangle),
    Sphere(Vec3, f32),
    Disk(Vec3, Vec3, f32),
    Cylinder(Vec3, Vec3, f32),
}

impl Shape {
    fn random(dice: &mut Dice) -> Self {
        let size = dice.magnitude(1e-4, 1e6);
        let far = dice.pick(&[0.0, 1e-3, 1.0, 1e3]) * size;
        let center = dice.direction() * dice.unit() * far.min(1e6);
        match dice.below(12) {
            0 | 1 => Self::Triangle([0; 3].map(|_| center + dice.point(1.0) * size)),
            2 => {
                let [along, across] = dice.plane();
                let width = f64::from(dice.magnitude(1e-6, 1e-1));
                let corner = |x: f64, y: f64| center + ((along * x + across * y) * f64::from(size)).as_vec3();
                Self::Triangle([corner(-1.0, 0.0), corner(1.0, 0.0), corner(0.3, width)])
            }
            3 => {
                // In a coordinate plane: one coordinate is exactly zero.
                let axis = dice.below(3);
                Self::Triangle([0; 3].map(|_| {
                    let mut corner = center + dice.point(1.0) * size;
                    corner[axis] = 0.0;
                    corner
                }))
            }
            4 => {
                // In a tilted plane through the world's origin, up to the rounding of the corners.
                let [x, y] = dice.plane();
                let mut corner = |_| {
                    let (u, v) = (dice.between(-1.0, 1.0), dice.between(-1.0, 1.0));
                    ((x * f64::from(u) + y * f64::from(v)) * f64::from(size)).as_vec3()
                };
                Self::Triangle([0; 3].map(&mut corner))
            }
            5 => {
                let [x, y] = match dice.below(2) {
                    0 => [DVec3::X, DVec3::NEG_Z],
                    _ => dice.plane(),
                };
                let lift = x.cross(y) * dice.pick(&[0.0, 1e-3, 1.0]);
                let corner = |u: f64, v: f64| ((x * u + y * v) * 1e6 + lift).as_vec3();
                Self::Floor([corner(-1.1, -0.9), corner(1.2, -0.8), corner(-0.2, 1.3)])
            }
            6 => Self::Sphere(center, size),
            7 | 8 => {
                // Through the world's origin, or anywhere.
                let anywhere = dice.direction();
                let normal = dice.pick(&[anywhere, Vec3::X, Vec3::NEG_Y, anywhere]);
                let center = dice.pick(&[center, center - normal * normal.dot(center), Vec3::ZERO]);
                Self::Disk(center, normal, size)
            }
            9 | 10 => {
                let anywhere = dice.direction();
                let along = dice.pick(&[anywhere, Vec3::Z, anywhere]) * size * dice.magnitude(1e-2, 1e2);
                // Its side through the world's origin, or anywhere.
                let beside = along.normalize().any_orthonormal_vector() * size;
                let from = dice.pick(&[center, beside - along * 0.3]);
                Self::Cylinder(from, from + along, size)
            }
            // A sphere that touches the world's origin.
            _ => Self::Sphere(dice.direction() * size, size),
        }
    }

    fn compile(self) -> chainlight::geometry::Geometry {
        let world = World::default();
        let world = match self {
            Self::Triangle(corners) | Self::Floor(corners) => world.mesh(&[corners]),
            Self::Sphere(center, radius) => world.sphere(center, radius),
            Self::Disk(center, normal, radius) => world.disk(center, normal, radius),
            Self::Cylinder(from, to, radius) => world.cylinder(from, to, radius),
        };
        world.compile().geometry
    }

    /// A ray at a random point of it.
    fn aim(self, dice: &mut Dice) -> Line {
        let (target, size) = match self {
            Self::Triangle(corners) => {
                let size = corners[0].distance(corners[1]).max(corners[0].distance(corners[2]));
                (point_on(corners, dice), size)
            }
            Self::Floor(_) => {
                let reach = dice.magnitude(1e-4, 1e3);
                (dice.point(1.0).as_dvec3() * f64::from(reach), reach)
            }
            Self::Sphere(center, radius) => {
                // Half of them near the world's origin, if the sphere touches it.
                let anywhere = dice.direction();
                let near_origin = anywhere * dice.magnitude(1e-6, 1.0) - center.normalize_or_zero();
                let outward = dice.pick(&[anywhere, near_origin]).as_dvec3().normalize();
                (center.as_dvec3() + outward * f64::from(radius), radius)
            }
            Self::Disk(center, normal, radius) => {
                let (x, y) = normal.as_dvec3().normalize().any_orthonormal_pair();
                let [u, v] = [0; 2].map(|_| f64::from(dice.between(-0.8, 0.8) * radius));
                // Half of them at the rim, or at the middle.
                let share = dice.pick(&[1.0, 1.0, 1e-4, 0.999_999 * f64::from(radius) / (u * u + v * v).sqrt()]);
                (center.as_dvec3() + (x * u + y * v) * share, radius)
            }
            Self::Cylinder(from, to, radius) => {
                let axis = to.as_dvec3() - from.as_dvec3();
                let anywhere = dice.fine_unit();
                let along = dice.pick(&[anywhere, anywhere, 1e-7, 0.999_999_9]);
                let outward = dice
                    .direction()
                    .as_dvec3()
                    .cross(axis)
                    .normalize_or(axis.any_orthonormal_vector().normalize());
                (from.as_dvec3() + axis * along + outward * f64::from(radius), radius)
            }
        };
        let away = dice.direction() * size * dice.magnitude(1e-3, 1e2);
        let origin = (target + away.as_dvec3()).as_vec3();
        (origin, (target - origin.as_dvec3()).normalize().as_vec3())
    }
}

/// A ray that leaves a point on the side where `cosine` with the geometric normal is, at any angle around it.
fn leave(point: &SurfacePoint, cosine: f32, dice: &mut Dice) -> Line {
    let direction = dice.at_cosine(point.geometric_normal, cosine);
    let origin = offset_origin(point.position, point.geometric_normal, point.offset, direction);
    (origin, direction)
}

/// 2.4 million rays and 1.2 million segments; none meets its surface, which bounds the rate by 1.3e-6.
#[test]
fn rays_that_leave_a_surface_never_hit_it_again() {
    let mut dice = Dice::new(31);
    let (mut left, mut sparse) = (0, 0);
    for _ in 0..40_000 {
        let shape = Shape::random(&mut dice);
        let geometry = shape.compile();
        let rays: Vec<Line> = (0..48).map(|_| shape.aim(&mut dice)).collect();
        let hits: Vec<_> = closest(&geometry, &rays)
            .iter()
            .filter_map(|found| found.hit())
            .collect();
        sparse += usize::from(hits.len() < 24);
        let mut away = Vec::new();
        for &hit in &hits {
            let point = geometry.surface_point(hit);
            // Half of them as low as the promise holds.
            let most = dice.pick(&[2.0 * LEAST_COSINE, 1.0]);
            let cosine = dice.magnitude(LEAST_COSINE, most);
            away.push((leave(&point, cosine, &mut dice), cosine, point));
            away.push((leave(&point, -cosine, &mut dice), -cosine, point));
        }
        let lines: Vec<Line> = away.iter().map(|&(line, ..)| line).collect();
        let segments: Vec<Line> = lines.iter().map(|&(p, d)| (p, p + d * 3.0e6)).collect();
        let found = closest(&geometry, &lines).into_iter().zip(free(&geometry, &segments));
        for ((line, cosine, point), (found, free)) in away.into_iter().zip(found) {
            left += 1;
            let inwards = cosine < 0.0;
            match shape {
                Shape::Sphere(_, radius) if inwards => {
                    // It crosses the sphere: the far side is what it meets, unless rounding takes more than the radius.
                    if point.offset < 0.1 * radius {
                        assert!(found.hit().is_some(), "{shape:?} {line:?} {point:?}");
                        let least = radius * -cosine;
                        assert!(
                            found.distance > least,
                            "{shape:?} {line:?} {cosine} {point:?} {found:?}"
                        );
                    }
                }
                Shape::Cylinder(_, _, radius) if inwards => {
                    // The far side, or out at an end.
                    if point.offset < 0.1 * radius && found.hit().is_some() {
                        assert!(
                            found.distance > radius * -cosine,
                            "{shape:?} {line:?} {cosine} {point:?} {found:?}"
                        );
                    }
                }
                _ => {
                    assert_eq!(found.hit(), None, "{shape:?} {line:?} {cosine} {point:?} {found:?}");
                    assert!(free, "{shape:?} {line:?} {cosine} {point:?}");
                }
            }
        }
    }
    assert!(left > 2_400_000, "{left}");
    assert!(sparse < 8_000, "{sparse} shapes were hardly hit");
}
