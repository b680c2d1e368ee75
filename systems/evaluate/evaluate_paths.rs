//! Whole paths: what they bring, and the densities of all strategies.

use super::super::chains::Keys;
use super::super::layers::LayersRef;
use super::super::paths::{VertexColumns, VertexColumnsMut, Vertices, VerticesMut};
use super::super::propose::paths::view::{PathEnds, PathRows};
use super::super::tile::{FilmBlocks, Queues, SceneRef, TilePlace};
use super::normalized;
use crate::chain::{ProposedClass, ProposedTarget};
use crate::color::Rgb;
use crate::geometry::SegmentTransmittance;
use crate::layer::{Layers, SplatLayer, Stop};
use crate::path::whole::*;
use crate::path::*;
use crate::sampling::StreamKey;
use crate::scene::Scene;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Local, Res, SystemParam};
use glam::Vec2;

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
    layers: Option<Res<'w, LayersRef>>,
    splat_layers: Write<'w, 's, SplatLayer, ProposedSplatTable>,
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

/// [`Found`] as slices.
pub struct FoundColumns<'a> {
    targets: &'a mut [ProposedTarget],
    classes: &'a mut [ProposedClass],
    counts: &'a mut [ProposedSplatCount],
    splat_pixels: &'a mut [SplatPixel],
    splat_colors: &'a mut [SplatColor],
    layers: Option<&'a Layers>,
    splat_layers: &'a mut [SplatLayer],
    lights: &'a mut [ProposedLight],
    pixels: &'a mut [FilmPixel],
    film: &'a mut [ProposedPathFilm],
    filters: &'a mut [ProposedFilter],
    kept_lights: &'a mut [ProposedKeptLight],
    vertices: VertexColumnsMut<'a>,
    shares: &'a mut [PathShare],
    onwards: &'a mut [PathOnward],
    backs: &'a mut [PathBack],
}

impl Found<'_, '_> {
    /// The columns as slices.
    pub fn columns(&mut self) -> FoundColumns<'_> {
        FoundColumns {
            targets: self.targets.rows(),
            classes: self.classes.rows(),
            counts: self.counts.rows(),
            splat_pixels: self.splat_pixels.rows(),
            splat_colors: self.splat_colors.rows(),
            layers: self.layers.as_deref().map(|layers| &*layers.0),
            splat_layers: self.splat_layers.rows(),
            lights: self.lights.rows(),
            pixels: self.pixels.rows(),
            film: self.film.rows(),
            filters: self.filters.rows(),
            kept_lights: self.kept_lights.rows(),
            vertices: self.vertices.columns(),
            shares: self.shares.rows(),
            onwards: self.onwards.rows(),
            backs: self.backs.rows(),
        }
    }
}

/// A proposal's whole path.
pub struct FoundPath<'a> {
    /// f / r, and what passes the edge that joins the subpaths.
    pub value: Rgb,
    /// x₀ … xₖ.
    pub vertices: &'a [WholeVertex],
    /// Its densities.
    pub measured: &'a Measured,
    /// The light that it ends on.
    pub light: u32,
    /// Where it is seen.
    pub seen: FilmPlace,
}

impl FoundColumns<'_> {
    /// Writes that a chain has no proposal, until it has one.
    pub fn nothing(&mut self, chain: usize) {
        self.targets.put(chain, 0.0);
        self.counts.put(chain, 0);
    }

    /// Writes a chain's proposal, where there was [nothing](Self::nothing); whether it can be taken.
    pub fn put(
        &mut self,
        scene: &Scene,
        place: &TilePlace,
        blocks: &FilmBlocks,
        chain: usize,
        path: &FoundPath<'_>,
    ) -> bool {
        let FoundPath {
            value,
            vertices,
            measured,
            light,
            seen,
        } = *path;
        let form = PathForm { vertices };
        if place.sought == Sought::Indirect && form.is_direct() {
            return false;
        }
        let target = target_of(value);
        self.targets.put(chain, target);
        let block = blocks.0.block_of(seen.pixel).unwrap_or(0) as u32;
        self.classes.put(chain, form.class().in_block(block).0);
        if !(target > 0.0 && target.is_finite()) {
            return false;
        }
        self.counts.put(chain, 1);
        self.splat_pixels.put(chain, seen.pixel);
        self.splat_colors.put(chain, normalized(value, target));
        if let Some(layers) = self.layers {
            let vertex = |i: usize| Stop {
                site: vertices[i].site(),
                material: vertices[i].surface.material,
            };
            let end = scene.lights.endpoint(light).into();
            let layer = layers.of_path(scene, vertices.len() - 1, end, vertex);
            self.splat_layers.put(chain, layer as u32);
        }
        self.lights.put(chain, light);
        self.pixels.put(chain, seen.pixel);
        self.film.put(chain, seen.film);
        self.filters.put(chain, seen.filter);
        self.kept_lights.put(chain, measured.kept_light);
        for (depth, vertex) in vertices.iter().enumerate() {
            let row = place.path_vertex(chain, depth);
            self.vertices.put(row, vertex);
            self.shares.put(row, measured.share(depth + 1));
            self.onwards.put(row, measured.passages[depth].onward);
            self.backs.put(row, measured.passages[depth].back);
        }
        true
    }

    /// The pixel and the place on the film that a chain's camera subpath was started through.
    #[must_use]
    pub fn started(&self, chain: usize) -> (u32, Vec2) {
        (self.pixels.at(chain), self.film.at(chain))
    }

    /// The rows of the paths that were written.
    #[must_use]
    pub fn rows(&self) -> PathRows<'_> {
        PathRows {
            vertices: self.vertices.shared(),
            shares: self.shares,
            onwards: self.onwards,
            backs: self.backs,
        }
    }

    /// Of a chain's proposal, what is known of it as a whole.
    #[must_use]
    pub fn ends(&self, chain: usize, edges: u32) -> PathEnds {
        PathEnds {
            edges,
            film: self.film.at(chain),
            filter: self.filters.at(chain),
            kept_light: self.kept_lights.at(chain),
        }
    }
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
    let mut found = found.columns();
    let mut segment = 0;
    for chain in 0..place.chains as usize {
        found.nothing(chain);
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
        let Some(seen) = joint.seen(key, camera_kept.at(chain), found.started(chain)) else {
            continue;
        };
        let path = FoundPath {
            value: value * passing,
            vertices,
            measured,
            light,
            seen,
        };
        found.put(scene, &place, &blocks, chain, &path);
    }
    debug_assert_eq!(segment, queues.segments);
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
        let light = if s == 0 {
            self.lights.at(self.place.vertex(self.chain, t - 1))
        } else {
            self.lights.at(light_path)
        };
        let from_light = (0..s).rev();
        let from_light = from_light.map(|depth| self.vertices.at(self.place.vertex(light_path, depth)));
        complete(self.scene, key, path, from_light, light)
    }

    /// The pixel that the path counts for: the one that it was started through, `started` with its place, or one of those whose
    /// filters reach the place where it is seen.
    fn seen(&self, key: StreamKey, kept: u32, (pixel, film): (u32, Vec2)) -> Option<FilmPlace> {
        if self.made[0] == 1 {
            let light_path = self.place.lights_from as usize + self.chain;
            let y = self.vertices.position(self.place.vertex(light_path, self.made[1] - 1));
            return FilmPlace::by_lens(self.scene, key, self.vertices.position(self.chain), y);
        }
        FilmPlace::through(self.scene, key, film, (kept != 1).then_some(pixel))
    }
}
