//! Rough lobes from the width of the hemisphere down to the smallest roughness, where they are far narrower than any cell of
//! the sphere: samples and densities meet in the plane of the facets' slopes, in units of the roughness. The facet's normal
//! is computed from the two directions, as `evaluate` does; chi-square tests of 300 000 samples in 402 cells.

use crate::support::cells::{Grid, angle};
use crate::support::materials::PLAIN;
use crate::support::rough::*;
use crate::support::verdict::Family;
use chainlight::material::{Model, Transport};
use glam::{DVec3, Vec3};

const SAMPLES: usize = 300_000;
const ALPHAS: [f32; 9] = [1.0, 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4];
const COSINES: [f32; 4] = [1.0, 0.6, 0.05, 1e-3];
const FAMILY: Family = Family {
    tests: 2 * ALPHAS.len() * (COSINES.len() + 3),
};
const SEES: f64 = 0.035;
/// The most that rounding a direction to `f32` may move a facet's normal, in units of the roughness: beyond, at grazing angles
/// on almost smooth surfaces, directions do not resolve the lobe that they are drawn from.
const RESOLVED: f32 = 0.011;

/// The plane of slopes over the roughness, by the angle around and s = 1 − 1 / √(1 + q²) of the slope's length q: facets of
/// GGX are spread almost evenly over it, whatever the roughness and wherever they are seen from.
fn plane() -> Grid {
    Grid::around([0.0, 1.0])
}

fn place(h: DVec3, alpha: f32) -> [f64; 2] {
    let (x, y) = (h.x / f64::from(alpha), h.y / f64::from(alpha));
    let z = h.z / (x * x + y * y + h.z * h.z).sqrt();
    [1.0 - z, angle(x, y)]
}

/// The normal of a place, and the solid angle around it per unit of the plane.
fn normal(s: f64, phi: f64, alpha: f32) -> (DVec3, f64) {
    let (alpha, z) = (f64::from(alpha), 1.0 - s);
    let q = (1.0 - z * z).sqrt() / z;
    let h = DVec3::new(alpha * q * libm::cos(phi), alpha * q * libm::sin(phi), 1.0).normalize();
    (h, alpha * alpha * h.z * h.z * h.z / (z * z * z))
}

fn wide(w: Vec3) -> DVec3 {
    w.as_dvec3().normalize()
}

#[test]
fn rough_lobes_follow_their_densities() {
    let mut case = 500;
    for distribution in DISTRIBUTIONS {
        for alpha in ALPHAS {
            for cosine in COSINES {
                case += 1;
                if 3e-8 / (cosine * alpha) > RESOLVED {
                    continue;
                }
                let (metal, wi) = (mirror(distribution, [alpha; 2]), incoming(cosine));
                let i = wide(wi);
                let counts = counts(&plane(), &metal, wi, draws(case, SAMPLES), |sample| {
                    place((i + wide(sample.wo)).normalize(), alpha)
                });
                // Grazing light sees facets on one side alone: the edge runs along cells.
                let points = if cosine < 0.01 { Points::Spread } else { Points::Rows };
                let share = |stated: f32| {
                    let metal = mirror(distribution, [stated; 2]);
                    expected(&plane(), points, 0.0, move |s, phi| {
                        let (h, solid_angle) = normal(s, phi, alpha);
                        let cosine = i.dot(h);
                        if cosine <= 0.0 {
                            return 0.0;
                        }
                        let wo = (h * (2.0 * cosine) - i).as_vec3();
                        let evaluated = metal.evaluate(&PLAIN, wi, wo, Transport::Radiance);
                        // Directions spread four times the cosine as much as normals.
                        f64::from(evaluated.density) * 4.0 * cosine * solid_angle
                    })
                };
                let name = format!("{distribution:?} {alpha}, cosine {cosine}");
                FAMILY.follows(&name, &counts, &share(alpha), SEES);
                if cosine == 0.6 {
                    FAMILY.refuses(&format!("{name}, 5 % off"), &counts, &share(0.95 * alpha));
                }
            }
        }
    }
}

#[test]
fn refracted_lobes_follow_their_densities() {
    const INDEX: f64 = 1.5;
    let mut case = 600;
    for distribution in DISTRIBUTIONS {
        for alpha in ALPHAS {
            for cosine in [1.0, 0.6, 0.05] {
                case += 1;
                let (glass, wi) = (ground(distribution, [alpha; 2], INDEX as f32), incoming(cosine));
                let i = wide(wi);
                let half = |wo: Vec3| -(i + wide(wo) * INDEX).normalize();
                // Reflections are tested above: here they are counted with what is absorbed.
                let mut counts = vec![0; plane().len() + 2];
                for draw in draws(case, SAMPLES) {
                    let cell = match glass.sample(&PLAIN, wi, draw, Transport::Radiance) {
                        Some(sample) if sample.wo.z < 0.0 => plane().cell(place(half(sample.wo), alpha)),
                        _ => plane().len() + 1,
                    };
                    counts[cell] += 1;
                }
                let share = |stated: f32| {
                    let glass = ground(distribution, [stated; 2], INDEX as f32);
                    expected(&plane(), Points::Spread, 0.0, move |s, phi| {
                        let (h, solid_angle) = normal(s, phi, alpha);
                        let cosine = i.dot(h);
                        if cosine <= 0.0 {
                            return 0.0;
                        }
                        let behind = (1.0 - (1.0 - cosine * cosine) / (INDEX * INDEX)).sqrt();
                        let wo = -(i / INDEX) + h * (cosine / INDEX - behind);
                        if wo.z >= 0.0 {
                            return 0.0;
                        }
                        let evaluated = glass.evaluate(&PLAIN, wi, wo.as_vec3(), Transport::Radiance);
                        let bend = INDEX * behind - cosine;
                        f64::from(evaluated.density) * bend * bend / (INDEX * INDEX * behind) * solid_angle
                    })
                };
                let name = format!("{distribution:?} {alpha}, cosine {cosine}, refracted");
                FAMILY.follows(&name, &counts, &share(alpha), SEES);
                if cosine == 0.6 {
                    FAMILY.refuses(&format!("{name}, 5 % off"), &counts, &share(0.95 * alpha));
                }
            }
        }
    }
}
