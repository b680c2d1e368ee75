//! All lights of a scene.

use super::{EmissionDensities, Emitted, Emitter, Endpoint, Light, LightSample};
use crate::color::Rgb;
use crate::geometry::{BoundingSphere, offset_distance, offset_origin};
use crate::material::Frame;
use crate::sampling::discrete::Discrete;
use crate::sampling::warp;
use glam::Vec3;
use std::f32::consts::PI;

/// Lights by number, emitters first, and the distribution over them.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    emitters: Vec<Emitter>,
    /// Unit geometric normals of triangles and disks; the others have one per point.
    normals: Vec<Vec3>,
    /// Lights that are no shapes: their numbers follow those of the emitters.
    others: Vec<Light>,
    /// Numbers of the lights that rays meet which leave the scene.
    infinite: Vec<u32>,
    /// Around the scene: lights at infinity send their light through it.
    scene: BoundingSphere,
    /// In proportion to power.
    choice: Discrete,
}

impl LightTable {
    /// A table of emitters alone, chosen in proportion to π · area · mean radiance.
    #[must_use]
    pub fn new(emitters: Vec<Emitter>) -> Self {
        Self::with_lights(emitters, Vec::new(), BoundingSphere::default())
    }

    /// A table of emitters, and of other lights of a scene inside `scene`. All are chosen in proportion to their power:
    /// what comes from infinity has the power that arrives on a disc which hides the scene.
    #[must_use]
    pub fn with_lights(emitters: Vec<Emitter>, others: Vec<Light>, scene: BoundingSphere) -> Self {
        let powers = emitters.iter().map(Emitter::power);
        let choice = Discrete::new(powers.chain(others.iter().map(|light| light.power(scene))));
        let normals = emitters.iter().map(Emitter::flat_normal).collect();
        let numbered = (emitters.len() as u32..).zip(&others);
        let infinite = numbered.filter(|(_, light)| light.infinite().is_some());
        Self {
            infinite: infinite.map(|(number, _)| number).collect(),
            emitters,
            normals,
            others,
            scene,
            choice,
        }
    }

    /// Number of lights.
    #[must_use]
    pub fn len(&self) -> usize {
        self.emitters.len() + self.others.len()
    }

    /// Number of emitting primitives: the first so many lights.
    #[must_use]
    pub fn emitter_count(&self) -> usize {
        self.emitters.len()
    }

    /// Whether nothing emits.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.choice.is_empty()
    }

    /// A radiance near the largest that pictures of the scene have, by which a film chooses its unit; 0 if nothing emits.
    /// The largest radiance of any channel of what can be seen. A point or a single direction is never seen: it
    /// counts as a white matt surface that faces it, a radius of the scene away.
    #[must_use]
    pub fn max_radiance(&self) -> f32 {
        let emitters = self.emitters.iter().map(|e| e.radiance.max_channel());
        let others = self.others.iter().map(|light| light.max_radiance(self.scene));
        emitters.chain(others).fold(0.0, f32::max)
    }

    /// The light with this number, if it is no shape.
    #[inline]
    fn other(&self, light: u32) -> Option<&Light> {
        self.others.get((light as usize).checked_sub(self.emitters.len())?)
    }

    /// What kind of vertex a path has on the light.
    #[inline]
    #[must_use]
    pub fn endpoint(&self, light: u32) -> Endpoint {
        self.other(light).map_or(Endpoint::Surface, Light::endpoint)
    }

    /// Whether no path meets the light by chance: a point, or a single direction.
    #[inline]
    #[must_use]
    pub fn is_delta(&self, light: u32) -> bool {
        self.other(light).is_some_and(|light| light.infinite().is_none())
    }

    /// Number of lights that are no shapes: the last so many.
    #[must_use]
    pub fn other_count(&self) -> usize {
        self.others.len()
    }

    /// The lights that send some light and that no path meets by chance: points, and single directions.
    pub fn unmet(&self) -> impl Iterator<Item = u32> {
        let others = self.emitters.len() as u32..self.len() as u32;
        others
            .filter(|&light| self.is_delta(light) && !self.is_empty() && self.choice.probability(light as usize) > 0.0)
    }

    /// Whether there are lights that rays meet which leave the scene.
    #[inline]
    #[must_use]
    pub fn has_infinite(&self) -> bool {
        self.infinite().next().is_some()
    }

    /// The lights that rays meet which leave the scene. They overlap: each has a radiance and a density in every
    /// direction, and their light adds up.
    pub fn infinite(&self) -> impl Iterator<Item = u32> {
        self.infinite.iter().copied()
    }

    /// Chooses a light with `choice` and a point on it with `u`, as seen from `from`. `None` if no light reaches
    /// `from` from there: its back, its edge, or the reference point inside it. Part of its callers, so that what they
    /// do not ask of the sample is not computed.
    #[inline(always)]
    #[must_use]
    pub fn sample(&self, from: Vec3, choice: f64, u: [f32; 2]) -> Option<LightSample> {
        let number = self.choice.sample(choice)?;
        if number >= self.emitters.len() {
            let rest = self.choice.rest(choice, number);
            return self.sample_other(number as u32, from, refined(u, rest));
        }
        let emitter = &self.emitters[number];
        let point = emitter.sample(self.normals[number], from, u)?;
        let density = self.choice.probability(number) * point.density;
        // The product of two tiny numbers can vanish; what was drawn must be divisible by its density.
        if density == 0.0 {
            return None;
        }
        let distance = (point.position - from).length();
        // The farther the light, the coarser the intersector's view of it, even in f64.
        let offset = offset_distance(point.position, point.normal, emitter.area.sqrt() + distance);
        Some(LightSample {
            direction: point.direction,
            target: offset_origin(point.position, point.normal, offset, point.normal),
            radiance: emitter.radiance,
            density,
            light: number as u32,
            position: point.position,
            normal: point.normal,
            discrete: false,
        })
    }

    /// [`sample`](Self::sample) of a light that is no shape. A call of its own: lamps are sampled far more often.
    #[inline(never)]
    fn sample_other(&self, light: u32, from: Vec3, u: [f64; 2]) -> Option<LightSample> {
        let arrival = self.other(light)?.sample(self.scene, from, u)?;
        let density = self.choice.probability(light as usize) * arrival.density;
        let usable = density > 0.0 && density.is_finite() && arrival.radiance.is_finite();
        (usable && !arrival.radiance.is_black()).then_some(LightSample {
            direction: arrival.direction,
            target: arrival.target,
            radiance: arrival.radiance,
            density,
            light,
            position: arrival.target,
            normal: -arrival.direction,
            discrete: self.is_delta(light),
        })
    }

    /// A discrete light as seen from `from`, with the probability of choosing it; `None` for any other light, and where none of
    /// its light goes.
    #[must_use]
    pub fn seen(&self, light: u32, from: Vec3) -> Option<LightSample> {
        self.is_delta(light).then(|| self.sample_other(light, from, [0.0; 2]))?
    }

    /// A point outside the scene in the unit direction `direction` from `from`: where a segment to a light at infinity ends.
    #[must_use]
    pub fn beyond(&self, from: Vec3, direction: Vec3) -> Vec3 {
        super::kind::beyond(self.scene, from, direction)
    }

    /// The density, per solid angle at `from`, with which [`sample`](Self::sample) finds the point `position` with the
    /// unit geometric normal `normal` on emitter `light`. For a light at infinity `position` does not matter, and `normal`
    /// is the direction in which the light travels. Zero for discrete lights: no other way leads to them.
    #[inline]
    #[must_use]
    pub fn density(&self, light: u32, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        let number = light as usize;
        let density = match self.other(light) {
            None => self.emitters[number].density(from, position, normal),
            Some(light) => light.infinite().map_or(0.0, |light| light.density(-normal)),
        };
        self.choice.probability(number) * density
    }

    /// Radiance that emitter `light` sends from a point with geometric normal `normal` along the unit direction
    /// `towards`. For a light at infinity `towards` is the direction in which the light travels, and `normal` does not
    /// matter. Black for discrete lights, which have none.
    #[inline]
    #[must_use]
    pub fn radiance(&self, light: u32, normal: Vec3, towards: Vec3) -> Rgb {
        match self.other(light) {
            None if normal.dot(towards) > 0.0 => self.emitters[light as usize].radiance,
            None => Rgb::BLACK,
            Some(light) => light.infinite().map_or(Rgb::BLACK, |light| light.radiance(-towards)),
        }
    }

    /// Chooses a light with `choice`, where on it with `point`, and a direction with `direction`, and sends light into the
    /// scene. `None` where nothing leaves that way. A light at infinity draws its direction with `point`, and where its
    /// ray starts with `direction`.
    #[inline]
    #[must_use]
    pub fn emit(&self, choice: f64, point: [f32; 2], direction: [f32; 2]) -> Option<Emitted> {
        let number = self.choice.sample(choice)?;
        let light = number as u32;
        if number >= self.emitters.len() {
            let rest = self.choice.rest(choice, number);
            return self.emit_other(light, refined(point, rest), direction);
        }
        let emitter = &self.emitters[number];
        let (position, normal) = emitter.point(self.normals[number], point);
        let local = warp::cosine_hemisphere(direction);
        let direction = Frame::new(normal).to_world(local).normalize();
        let densities = self.emission_densities(light, normal, direction);
        // The cosine over its density is π.
        let ratio = emitter.radiance * (PI / densities.position);
        if !densities.are_usable() || !ratio.is_finite() {
            return None;
        }
        let offset = offset_distance(position, normal, emitter.area.sqrt());
        Some(Emitted {
            light,
            endpoint: Endpoint::Surface,
            origin: offset_origin(position, normal, offset, direction),
            position,
            normal,
            direction,
            ratio,
            densities,
        })
    }

    /// [`emit`](Self::emit) from a light that is no shape.
    fn emit_other(&self, light: u32, u: [f64; 2], direction: [f32; 2]) -> Option<Emitted> {
        let other = self.other(light)?;
        let departure = other.emit(self.scene, u, direction)?;
        let densities = self.chosen(light, departure.densities);
        let ratio = departure.value / densities.position / densities.direction;
        let usable = densities.are_usable() && ratio.is_finite() && !ratio.is_black();
        usable.then_some(Emitted {
            light,
            endpoint: other.endpoint(),
            origin: departure.origin,
            position: departure.origin,
            normal: departure.direction,
            direction: departure.direction,
            ratio,
            densities,
        })
    }

    /// The densities with which [`emit`](Self::emit) draws light that leaves a point with the unit geometric normal `normal` of
    /// light `light` along the unit direction `towards`. Points of a light are drawn uniformly, so which one does not matter.
    /// For lights that are no shapes the normal does not matter either; for discrete ones the densities are those of the
    /// place or direction where the light is.
    #[inline]
    #[must_use]
    pub fn emission_densities(&self, light: u32, normal: Vec3, towards: Vec3) -> EmissionDensities {
        match self.other(light) {
            None => EmissionDensities {
                position: self.choice.probability(light as usize) / self.emitters[light as usize].area,
                direction: warp::cosine_hemisphere_density(normal.dot(towards)),
            },
            Some(other) => self.chosen(light, other.emission_densities(self.scene, towards)),
        }
    }

    /// Densities of a light, with the choice of it.
    fn chosen(&self, light: u32, given: EmissionDensities) -> EmissionDensities {
        EmissionDensities {
            position: self.choice.probability(light as usize) * given.position,
            direction: given.direction,
        }
    }
}

/// Uniform numbers with the bits that the choice of a light left over: those of `u` end at 2⁻²⁴, which in a picture with a
/// sun in it are too few for the rest of the sky.
fn refined([u, v]: [f32; 2], rest: f64) -> [f64; 2] {
    const END: f64 = 1.0 / 16_777_216.0;
    let shifted = rest / END;
    let both = [
        f64::from(u) + rest * END,
        f64::from(v) + (shifted - shifted.floor()) * END,
    ];
    both.map(|u| u.min(1.0_f64.next_down()))
}
