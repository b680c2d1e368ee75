//! Disks and tubes: found where a scan finds them, closed where they close one another, and as points where they are.

use super::dice::Dice;
use super::scan::Shape;
use super::tree::compare;
use super::world::{Line, World, closest, free};
use chainlight::geometry::{SurfacePoint, offset_origin};
use glam::{DVec3, Vec3};

/// Disks, tubes, spheres and triangles of all sizes among one another; a quarter of the rays along an axis or in a plane
/// of two.
#[test]
fn the_tree_finds_the_disks_and_tubes_that_a_scan_finds() {
    let mut dice = Dice::new(81);
    let (mut judged, mut all) = (0, 0);
    for (count, lines) in [(1, 4000), (3, 4000), (17, 4000), (120, 3000), (1000, 1500)] {
        for scale in [1.0, 1e-3, 1e5] {
            let mut next = |i: usize| {
                let center = dice.point(1.0) * scale;
                let radius = dice.magnitude(0.01, 0.3) * scale;
                let upright = dice.pick(&[Vec3::X, Vec3::NEG_Y, Vec3::Z]);
                let anywhere = dice.direction();
                let axis = dice.pick(&[anywhere, anywhere, upright]);
                match i % 4 {
                    0 => Shape::Disk(center, axis, radius),
                    1 => Shape::Sphere(center, radius),
                    2 => Shape::Cylinder(center, center + axis * radius * dice.magnitude(0.1, 10.0), radius),
                    _ => Shape::Triangle([0; 3].map(|_| center + dice.point(0.2) * scale)),
                }
            };
            let first = count % 3;
            let instances: Vec<Vec<Shape>> = (0..count).map(|i| vec![next(2 * first + i)]).collect();
            let ray = |dice: &mut Dice| {
                let mut direction = dice.direction();
                match dice.below(8) {
                    0 => direction[dice.below(3)] = dice.pick(&[0.0, -0.0]),
                    1 => {
                        direction = Vec3::ZERO;
                        direction[dice.below(3)] = dice.pick(&[1.0, -1.0]);
                    }
                    _ => {}
                }
                (dice.point(1.5) * scale, direction.normalize())
            };
            let rays: Vec<Line> = (0..lines).map(|_| ray(&mut dice)).collect();
            let segments: Vec<Line> = (0..lines)
                .map(|_| (dice.point(1.2) * scale, dice.point(1.2) * scale))
                .collect();
            judged += compare(instances, 1e-11, &rays, &segments);
            all += 2 * lines;
        }
    }
    assert!(judged * 100 > all * 95, "{judged} of {all} judged");
}

/// A tube and the two disks that close it.
struct Can {
    from: Vec3,
    to: Vec3,
    normal: Vec3,
    radius: f32,
}

impl Can {
    /// Somewhere, at some angle: the ends are rounded, and so is the normal.
    fn new(scale: f64, distance: f64, dice: &mut Dice) -> Self {
        let center = dice.direction().as_dvec3() * distance;
        let [axis, _] = dice.plane();
        let axis = dice.pick(&[axis, axis, DVec3::Y]);
        let half = axis * scale * f64::from(dice.between(0.6, 3.0));
        Self {
            from: (center - half).as_vec3(),
            to: (center + half).as_vec3(),
            normal: axis.as_vec3(),
            radius: scale as f32,
        }
    }

    fn center(&self) -> DVec3 {
        0.5 * (self.from.as_dvec3() + self.to.as_dvec3())
    }

    fn compile(&self, outward: bool) -> chainlight::geometry::Geometry {
        let normal = if outward { self.normal } else { -self.normal };
        let world = World::default().cylinder(self.from, self.to, self.radius);
        let world = world.disk(self.from, -normal, self.radius);
        world.disk(self.to, normal, self.radius).compile().geometry
    }

    /// A point of it; half of them at a rim or within a millionth of one.
    fn point(&self, dice: &mut Dice) -> DVec3 {
        let axis = self.to.as_dvec3() - self.from.as_dvec3();
        let outward = loop {
            let outward = dice.direction().as_dvec3().cross(axis);
            if outward.length() > 0.1 * axis.length() {
                break outward.normalize() * f64::from(self.radius);
            }
        };
        let near = f64::from(dice.magnitude(1e-12, 1e-6));
        let (along, out) = match dice.below(6) {
            0 => (dice.pick(&[0.0, 1.0]), 1.0),
            1 => (dice.pick(&[near, 1.0 - near]), 1.0),
            2 => (dice.pick(&[0.0, 1.0]), 1.0 - near),
            3 => (dice.pick(&[0.0, 1.0]), dice.fine_unit().sqrt()),
            _ => (dice.fine_unit(), 1.0),
        };
        self.from.as_dvec3() + axis * along + outward * out
    }
}

const PLACES: [(f64, f64); 9] = [
    (1e-4, 0.0),
    (1e-4, 1.0),
    (1e-2, 1e2),
    (1.0, 0.0),
    (1.0, 3.0),
    (1.0, 1e4),
    (1e2, 1e6),
    (1e4, 1.0),
    (1e6, 1e6),
];

/// 720 000 rays and as many segments from inside, half of them aimed at rims; none gets out, which bounds the rate by 4e-6.
#[test]
fn nothing_leaves_a_closed_can() {
    let mut dice = Dice::new(82);
    let (mut traced, mut escaped) = (0, 0);
    for (scale, distance) in PLACES {
        for turn in 0..20 {
            let can = Can::new(scale, distance, &mut dice);
            let geometry = can.compile(turn % 2 == 0);
            let lines: Vec<Line> = (0..4000)
                .map(|_| {
                    let origin = (can.center() + dice.point(0.3).as_dvec3() * scale).as_vec3();
                    let target = can.point(&mut dice);
                    (origin, (target - origin.as_dvec3()).normalize().as_vec3())
                })
                .collect();
            let missed = closest(&geometry, &lines)
                .iter()
                .filter(|found| found.hit().is_none())
                .count();
            let reach = 10.0 * scale as f32;
            let segments: Vec<Line> = lines.iter().map(|&(p, d)| (p, p + d * reach)).collect();
            let passed = free(&geometry, &segments).iter().filter(|&&free| free).count();
            assert_eq!(
                (missed, passed),
                (0, 0),
                "scale {scale} at {distance}: {:?} {:?}",
                can.from,
                can.to
            );
            escaped += missed + passed;
            traced += lines.len();
        }
    }
    assert!(traced == 720_000 && escaped == 0, "{escaped} of {traced}");
}

/// Paths that bounce about inside, 30 times each, aimed at the rims as often as anywhere: half a million rays, none of which
/// gets out, which bounds the rate by 6e-6.
#[test]
fn paths_stay_in_a_closed_can() {
    let mut dice = Dice::new(83);
    let mut traced = 0;
    for (scale, distance) in PLACES {
        for turn in 0..4 {
            let can = Can::new(scale, distance, &mut dice);
            let geometry = can.compile(turn % 2 == 0);
            let center = can.center();
            let inside = |point: &SurfacePoint| {
                let inwards = (center - point.position.as_dvec3()).dot(point.geometric_normal.as_dvec3());
                if inwards < 0.0 { -1.0 } else { 1.0 }
            };
            let aim = |origin: Vec3, dice: &mut Dice| (can.point(dice) - origin.as_dvec3()).normalize().as_vec3();
            let start = center.as_vec3();
            let mut rays: Vec<Line> = (0..500).map(|_| (start, aim(start, &mut dice))).collect();
            for bounce in 0..30 {
                traced += rays.len();
                let mut next = Vec::with_capacity(rays.len());
                for (ray, found) in rays.iter().zip(closest(&geometry, &rays)) {
                    let hit = found.hit();
                    assert!(
                        hit.is_some(),
                        "scale {scale} at {distance}, bounce {bounce}: {ray:?} {:?} {:?}",
                        can.from,
                        can.to
                    );
                    let point = geometry.surface_point(hit.expect("checked"));
                    let mut direction = aim(point.position, &mut dice);
                    let side = inside(&point);
                    let cosine = direction.dot(point.geometric_normal) * side;
                    if cosine < 1e-3 {
                        let least = dice.magnitude(1e-3, 1.0) * side;
                        direction = dice.at_cosine(point.geometric_normal, least);
                    }
                    let origin = offset_origin(point.position, point.geometric_normal, point.offset, direction);
                    next.push((origin, direction));
                }
                rays = next;
            }
        }
    }
    assert!(traced >= 500_000, "{traced}");
}

#[test]
fn a_hit_on_a_disk_or_a_tube_is_where_the_ray_was_aimed() {
    let mut dice = Dice::new(84);
    for round in 0..20_000 {
        let center = dice.point(3.0);
        let radius = dice.magnitude(0.1, 2.0);
        let axis = dice.direction();
        let (x, y) = axis.as_dvec3().normalize().any_orthonormal_pair();
        let angle = f64::from(dice.between(0.0, std::f32::consts::TAU));
        let around = x * libm::cos(angle) + y * libm::sin(angle);
        let (geometry, target, normal) = if round % 2 == 0 {
            let out = f64::from(dice.between(0.0, 0.99) * radius);
            let world = World::default().disk(center, axis, radius);
            (world, center.as_dvec3() + around * out, axis.as_dvec3())
        } else {
            let world = World::default().cylinder(center, center + axis * 2.0, radius);
            let along = f64::from(dice.between(0.01, 1.99));
            let on_axis = center.as_dvec3() + axis.as_dvec3() * along;
            (world, on_axis + around * f64::from(radius), around)
        };
        let geometry = geometry.compile().geometry;
        let cosine = dice.between(0.2, 1.0);
        let away = dice.at_cosine(normal.as_vec3(), cosine).as_dvec3();
        let origin = (target + away * 5.0).as_vec3();
        let span = target - origin.as_dvec3();
        let found = closest(&geometry, &[(origin, span.normalize().as_vec3())])[0];
        let point = geometry.surface_point(found.hit().expect("a hit"));
        assert!(
            (f64::from(found.distance) - span.length()).abs() < 2e-5,
            "{found:?} for {}",
            span.length()
        );
        // The direction's rounding over a length of 5, aslant.
        assert!(
            point.position.as_dvec3().distance(target) < 2e-5,
            "{point:?} for {target}"
        );
        assert!(
            point.geometric_normal.as_dvec3().distance(normal) < 2e-4 / 5.0,
            "{point:?} for {normal}"
        );
        assert_eq!(point.shading_normal, point.geometric_normal);
    }
}

#[test]
fn shapes_without_extent_are_never_met() {
    let world = World::default()
        .disk(Vec3::ZERO, Vec3::Z, 0.0)
        .disk(Vec3::ZERO, Vec3::ZERO, 1.0)
        .disk(Vec3::new(f32::NAN, 0.0, 0.0), Vec3::Z, 1.0)
        .cylinder(Vec3::ZERO, Vec3::ZERO, 1.0)
        .cylinder(Vec3::ZERO, Vec3::Z, -1.0)
        .cylinder(Vec3::ZERO, Vec3::splat(f32::INFINITY), 1.0);
    let geometry = world.compile().geometry;
    let mut dice = Dice::new(85);
    let rays: Vec<Line> = (0..10_000).map(|_| (dice.point(2.0), dice.direction())).collect();
    assert!(closest(&geometry, &rays).iter().all(|found| found.hit().is_none()));
}
