//! What a whole path brings, and the shares that strategies have of it.

use super::{Passage, Scaled, WholeVertex};
use crate::color::Rgb;
use crate::scene::Scene;
use glam::Vec3;

/// A path with the light that it ends on.
#[derive(Clone, Copy, Debug)]
pub struct WholePath<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// x₀ … xₖ, at least two.
    pub vertices: &'a [WholeVertex],
    /// The light's number.
    pub light: u32,
}

/// How a path's last vertex comes to be where a light subpath has it alone (s = 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightEnd {
    /// Chosen as seen from the vertex before it, as next-event estimation does.
    Sampled,
    /// It was there: a mutation keeps it. Then its density is that of a light subpath's start, whatever leads to it.
    Kept,
}

/// A whole path in the measure of bidirectional path tracing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// f / r per channel, with the camera's importance for every place of the film, and filters left out.
    pub light: Rgb,
    /// p₍ₛ,ₜ₎ / r by t, from 0 to k + 1; 0 for strategies that cannot find the path. They sum to 1.
    shares: Vec<f64>,
}

impl Measured {
    /// The share of strategy (s, t), t = k + 1 − s: the weight that the balance heuristic gives it.
    #[must_use]
    pub fn share(&self, t: usize) -> f64 {
        self.shares.get(t).copied().unwrap_or(0.0)
    }

    /// The sum of the shares of the strategies with `t` in a range.
    #[must_use]
    pub fn shares(&self, t: std::ops::RangeInclusive<usize>) -> f64 {
        t.map(|t| self.share(t)).sum()
    }
}

impl WholePath<'_> {
    /// k: the number of edges.
    #[must_use]
    pub const fn length(&self) -> usize {
        self.vertices.len() - 1
    }

    /// The unit direction of the edge from vertex `i` to the next.
    fn edge(&self, i: usize) -> Vec3 {
        self.vertices[i + 1].surface.direction
    }

    /// How light passes every vertex; `None` where it does not.
    #[must_use]
    pub fn passages(&self) -> Option<Vec<Passage>> {
        let inner = 1..self.length();
        let passed = inner.map(|i| self.vertices[i].passage(self.scene, self.edge(i)));
        [Some(Passage::END)]
            .into_iter()
            .chain(passed)
            .chain([Some(Passage::END)])
            .collect()
    }

    /// What the path brings, and the shares of strategies. `passages` are those of [`passages`](Self::passages). `None` where it
    /// brings nothing, or no strategy finds it.
    #[must_use]
    pub fn measure(&self, passages: &[Passage]) -> Option<Measured> {
        let lights = &self.scene.lights;
        let k = self.length();
        let (end, before) = (&self.vertices[k], &self.vertices[k - 1]);
        let last = self.edge(k - 1);
        let delta = lights.is_delta(self.light);
        let densities = self.densities(passages, LightEnd::Sampled);
        // The density of one strategy, and what the path brings over it: that which meets the light, or, of a light in one place or
        // direction, which no path meets, that which samples it.
        let mut light = [1.0; 3];
        for passage in &passages[1..k] {
            for (light, ratio) in light.iter_mut().zip(passage.ratio) {
                *light *= ratio;
            }
        }
        let (reference, factor, emitted) = if delta {
            if k < 2 {
                return None;
            }
            let seen = lights.seen(self.light, before.surface.position)?;
            // As if it were a small lamp: also where a mirror reflects it, though no strategy samples it there.
            let factor = f64::from(passages[k - 1].onward) / f64::from(seen.density);
            (k, factor, seen.radiance)
        } else {
            (k + 1, 1.0, lights.radiance(self.light, end.surface.normal, -last))
        };
        let over: Vec<f64> = (0..k + 2)
            .map(|t| densities[t].over(densities[reference]))
            .zip(0..)
            .map(|(ratio, t)| if t > 0 && self.finds(t) { ratio } else { 0.0 })
            .collect();
        let total: f64 = over.iter().sum();
        let scale = factor / total;
        if !(scale.is_finite() && total > 0.0) {
            return None;
        }
        let emitted = emitted.to_array();
        let [r, g, b] = std::array::from_fn(|c| (light[c] * f64::from(emitted[c]) * scale) as f32);
        let measured = Measured {
            light: Rgb::new(r, g, b),
            shares: over.into_iter().map(|ratio| ratio / total).collect(),
        };
        (!measured.light.is_black()).then_some(measured)
    }

    /// The densities of all strategies by t, where the last vertex has come to be as `end` says: the products alone, also of
    /// strategies that [cannot find](Self::finds) the path, as the discrete vertices that they would join cannot be joined.
    fn densities(&self, passages: &[Passage], end: LightEnd) -> Vec<Scaled> {
        let (lights, camera) = (&self.scene.lights, &self.scene.camera);
        let k = self.length();
        let site = |i: usize| self.vertices[i].site();
        let emission = lights.emission_densities(self.light, self.vertices[k].surface.normal, -self.edge(k - 1));
        // p→ of vertex i + 1, and p← of vertex i, over their edge.
        let onward = |i: usize| {
            let density = if i == 0 {
                camera.density(self.edge(0))
            } else {
                passages[i].onward
            };
            site(i).arriving_along(&site(i + 1), density, self.edge(i))
        };
        let back = |i: usize| {
            let density = if i + 1 == k {
                emission.direction
            } else {
                passages[i + 1].back
            };
            site(i + 1).arriving_along(&site(i), density, self.edge(i))
        };
        let position = f64::from(emission.position);
        let delta = lights.is_delta(self.light);
        let sampled = if delta || k < 2 || end == LightEnd::Kept {
            position
        } else {
            let (from, to) = (&self.vertices[k - 1].surface, &self.vertices[k].surface);
            let density = lights.density(self.light, from.position, to.position, to.normal);
            site(k - 1).arriving_along(&site(k), density, self.edge(k - 1))
        };
        // The product over the light subpath of strategy t, from the longest camera subpath on.
        let mut behind = vec![Scaled::ONE; k + 2];
        for t in (1..=k).rev() {
            behind[t] = match k - t {
                0 => Scaled::new(sampled),
                1 => Scaled::new(position).times(back(t)),
                _ => behind[t + 1].times(back(t)),
            };
        }
        let mut strategies = vec![Scaled::new(0.0); k + 2];
        let mut ahead = Scaled::ONE;
        for t in 1..=k + 1 {
            strategies[t] = ahead.by(behind[t]);
            if t <= k {
                ahead = ahead.times(onward(t - 1));
            }
        }
        strategies
    }

    /// Whether the strategy with t vertices from the camera can find the path.
    fn finds(&self, t: usize) -> bool {
        let lights = &self.scene.lights;
        let (k, delta) = (self.length(), lights.is_delta(self.light));
        let connects = |i: usize| self.vertices[i].site().connects();
        match k + 1 - t {
            0 => !delta,
            // The lens samples no light; it sees those that light subpaths start at, if they are somewhere.
            1 if t == 1 => !delta && !self.vertices[k].site().is_infinite(),
            _ => connects(t - 1) && connects(t),
        }
    }
}
