//! Strategies (s, t): what a pair of subpaths contributes by each, and with what weight.

use super::subpath::{EndVertex, odds_behind};
use crate::color::Rgb;
use crate::geometry::NOT_EMITTING;
use crate::light::Endpoint;
use crate::material::Transport;
use crate::path::draws::LightDraw;
use crate::path::film_position::pixel_of;
use crate::path::measure::Site;
use crate::path::mis::{Heuristic, weight};
use crate::path::{VERTEX_INFINITE, VERTEX_LIGHT};
use crate::scene::Scene;
use glam::Vec3;

/// How strategies share the paths that several of them find.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// By multiple importance sampling among all of them.
    #[default]
    All,
    /// Strategy (s, t) alone, with weight one: for tests.
    Only(u32, u32),
    /// Those with t = 1 alone, with weight one: light tracing.
    Lens,
}

/// Which strategies there are, and how they are weighed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Strategies {
    /// How they share paths.
    pub weights: Weights,
    /// How weights are made of densities.
    pub heuristic: Heuristic,
}

impl Strategies {
    /// Whether strategy (s, t) is used.
    #[inline]
    #[must_use]
    pub const fn has(&self, s: u32, t: u32) -> bool {
        match self.weights {
            Weights::All => true,
            Weights::Only(only_s, only_t) => s == only_s && t == only_t,
            Weights::Lens => t == 1,
        }
    }

    #[inline]
    fn weight(&self, odds: impl FnOnce(Heuristic) -> f64) -> f32 {
        match self.weights {
            Weights::All => weight(odds(self.heuristic)),
            Weights::Only(..) | Weights::Lens => 1.0,
        }
    }
}

/// Light that arrives if nothing is in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offer {
    /// Its contribution, weighted.
    pub value: Rgb,
    /// The start of the segment that has to be free, off its surface.
    pub origin: Vec3,
    /// The end of the segment.
    pub target: Vec3,
    /// The light, where it was sampled for this offer; otherwise [`NOT_EMITTING`], and the path ends where its light subpath starts.
    pub light: u32,
}

/// An [`Offer`] that is seen by the lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The light: for each of the whole film's samples, so that a film of n pixels takes n of them.
    pub offer: Offer,
    /// The pixel that it counts for.
    pub pixel: u32,
}

/// A pair of subpaths.
#[derive(Clone, Copy, Debug)]
pub struct Join<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Which strategies.
    pub strategies: Strategies,
    /// x₀ …
    pub camera: &'a [EndVertex],
    /// y₀ …
    pub light: &'a [EndVertex],
}

impl Join<'_> {
    /// Strategy (0, t): what the camera subpath's vertex number t − 1 emits back along it.
    #[must_use]
    pub fn met(&self, t: usize) -> Rgb {
        let x = &self.camera[t - 1];
        if x.kind == VERTEX_INFINITE {
            let mut sum = Rgb::BLACK;
            for light in self.scene.lights.infinite() {
                sum += self.met_light(t, light);
            }
            return sum;
        }
        if x.light == NOT_EMITTING {
            return Rgb::BLACK;
        }
        self.met_light(t, x.light)
    }

    fn met_light(&self, t: usize, light: u32) -> Rgb {
        let lights = &self.scene.lights;
        let (x, from) = (&self.camera[t - 1], &self.camera[t - 2]);
        let towards = -x.surface.direction;
        let emitted = lights.radiance(light, x.surface.normal, towards);
        if emitted.is_black() {
            return emitted;
        }
        let weight = self.strategies.weight(|heuristic| {
            let (here, before) = (x.site(), from.site());
            let emission = lights.emission_densities(light, x.surface.normal, towards);
            if t == 2 {
                // The lens samples no light; it sees those that light subpaths start at, if they are somewhere.
                if here.is_infinite() {
                    return 0.0;
                }
                return odds_behind(heuristic, &self.camera[..t], f64::from(emission.position), 0.0, false);
            }
            let sampled = lights.density(light, from.surface.position, x.surface.position, x.surface.normal);
            let sampled = before.arriving_along(&here, sampled, towards);
            let back = here.arriving_along(&before, emission.direction, towards);
            let going_on = back * (f64::from(emission.position) / sampled);
            odds_behind(heuristic, &self.camera[..t], sampled, going_on, false)
        });
        x.throughput * emitted * weight
    }

    /// Strategy (1, t), t ≥ 2: a light sampled from the camera subpath's vertex number t − 1.
    #[must_use]
    pub fn sampled(&self, t: usize, draw: LightDraw) -> Option<Offer> {
        let lights = &self.scene.lights;
        let x = &self.camera[t - 1];
        let sample = lights.sample(x.surface.position, draw.choice, draw.point)?;
        let scattering = x.surface.evaluate(self.scene, sample.direction, Transport::Radiance)?;
        let weight = self.strategies.weight(|heuristic| {
            let here = x.site();
            let end = Site {
                kind: match lights.endpoint(sample.light) {
                    Endpoint::Infinite => VERTEX_INFINITE,
                    Endpoint::Surface | Endpoint::Point => VERTEX_LIGHT,
                },
                position: sample.position,
                normal: sample.normal,
            };
            let emission = lights.emission_densities(sample.light, sample.normal, -sample.direction);
            let (drawn, met) = if sample.discrete {
                (f64::from(sample.density), 0.0)
            } else {
                // In the measure of directions: what turns both into that of the vertex is the same.
                let odds = heuristic.odds(f64::from(scattering.density) / f64::from(sample.density));
                (here.arriving(&end, sample.density), odds)
            };
            let going_on = end.arriving(&here, emission.direction) * (f64::from(emission.position) / drawn);
            met + self.odds_behind_camera(heuristic, t, going_on, scattering.reverse)
        });
        Some(Offer {
            value: x.throughput * scattering.value * sample.radiance * (weight / sample.density),
            origin: x.surface.leaving(sample.direction),
            target: sample.target,
            light: sample.light,
        })
    }

    /// Strategy (s, t), s ≥ 2, t ≥ 2: an edge between two surfaces.
    #[must_use]
    pub fn joined(&self, s: usize, t: usize) -> Option<Offer> {
        let (x, y) = (&self.camera[t - 1], &self.light[s - 1]);
        let span = y.surface.position.as_dvec3() - x.surface.position.as_dvec3();
        let squared = span.length_squared();
        if squared == 0.0 {
            return None;
        }
        let direction = (span / squared.sqrt()).as_vec3();
        let at_x = x.surface.evaluate(self.scene, direction, Transport::Radiance)?;
        let at_y = y.surface.evaluate(self.scene, -direction, Transport::Importance)?;
        let weight = self.strategies.weight(|heuristic| {
            let (here, there) = (x.site(), y.site());
            self.odds_behind_camera(heuristic, t, there.arriving(&here, at_y.density), at_x.reverse)
                + self.odds_behind_light(heuristic, s, here.arriving(&there, at_x.density), at_y.reverse)
        });
        let scale = f64::from(weight) / squared;
        Some(Offer {
            value: x.throughput * at_x.value * (at_y.value * y.throughput) * scale as f32,
            origin: x.surface.leaving(direction),
            target: y.surface.leaving(-direction),
            light: NOT_EMITTING,
        })
    }

    /// Strategy (s, 1): the light subpath's vertex number s − 1, seen by the lens. `u` chooses among the pixels whose filters
    /// reach where it is seen.
    #[must_use]
    pub fn seen(&self, s: usize, u: f32) -> Option<Seen> {
        let camera = &self.scene.camera;
        let (x, y) = (&self.camera[0], &self.light[s - 1]);
        if y.kind == VERTEX_INFINITE {
            return None;
        }
        let view = camera.project(x.surface.position, y.surface.position)?;
        let (pixel, filter) = pixel_of(self.scene, view.film, u)?;
        let importance = camera.density(view.direction);
        let towards = -view.direction;
        let lens = Site {
            position: view.origin,
            ..x.site()
        };
        let arriving = lens.arriving(&y.site(), importance);
        let squared = if camera.is_directional() {
            1.0
        } else {
            (y.surface.position.as_dvec3() - view.origin.as_dvec3()).length_squared()
        };
        let (light, weight) = if s == 1 {
            let lights = &self.scene.lights;
            if lights.is_delta(y.light) {
                return None;
            }
            let emission = lights.emission_densities(y.light, y.surface.normal, towards);
            let cosine = y.surface.normal.dot(towards).abs();
            let radiance = lights.radiance(y.light, y.surface.normal, towards) * (cosine / emission.position);
            let odds = |heuristic: Heuristic| heuristic.odds(arriving / f64::from(emission.position));
            (radiance, self.strategies.weight(odds))
        } else {
            let at_y = y.surface.evaluate(self.scene, towards, Transport::Importance)?;
            let odds = |heuristic| self.odds_behind_light(heuristic, s, arriving, at_y.reverse);
            (y.throughput * at_y.value, self.strategies.weight(odds))
        };
        let scale = f64::from(weight) * f64::from(importance) * f64::from(filter) / squared;
        let value = light * scale as f32;
        (!value.is_black()).then(|| Seen {
            offer: Offer {
                value,
                origin: y.surface.leaving(towards),
                target: view.origin,
                light: NOT_EMITTING,
            },
            pixel,
        })
    }

    /// Sₜ₋₁ of the camera subpath: `reverse` is p← of its vertex number t − 1, `back` the density of going from there to the
    /// vertex before.
    fn odds_behind_camera(&self, heuristic: Heuristic, t: usize, reverse: f64, back: f32) -> f64 {
        let subpath = &self.camera[..t];
        odds_behind(heuristic, subpath, reverse, before(subpath, back), false)
    }

    /// The same of the light subpath.
    fn odds_behind_light(&self, heuristic: Heuristic, s: usize, reverse: f64, back: f32) -> f64 {
        let subpath = &self.light[..s];
        let met = !self.scene.lights.is_delta(self.light[0].light);
        odds_behind(heuristic, subpath, reverse, before(subpath, back), met)
    }
}

/// p← of the last vertex but one, where going back to it has the density `back`.
fn before(subpath: &[EndVertex], back: f32) -> f64 {
    match subpath {
        [.., previous, last] => last
            .site()
            .arriving_along(&previous.site(), back, last.surface.direction),
        _ => 0.0,
    }
}
