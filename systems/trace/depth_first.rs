//! The depth-first path tracer: one path after another, as most renderers work. It is the oracle of the staged one (with
//! the same draws it must give the same light, bit for bit) and the honest baseline of its benchmark.

use super::super::evaluate::Brightest;
use super::super::tile::{Counters, SceneRef, TilePlace, connectable};
use super::extend_paths::met_at_infinity;
use crate::chain::StateClass;
use crate::color::Rgb;
use crate::geometry::{
    Hit, HitColumns, HitDistance, HitInstance, HitPrimitive, HitUv, NO_HIT, NOT_EMITTING, RayColumns, RayDirection,
    RayOrigin, SegmentColumns, SegmentTarget, SegmentTransmittance, SurfacePoint, TexturePoint, offset_origin,
};
use crate::material::{ScatterDraw, Transport};
use crate::path::mis::Heuristic;
use crate::path::*;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};
use glam::{Vec2, Vec3};

/// A ray table of one lane group, of which one ray is used.
#[derive(SystemParam)]
pub struct OneRay<'w, 's> {
    origin: Write<'w, 's, RayOrigin, RayTable>,
    direction: Write<'w, 's, RayDirection, RayTable>,
    distance: Write<'w, 's, HitDistance, RayTable>,
    instance: Write<'w, 's, HitInstance, RayTable>,
    primitive: Write<'w, 's, HitPrimitive, RayTable>,
    uv: Write<'w, 's, HitUv, RayTable>,
    target: Write<'w, 's, SegmentTarget, RayTable>,
    transmittance: Write<'w, 's, SegmentTransmittance, RayTable>,
}

/// The columns of [`OneRay`] as slices, with the scene they are traced against.
pub(in super::super) struct Tracer<'a> {
    scene: &'a Scene,
    heuristic: Heuristic,
    pub(super) counters: &'a mut Counters,
    origin: &'a mut [RayOrigin],
    direction: &'a mut [RayDirection],
    distance: &'a mut [HitDistance],
    instance: &'a mut [HitInstance],
    primitive: &'a mut [HitPrimitive],
    uv: &'a mut [HitUv],
    target: &'a mut [SegmentTarget],
    transmittance: &'a mut [SegmentTransmittance],
}

/// Traces one whole path per chain and writes its contribution.
pub fn trace_depth_first(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut counters: ResMut<Counters>,
    keys: Read<ChainKey, ChainTable>,
    pixels: Read<FilmPixel, ChainTable>,
    mut contributions: Write<Contribution, ChainTable>,
    mut ray: OneRay,
) {
    let (keys, pixels, contributions) = (keys.rows(), pixels.rows(), contributions.rows());
    let mut tracer = Tracer::new(&scene.0, place.heuristic, &mut counters, &mut ray);
    for chain in 0..place.chains as usize {
        let key = place.key(chain, keys.at(chain));
        let film = film_position(&scene.0, key, pixels.at(chain));
        contributions.put(chain, tracer.trace(film, &mut KeyedDraws(key)).0);
    }
}

impl<'a> Tracer<'a> {
    /// The tracer over `ray`'s columns, whose weights are made as `heuristic` says.
    pub(in super::super) fn new(
        scene: &'a Scene,
        heuristic: Heuristic,
        counters: &'a mut Counters,
        ray: &'a mut OneRay<'_, '_>,
    ) -> Self {
        Self {
            scene,
            heuristic,
            counters,
            origin: ray.origin.rows(),
            direction: ray.direction.rows(),
            distance: ray.distance.rows(),
            instance: ray.instance.rows(),
            primitive: ray.primitive.rows(),
            uv: ray.uv.rows(),
            target: ray.target.rows(),
            transmittance: ray.transmittance.rows(),
        }
    }

    /// The radiance that one path through a film position estimates, and the classes of the path that brings the most of
    /// it.
    pub(in super::super) fn trace(&mut self, film: Vec2, draws: &mut impl PathDraws) -> (Rgb, StateClass) {
        let scene = self.scene;
        let lens = if scene.camera.has_aperture() {
            draws.lens()
        } else {
            LENS_CENTER
        };
        let ray = scene.camera.ray(film, lens);
        let (mut position, mut direction) = (ray.origin, ray.direction);
        let mut origin = position;
        let (mut radiance, mut throughput, mut judged, mut scale) = (Rgb::BLACK, Rgb::ONE, Rgb::ONE, 1.0);
        let (mut density, mut kind) = (0.0, VERTEX_LENS);
        let mut brightest = Brightest::default();
        for depth in 1..=scene.max_depth {
            let Some((hit, point)) = self.closest(origin, direction) else {
                if scene.lights.has_infinite() {
                    self.counters.vertices += 1;
                    let before = connectable(kind).then_some((position, density));
                    let met = throughput * met_at_infinity(scene, direction, before, self.heuristic);
                    radiance += met;
                    brightest.see(met, Rgb::BLACK, depth, false);
                }
                break;
            };
            self.counters.vertices += 1;
            let met = throughput * self.emission(&point, direction, position, density, kind);
            radiance += met;
            if depth == scene.max_depth {
                brightest.see(met, Rgb::BLACK, depth, false);
                break;
            }
            let front = point.geometric_normal.dot(direction) < 0.0;
            let material = scene.materials.facing(point.material, front);
            let local = local_coordinates(scene, hit);
            let scatterer = Scatterer {
                position: point.position,
                normal: point.geometric_normal,
                shading_normal: point.shading_normal,
                offset: point.offset,
                material,
                uv: local.uv,
                tangent: local.tangent,
                direction,
            };
            draws.reach(depth);
            let model = scene.materials.kind(material);
            let mut connected = Rgb::BLACK;
            if !model.is_discrete()
                && let Some(connection) = scatterer.connect(scene, draws.light(depth), self.heuristic)
            {
                let passed = self.transmittance(connection.origin, connection.target);
                connected = throughput * (connection.value * passed);
                radiance += connected;
            }
            let outcome = scatterer.scatter(Transport::Radiance, |wi| {
                let draw = ScatterDraw {
                    direction: draws.scatter(depth),
                    lobe: if model.chooses_lobes() { draws.lobe(depth) } else { 0.0 },
                };
                let materials = &scene.materials;
                materials.sample(material, scatterer.uv, wi, draw, Transport::Radiance)
            });
            let discrete = outcome.as_ref().is_some_and(|(_, outcome)| outcome.discrete);
            brightest.see(met, connected, depth, discrete);
            let Some((onward, outcome)) = outcome else { break };
            scale *= outcome.relative_ior * outcome.relative_ior;
            judged *= outcome.ratio;
            let survival = roulette::survival(depth, judged, scale);
            let mut ratio = outcome.ratio;
            if survival < 1.0 {
                if draws.roulette(depth) >= survival {
                    break;
                }
                ratio = ratio / survival;
                judged = judged / survival;
            }
            throughput *= ratio;
            density = outcome.density;
            kind = if outcome.discrete {
                VERTEX_DISCRETE
            } else {
                VERTEX_SURFACE
            };
            (position, direction) = (point.position, onward);
            origin = offset_origin(point.position, point.geometric_normal, point.offset, direction);
        }
        (radiance, brightest.class())
    }

    /// Light that `point` sends back along the path, weighted against sampling it from the vertex before.
    fn emission(&self, point: &SurfacePoint, direction: Vec3, previous: Vec3, density: f32, kind: u32) -> Rgb {
        if point.light == NOT_EMITTING {
            return Rgb::BLACK;
        }
        let lights = &self.scene.lights;
        let emitted = lights.radiance(point.light, point.geometric_normal, -direction);
        if !connectable(kind) {
            return emitted;
        }
        let sampled = lights.density(point.light, previous, point.position, point.geometric_normal);
        emitted * self.heuristic.share(density, sampled)
    }

    pub(super) fn closest(&mut self, origin: Vec3, direction: Vec3) -> Option<(Hit, SurfacePoint)> {
        self.origin.put(0, origin);
        self.direction.put(0, direction);
        let rays = RayColumns {
            origin: self.origin,
            direction: self.direction,
            len: 1,
        };
        let hits = HitColumns {
            distance: self.distance,
            instance: self.instance,
            primitive: self.primitive,
            uv: self.uv,
        };
        self.scene.geometry.closest_hits(rays, hits);
        self.counters.rays += 1;
        let instance = self.instance.at(0);
        (instance != NO_HIT).then(|| {
            let hit = Hit {
                instance,
                primitive: self.primitive.at(0),
                uv: self.uv.at(0),
            };
            (hit, self.scene.geometry.surface_point(hit))
        })
    }

    pub(super) fn transmittance(&mut self, origin: Vec3, target: Vec3) -> Rgb {
        self.origin.put(0, origin);
        self.target.put(0, target);
        let segments = SegmentColumns {
            origin: self.origin,
            target: self.target,
            len: 1,
        };
        self.scene.geometry.transmittances(segments, self.transmittance);
        self.counters.segments += 1;
        self.transmittance.at(0)
    }
}

/// Texture coordinates and tangent, each where some material asks for it.
pub(super) fn local_coordinates(scene: &Scene, hit: Hit) -> TexturePoint {
    let needs = scene.materials.needs();
    if !(needs.textures || needs.tangents) {
        return TexturePoint::NONE;
    }
    let local = scene.geometry.texture_point(hit);
    TexturePoint {
        uv: if needs.textures { local.uv } else { Vec2::ZERO },
        tangent: if needs.tangents { local.tangent } else { Vec3::ZERO },
    }
}
