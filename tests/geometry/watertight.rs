//! Closed meshes are closed: nothing that starts inside gets out.

use super::dice::Dice;
use super::shapes::{icosphere, placed, point_on, room};
use super::world::{Line, Triangle, World, closest, free};
use glam::{DVec3, Vec3};

/// 1.2 million rays and as many segments from inside, half of them aimed at corners and points of edges; none gets out,
/// which bounds the rate of leaks by 2.5e-6.
#[test]
fn nothing_leaves_a_closed_mesh() {
    let mut dice = Dice::new(21);
    let (mut rays_traced, mut escaped) = (0, 0);
    let spheres = [icosphere(0), icosphere(2), icosphere(4)];
    let places = [
        (1e-4, 0.0),
        (1e-4, 1.0),
        (1e-2, 1e2),
        (1.0, 0.0),
        (1.0, 1e4),
        (1e2, 1e6),
        (1e4, 1.0),
        (1e6, 0.0),
        (1e6, 1e6),
    ];
    for (scale, distance) in places {
        let center = dice.direction().as_dvec3() * distance;
        let mut meshes: Vec<Vec<Triangle>> = spheres.iter().map(|unit| placed(unit, scale, center)).collect();
        let half = DVec3::new(0.9, 0.6, 0.3) * scale;
        meshes.push(room((center - half).as_vec3(), (center + half).as_vec3()));
        for mesh in meshes {
            let geometry = World::default().mesh(&mesh).compile().geometry;
            let lines: Vec<Line> = (0..34_000)
                .map(|_| {
                    let origin = (center + dice.point(0.2).as_dvec3() * scale).as_vec3();
                    let target = point_on(mesh[dice.below(mesh.len())], &mut dice);
                    let direction = (target - origin.as_dvec3()).normalize();
                    (origin, direction.as_vec3())
                })
                .collect();
            escaped += closest(&geometry, &lines)
                .iter()
                .filter(|found| found.hit().is_none())
                .count();
            let reach = 4.0 * scale as f32;
            let segments: Vec<Line> = lines.iter().map(|&(p, d)| (p, p + d * reach)).collect();
            escaped += free(&geometry, &segments).iter().filter(|&&free| free).count();
            rays_traced += lines.len();
        }
    }
    assert!(rays_traced > 1_200_000, "{rays_traced}");
    assert_eq!(escaped, 0, "of {rays_traced} rays and segments each");
}

/// Lattices where every number is exact, with rays exactly through shared corners and along planes of triangles.
#[test]
fn nothing_leaves_a_box_through_its_exact_corners_and_edges() {
    let half = Vec3::new(4.0, 2.0, 1.0);
    let mesh = room(-half, half);
    let geometry = World::default().mesh(&mesh).compile().geometry;
    let mut rays = Vec::new();
    let steps = [-1.0, -0.5, 0.0, 0.5, 1.0];
    for x in steps {
        for y in steps {
            for z in steps {
                let target = half * Vec3::new(x, y, z);
                for origin in [Vec3::ZERO, half * 0.5, half * Vec3::new(0.0, 0.5, -0.5), half * -0.75] {
                    if [x, y, z].iter().any(|s: &f32| s.abs() == 1.0) && target != origin {
                        rays.push((origin, target - origin));
                    }
                }
            }
        }
    }
    assert!(
        closest(&geometry, &rays)
            .iter()
            .all(|found| found.hit().is_some() && found.distance == 1.0)
    );
}
