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

/// A whole path in the measure of bidirectional path tracing, and the room to work it out in: to be used again for the next one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// f / r per channel, with the camera's importance for every place of the film, and filters left out.
    pub light: Rgb,
    /// How light passes x₀ … xₖ. At the ends, which it does not pass, nothing is lost, and the densities are those of the directions
    /// in which subpaths leave them.
    pub passages: Vec<Passage>,
    /// The density of xₖ where a light subpath starts, over that with which it is chosen as seen from the vertex before, the way
    /// that strategy s = 1 does: 1 where no choice is made. A mutation that keeps xₖ alone of the light's end has p₍₁,ₖ₎ times this.
    pub kept_light: f64,
    /// p₍ₛ,ₜ₎ / r by t, from 0 to k + 1; 0 for strategies that cannot find the path. They sum to 1.
    shares: Vec<f64>,
    densities: Vec<Scaled>,
}

impl Measured {
    /// The share of strategy (s, t), t = k + 1 − s: the weight that the balance heuristic gives it.
    #[must_use]
    pub fn share(&self, t: usize) -> f64 {
        self.shares.get(t).copied().unwrap_or(0.0)
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

    /// What the path brings, and the shares of strategies. `None` where it brings nothing, or no strategy finds it.
    #[must_use]
    pub fn measure(&self, measured: &mut Measured) -> Option<Rgb> {
        self.pass(&mut measured.passages)?;
        let lights = &self.scene.lights;
        let k = self.length();
        let (end, before) = (&self.vertices[k], &self.vertices[k - 1]);
        let last = self.edge(k - 1);
        let mut light = [1.0; 3];
        for passage in &measured.passages[1..k] {
            for (light, ratio) in light.iter_mut().zip(passage.ratio) {
                *light *= ratio;
            }
        }
        // The density of one strategy, and what the path brings over it: that which meets the light, or, of a light in one place or
        // direction, which no path meets, that which samples it.
        let (reference, factor, emitted) = if lights.is_delta(self.light) {
            if k < 2 {
                return None;
            }
            let seen = lights.seen(self.light, before.surface.position)?;
            // As if it were a small lamp: also where a mirror reflects it, though no strategy samples it there.
            let factor = f64::from(measured.passages[k - 1].onward) / f64::from(seen.density);
            (k, factor, seen.radiance)
        } else {
            // Lights at infinity overlap: one of them is chosen where a path meets all.
            let factor = self.meeting().recip();
            (k + 1, factor, lights.radiance(self.light, end.surface.normal, -last))
        };
        if emitted.is_black() {
            return None;
        }
        self.densities(measured);
        let Measured { shares, densities, .. } = measured;
        shares.clear();
        shares.push(0.0);
        for t in 1..k + 2 {
            shares.push(if self.finds(t) {
                densities[t].over(densities[reference])
            } else {
                0.0
            });
        }
        let total: f64 = shares.iter().sum();
        let scale = factor / total;
        if !(scale.is_finite() && total > 0.0) {
            return None;
        }
        shares.iter_mut().for_each(|share| *share /= total);
        let emitted = emitted.to_array();
        let [r, g, b] = std::array::from_fn(|c| (light[c] * f64::from(emitted[c]) * scale) as f32);
        measured.light = Rgb::new(r, g, b);
        (!measured.light.is_black()).then_some(measured.light)
    }

    /// How light passes every vertex; `None` where it does not.
    fn pass(&self, passages: &mut Vec<Passage>) -> Option<()> {
        passages.clear();
        passages.push(Passage::END);
        for i in 1..self.length() {
            passages.push(self.vertices[i].passage(self.scene, self.edge(i))?);
        }
        passages.push(Passage::END);
        Some(())
    }

    /// The chance with which a path that meets the light has it for its end.
    fn meeting(&self) -> f64 {
        if self.vertices[self.length()].site().is_infinite() {
            1.0 / self.scene.lights.infinite().count().max(1) as f64
        } else {
            1.0
        }
    }

    /// Works out the densities of all strategies by t: the products alone, also of strategies that [cannot find](Self::finds) the
    /// path, as the discrete vertices that they would join cannot be joined. Entry 0 stands for none.
    fn densities(&self, measured: &mut Measured) {
        let (lights, camera) = (&self.scene.lights, &self.scene.camera);
        let k = self.length();
        let passages = &measured.passages;
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
        let sampled = if lights.is_delta(self.light) || k < 2 {
            position
        } else {
            let (from, to) = (&self.vertices[k - 1].surface, &self.vertices[k].surface);
            let density = lights.density(self.light, from.position, to.position, to.normal);
            site(k - 1).arriving_along(&site(k), density, self.edge(k - 1))
        };
        // The product over the light subpath of strategy t, from the longest camera subpath on.
        let densities = &mut measured.densities;
        densities.clear();
        densities.resize(k + 2, Scaled::new(self.meeting()));
        for t in (1..=k).rev() {
            densities[t] = match k - t {
                0 => Scaled::new(sampled),
                1 => Scaled::new(position).times(back(t)),
                _ => densities[t + 1].times(back(t)),
            };
        }
        let mut ahead = Scaled::ONE;
        for (t, density) in densities.iter_mut().enumerate().skip(1) {
            *density = ahead.by(*density);
            if t <= k {
                ahead = ahead.times(onward(t - 1));
            }
        }
        measured.kept_light = position / sampled;
        measured.passages[0].onward = camera.density(self.edge(0));
        measured.passages[k].back = emission.direction;
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
