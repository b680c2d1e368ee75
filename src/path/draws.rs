//! The uniform numbers that a path is made of, and where they come from: keyed streams, or the coordinates of a chain.

use super::roulette;
use crate::chain::{Kernel, KnownDraws, to_f32, to_f64};
use crate::sampling::{Purpose, Stream, StreamKey};
use crate::scene::Scene;
use glam::Vec2;

/// The numbers that choose the centre of a lens: those of cameras that have no aperture.
pub const LENS_CENTER: [f32; 2] = [0.5, 0.5];

/// The numbers that choose a light and a point on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightDraw {
    /// Chooses the light.
    pub choice: f64,
    /// Chooses the point.
    pub point: [f32; 2],
}

/// Where a path's numbers come from, vertex by vertex. Each is in [0, 1), and asked for at most once.
pub trait PathDraws {
    /// For choosing a point of the lens.
    fn lens(&mut self) -> [f32; 2];
    /// Says that the path has reached a vertex at `depth` that may scatter: what is asked for next is for that vertex.
    fn reach(&mut self, depth: u32) {
        let _ = depth;
    }
    /// For connecting the vertex at `depth` to a light.
    fn light(&mut self, depth: u32) -> LightDraw;
    /// For scattering at the vertex at `depth`.
    fn scatter(&mut self, depth: u32) -> [f32; 2];
    /// For choosing between the lobes of the material at the vertex at `depth`.
    fn lobe(&mut self, depth: u32) -> f32;
    /// For Russian roulette after the vertex at `depth`.
    fn roulette(&mut self, depth: u32) -> f32;
}

/// Marks the depths of light subpaths where draws are keyed by them; no path is as long.
pub const LIGHT_SUBPATH: u32 = 1 << 16;

/// Whether roulette is played after the vertex whose draws are keyed by `depth`.
const fn plays_roulette(depth: u32) -> bool {
    depth & !LIGHT_SUBPATH >= roulette::FIRST_DEPTH
}

/// The stream of the small steps of the vertex whose draws are keyed by `depth`. The film's is at depth 0 too: were it the
/// same as that of the vertex there, two coordinates would move as one, and T would be no product.
#[inline]
fn steps_of_vertex(key: StreamKey, depth: u32) -> Stream {
    let purpose = if depth == 0 {
        Purpose::PERTURB_LENS
    } else {
        Purpose::PERTURB
    };
    key.stream(purpose, depth)
}

/// Numbers from keyed streams: independent from step to step.
#[derive(Clone, Copy, Debug)]
pub struct KeyedDraws(pub StreamKey);

impl KeyedDraws {
    /// For starting a path at a light: a light and a point on it, and a direction.
    #[inline]
    #[must_use]
    pub fn emission(self) -> (LightDraw, [f32; 2]) {
        let mut stream = self.0.stream(Purpose::EMISSION, 0);
        let choice = stream.next_f64();
        let point = stream.next_pair();
        (LightDraw { choice, point }, stream.next_pair())
    }

    /// For choosing the pixel that light from the vertex at `depth` of a light path counts for.
    #[inline]
    #[must_use]
    pub fn splat(self, depth: u32) -> f32 {
        self.0.stream(Purpose::SPLAT, depth).next_f32()
    }
}

impl PathDraws for KeyedDraws {
    #[inline]
    fn lens(&mut self) -> [f32; 2] {
        self.0.stream(Purpose::LENS, 0).next_pair()
    }
    #[inline]
    fn light(&mut self, depth: u32) -> LightDraw {
        let mut stream = self.0.stream(Purpose::LIGHT, depth);
        let choice = stream.next_f64();
        LightDraw {
            choice,
            point: stream.next_pair(),
        }
    }
    #[inline]
    fn scatter(&mut self, depth: u32) -> [f32; 2] {
        self.0.stream(Purpose::SCATTER, depth).next_pair()
    }
    #[inline]
    fn lobe(&mut self, depth: u32) -> f32 {
        self.0.stream(Purpose::LOBE, depth).next_f32()
    }
    #[inline]
    fn roulette(&mut self, depth: u32) -> f32 {
        self.0.stream(Purpose::ROULETTE, depth).next_f32()
    }
}

/// The primary coordinates of where a path starts on the film, in units of 2⁻⁶⁴ of its width and height.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FilmCoordinates(pub [u64; 2]);

/// The primary coordinates of a vertex: `choice` in units of 2⁻⁶⁴, the others of 2⁻³².
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VertexCoordinates {
    /// Chooses a light.
    pub choice: u64,
    /// Chooses the point on it.
    pub light: [u32; 2],
    /// Chooses where to scatter to.
    pub scatter: [u32; 2],
    /// Plays roulette; only from [`roulette::FIRST_DEPTH`] on, 0 before.
    pub roulette: u32,
    /// Chooses between lobes.
    pub lobe: u32,
}

/// Which coordinates vertices have, beside those that scatter and play roulette.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CoordinateSet {
    /// Those that connect to lights.
    pub lights: bool,
    /// Those that choose between lobes.
    pub lobes: bool,
}

impl FilmCoordinates {
    /// Coordinates that depend on nothing but `key`.
    #[inline]
    #[must_use]
    pub fn independent(key: StreamKey) -> Self {
        let mut stream = key.stream(Purpose::FILM, 0);
        Self([stream.next_u64(), stream.next_u64()])
    }

    /// These coordinates, moved by a small step.
    #[inline]
    #[must_use]
    pub fn perturbed(self, kernel: &Kernel, key: StreamKey) -> Self {
        let mut stream = key.stream(Purpose::PERTURB, 0);
        Self(self.0.map(|c| kernel.perturb_wide(c, stream.next_u32())))
    }

    /// Coordinates drawn about these with a known density.
    #[must_use]
    pub fn known(self, known: &KnownDraws, key: StreamKey) -> Self {
        let mut stream = key.stream(Purpose::PERTURB, 0);
        Self(
            self.0
                .map(|c| known.draw_wide(c, [stream.next_u32(), stream.next_u32()])),
        )
    }

    /// ln of the density of drawing `to` about these by [`known`](Self::known).
    #[must_use]
    pub fn log_known(self, known: &KnownDraws, to: Self) -> f64 {
        let pairs = self.0.into_iter().zip(to.0);
        pairs.map(|(from, to)| known.log_density_wide(from, to)).sum()
    }

    /// Coordinates uniform over those that a small step from these can reach.
    #[must_use]
    pub fn uniform_in_support(self, kernel: &Kernel, key: StreamKey) -> Self {
        let mut stream = key.stream(Purpose::PERTURB, 0);
        Self(self.0.map(|c| kernel.uniform_in_support_wide(c, stream.next_u32())))
    }

    /// ln of the density of the small step from these to `to`.
    #[must_use]
    pub fn log_density(self, kernel: &Kernel, to: Self) -> f64 {
        let pairs = self.0.into_iter().zip(to.0);
        pairs.map(|(from, to)| kernel.log_density_wide(from, to)).sum()
    }

    /// The pixel that these coordinates stand for, and a film position drawn from the filter about its centre with what
    /// they say beyond the pixel: the position then counts fully for that pixel, as in
    /// [`film_position`](super::film_position), and every pixel of the film, at its edges too, has the same share of the
    /// coordinates.
    #[inline]
    #[must_use]
    pub fn on_film(self, scene: &Scene) -> (u32, Vec2) {
        let place = |c: u64, pixels: u32| {
            let x = to_f64(c) * f64::from(pixels);
            // The product can round up to the film's edge.
            let pixel = (x as u32).min(pixels - 1);
            (pixel, ((x - f64::from(pixel)) as f32).min(1.0 - f32::EPSILON / 2.0))
        };
        let ((x, u), (y, v)) = (place(self.0[0], scene.width), place(self.0[1], scene.height));
        let center = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
        (
            y * scene.width + x,
            center + Vec2::from_array(scene.filter.sample([u, v])),
        )
    }
}

impl VertexCoordinates {
    /// Coordinates of the vertex at `depth` that depend on nothing but `key`.
    #[inline]
    #[must_use]
    pub fn independent(key: StreamKey, depth: u32) -> Self {
        let mut stream = key.stream(Purpose::SCATTER, depth);
        let scatter = [stream.next_u32(), stream.next_u32()];
        let choice = stream.next_u64();
        let light = [stream.next_u32(), stream.next_u32()];
        let plays = plays_roulette(depth);
        Self {
            choice,
            light,
            scatter,
            roulette: if plays { stream.next_u32() } else { 0 },
            lobe: stream.next_u32(),
        }
    }

    /// These coordinates of the vertex at `depth`, moved by a small step.
    #[inline]
    #[must_use]
    pub fn perturbed(self, kernel: &Kernel, key: StreamKey, depth: u32) -> Self {
        let mut stream = steps_of_vertex(key, depth);
        // Eight steps fill the lanes that seven need.
        let steps = kernel.steps::<8>(std::array::from_fn(|i| if i < 7 { stream.next_u32() } else { 0 }));
        let plays = plays_roulette(depth);
        Self {
            scatter: [0, 1].map(|i| steps.narrow(i, self.scatter[i])),
            choice: steps.wide(2, self.choice),
            light: [0, 1].map(|i| steps.narrow(3 + i, self.light[i])),
            roulette: if plays { steps.narrow(5, self.roulette) } else { 0 },
            lobe: steps.narrow(6, self.lobe),
        }
    }

    /// Coordinates of the vertex at `depth` drawn about these with a known density.
    #[must_use]
    pub fn known(self, known: &KnownDraws, key: StreamKey, depth: u32) -> Self {
        let mut stream = steps_of_vertex(key, depth);
        let known = known.at(depth & !LIGHT_SUBPATH);
        let mut random = || [stream.next_u32(), stream.next_u32()];
        Self {
            scatter: self.scatter.map(|c| known.draw(c, random())),
            choice: known.draw_wide(self.choice, random()),
            light: self.light.map(|c| known.draw(c, random())),
            roulette: if plays_roulette(depth) {
                known.draw(self.roulette, random())
            } else {
                0
            },
            lobe: known.draw(self.lobe, random()),
        }
    }

    /// ln of the density of drawing `to` about these by [`known`](Self::known). Those coordinates count that the plan has.
    #[must_use]
    pub fn log_known(self, known: &KnownDraws, to: Self, depth: u32, set: CoordinateSet) -> f64 {
        let known = known.at(depth & !LIGHT_SUBPATH);
        self.sum_of_logs(
            to,
            (depth, set),
            |from, to| known.log_density(from, to),
            |from, to| known.log_density_wide(from, to),
        )
    }

    /// ln of the density of the small step from these to `to` at the vertex at `depth`. Those coordinates count that
    /// the plan has.
    #[must_use]
    pub fn log_density(self, kernel: &Kernel, to: Self, depth: u32, set: CoordinateSet) -> f64 {
        self.sum_of_logs(
            to,
            (depth, set),
            |from, to| kernel.log_density(from, to),
            |from, to| kernel.log_density_wide(from, to),
        )
    }

    /// The sum over the coordinates that the vertex at `depth` has of what `narrow` and `wide` say of each.
    #[inline]
    fn sum_of_logs(
        self,
        to: Self,
        (depth, set): (u32, CoordinateSet),
        narrow: impl Fn(u32, u32) -> f64,
        wide: impl Fn(u64, u64) -> f64,
    ) -> f64 {
        let pair = |from: [u32; 2], to: [u32; 2]| narrow(from[0], to[0]) + narrow(from[1], to[1]);
        let mut sum = pair(self.scatter, to.scatter);
        if set.lights {
            sum += wide(self.choice, to.choice) + pair(self.light, to.light);
        }
        if plays_roulette(depth) {
            sum += narrow(self.roulette, to.roulette);
        }
        if set.lobes {
            sum += narrow(self.lobe, to.lobe);
        }
        sum
    }

    /// The numbers that connect to a light.
    #[inline]
    #[must_use]
    pub fn light_draw(self) -> LightDraw {
        LightDraw {
            choice: to_f64(self.choice),
            point: self.light.map(to_f32),
        }
    }

    /// The numbers that scatter.
    #[inline]
    #[must_use]
    pub fn scatter_draw(self) -> [f32; 2] {
        self.scatter.map(to_f32)
    }

    /// The number that chooses between lobes.
    #[inline]
    #[must_use]
    pub fn lobe_draw(self) -> f32 {
        to_f32(self.lobe)
    }

    /// The number that chooses a pixel, for vertices of light paths, which are not connected to lights.
    #[inline]
    #[must_use]
    pub fn splat_draw(self) -> f32 {
        to_f32(self.light[0])
    }

    /// The number that plays roulette.
    #[inline]
    #[must_use]
    pub fn roulette_draw(self) -> f32 {
        to_f32(self.roulette)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::KernelError;

    /// The sizes and signs of all steps of one proposal, from coordinates that are all 0: no two are alike, whether they are of
    /// the film or of the vertices that either subpath starts at and goes on by. Where two were, T would be no product.
    #[test]
    fn no_two_coordinates_move_by_the_same_random_numbers() -> Result<(), KernelError> {
        let kernel = Kernel::new(1.0 / 1024.0, 0.5)?;
        let key = StreamKey::new(1, 2, 3);
        let known = KnownDraws::about(kernel);
        for is_known in [false, true] {
            let film = FilmCoordinates::default();
            let film = if is_known {
                film.known(&known, key)
            } else {
                film.perturbed(&kernel, key)
            };
            let mut moved = film.0.map(|c| (c >> 32) as u32).to_vec();
            for depth in [0, 1, 5, LIGHT_SUBPATH, LIGHT_SUBPATH | 1, LIGHT_SUBPATH | 5] {
                let from = VertexCoordinates::default();
                let vertex = if is_known {
                    from.known(&known, key, depth)
                } else {
                    from.perturbed(&kernel, key, depth)
                };
                moved.extend(vertex.scatter.into_iter().chain(vertex.light));
                moved.extend([(vertex.choice >> 32) as u32, vertex.lobe]);
                moved.extend(plays_roulette(depth).then_some(vertex.roulette));
            }
            // To what 24 bits of size tell apart.
            moved.iter_mut().for_each(|c| *c >>= 8);
            moved.sort_unstable();
            assert!(moved.windows(2).all(|pair| pair[0] != pair[1]), "{moved:?}");
        }
        Ok(())
    }
}
