//! Surface points against direct computation.

use super::dice::Dice;
use super::world::{Line, Triangle, World, closest};
use chainlight::geometry::Hit;
use glam::Vec3;

fn triangle(dice: &mut Dice) -> Triangle {
    let center = dice.point(3.0);
    [0; 3].map(|_| center + dice.point(1.0))
}

/// Rays at points with known weights: the hit is there, in distance, weights, position and normals.
#[test]
fn a_hit_on_a_triangle_is_where_the_ray_was_aimed() {
    let mut dice = Dice::new(71);
    let mut judged = 0;
    for _ in 0..3000 {
        let corners = triangle(&mut dice);
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let cross = (b - a).cross(c - a);
        if cross.length() < 0.1 {
            continue;
        }
        let normal = cross.normalize();
        let normals: Vec<Vec3> = (0..3).map(|_| dice.at_cosine(normal.as_vec3(), 0.8)).collect();
        let flat = World::default().mesh(&[corners]).compile().geometry;
        let smooth = World::default().smooth(&[corners], normals.clone()).compile().geometry;
        for _ in 0..20 {
            let (u, v) = (dice.between(0.05, 0.45), dice.between(0.05, 0.45));
            let (wide_u, wide_v) = (f64::from(u), f64::from(v));
            let target = a + (b - a) * wide_u + (c - a) * wide_v;
            let side = dice.pick(&[1.0, -1.0]);
            let cosine = dice.between(0.2, 1.0) * side;
            let origin = (target + dice.at_cosine(normal.as_vec3(), cosine).as_dvec3() * 5.0).as_vec3();
            let away = target - origin.as_dvec3();
            let ray: Line = (origin, away.normalize().as_vec3());
            let [found, also] = [&flat, &smooth].map(|geometry| closest(geometry, &[ray])[0]);
            assert_eq!(found, also);
            assert!((f64::from(found.distance) - away.length()).abs() < 2e-5, "{found:?}");
            // The direction is rounded: its 1e-7 over a length of 5, seen at a slant, across a triangle of area 0.05.
            assert!(
                found.uv.distance(glam::DVec2::new(u.into(), v.into())) < 1e-4,
                "{found:?} for {u}, {v}"
            );
            let hit = found.hit().expect("a hit");
            let (point, curved) = (flat.surface_point(hit), smooth.surface_point(hit));
            let (hit_u, hit_v) = (hit.uv.x, hit.uv.y);
            let exact = a + (b - a) * hit_u + (c - a) * hit_v;
            // The point is farther from all edges than `EDGE_INSET_UNITS`, so all that moves it is its rounding.
            assert!(
                point.position.as_dvec3().distance(exact) < 2e-6,
                "{point:?} for {exact}"
            );
            assert_eq!(point.position, curved.position);
            assert!(point.geometric_normal.as_dvec3().distance(normal) < 2e-7);
            assert_eq!(point.shading_normal, point.geometric_normal);
            let [na, nb, nc] = [0, 1, 2].map(|i| normals[i].as_dvec3());
            let interpolated = (na * (1.0 - hit_u - hit_v) + nb * hit_u + nc * hit_v).normalize();
            assert!(
                curved.shading_normal.as_dvec3().distance(interpolated) < 2e-6,
                "{curved:?}"
            );
            assert_eq!(curved.geometric_normal, point.geometric_normal);
            judged += 1;
        }
    }
    assert!(judged > 50_000, "{judged}");
}

/// Points of edges, corners and needles: off the edge where the triangle has room, and never far from where they were.
#[test]
fn points_hardly_move_when_kept_off_edges() {
    let mut dice = Dice::new(73);
    for round in 0..3000 {
        let [mut a, mut b, mut c] = triangle(&mut dice);
        if round % 3 == 0 {
            c = a + (b - a) * dice.unit() + dice.direction() * dice.magnitude(1e-5, 1e-1);
            [a, b, c] = dice.pick(&[[a, b, c], [b, c, a], [c, a, b]]);
        }
        let geometry = World::default().mesh(&[[a, b, c]]).compile().geometry;
        let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
        let reach = (b - a).length() + (c - a).length() + a.abs().max_element();
        let unit = f64::from(f32::EPSILON) * 0.5 * reach;
        let area = (b - a).cross(c - a).length();
        let heights = [c - b, c - a, b - a].map(|edge| area / edge.length());
        for (u, v) in [
            (0.0, 0.0),
            (1.0, 0.0),
            (0.0, 1.0),
            (0.5, 0.5),
            (0.5, 0.0),
            (0.0, 0.25),
            (0.125, 0.25),
        ] {
            let hit = Hit {
                instance: 0,
                primitive: 0,
                uv: glam::DVec2::new(u, v),
            };
            let position = geometry.surface_point(hit).position.as_dvec3();
            let moved = position.distance(a + (b - a) * u + (c - a) * v);
            assert!(moved < 128.0 * unit, "{moved} of {unit}");
            let normal = (b - a).cross(c - a).normalize();
            let off = [(b, c), (c, a), (a, b)].map(|(p, q)| normal.dot((q - p).cross(position - p)) / (q - p).length());
            let roomy = heights
                .iter()
                .all(|&h| h > 0.125 * ((b - a).length() + (c - a).length()));
            let rounding = f64::from(f32::EPSILON) * 0.5 * position.abs().max_element();
            assert!(
                !roomy || off.iter().all(|&d| d > 6.0 * rounding),
                "{off:?} of {rounding}"
            );
        }
    }
}

#[test]
fn interpolated_normals_stay_on_the_side_of_the_surface() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let against = vec![Vec3::new(0.6, 0.0, -0.8); 3];
    let vanishing = vec![Vec3::X, Vec3::NEG_X, Vec3::ZERO];
    for (normals, expected) in [(against, Vec3::new(-0.6, 0.0, 0.8)), (vanishing, Vec3::Z)] {
        let geometry = World::default().smooth(&[corners], normals).compile().geometry;
        let found = closest(&geometry, &[(Vec3::new(0.25, 0.25, 1.0), Vec3::NEG_Z)])[0];
        let mut hit = found.hit().expect("a hit");
        hit.uv = glam::DVec2::new(0.5, 0.0);
        let point = geometry.surface_point(hit);
        assert!(point.shading_normal.distance(expected) < 1e-6, "{point:?}");
    }
}

#[test]
fn a_hit_on_a_sphere_is_on_the_sphere_where_the_ray_was_aimed() {
    let mut dice = Dice::new(72);
    for _ in 0..100_000 {
        let radius = dice.magnitude(1e-4, 1e6);
        let center = dice.point(1.0) * radius;
        let geometry = World::default().sphere(center, radius).compile().geometry;
        let outward = dice.direction().as_dvec3().normalize();
        let target = center.as_dvec3() + outward * f64::from(radius);
        let cosine = dice.between(0.2, 1.0);
        let away = dice.at_cosine(outward.as_vec3(), cosine);
        let origin = (target + away.as_dvec3() * f64::from(radius)).as_vec3();
        let direction = (target - origin.as_dvec3()).normalize().as_vec3();
        let hit = closest(&geometry, &[(origin, direction)])[0].hit().expect("a hit");
        let point = geometry.surface_point(hit);
        // The octahedral coordinates are two f32: 3e-7 is their measured bound; rounding of the ray makes the rest.
        assert!(
            point.geometric_normal.as_dvec3().distance(outward) < 4e-6,
            "{point:?} for {outward}"
        );
        let off = (point.position.as_dvec3().distance(center.as_dvec3()) - f64::from(radius)).abs();
        assert!(off < 3e-7 * f64::from(radius), "{off} off a sphere of {radius}");
        assert_eq!(point.shading_normal, point.geometric_normal);
    }
}

#[test]
fn a_hit_names_the_material_and_the_light() {
    let far = Vec3::Z * 4.0;
    let triangle = |z: f32| [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p + Vec3::Z * z);
    let geometry = World::default()
        .mesh(&[triangle(0.0), triangle(1.0)])
        .light_mesh(&[triangle(2.0), triangle(3.0)])
        .light_sphere(far * 4.0, 1.0)
        .compile()
        .geometry;
    let none = chainlight::geometry::NOT_EMITTING;
    let lights = [
        (0.5, (0, 1), none),
        (1.5, (1, 0), 0),
        (2.5, (1, 1), 1),
        (3.5, (2, 0), 2),
    ];
    for (z, name, light) in lights {
        let found = closest(&geometry, &[(Vec3::new(0.25, 0.25, z), Vec3::Z)])[0];
        assert_eq!(found.name(), name);
        assert_eq!(geometry.surface_point(found.hit().expect("a hit")).light, light);
    }
}

#[test]
fn points_on_a_huge_triangle_are_as_exact_as_those_on_a_small_one() {
    let mut dice = Dice::new(75);
    let size = 1e6;
    let floor = [
        Vec3::new(-size, 0.0, -size),
        Vec3::new(-size, 0.0, size),
        Vec3::new(size, 0.0, -size),
    ];
    let geometry = World::default().mesh(&[floor]).compile().geometry;
    let rays: Vec<_> = (0..10_000)
        .map(|_| {
            (
                Vec3::new(dice.between(-1.0, -0.1), 1.0, dice.between(-1.0, -0.1)),
                Vec3::NEG_Y,
            )
        })
        .collect();
    for (ray, found) in rays.iter().zip(closest(&geometry, &rays)) {
        let point = geometry.surface_point(found.hit().expect("the floor"));
        let expected = Vec3::new(ray.0.x, 0.0, ray.0.z);
        let off = point.position.distance(expected);
        assert!(off < 2e-7, "{off} at {expected}");
    }
}
