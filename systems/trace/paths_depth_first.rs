//! Proposals of whole paths made depth first: one chain after another, each from its mutation's choice to the densities of both
//! ways, as most renderers work. It is the oracle of the staged ones (the same draws make the same proposals, bit for bit) and the
//! honest baseline of their benchmark. What a mutation keeps, steers and weighs is the same code.

use super::super::chains::{Keys, Mutations};
use super::super::evaluate::{Found, FoundPath};
use super::super::propose::paths::moved::log_densities;
use super::super::propose::paths::steering::Reached;
use super::super::propose::paths::view::StatePaths;
use super::super::propose::{MovesPaths, PathProposal, PathView, Way};
use super::super::tile::{Counters, FilmBlocks, SceneRef, TilePlace};
use super::depth_first::{OneRay, Tracer, local_coordinates};
use crate::chain::{ChosenMutation, ForwardDensity, ReverseDensity};
use crate::color::Rgb;
use crate::geometry::{NOT_EMITTING, offset_origin};
use crate::material::{ScatterDraw, Transport};
use crate::path::mis::Heuristic;
use crate::path::whole::*;
use crate::path::*;
use crate::sampling::StreamKey;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Local, Res, ResMut, SystemParam};
use glam::Vec2;

/// What is read of states beside their paths.
#[derive(SystemParam)]
pub struct States<'w, 's> {
    keys: Keys<'w, 's>,
    chosen: Read<'w, 's, ChosenMutation, ChainTable>,
    lights: Read<'w, 's, PathLight, ChainTable>,
    pixels: Read<'w, 's, PathPixel, ChainTable>,
    paths: StatePaths<'w, 's>,
}

/// What is written of proposals.
#[derive(SystemParam)]
pub struct Proposals<'w, 's> {
    found: Found<'w, 's>,
    edges: Write<'w, 's, ProposedEdges, ChainTable>,
    forward: Write<'w, 's, ForwardDensity, ChainTable>,
    reverse: Write<'w, 's, ReverseDensity, ChainTable>,
}

/// Room to make a proposal in.
#[derive(Default)]
pub struct Room {
    camera: Vec<WholeVertex>,
    light: Vec<WholeVertex>,
    measured: Measured,
}

/// Makes the proposal of every chain in turn: what its mutation keeps, both subpaths, the edge that joins them, what the path brings,
/// and the densities of both ways.
pub fn propose_paths_depth_first(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    blocks: Res<FilmBlocks>,
    mutations: Res<Mutations>,
    mut counters: ResMut<Counters>,
    states: States,
    mut proposals: Proposals,
    mut ray: OneRay,
    mut room: Local<Room>,
) {
    let (keys, chosen) = (states.keys.columns(), states.chosen.rows());
    let (lights, pixels, paths) = (states.lights.rows(), states.pixels.rows(), states.paths.columns());
    let (edges, forward, reverse) = (
        proposals.edges.rows(),
        proposals.forward.rows(),
        proposals.reverse.rows(),
    );
    let mut found = proposals.found.columns();
    let mut tracer = Tracer::new(&scene.0, Heuristic::default(), &mut counters, &mut ray);
    for chain in 0..place.chains as usize {
        found.nothing(chain);
        edges.put(chain, 0);
        forward.put(chain, 0.0);
        reverse.put(chain, 0.0);
        let number = chosen.at(chain) as usize;
        // A plan has none that cannot.
        let Some(mutation) = mutations.moves_paths(number) else {
            continue;
        };
        let path = paths.of(&scene.0, &place, chain);
        if path.edges == 0 && number != mutations.independent() {
            continue;
        }
        let key = keys.at(chain);
        let Some(proposal) = mutation.propose(&path, key) else {
            continue;
        };
        let maker = Maker {
            scene: &scene.0,
            place: &place,
            mutation,
            key,
            state: State {
                path,
                light: lights.at(chain),
                pixel: pixels.at(chain),
            },
            proposal,
        };
        let Some(made) = maker.make(&mut tracer, &mut room) else {
            continue;
        };
        let Made {
            t,
            k,
            seen,
            light,
            passing,
        } = made;
        edges.put(chain, k);
        let Room { camera, measured, .. } = &mut *room;
        let vertices = &camera[..];
        let whole = WholePath {
            scene: &scene.0,
            vertices,
            light,
        };
        let Some(value) = whole.measure(measured) else {
            continue;
        };
        let Some(seen) = seen else { continue };
        let made = FoundPath {
            value: value * passing,
            vertices,
            measured,
            light,
            seen,
        };
        if !found.put(&scene.0, &place, &blocks, chain, &made) {
            continue;
        }
        let (rows, ends) = (found.rows(), found.ends(chain, k));
        let way = Way {
            from: path,
            to: PathView::new(&scene.0, &place, chain, ends, &rows),
            kept: proposal.kept,
            made: t,
            is_back: false,
            key,
        };
        let (there, back) = log_densities(mutation, way);
        forward.put(chain, there);
        reverse.put(chain, back);
    }
}

/// A chain's state.
struct State<'a> {
    path: PathView<'a>,
    light: u32,
    pixel: u32,
}

/// What was made of a proposal.
struct Made {
    /// Vertices of its camera subpath.
    t: u32,
    /// Its edges.
    k: u32,
    /// Where it is seen, if it is.
    seen: Option<FilmPlace>,
    /// The light that it ends on.
    light: u32,
    /// What passes the edge that joins its subpaths.
    passing: Rgb,
}

/// What makes a proposal of a state.
struct Maker<'a> {
    scene: &'a Scene,
    place: &'a TilePlace,
    mutation: &'a dyn MovesPaths,
    key: StreamKey,
    state: State<'a>,
    proposal: PathProposal,
}

impl Maker<'_> {
    /// Grows both subpaths and joins them; leaves the path in the room's camera subpath.
    fn make(&self, tracer: &mut Tracer<'_>, room: &mut Room) -> Option<Made> {
        let (scene, key) = (self.scene, self.key);
        let [mut t, s] = self.proposal.made;
        let Room { camera, light, .. } = room;
        let (started, met) = self.grow_from_camera(tracer, camera);
        let mut sent = self.grow_from_light(tracer, light);
        if self.proposal.to_joint {
            t = camera.len() as u32;
            if t < 2 || camera[t as usize - 1].kind == VERTEX_DISCRETE {
                return None;
            }
        }
        if camera.len() != t as usize {
            return None;
        }
        let k = s + t - 1;
        let mut passing = Rgb::ONE;
        if s > 0 {
            let x = &camera[t as usize - 1];
            if t > 1 && x.kind == VERTEX_INFINITE {
                return None;
            }
            if s == 1 && self.proposal.kept[1] == 0 && t > 1 {
                let draw = KeyedDraws(key).light(t - 1);
                let (number, end) = WholeVertex::sampled_light(scene, x.surface.position, draw)?;
                light.clear();
                light.push(end);
                sent = number;
            }
            if light.len() != s as usize {
                return None;
            }
            let (origin, target) = segment(scene, x, &light[s as usize - 1], t == 1)?;
            passing = tracer.transmittance(origin, target);
        }
        if passing.is_black() || k < self.place.shortest {
            return None;
        }
        let ends_on = if s == 0 { met } else { sent };
        let seen = if t == 1 {
            let y = light[s as usize - 1].surface.position;
            FilmPlace::by_lens(scene, key, camera[0].surface.position, y)
        } else {
            let (pixel, film) = started;
            FilmPlace::through(scene, key, film, (self.proposal.kept[0] != 1).then_some(pixel))
        };
        let ends_on = complete(scene, key, camera, light[..s as usize].iter().rev().copied(), ends_on)?;
        Some(Made {
            t,
            k,
            seen,
            light: ends_on,
            passing,
        })
    }

    /// The subpath from the camera: the pixel and place that it is started through, and the light that its last vertex is on.
    fn grow_from_camera(&self, tracer: &mut Tracer<'_>, path: &mut Vec<WholeVertex>) -> ((u32, Vec2), u32) {
        let Self {
            scene, proposal, state, ..
        } = self;
        let (made, kept) = (proposal.made[0], proposal.kept[0]);
        path.clear();
        let mut direction = None;
        let started = match kept {
            0 => {
                let lens = if scene.camera.has_aperture() {
                    KeyedDraws(self.key).lens()
                } else {
                    LENS_CENTER
                };
                let start = CameraStart::draw(scene, self.key, lens);
                path.push(start.vertex);
                direction = Some(start.direction);
                (start.pixel, start.film)
            }
            _ => {
                path.extend((0..kept).map(|depth| WholeVertex::kept(|i| state.path.vertex(i), depth, kept, None)));
                (state.pixel, state.path.film)
            }
        };
        let mut through = started;
        if let Some(film) = proposal.film {
            let ray = scene.camera.ray_from(path[0].surface.position, film);
            if scene.camera.is_directional() {
                path[0] = WholeVertex::lens(scene, ray.origin, ray.direction);
            }
            direction = Some(ray.direction);
            through = (started.0, film);
        }
        let met = self.grow(tracer, path, made, direction, false);
        (through, met)
    }

    /// The subpath from the light, and the light that it starts on.
    fn grow_from_light(&self, tracer: &mut Tracer<'_>, path: &mut Vec<WholeVertex>) -> u32 {
        let Self {
            scene, proposal, state, ..
        } = self;
        let ([t, made], kept) = (proposal.made, proposal.kept[1]);
        path.clear();
        let (mut direction, mut light) = (None, state.light);
        match kept {
            0 if made > 1 || (made, t) == (1, 1) => {
                let Some(start) = LightStart::draw(scene, KeyedDraws(self.key).emission()) else {
                    return NOT_EMITTING;
                };
                path.push(start.vertex);
                (direction, light) = (Some(start.direction), start.light);
            }
            0 => return NOT_EMITTING,
            _ => {
                let from_light = Some(state.path.edges);
                path.extend(
                    (0..kept).map(|depth| WholeVertex::kept(|i| state.path.vertex(i), depth, kept, from_light)),
                );
            }
        }
        if let Some(steered) = proposal.light {
            if kept == 1 && path[0].kind == VERTEX_INFINITE {
                path[0].surface.position = steered.origin;
            }
            direction = Some(steered.direction);
        }
        self.grow(tracer, path, made, direction, true);
        light
    }

    /// Grows a subpath to `made` vertices, or as far as it comes; its next ray goes in the direction `next`, if that is known. The
    /// light that its last vertex is on.
    fn grow(
        &self,
        tracer: &mut Tracer<'_>,
        path: &mut Vec<WholeVertex>,
        made: u32,
        mut next: Option<glam::Vec3>,
        from_light: bool,
    ) -> u32 {
        let (scene, mut met) = (self.scene, NOT_EMITTING);
        while path.len() < made as usize {
            let depth = path.len() as u32 - 1;
            let to_joint = self.proposal.to_joint && !from_light && depth > 0;
            let material = path[depth as usize].surface.material;
            if to_joint && !scene.materials.kind(material).has_discrete_lobe() {
                break;
            }
            let Some(direction) = next.take().or_else(|| self.scatter(path, depth, from_light)) else {
                break;
            };
            // It was scattered, but into no discrete lobe.
            if to_joint && path[depth as usize].kind != VERTEX_DISCRETE {
                break;
            }
            let last = &path[depth as usize].surface;
            let (position, normal) = (last.position, last.normal);
            let origin = offset_origin(position, normal, last.offset, direction);
            let Some((hit, point)) = tracer.closest(origin, direction) else {
                if !from_light && scene.lights.has_infinite() {
                    tracer.counters.vertices += 1;
                    // The vertex has the direction in which its light travels, and no position.
                    let mut end = WholeVertex::end(VERTEX_INFINITE, position, -direction, 0.0);
                    end.surface.direction = direction;
                    path.push(end);
                }
                return NOT_EMITTING;
            };
            tracer.counters.vertices += 1;
            let front = point.geometric_normal.dot(direction) < 0.0;
            let local = local_coordinates(scene, hit);
            met = point.light;
            path.push(WholeVertex {
                surface: Scatterer {
                    position: point.position,
                    normal: point.geometric_normal,
                    shading_normal: point.shading_normal,
                    offset: point.offset,
                    material: scene.materials.facing(point.material, front),
                    uv: local.uv,
                    tangent: local.tangent,
                    direction,
                },
                kind: VERTEX_SURFACE,
            });
        }
        met
    }

    /// The direction in which a subpath goes on from its last vertex, at `depth`.
    fn scatter(&self, path: &mut [WholeVertex], depth: u32, from_light: bool) -> Option<glam::Vec3> {
        let (scene, current) = (self.scene, &self.state.path);
        let vertex = path.last_mut()?;
        let keyed = if from_light { depth | LIGHT_SUBPATH } else { depth };
        let is_steered = if from_light {
            self.proposal.light.is_some()
        } else {
            self.proposal.film.is_some()
        };
        if is_steered {
            let i = if from_light { current.edges - depth } else { depth };
            let old = current.vertex(i);
            let reached = Reached {
                surface: vertex.surface,
                key: self.key,
                depth: keyed,
                from_light,
            };
            let direction = reached.goes_on(scene, self.mutation, &old, current.vertex(i + 1).surface.direction)?;
            if old.kind == VERTEX_DISCRETE {
                vertex.kind = VERTEX_DISCRETE;
            }
            return Some(direction);
        }
        let (surface, transport) = (
            vertex.surface,
            if from_light {
                Transport::Importance
            } else {
                Transport::Radiance
            },
        );
        let model = scene.materials.kind(surface.material);
        let (direction, outcome) = surface.scatter(transport, |wi| {
            let mut draws = KeyedDraws(self.key);
            let draw = ScatterDraw {
                direction: draws.scatter(keyed),
                lobe: if model.chooses_lobes() { draws.lobe(keyed) } else { 0.0 },
            };
            scene
                .materials
                .sample(surface.material, surface.uv, wi, draw, transport)
        })?;
        if outcome.discrete {
            vertex.kind = VERTEX_DISCRETE;
        }
        Some(direction)
    }
}
