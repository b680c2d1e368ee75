//! Near hits are not lost: sheets a hair apart.

use super::dice::Dice;
use super::world::{Line, World, closest, free};
use chainlight::geometry::offset_origin;
use glam::Vec3;

/// A ray from the lower of two sheets meets the upper one if their distance is this many offsets: a moved origin is one
/// offset off its sheet, and half an offset more by the rounding that the offset covers twice over.
const LEAST_GAP: f64 = 1.5;

/// Two parallel sheets, tilted anyhow, of all sizes, gaps and places: 1.3 million rays and segments each from the lower
/// one, none through the upper.
#[test]
fn near_sheets_are_never_passed() {
    let mut dice = Dice::new(41);
    let (mut judged, mut too_near) = (0, 0);
    for scale in [1e-4_f32, 1e-2, 1.0, 1e2, 1e4] {
        for gap in [1e-2_f32, 1e-3, 1e-4, 1e-5, 1e-6] {
            for distance in [0.0_f32, 1e-2, 1.0, 1e2, 1e4] {
                for tilted in [false, true] {
                    let center = dice.direction() * distance * scale;
                    let [x, y] = if tilted {
                        dice.plane()
                    } else {
                        [Vec3::X, Vec3::Z].map(|v| v.as_dvec3())
                    };
                    let normal = x.cross(y);
                    let size = f64::from(scale);
                    let at =
                        |u: f64, v: f64, h: f64| (center.as_dvec3() + (x * u + y * v + normal * h) * size).as_vec3();
                    let sheet =
                        |reach: f64, h: f64| [at(-reach, -reach, h), at(reach, -0.9 * reach, h), at(0.1, reach, h)];
                    let lower = sheet(1.0, 0.0);
                    let upper = sheet(8.0, f64::from(gap));
                    let geometry = World::default().mesh(&[lower]).mesh(&[upper]).compile().geometry;
                    let below: Vec<Line> = (0..6000)
                        .map(|_| {
                            let target = at(
                                f64::from(dice.between(-0.3, 0.3)),
                                f64::from(dice.between(-0.5, 0.3)),
                                0.0,
                            );
                            let origin = at(
                                f64::from(dice.between(-1.0, 1.0)),
                                f64::from(dice.between(-1.0, 1.0)),
                                -1.0,
                            );
                            (origin, (target - origin).normalize())
                        })
                        .collect();
                    let mut lines = Vec::new();
                    for found in closest(&geometry, &below) {
                        let Some(hit) = found.hit().filter(|hit| hit.instance == 0) else {
                            continue;
                        };
                        let point = geometry.surface_point(hit);
                        let [a, b, c] = upper.map(Vec3::as_dvec3);
                        let plane = (b - a).cross(c - a).normalize();
                        let height = plane.dot(a - point.position.as_dvec3()).abs();
                        if height < LEAST_GAP * f64::from(point.offset) {
                            too_near += 1;
                            continue;
                        }
                        let up = if point.geometric_normal.as_dvec3().dot(normal) > 0.0 {
                            1.0
                        } else {
                            -1.0
                        };
                        // Steep enough for the upper sheet, far wider than the gap, to be above.
                        let cosine = up * dice.magnitude(1e-2, 1.0);
                        let direction = dice.at_cosine(point.geometric_normal, cosine);
                        let origin = offset_origin(point.position, point.geometric_normal, point.offset, direction);
                        lines.push((origin, direction));
                    }
                    for (line, found) in lines.iter().zip(closest(&geometry, &lines)) {
                        assert_eq!(found.instance, 1, "{scale} {gap} {distance}: {line:?} {found:?}");
                    }
                    let segments: Vec<Line> = lines.iter().map(|&(p, d)| (p, p + d * scale * 1e3)).collect();
                    for (segment, free) in segments.iter().zip(free(&geometry, &segments)) {
                        assert!(!free, "{scale} {gap} {distance}: {segment:?}");
                    }
                    judged += lines.len();
                }
            }
        }
    }
    assert!(
        judged > 1_000_000,
        "{judged} judged, {too_near} nearer than the offset allows"
    );
}
