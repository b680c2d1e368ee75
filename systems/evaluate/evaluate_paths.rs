//! Whole paths: what they bring, and the densities of all strategies.

use super::super::chains::Keys;
use super::super::paths::{VertexColumns, Vertices, VerticesMut};
use super::super::tile::{FilmBlocks, Queues, SceneRef, TilePlace};
use super::super::trace::join::joining;
use super::normalized;
use crate::chain::{ProposedClass, ProposedTarget};
use crate::color::Rgb;
use crate::geometry::{NOT_EMITTING, SegmentTransmittance};
use crate::path::whole::*;
use crate::path::*;
use crate::sampling::{Purpose, StreamKey};
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Local, Res, SystemParam};
use glam::Vec2;

/// Chooses among lights at infinity that a path meets all at once.
const AMONG_INFINITE: Purpose = Purpose::named("light met at infinity");

/// What proposals were made of.
#[derive(SystemParam)]
pub struct Subpaths<'w, 's> {
    keys: Keys<'w, 's>,
    camera_kept: Read<'w, 's, KeptFromCamera, ChainTable>,
    camera_made: Read<'w, 's, CameraVertices, ChainTable>,
    light_made: Read<'w, 's, LightVertices, ChainTable>,
    edges: Read<'w, 's, ProposedEdges, ChainTable>,
    lights: Read<'w, 's, VertexLight, ProposalTable>,
    vertices: Vertices<'w, 's, ProposalTable>,
    segment_chains: Read<'w, 's, RayChain, RayTable>,
    transmittances: Read<'w, 's, SegmentTransmittance, RayTable>,
}

/// What is written of them.
#[derive(SystemParam)]
pub struct Found<'w, 's> {
    targets: Write<'w, 's, ProposedTarget, ChainTable>,
    classes: Write<'w, 's, ProposedClass, ChainTable>,
    counts: Write<'w, 's, ProposedSplatCount, ChainTable>,
    splat_pixels: Write<'w, 's, SplatPixel, ProposedSplatTable>,
    splat_colors: Write<'w, 's, SplatColor, ProposedSplatTable>,
    lights: Write<'w, 's, ProposedLight, ChainTable>,
    pixels: Write<'w, 's, FilmPixel, ChainTable>,
    film: Write<'w, 's, ProposedPathFilm, ChainTable>,
    filters: Write<'w, 's, ProposedFilter, ChainTable>,
    kept_lights: Write<'w, 's, ProposedKeptLight, ChainTable>,
    vertices: VerticesMut<'w, 's, ProposedPathTable>,
    shares: Write<'w, 's, PathShare, ProposedPathTable>,
    onwards: Write<'w, 's, PathOnward, ProposedPathTable>,
    backs: Write<'w, 's, PathBack, ProposedPathTable>,
}

/// Room to put a path together in.
#[derive(Default)]
pub struct Work {
    vertices: Vec<WholeVertex>,
    measured: Measured,
}

/// Puts every proposal's path together from its subpaths, and writes what it brings to which pixel, its class, and the densities
/// that mutations weigh it by. Proposals that are no path, or bring nothing, have the target 0.
pub fn evaluate_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    blocks: Res<FilmBlocks>,
    queues: Res<Queues>,
    subpaths: Subpaths,
    mut found: Found,
    mut work: Local<Work>,
) {
    let scene = &*scene.0;
    let (keys, camera_kept) = (subpaths.keys.columns(), subpaths.camera_kept.rows());
    let (camera_made, light_made) = (subpaths.camera_made.rows(), subpaths.light_made.rows());
    let (edges, lights, vertices) = (
        subpaths.edges.rows(),
        subpaths.lights.rows(),
        subpaths.vertices.columns(),
    );
    let (segment_chains, transmittances) = (subpaths.segment_chains.rows(), subpaths.transmittances.rows());
    let (targets, classes, counts) = (found.targets.rows(), found.classes.rows(), found.counts.rows());
    let (splat_pixels, splat_colors) = (found.splat_pixels.rows(), found.splat_colors.rows());
    let (proposed_lights, pixels, film) = (found.lights.rows(), found.pixels.rows(), found.film.rows());
    let (filters, kept_lights) = (found.filters.rows(), found.kept_lights.rows());
    let mut proposed = found.vertices.columns();
    let (shares, onwards, backs) = (found.shares.rows(), found.onwards.rows(), found.backs.rows());
    let mut segment = 0;
    for chain in 0..place.chains as usize {
        targets.put(chain, 0.0);
        counts.put(chain, 0);
        let k = edges.at(chain) as usize;
        if k == 0 {
            continue;
        }
        let joint = Joint {
            scene,
            place: &place,
            vertices: &vertices,
            lights,
            chain,
            made: [camera_made.at(chain), light_made.at(chain)],
        };
        let mut passing = Rgb::ONE;
        if joint.made[1] > 0 {
            debug_assert_eq!(segment_chains.at(segment) as usize, chain);
            passing = transmittances.at(segment);
            segment += 1;
        }
        if passing.is_black() || k < place.shortest as usize {
            continue;
        }
        let key = keys.at(chain);
        let Some(light) = joint.path(key, &mut work.vertices) else {
            continue;
        };
        let Work { vertices, measured } = &mut *work;
        let path = WholePath { scene, vertices, light };
        let Some(value) = path.measure(measured) else {
            continue;
        };
        let Some(seen) = joint.seen(key, camera_kept.at(chain), (pixels.at(chain), film.at(chain))) else {
            continue;
        };
        let value = value * passing;
        let target = target_of(value);
        targets.put(chain, target);
        let block = blocks.0.block_of(seen.pixel).unwrap_or(0) as u32;
        let form = PathForm { vertices };
        classes.put(chain, form.class().in_block(block).0);
        if !(target > 0.0 && target.is_finite()) {
            continue;
        }
        counts.put(chain, 1);
        splat_pixels.put(chain, seen.pixel);
        splat_colors.put(chain, normalized(value, target));
        proposed_lights.put(chain, light);
        pixels.put(chain, seen.pixel);
        film.put(chain, seen.film);
        filters.put(chain, seen.filter);
        kept_lights.put(chain, measured.kept_light);
        for (depth, vertex) in vertices.iter().enumerate() {
            let row = place.path_vertex(chain, depth);
            proposed.put(row, vertex);
            shares.put(row, measured.share(depth + 1));
            onwards.put(row, measured.passages[depth].onward);
            backs.put(row, measured.passages[depth].back);
        }
    }
    debug_assert_eq!(segment, queues.segments);
}

/// Where on the film a path is seen.
struct Seen {
    pixel: u32,
    film: Vec2,
    filter: f32,
}

/// The subpaths of a chain's proposal, and where they are joined.
struct Joint<'a> {
    scene: &'a Scene,
    place: &'a TilePlace,
    vertices: &'a VertexColumns<'a>,
    lights: &'a [VertexLight],
    chain: usize,
    /// t and s.
    made: [u32; 2],
}

impl Joint<'_> {
    /// Puts the path together; the light that it ends on, if it is one.
    fn path(&self, key: StreamKey, path: &mut Vec<WholeVertex>) -> Option<u32> {
        let ([t, s], light_path) = (self.made, self.place.lights_from as usize + self.chain);
        path.clear();
        path.extend((0..t).map(|depth| self.vertices.at(self.place.vertex(self.chain, depth))));
        let last = t as usize - 1;
        if s == 0 {
            if path[last].kind == VERTEX_INFINITE {
                let lights = &self.scene.lights;
                let u = key.stream(AMONG_INFINITE, 0).next_f64();
                let count = lights.infinite().count();
                return lights.infinite().nth((u * count as f64) as usize);
            }
            let light = self.lights.at(self.place.vertex(self.chain, t - 1));
            path[last].kind = VERTEX_LIGHT;
            return (light != NOT_EMITTING).then_some(light);
        }
        let y = self.vertices.at(self.place.vertex(light_path, s - 1));
        let mut direction = joining(self.scene, &path[last], &y)?;
        for depth in (0..s).rev() {
            let mut vertex = self.vertices.at(self.place.vertex(light_path, depth));
            // What led from the light to this vertex leads from it to the light.
            let onward = -vertex.surface.direction;
            vertex.surface.direction = direction;
            direction = onward;
            path.push(vertex);
        }
        Some(self.lights.at(light_path))
    }

    /// The pixel that the path counts for: the one that it was started through, or one of those whose filters reach the place
    /// where it is seen. `started` is that pixel, and its place.
    fn seen(&self, key: StreamKey, kept: u32, (pixel, film): (u32, Vec2)) -> Option<Seen> {
        let film = if self.made[0] == 1 {
            let light_path = self.place.lights_from as usize + self.chain;
            let y = self.vertices.at(self.place.vertex(light_path, self.made[1] - 1));
            let lens = self.vertices.at(self.chain).surface.position;
            self.scene.camera.project(lens, y.surface.position)?.film
        } else {
            film
        };
        let (chosen, filter) = pixel_of(self.scene, film, KeyedDraws(key).splat(0))?;
        let was_started = self.made[0] > 1 && kept != 1;
        Some(Seen {
            pixel: if was_started { pixel } else { chosen },
            film,
            filter,
        })
    }
}
