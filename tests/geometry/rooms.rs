//! Closed rooms keep paths in and light out.

use super::dice::Dice;
use super::shapes::{icosphere, placed, point_on, quad, room};
use super::world::{Line, Triangle, World, closest, free};
use chainlight::geometry::{SurfacePoint, offset_origin};
use chainlight::scene::Scene;
use glam::{DVec3, Vec3};

/// What went wrong in a walk.
#[derive(Debug, Default)]
struct Walked {
    rays: usize,
    segments: usize,
    lost: usize,
    lit: usize,
}

/// Bounces paths about inside a closed mesh (instance 0) around `center`, aiming at its edges and corners as often as
/// anywhere, and looks from every point for the light that shines on the mesh from outside.
fn walk(scene: &Scene, mesh: &[Triangle], center: DVec3, paths: usize, bounces: usize, dice: &mut Dice) -> Walked {
    let mut walked = Walked::default();
    let aim = |origin: Vec3, dice: &mut Dice| {
        let target = point_on(mesh[dice.below(mesh.len())], dice);
        (target - origin.as_dvec3()).normalize_or_zero().as_vec3()
    };
    let mut rays: Vec<Line> = (0..paths)
        .map(|_| (center.as_vec3(), aim(center.as_vec3(), dice)))
        .collect();
    for _ in 0..bounces {
        walked.rays += rays.len();
        let mut next = Vec::new();
        let mut segments = Vec::new();
        for found in closest(&scene.geometry, &rays) {
            let Some(hit) = found.hit().filter(|hit| hit.instance == 0) else {
                walked.lost += 1;
                next.push((center.as_vec3(), dice.direction()));
                continue;
            };
            let point = scene.geometry.surface_point(hit);
            // The side of the surface that the room is on.
            let inwards = point.geometric_normal * inside(&point, center);
            let leave = |direction| {
                (
                    offset_origin(point.position, point.geometric_normal, point.offset, direction),
                    direction,
                )
            };
            let towards = (0..4)
                .map(|_| aim(point.position, dice))
                .find(|d| inwards.dot(*d) > 1e-3);
            let cosine = dice.magnitude(1e-4, 1.0);
            next.push(leave(towards.unwrap_or_else(|| dice.at_cosine(inwards, cosine))));
            let light = scene.lights.sample(point.position, dice.fine_unit(), dice.pair());
            if let Some(light) = light.filter(|light| inwards.dot(light.direction) > 1e-4) {
                segments.push((leave(light.direction).0, light.target));
            }
        }
        walked.segments += segments.len();
        walked.lit += free(&scene.geometry, &segments).iter().filter(|&&free| free).count();
        rays = next;
    }
    walked
}

fn inside(point: &SurfacePoint, center: DVec3) -> f32 {
    let inwards = (center - point.position.as_dvec3()).dot(point.geometric_normal.as_dvec3());
    if inwards < 0.0 { -1.0 } else { 1.0 }
}

/// A regular tetrahedron, the sharpest of the closed rooms here: its faces meet at 70.5 degrees.
fn tetrahedron() -> Vec<[DVec3; 3]> {
    let [a, b, c, d] =
        [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)].map(|(x, y, z)| DVec3::new(x.into(), y.into(), z.into()));
    vec![[a, b, c], [a, c, d], [a, d, b], [b, d, c]]
}

/// 1.9 million rays and a million segments in rooms from 1e-4 to 1e6 in size, down to 1e-4 of their distance from
/// the world's origin: none gets out, which bounds the rate by 2e-6 for rays and 3e-6 for segments.
#[test]
fn closed_rooms_keep_paths_in_and_light_out() {
    let mut dice = Dice::new(51);
    let mut total = Walked::default();
    let places = [
        (1e-4, 0.0),
        (1e-4, 1.0),
        (1e-3, 0.0),
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
        let half = DVec3::new(1.0, 0.6, 0.8) * scale;
        let outside = DVec3::splat(5.0 * scale);
        let meshes = [
            room((center - half).as_vec3(), (center + half).as_vec3()),
            placed(&icosphere(1), scale, center),
            placed(&tetrahedron(), scale, center),
        ];
        for (kind, mesh) in meshes.into_iter().enumerate() {
            let outer = room((center - outside).as_vec3(), (center + outside).as_vec3());
            let scene = World::default().mesh(&mesh).light_mesh(&outer).compile();
            let walked = walk(&scene, &mesh, center, 2100, 30, &mut dice);
            assert_eq!(
                (walked.lost, walked.lit),
                (0, 0),
                "{scale} at {distance}, mesh {kind}: {walked:?}"
            );
            total.rays += walked.rays;
            total.segments += walked.segments;
        }
    }
    assert!(total.rays > 1_800_000 && total.segments > 1_000_000, "{total:?}");
}

/// Four walls and a ceiling, 2 wide, on a floor that reaches far beyond. A hit keeps its place on a triangle in f32, so
/// a point on the floor is off by up to 2⁻²² of the half floor's size: nearer to a wall than that it may be behind it.
#[test]
fn walls_on_a_huge_floor_keep_light_out() {
    let mut dice = Dice::new(52);
    for floor in [1e1_f32, 1e3, 1e5, 1e6] {
        let margin = floor * 2.0 * f32::EPSILON;
        let mut walls = room(Vec3::new(-1.0, 0.0, -1.0), Vec3::ONE);
        walls.drain(..2);
        let ground = quad(
            Vec3::new(-0.7, 0.0, 1.1) * floor,
            Vec3::X * 1.9 * floor,
            Vec3::NEG_Z * 2.1 * floor,
        );
        let sky = quad(Vec3::new(-30.0, 5.0, -30.0), Vec3::X * 60.0, Vec3::Z * 60.0);
        let scene = World::default().mesh(&ground).mesh(&walls).light_mesh(&sky).compile();
        let rays: Vec<Line> = (0..100_000)
            .map(|_| {
                let near = 1.0 - margin;
                let mut target = Vec3::new(dice.between(-near, near), 0.0, dice.between(-near, near));
                target[dice.pick(&[0, 2])] =
                    dice.pick(&[-1.0, 1.0]) * (1.0 - margin * dice.magnitude(1.0, 10.0)).max(0.0);
                let origin = Vec3::new(0.1, 0.5, -0.2);
                (origin, (target - origin).normalize())
            })
            .collect();
        let mut segments = Vec::new();
        for found in closest(&scene.geometry, &rays) {
            let hit = found.hit().expect("the room is closed");
            if hit.instance != 0 {
                continue;
            }
            let point = scene.geometry.surface_point(hit);
            if let Some(light) = scene.lights.sample(point.position, dice.fine_unit(), dice.pair()) {
                let origin = offset_origin(point.position, point.geometric_normal, point.offset, light.direction);
                segments.push((origin, light.target));
            }
        }
        assert!(segments.len() > 40_000, "{floor}: {}", segments.len());
        let lit = free(&scene.geometry, &segments).iter().filter(|&&free| free).count();
        assert_eq!(lit, 0, "of {} on a floor of {floor}", segments.len());
    }
}
