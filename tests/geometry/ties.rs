//! Hits at the same distance: the lowest (instance, primitive) wins, whatever the tree looks like. The same distance is
//! the same f64: triangles that lie in one plane but list other corners may differ in its last bits.

use super::dice::Dice;
use super::world::{Line, Triangle, World, closest};
use glam::Vec3;

/// 40 copies of each triangle, spread over 8 instances, and as many decoys as the tree needs to part the copies.
#[test]
fn coincident_triangles_return_the_lowest_primitive() {
    let mut dice = Dice::new(11);
    let mut cases = 0;
    for round in 0..60 {
        let scale = dice.magnitude(1e-3, 1e4);
        let flat = round % 3 == 0;
        let originals: Vec<Triangle> = (0..3)
            .map(|_| {
                let center = dice.point(1.0);
                let mut corners = [0; 3].map(|_| (center + dice.point(0.5)) * scale);
                if flat {
                    corners.iter_mut().for_each(|corner| corner.y = center.y * scale);
                }
                corners
            })
            .collect();
        // For every original the lowest name that it was given.
        let mut lowest = [(u32::MAX, u32::MAX); 3];
        let mut world = World::default();
        for instance in 0..8 {
            let mesh: Vec<Triangle> = (0..15)
                .map(|primitive| {
                    // Some instances come late with their first copy of an original.
                    let which = dice.below(3);
                    lowest[which] = lowest[which].min((instance, primitive));
                    originals[which]
                })
                .collect();
            world = world.mesh(&mesh);
        }
        let geometry = world.compile().geometry;
        let rays: Vec<Line> = (0..2000)
            .map(|i| {
                let [a, b, c] = originals[i % 3];
                let (u, v) = (dice.between(0.05, 0.45), dice.between(0.05, 0.45));
                let target = a + (b - a) * u + (c - a) * v;
                let origin = target + dice.direction() * scale * dice.magnitude(0.01, 10.0);
                (origin, (target - origin).normalize())
            })
            .collect();
        for (ray, found) in rays.iter().zip(closest(&geometry, &rays)) {
            // Rays that graze their triangle may meet nothing; what is met must be the lowest copy of some original.
            if found.hit().is_some() {
                assert!(
                    lowest.contains(&found.name()),
                    "round {round}: {found:?} of {lowest:?} for {ray:?}"
                );
                cases += 1;
            }
        }
    }
    assert!(cases > 110_000, "{cases}");
}

/// Coplanar triangles of many sizes around one point: their boxes differ, their distances do not.
#[test]
fn coplanar_triangles_return_the_lowest_primitive() {
    let mut dice = Dice::new(12);
    for round in 0..300 {
        let axis = round % 3;
        let level = dice.between(-3.0, 3.0);
        let at = |x: f32, y: f32| {
            let mut p = [x, y, 0.0];
            p.rotate_right(axis);
            let mut p = Vec3::from_array(p);
            p[(axis + 2) % 3] = level;
            p
        };
        let mesh: Vec<Triangle> = (0..40)
            .map(|_| {
                let size = dice.magnitude(0.2, 20.0);
                let (dx, dy) = (dice.between(-0.01, 0.01), dice.between(-0.01, 0.01));
                [at(-size + dx, -size), at(size, -size + dy), at(dx, size)]
            })
            .collect();
        let geometry = World::default().mesh(&mesh).compile().geometry;
        let rays: Vec<Line> = (0..500)
            .map(|_| {
                // Straight down or up, so that the distance is the same number for every triangle.
                let mut origin = at(dice.between(-0.05, 0.05), dice.between(-0.05, 0.05));
                let (side, height) = (dice.pick(&[-1.0, 1.0]), dice.magnitude(0.01, 5.0));
                origin[(axis + 2) % 3] = level + side * height;
                let mut direction = Vec3::ZERO;
                direction[(axis + 2) % 3] = -side;
                (origin, direction)
            })
            .collect();
        for (ray, found) in rays.iter().zip(closest(&geometry, &rays)) {
            assert_eq!(found.name(), (0, 0), "round {round}: {ray:?} {found:?}");
        }
    }
}

/// A ray exactly through the hub of a fan, or exactly through a shared edge, meets all triangles there at once.
#[test]
fn a_ray_through_a_shared_corner_or_edge_reports_the_lowest_triangle() {
    let mut dice = Dice::new(13);
    for count in 3..40_usize {
        // Rims on a lattice, so that everything is exact; z = 0 and the hub at the origin, or a cone with its tip there.
        for lift in [0.0, 1.0, -1.0] {
            let rim: Vec<Vec3> = (0..count)
                .map(|i| {
                    let angle = std::f64::consts::TAU * i as f64 / count as f64;
                    let lattice = |x: f64| (x * 1024.0).round() as f32;
                    Vec3::new(lattice(libm::cos(angle)), lattice(libm::sin(angle)), lift * 256.0)
                })
                .collect();
            let mut spokes: Vec<usize> = (0..count).collect();
            for i in (1..count).rev() {
                spokes.swap(i, dice.below(i + 1));
            }
            let fan: Vec<Triangle> = spokes
                .iter()
                .map(|&i| [Vec3::ZERO, rim[i], rim[(i + 1) % count]])
                .collect();
            let geometry = World::default().mesh(&fan).compile().geometry;
            let down = Vec3::NEG_Z;
            let mut rays: Vec<Line> = vec![(Vec3::new(0.0, 0.0, 512.0), down)];
            rays.extend(rim.iter().map(|&p| (p * 0.5 + Vec3::Z * 512.0, down)));
            let found = closest(&geometry, &rays);
            assert_eq!(found[0].name(), (0, 0), "the hub of {count}");
            for (i, found) in found[1..].iter().enumerate() {
                let before = (i + count - 1) % count;
                let lowest = spokes
                    .iter()
                    .position(|&spoke| spoke == i || spoke == before)
                    .expect("two spokes");
                assert_eq!(found.name(), (0, lowest as u32), "edge {i} of {count}");
            }
        }
    }
}

/// Distances are compared in f64: from afar, f32 does not tell the two apart, and the lower name must not win then.
#[test]
fn of_two_close_surfaces_the_nearer_is_seen_from_afar() {
    let sheet = |z: f32| {
        [
            Vec3::new(-9.0, -9.0, z),
            Vec3::new(9.0, -9.0, z),
            Vec3::new(0.0, 9.0, z),
        ]
    };
    let mut dice = Dice::new(13);
    let geometry = World::default()
        .mesh(&[sheet(0.0)])
        .mesh(&[sheet(1e-4)])
        .compile()
        .geometry;
    let rays: Vec<Line> = (0..1000)
        .map(|_| {
            let eye = Vec3::new(0.0, 0.0, dice.between(2000.0, 9000.0));
            (
                eye,
                (Vec3::new(dice.between(-3.0, 3.0), dice.between(-3.0, 3.0), 0.0) - eye).normalize(),
            )
        })
        .collect();
    assert!(closest(&geometry, &rays).iter().all(|found| found.name() == (1, 0)));
}
