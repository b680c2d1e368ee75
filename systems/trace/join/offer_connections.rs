//! What strategies offer.

use super::super::super::tile::{Queues, SceneRef, StrategiesRef, TilePlace};
use super::super::draws::{DrawColumns, Draws};
use super::join_layers::{Split, SplitColumns};
use super::join_loop::JoinCursor;
use super::subpaths::{SubpathColumns, SubpathTables, lens};
use crate::chain::{ProposedClass, Signature, StateClass};
use crate::color::Rgb;
use crate::geometry::{RayOrigin, SegmentTarget};
use crate::layer::SegmentLayer;
use crate::path::bidirectional::{EndVertex, Join, Offer, Strategies};
use crate::path::*;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Local, Res, ResMut, SystemParam};
use glam::Vec3;

/// Segments on offer.
#[derive(SystemParam)]
pub struct Segments<'w, 's> {
    chains: Write<'w, 's, RayChain, RayTable>,
    origins: Write<'w, 's, RayOrigin, RayTable>,
    targets: Write<'w, 's, SegmentTarget, RayTable>,
    lights: Write<'w, 's, SegmentLight, RayTable>,
    pixels: Write<'w, 's, SegmentPixel, RayTable>,
    classes: Write<'w, 's, SegmentClass, RayTable>,
    layers: Write<'w, 's, SegmentLayer, RayTable>,
}

struct SegmentColumns<'a> {
    chains: &'a mut [RayChain],
    origins: &'a mut [RayOrigin],
    targets: &'a mut [SegmentTarget],
    lights: &'a mut [SegmentLight],
    pixels: &'a mut [SegmentPixel],
    classes: &'a mut [SegmentClass],
    layers: &'a mut [SegmentLayer],
    len: usize,
}

/// The lists of light that chains bring to the film.
#[derive(SystemParam)]
pub struct Splats<'w, 's> {
    counts: Write<'w, 's, ProposedSplatCount, ChainTable>,
    pixels: Write<'w, 's, SplatPixel, ProposedSplatTable>,
    colors: Write<'w, 's, SplatColor, ProposedSplatTable>,
    brightest: Write<'w, 's, BrightestLight, ChainTable>,
    classes: Write<'w, 's, ProposedClass, ChainTable>,
}

/// A chain's subpaths, read once for all of its strategies.
#[derive(Default)]
pub struct Pair {
    camera: Vec<EndVertex>,
    light: Vec<EndVertex>,
}

/// Offers the next strategies, as many as the ray table has room for: writes the segment of each that would bring light, and
/// what it would bring. When a chain's turn comes, its list begins with the light that its camera subpath met.
pub fn offer_connections(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    strategies: Res<StrategiesRef>,
    mut cursor: ResMut<JoinCursor>,
    mut queues: ResMut<Queues>,
    draws: Draws,
    tables: SubpathTables,
    film: Read<FilmPixel, ChainTable>,
    mut segments: Segments,
    mut splats: Splats,
    mut pair: Local<Pair>,
    mut split: Split,
) {
    let (scene, strategies, place) = (&*scene.0, strategies.0, &*place);
    let (draws, subpaths, film) = (draws.columns(place), tables.columns(), film.rows());
    let (counts, pixels, colors) = (splats.counts.rows(), splats.pixels.rows(), splats.colors.rows());
    let (brightest, classes) = (splats.brightest.rows(), splats.classes.rows());
    let mut segments = SegmentColumns {
        chains: segments.chains.rows(),
        origins: segments.origins.rows(),
        targets: segments.targets.rows(),
        lights: segments.lights.rows(),
        pixels: segments.pixels.rows(),
        classes: segments.classes.rows(),
        layers: segments.layers.rows(),
        len: 0,
    };
    let room = place.capacity as usize;
    let mut split = split.columns();
    while cursor.chain < place.chains as usize {
        let chain = cursor.chain;
        pair.read(scene, place, &draws, &subpaths, chain);
        let join = Join {
            scene,
            strategies,
            camera: &pair.camera,
            light: &pair.light,
        };
        if *cursor == JoinCursor::at(chain) {
            if let Some(split) = &mut split {
                split.begin(&join, place, chain);
            }
            let (met, most, class) = met(&join);
            let has_pixel = place.lights_from > 0;
            counts.put(chain, u32::from(has_pixel));
            if has_pixel {
                pixels.put(chain, film.at(chain));
                colors.put(chain, met);
            }
            if !brightest.is_empty() {
                brightest.put(chain, most);
                classes.put(chain, class.0);
            }
        }
        let (done, next) = offer_all(&join, place, &draws, *cursor, room, &mut segments, split.as_mut());
        if !done {
            *cursor = next;
            break;
        }
        if let Some(split) = &mut split {
            split.end(&join);
        }
        *cursor = JoinCursor::at(chain + 1);
    }
    queues.segments = segments.len;
}

impl Pair {
    fn read(
        &mut self,
        scene: &Scene,
        place: &TilePlace,
        draws: &DrawColumns<'_>,
        subpaths: &SubpathColumns<'_>,
        chain: usize,
    ) {
        if place.lights_from > 0 {
            subpaths.read(place, chain, &mut self.camera);
        } else {
            // Light tracing has no camera subpaths: it needs the point of the lens alone.
            let numbers = if scene.camera.has_aperture() {
                draws.lens(chain)
            } else {
                LENS_CENTER
            };
            let position = scene.camera.lens_point(numbers);
            self.camera.clear();
            self.camera.push(if scene.camera.is_directional() {
                lens(
                    position,
                    VERTEX_INFINITE,
                    scene.camera.ray(glam::Vec2::ZERO, numbers).direction,
                )
            } else {
                lens(position, VERTEX_LENS, Vec3::ZERO)
            });
        }
        subpaths.read(place, place.lights_from as usize + chain, &mut self.light);
    }
}

/// The light that the camera subpath met, and the class of the path that brings the most of it.
fn met(join: &Join<'_>) -> (Rgb, f32, StateClass) {
    let (mut sum, mut most, mut class) = (Rgb::BLACK, 0.0, StateClass::default());
    for t in 2..=join.camera.len() {
        if !join.strategies.has(0, t as u32) {
            continue;
        }
        let light = join.met(t);
        sum += light;
        let target = target_of(light);
        if target > most {
            (most, class) = (target, class_of(join, 0, t));
        }
    }
    (sum, most, class)
}

/// Offers the strategies from `cursor` on. Whether all found room, and the first that did not.
fn offer_all(
    join: &Join<'_>,
    place: &TilePlace,
    draws: &DrawColumns<'_>,
    mut cursor: JoinCursor,
    room: usize,
    segments: &mut SegmentColumns<'_>,
    mut split: Option<&mut SplitColumns<'_>>,
) -> (bool, JoinCursor) {
    let (scene, chain) = (join.scene, cursor.chain);
    let light_path = place.lights_from as usize + chain;
    while cursor.t <= join.camera.len() {
        let t = cursor.t;
        // Edges: s + t − 1.
        let longest = (scene.max_depth as usize + 1).saturating_sub(t);
        let connects = t == 1 || connects(scene, &join.camera[t - 1]);
        let most = if connects {
            longest.min(join.light.len().max(1))
        } else {
            0
        };
        while cursor.s < most {
            cursor.s += 1;
            let s = cursor.s;
            if !join.strategies.has(s as u32, t as u32) {
                continue;
            }
            let (offer, pixel) = if t == 1 {
                if s > join.light.len() || (s > 1 && !connects_light(scene, join, s)) {
                    continue;
                }
                let Some(seen) = join.seen(s, draws.splat(light_path, s as u32 - 1)) else {
                    continue;
                };
                (seen.offer, seen.pixel)
            } else {
                let offer = if s == 1 {
                    join.sampled(t, draws.light(chain, t as u32 - 1))
                } else if connects_light(scene, join, s) {
                    join.joined(s, t)
                } else {
                    None
                };
                let Some(offer) = offer else { continue };
                (offer, OWN_PIXEL)
            };
            if segments.len == room {
                // Offered again in the next round.
                cursor.s -= 1;
                return (false, cursor);
            }
            if let Some(split) = &mut split {
                segments
                    .layers
                    .put(segments.len, split.offered(join, s, t, &offer) as u32);
            }
            segments.push(chain, &offer, pixel, || class_of(join, s, t));
        }
        cursor.t += 1;
        cursor.s = 0;
    }
    (true, cursor)
}

/// Whether a vertex is on a surface that scatters with a density.
fn connects(scene: &Scene, vertex: &EndVertex) -> bool {
    vertex.kind != VERTEX_INFINITE && !scene.materials.kind(vertex.surface.material).is_discrete()
}

fn connects_light(scene: &Scene, join: &Join<'_>, s: usize) -> bool {
    connects(scene, &join.light[s - 1])
}

/// Length and signature of the path that strategy (s, t) makes.
fn class_of(join: &Join<'_>, s: usize, t: usize) -> StateClass {
    let mut signature = Signature::default();
    // The last vertex of a camera subpath that met a light does not scatter.
    let scattering = if s == 0 { t - 1 } else { t };
    for vertex in join.camera[..scattering].iter().skip(1) {
        signature = signature.then(vertex.kind == VERTEX_DISCRETE);
    }
    for vertex in join.light[..s.min(join.light.len())].iter().skip(1).rev() {
        signature = signature.then(vertex.kind == VERTEX_DISCRETE);
    }
    StateClass::new(0, (s + t - 1) as u32, signature)
}

impl SegmentColumns<'_> {
    fn push(&mut self, chain: usize, offer: &Offer, pixel: u32, class: impl FnOnce() -> StateClass) {
        let Self { len, .. } = *self;
        self.chains.put(len, chain as u32);
        self.origins.put(len, offer.origin);
        self.targets.put(len, offer.target);
        self.lights.put(len, offer.value);
        self.pixels.put(len, pixel);
        if !self.classes.is_empty() {
            self.classes.put(len, class().0);
        }
        self.len = len + 1;
    }
}

/// Which strategies a plan has.
impl From<Strategies> for StrategiesRef {
    fn from(strategies: Strategies) -> Self {
        Self(strategies)
    }
}
