//! Layers under way: where they are summed, and what they came to.

use super::rendering::error_blocks;
use super::samples::Samples;
use super::turns::Turns;
use crate::color::Rgb;
use crate::film::{FilmError, LayerChannels, Picture};
use crate::layer::{LayerFilms, Layers};
use crate::plan::{Plan, SPLAT_FILMS};
use crate::scene::Scene;
use crate::stats::error::{IndependentBlocks, PictureError};
use crate::stats::group_means::GroupMeans;
use crate::systems::layers::{LayerFilmsRef, LayerWork, LayersRef};
use bevy_ecs::world::World;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::time::Duration;

/// The layers of a render, or of a part of one, and their films.
pub struct LayerSums {
    pub(super) layers: Arc<Layers>,
    pub(super) films: Arc<LayerFilms>,
    /// The radiance that one unit of the films stands for: a power of two.
    unit: f64,
}

/// What a render, or a part of one, says of its layers: an entry for each.
#[derive(Default)]
pub(super) struct LayerParts {
    layers: Vec<LayerPart>,
    /// Time that was spent on paths to no light.
    nowhere: Duration,
}

/// What it says of one of them.
struct LayerPart {
    rgb: Vec<Rgb>,
    /// Block means by group.
    blocks: Option<GroupMeans>,
    time: Duration,
}

/// A layer of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerFinding {
    /// Its light.
    pub rgb: Vec<Rgb>,
    /// What it costs.
    pub record: LayerRecord,
}

/// What a layer costs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LayerRecord {
    /// The layer's name.
    pub name: String,
    /// Its light path expression.
    pub expression: String,
    /// Its share of the picture's light: of the mean over all pixels and channels.
    pub light_share: f64,
    /// Its error relative to its own mean, as [`Rendering::error`](super::Rendering::error) has it of the picture. `None` where it has no
    /// light, or too little is known.
    pub error: Option<PictureError>,
    /// Its share of the sum of all layers' squared errors.
    pub error_share: f64,
    /// Busy seconds of all threads that belong to it. Chains spend theirs where light is, so it goes by the states' light; of independent
    /// samples by the edges that were traced for its paths, a sample's own being shared by all paths that were tried with it.
    pub seconds: f64,
    /// That over the busy time of the render.
    pub time_share: f64,
}

impl LayerRecord {
    /// How many times as long a render as this one would take until the layer's own error is `error`: squared errors fall with time.
    #[must_use]
    pub fn times_to(&self, error: f64) -> Option<f64> {
        self.error.map(|own| (own.rms / error) * (own.rms / error))
    }
}

/// The unit of layers' films of samples of pixels: so far below the brightest light that most samples are between it and the
/// resolution, and few are beyond what sums are held in.
pub(super) fn unit(scene: &Scene) -> f64 {
    let brightest = f64::from(scene.lights.max_radiance());
    if brightest > 0.0 && brightest.is_finite() {
        libm::exp2(libm::round(libm::log2(brightest)) - 14.0)
    } else {
        1.0
    }
}

/// Inserts what systems that split layers read.
pub(super) fn insert_layers(world: &mut World, layers: Option<&LayerSums>) {
    let Some(layers) = layers else { return };
    world.insert_resource(LayersRef(Arc::clone(&layers.layers)));
    world.insert_resource(LayerFilmsRef {
        films: Arc::clone(&layers.films),
        scale: (1.0 / layers.unit) as f32,
        weight: 1.0,
    });
    world.init_resource::<LayerWork>();
}

impl LayerSums {
    /// The films of `layers` for pictures of `scene` by so many groups.
    pub(super) fn new(layers: &Arc<Layers>, scene: &Scene, groups: u32, unit: f64) -> Result<Self, FilmError> {
        let films = LayerFilms::new(layers, error_blocks(scene), groups)?;
        Ok(Self {
            layers: Arc::clone(layers),
            films: Arc::new(films),
            unit,
        })
    }

    /// Those of a plan of independent samples, if it has any.
    pub(super) fn planned(plan: &Plan, scene: &Scene, unit: f64) -> Result<Option<Self>, FilmError> {
        let layers = plan.layers.as_ref();
        layers
            .map(|layers| Self::new(layers, scene, SPLAT_FILMS, unit))
            .transpose()
    }

    /// Those of a plan of chains, if it has any.
    pub(super) fn of_groups(plan: &Plan, scene: &Scene, groups: u32) -> Result<Option<Self>, FilmError> {
        let layers = plan.layers.as_ref();
        layers.map(|layers| Self::new(layers, scene, groups, 1.0)).transpose()
    }

    /// What layers have after so many samples of every pixel, and one more of the first `more` pixels.
    pub(super) fn of_samples(&self, samples: &Samples, steps: u64, more: u32) -> LayerParts {
        let mut work = LayerWork::default();
        samples.for_each_world(&mut |_, world| work.add(world.world().resource::<LayerWork>()));
        let all = (work.edges.iter().sum::<f64>() + work.nowhere).max(f64::MIN_POSITIVE);
        let busy = samples.busy_time();
        let turns = Turns::new(self.films.groups(), steps, f64::from(more) / samples.pixels());
        let part = |layer: usize| {
            let pixel = |(pixel, sums): (usize, [f64; 3])| {
                let count = (steps + u64::from((pixel as u32) < more)) as f64;
                color(sums, if count > 0.0 { self.unit / count } else { 0.0 })
            };
            let rows: Vec<_> = turns
                .counts()
                .iter()
                .enumerate()
                .map(|(group, count)| self.films.block_means(group, layer, self.unit / count))
                .collect();
            LayerPart {
                rgb: self.films.sums(layer).enumerate().map(pixel).collect(),
                blocks: GroupMeans::from_rows(&rows)
                    .ok()
                    .map(|means| means.combined(|values| turns.combine(values))),
                time: busy.mul_f64(work.edges.get(layer).copied().unwrap_or(0.0) / all),
            }
        };
        LayerParts {
            layers: (0..self.layers.len()).map(part).collect(),
            nowhere: busy.mul_f64(work.nowhere / all),
        }
    }

    /// What layers have of the states of chains that were busy for so long. `scale` makes radiance of the sums over all groups, as these
    /// count; `per_state` of a group's sums the means that `combine` makes the groups' estimates of.
    pub(super) fn of_states(
        &self,
        scale: f64,
        per_state: f64,
        busy: Duration,
        combine: &dyn Fn(&mut [f64]),
    ) -> LayerParts {
        let light: Vec<f64> = (0..self.layers.len()).map(|layer| self.films.light(layer)).collect();
        let all = light.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        let part = |layer: usize| {
            let row = |group| self.films.block_means(group, layer, per_state);
            let rows: Vec<_> = (0..self.films.groups()).map(row).collect();
            LayerPart {
                rgb: self.films.sums(layer).map(|sums| color(sums, scale)).collect(),
                blocks: GroupMeans::from_rows(&rows).ok().map(|means| means.combined(combine)),
                time: busy.mul_f64(light[layer] / all),
            }
        };
        LayerParts {
            layers: (0..self.layers.len()).map(part).collect(),
            nowhere: Duration::ZERO,
        }
    }
}

fn color(sums: [f64; 3], scale: f64) -> Rgb {
    let [r, g, b] = sums.map(|sum| (sum * scale) as f32);
    Rgb::new(r, g, b)
}

/// The mean over all pixels and channels.
fn mean(rgb: &[Rgb]) -> f64 {
    let sum: f64 = rgb.iter().flat_map(|rgb| rgb.to_array()).map(f64::from).sum();
    sum / (3 * rgb.len()).max(1) as f64
}

impl LayerPart {
    /// Adds what direct light that is rendered apart has of it. Its error, in units of radiance.
    fn with_direct(&mut self, direct: Option<&Self>) -> Option<PictureError> {
        let means = self.blocks.as_ref()?;
        let Some(direct) = direct else {
            return PictureError::of(means);
        };
        self.rgb
            .iter_mut()
            .zip(&direct.rgb)
            .for_each(|(sum, more)| *sum += *more);
        self.time += direct.time;
        let known = direct.blocks.as_ref()?;
        let blocks = IndependentBlocks {
            variances: known
                .estimates()
                .iter()
                .map(|estimate| estimate.error * estimate.error)
                .collect(),
            channels: 3,
            degrees_of_freedom: known.groups().saturating_sub(1).max(1) as f64,
        };
        PictureError::of_parts(means, &blocks)
    }
}

impl LayerFinding {
    /// The layers of a render, from its parts.
    pub(super) fn all(layers: &Layers, parts: LayerParts, direct: Option<LayerParts>) -> Vec<Self> {
        let nowhere = parts.nowhere + direct.as_ref().map_or(Duration::ZERO, |direct| direct.nowhere);
        let mut found: Vec<(LayerPart, Option<PictureError>)> = Vec::with_capacity(layers.len());
        for (number, mut part) in parts.layers.into_iter().enumerate() {
            let error = part.with_direct(direct.as_ref().and_then(|direct| direct.layers.get(number)));
            found.push((part, error));
        }
        let light: f64 = found.iter().map(|(part, _)| mean(&part.rgb)).sum();
        let squared = |error: &Option<PictureError>| error.map_or(0.0, |error| error.rms * error.rms);
        let errors: f64 = found.iter().map(|(_, error)| squared(error)).sum();
        let time = found.iter().map(|(part, _)| part.time).sum::<Duration>() + nowhere;
        let share = |part: f64, all: f64| if all > 0.0 { part / all } else { 0.0 };
        let named = layers.names().iter().zip(layers.expressions());
        let findings = found.into_iter().zip(named).map(|((part, error), (name, expression))| {
            let own = mean(&part.rgb);
            let record = LayerRecord {
                name: name.clone(),
                expression: expression.clone(),
                light_share: share(own, light),
                error: error.and_then(|error| error.relative_to(own)),
                error_share: share(squared(&error), errors),
                seconds: part.time.as_secs_f64(),
                time_share: share(part.time.as_secs_f64(), time.as_secs_f64()),
            };
            Self { rgb: part.rgb, record }
        });
        findings.collect()
    }

    /// `picture` with these as layers of its file.
    #[must_use]
    pub fn add_to(findings: &[Self], picture: Picture) -> Picture {
        findings.iter().fold(picture, |picture, found| {
            picture.with_layer(&found.record.name, LayerChannels::Rgb(found.rgb.clone()))
        })
    }
}
