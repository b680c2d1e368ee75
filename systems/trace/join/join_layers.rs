//! Layers of what strategies bring.

use super::super::super::layers::{LayerWork, LayersRef};
use super::super::super::tile::TilePlace;
use crate::color::Rgb;
use crate::geometry::NOT_EMITTING;
use crate::layer::{End, LayerColor, Layers, OWN_LAYERS, ProposedLayerTable, SplatLayer, Stop};
use crate::path::bidirectional::{EndVertex, Join, Offer};
use crate::path::measure::Site;
use crate::path::{ProposedSplatTable, VERTEX_INFINITE, VERTEX_LIGHT};
use crate::table::{Rows, Write};
use bevy_ecs::system::{Local, Res, ResMut, SystemParam};
use glam::Vec3;

/// Where light is split among layers: what splitting reads and writes.
#[derive(SystemParam)]
pub struct Split<'w, 's> {
    layers: Option<Res<'w, LayersRef>>,
    work: Option<ResMut<'w, LayerWork>>,
    own: Write<'w, 's, LayerColor, ProposedLayerTable>,
    splat_layers: Write<'w, 's, SplatLayer, ProposedSplatTable>,
    tried: Local<'s, Tried>,
}

/// What a chain has tried so far; its turn may last for several rounds.
#[derive(Default)]
pub struct Tried {
    /// Edges of paths, by layer.
    edges: Vec<f64>,
    /// Segments looked along.
    segments: f64,
}

/// [`Split`] as slices.
pub struct SplitColumns<'a> {
    layers: &'a Layers,
    work: Option<&'a mut LayerWork>,
    own: &'a mut [LayerColor],
    splat_layers: &'a mut [SplatLayer],
    tried: &'a mut Tried,
}

impl Split<'_, '_> {
    /// The columns as slices; `None` where nothing is split.
    pub fn columns(&mut self) -> Option<SplitColumns<'_>> {
        Some(SplitColumns {
            layers: &self.layers.as_ref()?.0,
            work: self.work.as_deref_mut(),
            own: self.own.rows(),
            splat_layers: self.splat_layers.rows(),
            tried: &mut self.tried,
        })
    }
}

impl SplitColumns<'_> {
    /// Begins a chain's list with the light that its camera subpath met.
    pub fn begin(&mut self, join: &Join<'_>, place: &TilePlace, chain: usize) {
        self.tried.edges.clear();
        self.tried.edges.resize(self.layers.len(), 0.0);
        self.tried.segments = 0.0;
        if self.own.is_empty() {
            return;
        }
        self.splat_layers.put(chain, OWN_LAYERS);
        let own = |layer: usize| place.vertex(chain, layer as u32);
        (0..self.layers.len()).for_each(|layer| self.own.put(own(layer), Rgb::BLACK));
        for t in (2..=join.camera.len()).filter(|&t| join.strategies.has(0, t as u32)) {
            let light = join.met(t);
            if light.is_black() {
                continue;
            }
            let end = if join.camera[t - 1].kind == VERTEX_INFINITE {
                End::Infinity
            } else {
                End::Shape
            };
            let layer = self.layers.of_path(join.scene, t - 1, end, |i| stop(&join.camera[i]));
            self.tried.edges[layer] += (t - 1) as f64;
            self.own.put(own(layer), self.own.at(own(layer)) + light);
        }
    }

    /// The layer of the path that strategy (s, t) makes, s ≥ 1, of a chain that is to look along its segment.
    pub fn offered(&mut self, join: &Join<'_>, s: usize, t: usize, offer: &Offer) -> usize {
        let layer = layer_of(join, self.layers, s, t, offer);
        self.tried.edges[layer] += (s + t - 1) as f64;
        self.tried.segments += 1.0;
        layer
    }

    /// Books the work of a chain whose turn is over.
    pub fn end(&mut self, join: &Join<'_>) {
        if let Some(work) = &mut self.work {
            let traced = (join.camera.len() + join.light.len()).saturating_sub(2).max(1);
            work.book(traced as f64 + self.tried.segments, &self.tried.edges);
        }
    }
}

fn stop(vertex: &EndVertex) -> Stop {
    Stop {
        site: vertex.site(),
        material: vertex.surface.material,
    }
}

/// The layer of the path that strategy (s, t) makes, s ≥ 1.
fn layer_of(join: &Join<'_>, layers: &Layers, s: usize, t: usize, offer: &Offer) -> usize {
    let lights = &join.scene.lights;
    if offer.light != NOT_EMITTING {
        let end = Stop {
            site: Site {
                kind: VERTEX_LIGHT,
                position: offer.target,
                normal: Vec3::ZERO,
            },
            material: 0,
        };
        let vertex = |i: usize| join.camera.get(i).filter(|_| i < t).map_or(end, stop);
        return layers.of_path(join.scene, t, lights.endpoint(offer.light).into(), vertex);
    }
    let vertex = |i: usize| {
        stop(if i < t {
            &join.camera[i]
        } else {
            &join.light[s + t - 1 - i]
        })
    };
    layers.of_path(
        join.scene,
        s + t - 1,
        lights.endpoint(join.light[0].light).into(),
        vertex,
    )
}
