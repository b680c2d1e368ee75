//! Proposals of whole paths, up to where they are traced: what mutations say that they keep, and the starts of what is new.

use super::super::super::paths::{VertexColumns, VertexColumnsMut, Vertices, VerticesMut};
use super::super::super::tile::{Queues, SceneRef, TilePlace, grow_tables};
use super::super::super::trace::draws::{DrawColumns, Draws};
use crate::geometry::NOT_EMITTING;
use crate::material::MaterialKind;
use crate::path::whole::*;
use crate::path::*;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};
use bevy_ecs::world::World;
use glam::Vec3;

use super::super::super::chains::{KeyColumns, Keys};

/// Makes room in the tables for the deepest subpath that a mutation asks for.
pub fn make_room(world: &mut World) {
    let deepest = world.resource::<Queues>().deepest;
    grow_tables(world, deepest + 1);
}

/// What mutations say of proposals.
#[derive(SystemParam)]
pub struct Asked<'w, 's> {
    camera_kept: Read<'w, 's, KeptFromCamera, ChainTable>,
    light_kept: Read<'w, 's, KeptFromLight, ChainTable>,
    camera_made: Read<'w, 's, CameraVertices, ChainTable>,
    light_made: Read<'w, 's, LightVertices, ChainTable>,
    stops: Read<'w, 's, StopDepth, ChainTable>,
    origins: Read<'w, 's, SteeredOrigin, ChainTable>,
}

/// Current paths.
#[derive(SystemParam)]
pub struct CurrentPaths<'w, 's> {
    vertices: Vertices<'w, 's, PathTable>,
    edges: Read<'w, 's, PathEdges, ChainTable>,
    lights: Read<'w, 's, PathLight, ChainTable>,
    pixels: Read<'w, 's, PathPixel, ChainTable>,
    film: Read<'w, 's, PathFilm, ChainTable>,
}

/// What subpaths are started with.
#[derive(SystemParam)]
pub struct Started<'w, 's> {
    lengths: Write<'w, 's, PathLength, ChainTable>,
    directions: Write<'w, 's, Direction, ChainTable>,
    active: Write<'w, 's, ActiveList, ChainTable>,
    scatter: Write<'w, 's, ScatterList, ScatterTable>,
    pixels: Write<'w, 's, FilmPixel, ChainTable>,
    film: Write<'w, 's, ProposedPathFilm, ChainTable>,
    lights: Write<'w, 's, VertexLight, ProposalTable>,
    vertices: VerticesMut<'w, 's, ProposalTable>,
}

/// Starts the subpaths of every chain's proposal: copies the vertices that it keeps, lists the last of them to be scattered from, or
/// to send a ray in the direction that its mutation has written; starts those of which nothing is kept on the lens, or on a light.
pub fn start_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    keys: Keys,
    draws: Draws,
    asked: Asked,
    current: CurrentPaths,
    mut started: Started,
) {
    let mut run = Run {
        scene: &scene.0,
        place: &place,
        keys: keys.columns(),
        draws: draws.columns(&place),
        current: current.vertices.columns(),
        queues: &mut queues,
        lengths: started.lengths.rows(),
        directions: started.directions.rows(),
        active: started.active.rows(),
        scatter: started.scatter.rows(),
        pixels: started.pixels.rows(),
        film: started.film.rows(),
        lights: started.lights.rows(),
        vertices: started.vertices.columns(),
    };
    let (camera_kept, light_kept) = (asked.camera_kept.rows(), asked.light_kept.rows());
    let (camera_made, light_made) = (asked.camera_made.rows(), asked.light_made.rows());
    let (stops, origins) = (asked.stops.rows(), asked.origins.rows());
    let (edges, lights) = (current.edges.rows(), current.lights.rows());
    let (pixels, film) = (current.pixels.rows(), current.film.rows());
    for chain in 0..place.chains as usize {
        let (from_camera, from_light) = (chain, place.lights_from as usize + chain);
        let (t, s) = (camera_made.at(chain), light_made.at(chain));
        if t == 0 {
            run.without(from_camera);
            run.without(from_light);
            continue;
        }
        match camera_kept.at(chain) {
            0 => run.start_camera(chain, t > 1),
            kept => {
                let kept = Kept {
                    chain,
                    path: from_camera,
                    count: kept,
                    made: t,
                    steered: stops.at(from_camera) & STEERED != 0,
                };
                if kept.count > 1 {
                    run.pixels.put(chain, pixels.at(chain));
                    run.film.put(chain, film.at(chain));
                }
                run.keep(kept, None, NOT_EMITTING);
                if kept.count == 1 && kept.made > 1 {
                    run.look_through(chain);
                }
            }
        }
        match light_kept.at(chain) {
            // A light that is to be joined to a surface is chosen from there, when that is known.
            0 if s > 1 || (s, t) == (1, 1) => run.start_light(from_light, s > 1),
            0 => run.without(from_light),
            kept => {
                let kept = Kept {
                    chain,
                    path: from_light,
                    count: kept,
                    made: s,
                    steered: stops.at(from_light) & STEERED != 0,
                };
                run.keep(kept, Some(edges.at(chain)), lights.at(chain));
                if kept.count == 1 && kept.steered {
                    run.shine_from(from_light, origins.at(chain));
                }
            }
        }
    }
    // Subpaths that wait to be scattered are in the lists already: the trace loop has to go round once.
    run.queues.starting = true;
}

/// Vertices that a subpath keeps.
#[derive(Clone, Copy)]
struct Kept {
    chain: usize,
    path: usize,
    count: u32,
    made: u32,
    steered: bool,
}

/// One run of the system: its columns as slices.
struct Run<'a> {
    scene: &'a Scene,
    place: &'a TilePlace,
    keys: KeyColumns<'a>,
    draws: DrawColumns<'a>,
    current: VertexColumns<'a>,
    queues: &'a mut Queues,
    lengths: &'a mut [PathLength],
    directions: &'a mut [Direction],
    active: &'a mut [ActiveList],
    scatter: &'a mut [ScatterList],
    pixels: &'a mut [FilmPixel],
    film: &'a mut [ProposedPathFilm],
    lights: &'a mut [VertexLight],
    vertices: VertexColumnsMut<'a>,
}

impl Run<'_> {
    fn without(&mut self, path: usize) {
        self.lengths.put(path, NO_SUBPATH);
    }

    fn activate(&mut self, path: usize) {
        self.active.put(self.queues.active, path as u32);
        self.queues.active += 1;
    }

    /// A new point of the lens, and a place of the film; nobody looks through it yet where the lens is all of the subpath.
    fn start_camera(&mut self, chain: usize, goes_on: bool) {
        let lens = if self.scene.camera.has_aperture() {
            self.draws.lens(chain)
        } else {
            LENS_CENTER
        };
        let start = CameraStart::draw(self.scene, self.keys.at(chain), lens);
        self.pixels.put(chain, start.pixel);
        self.film.put(chain, start.film);
        self.start(chain, &start.vertex, NOT_EMITTING);
        if goes_on {
            self.directions.put(chain, start.direction);
            self.activate(chain);
        }
    }

    /// Moves the start of a ray that its mutation sends through another place on the film, where rays are parallel.
    fn look_through(&mut self, chain: usize) {
        let camera = &self.scene.camera;
        if camera.is_directional() {
            let lens = self.vertices.at(chain);
            let ray = camera.ray_from(lens.surface.position, self.film.at(chain));
            self.vertices
                .put(chain, &WholeVertex::lens(self.scene, ray.origin, ray.direction));
        }
    }

    /// Moves the start of a ray that its mutation sends from elsewhere at infinity.
    fn shine_from(&mut self, path: usize, origin: Vec3) {
        let mut light = self.vertices.at(path);
        if light.kind == VERTEX_INFINITE {
            light.surface.position = origin;
            self.vertices.put(path, &light);
        }
    }

    /// A point of a light, and a way from it.
    fn start_light(&mut self, path: usize, goes_on: bool) {
        let Some(start) = LightStart::draw(self.scene, self.draws.emission(path)) else {
            self.without(path);
            return;
        };
        self.start(path, &start.vertex, start.light);
        if goes_on {
            self.directions.put(path, start.direction);
            self.activate(path);
        }
    }

    fn start(&mut self, path: usize, vertex: &WholeVertex, light: u32) {
        self.lengths.put(path, 0);
        self.vertices.put(path, vertex);
        self.lights.put(path, light);
    }

    /// Copies vertices of the current path, and goes on from the last.
    fn keep(&mut self, kept: Kept, from_light: Option<u32>, light: u32) {
        let Kept { chain, path, count, .. } = kept;
        let mut end = WholeVertex::end(VERTEX_LENS, Vec3::ZERO, Vec3::ZERO, 0.0);
        for depth in 0..count {
            let of = |i: u32| self.current.at(self.place.path_vertex(chain, i as usize));
            end = WholeVertex::kept(of, depth, count, from_light);
            self.vertices.put(self.place.vertex(path, depth), &end);
        }
        self.lengths.put(path, count - 1);
        self.lights.put(path, light);
        if kept.made == count {
            return;
        }
        if kept.steered {
            self.activate(path);
        } else {
            self.directions.put(path, end.surface.direction);
            self.list(path, self.scene.materials.kind(end.surface.material));
        }
    }

    /// Lists a subpath for scattering off its last vertex.
    fn list(&mut self, path: usize, kind: MaterialKind) {
        if let Some(model) = self.scene.materials.model(kind) {
            let entry = self.place.vertex(self.queues.scatter[model], model as u32);
            self.scatter.put(entry, path as u32);
            self.queues.scatter[model] += 1;
        }
    }
}
