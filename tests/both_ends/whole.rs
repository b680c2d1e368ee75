//! Whole paths in the measure of bidirectional path tracing: what they bring and the shares of strategies are those that joined
//! subpaths have, by the balance heuristic.
//!
//! Both are computed from the same vertices in different ways: subpaths carry throughputs of either direction and a recursion
//! of odds; whole paths are evaluated from the camera alone, adjoint corrections and all, and take products of densities.

use super::weights::{CAMERAS, LIGHTS, Pair, for_each_pair, light_draw, scene};
use crate::support::draws::stream;
use crate::support::verdict::say;
use chainlight::light::Endpoint;
use chainlight::path::bidirectional::{EndVertex, Weights};
use chainlight::path::mis::Heuristic;
use chainlight::path::whole::{Measured, WholePath, WholeVertex};
use chainlight::path::*;
use chainlight::scene::Scene;
use glam::Vec3;
use std::sync::Arc;

/// A subpath's vertex on a path that arrives along `direction`.
fn vertex(vertex: &EndVertex, direction: Vec3, joined: bool) -> WholeVertex {
    WholeVertex {
        surface: Scatterer {
            direction,
            ..vertex.surface
        },
        kind: if joined && vertex.kind == VERTEX_DISCRETE {
            VERTEX_SURFACE
        } else {
            vertex.kind
        },
    }
}

/// The path that strategy (s, t) makes, and its light.
fn path(pair: &Pair<'_>, s: usize, t: usize, draw: LightDraw) -> Option<(Vec<WholeVertex>, u32)> {
    let camera = &pair.camera[..t];
    let mut vertices: Vec<WholeVertex> = Vec::new();
    for (i, x) in camera.iter().enumerate() {
        vertices.push(vertex(x, x.surface.direction, i + 1 == t));
    }
    let from = camera[t - 1].surface.position;
    if s == 0 {
        let last = &camera[t - 1];
        let infinite = last.kind == VERTEX_INFINITE;
        let light = if infinite {
            pair.scene.lights.infinite().next()?
        } else {
            last.light
        };
        return Some((vertices, light));
    }
    let towards = |to: Vec3| (to.as_dvec3() - from.as_dvec3()).normalize().as_vec3();
    if s == 1 && t > 1 {
        let sample = pair.scene.lights.sample(from, draw.choice, draw.point)?;
        let infinite = pair.scene.lights.endpoint(sample.light) == Endpoint::Infinite;
        let surface = Scatterer {
            position: sample.position,
            normal: sample.normal,
            direction: sample.direction,
            ..pair.camera[0].surface
        };
        let kind = if infinite { VERTEX_INFINITE } else { VERTEX_LIGHT };
        vertices.push(WholeVertex { surface, kind });
        return Some((vertices, sample.light));
    }
    let joined = &pair.light[s - 1];
    let mut direction = if t > 1 {
        towards(joined.surface.position)
    } else {
        pair.scene.camera.project(from, joined.surface.position)?.direction
    };
    for (j, y) in pair.light[..s].iter().enumerate().rev() {
        vertices.push(vertex(y, direction, j + 1 == s));
        direction = -y.surface.direction;
    }
    Some((vertices, pair.light[0].light))
}

/// What one film position's filters add up to, which strategies seen by the lens multiply with.
fn filter(pair: &Pair<'_>, s: usize) -> Option<f32> {
    let from = pair.camera[0].surface.position;
    let view = pair.scene.camera.project(from, pair.light[s - 1].surface.position)?;
    pixel_of(pair.scene, view.film, 0.5).map(|(_, sum)| sum)
}

/// What one joined path says against what the whole path says.
struct Compared {
    /// |whole / joined − 1|, of the light.
    light: f64,
    /// |whole / joined − 1|, of the share of the strategy that joined it.
    share: f64,
}

/// Compares every path that the pairs of subpaths of a scene join. Of paths that `mistake` changes before they are measured.
fn compare(scene: &Arc<Scene>, mistake: impl Fn(&mut [WholeVertex])) -> Vec<Compared> {
    let mut stream = stream(2);
    let (mut compared, mut measured) = (Vec::new(), Measured::default());
    for_each_pair(scene, Heuristic::Balance, |pair| {
        for (s, t) in pair.strategies() {
            let draw = light_draw(&mut stream);
            let weighted = pair.value(s, t, draw, Weights::All);
            // Roulette, from the sixth vertex on, is of no density's concern: its chances are in what a subpath carries.
            if !pair.connects(s, t) || weighted.max_channel() <= 0.0 || t > 6 || s > 6 {
                continue;
            }
            let alone = pair.value(s, t, draw, Weights::Only(s as u32, t as u32));
            let (mut vertices, light) = path(pair, s, t, draw).expect("a path that brings light");
            let last = vertices[vertices.len() - 1].surface;
            // Along its surface a light subpath's direction is one of few of f32's numbers.
            if last.normal.dot(last.direction).abs() < 1e-6 {
                continue;
            }
            mistake(&mut vertices);
            let whole = WholePath {
                scene,
                vertices: &vertices,
                light,
            };
            let found = whole.measure(&mut measured);
            let filter = if t == 1 { filter(pair, s).expect("seen") } else { 1.0 };
            let light = found.map_or(0.0, |light| light.max_channel()) * filter;
            let share = measured.share(t);
            let expected = f64::from(weighted.max_channel() / alone.max_channel());
            compared.push(Compared {
                light: f64::from(light / weighted.max_channel() - 1.0).abs(),
                share: (share - expected).abs() / expected.max(1e-6),
            });
        }
    });
    compared
}

/// The worst deviations that rounding may make, in sums of a dozen f32 factors of which some are differences.
const LIGHT: f64 = 1e-3;
const SHARE: f64 = 1e-3;

#[test]
fn whole_paths_bring_what_joined_subpaths_bring_and_share_it_alike() {
    let mut failed = Vec::new();
    for (camera_name, camera) in CAMERAS {
        for (light_name, shape, light) in LIGHTS {
            let compared = compare(&scene(camera, shape, light), |_| {});
            let worst = |of: fn(&Compared) -> f64| compared.iter().map(of).fold(0.0, f64::max);
            let (light, share) = (worst(|c| c.light), worst(|c| c.share));
            let line = format!(
                "{camera_name}, {light_name}: {} paths, light off by {light:.1e}, shares by {share:.1e}",
                compared.len()
            );
            say(&line);
            if compared.len() < 100 || !(light < LIGHT && share < SHARE) {
                failed.push(line);
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn a_whole_path_that_arrives_a_hundredth_aside_is_seen() {
    let (_, camera) = CAMERAS[0];
    let (_, shape, light) = LIGHTS[0];
    let compared = compare(&scene(camera, shape, light), |vertices| {
        for vertex in &mut vertices[1..] {
            let direction = vertex.surface.direction;
            vertex.surface.direction = (direction + 0.01 * direction.any_orthonormal_vector()).normalize();
        }
    });
    let seen = compared.iter().filter(|c| !(c.light < LIGHT && c.share < SHARE));
    assert!(seen.count() * 2 > compared.len());
}
