//! Lights that are no shapes: points, directions, and what surrounds the scene.

use super::infinite::Infinite;
use super::point::UNIFORM;
use super::{Constant, Directional, EmissionDensities, Endpoint, Image, Point, Sky, Spot, Sun};
use crate::color::Rgb;
use crate::geometry::BoundingSphere;
use crate::sampling::warp;
use glam::Vec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// A light that is no shape.
#[derive(Clone, Debug)]
pub enum Light {
    /// See [`Point`].
    Point(Point),
    /// See [`Spot`].
    Spot(Spot),
    /// See [`Directional`].
    Directional(Directional),
    /// See [`Constant`].
    Constant(Constant),
    /// See [`Image`].
    Image(Arc<Image>),
    /// See [`Sun`].
    Sun(Sun),
    /// See [`Sky`].
    Sky(Arc<Sky>),
}

/// A light as seen from a point, given that it was chosen.
pub(super) struct Arrival {
    pub direction: Vec3,
    pub target: Vec3,
    pub radiance: Rgb,
    pub density: f32,
}

/// Light that leaves, given that its light was chosen.
pub(super) struct Departure {
    pub origin: Vec3,
    pub direction: Vec3,
    /// Intensity, irradiance or radiance.
    pub value: Rgb,
    pub densities: EmissionDensities,
}

/// How near to a point light a surface is that is called brightly lit, relative to the scene's radius: films hold what is
/// 2²⁰ times as near as that, and what is far keeps all its bits.
const NEAR_POINTS: f32 = 1.0 / 256.0;

impl Light {
    /// The name in scene files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Point(_) => "Point",
            Self::Spot(_) => "Spot",
            Self::Directional(_) => "Directional",
            Self::Constant(_) | Self::Image(_) => "Environment",
            Self::Sun(_) => "Sun",
            Self::Sky(_) => "Sky",
        }
    }

    pub(super) const fn endpoint(&self) -> Endpoint {
        match self {
            Self::Point(_) | Self::Spot(_) => Endpoint::Point,
            Self::Directional(_) | Self::Constant(_) | Self::Image(_) | Self::Sun(_) | Self::Sky(_) => {
                Endpoint::Infinite
            }
        }
    }

    /// The light as one that rays meet when they leave the scene; `None` if none does.
    pub(super) fn infinite(&self) -> Option<&dyn Infinite> {
        match self {
            Self::Point(_) | Self::Spot(_) | Self::Directional(_) => None,
            Self::Constant(light) => Some(light),
            Self::Image(light) => Some(light.as_ref()),
            Self::Sun(light) => Some(light),
            Self::Sky(light) => Some(light.as_ref()),
        }
    }

    /// Mean of the channels' powers in W; of a light at infinity what reaches a disc that hides the scene.
    pub(super) fn power(&self, scene: BoundingSphere) -> f64 {
        let disc = PI * f64::from(scene.radius) * f64::from(scene.radius);
        match self {
            Self::Point(light) => light.power(),
            Self::Spot(light) => light.power(),
            Self::Directional(light) => f64::from(light.irradiance.mean()) * disc,
            Self::Constant(_) | Self::Image(_) | Self::Sun(_) | Self::Sky(_) => {
                self.infinite().map_or(0.0, |light| light.total() * disc)
            }
        }
    }

    /// Whether it sends no light at all.
    #[must_use]
    pub fn is_black(&self) -> bool {
        self.power(BoundingSphere::default()) <= 0.0
    }

    /// A radiance that pictures of the light have: its own, or what a white matt surface that faces the light has,
    /// [`NEAR_POINTS`] of the scene's radius away from a point.
    pub(super) fn max_radiance(&self, scene: BoundingSphere) -> f32 {
        let reflected = |irradiance: f32| irradiance.min(f32::MAX) * std::f32::consts::FRAC_1_PI;
        let squared = (scene.radius * NEAR_POINTS) * (scene.radius * NEAR_POINTS);
        match self {
            Self::Point(light) => reflected(light.intensity.max_channel() / squared),
            Self::Spot(light) => reflected(light.intensity.max_channel() / squared),
            Self::Directional(light) => reflected(light.irradiance.max_channel()),
            Self::Constant(_) | Self::Image(_) | Self::Sun(_) | Self::Sky(_) => {
                self.infinite().map_or(0.0, Infinite::max_radiance)
            }
        }
    }

    /// The light as seen from `from`; `None` if nothing comes from there.
    pub(super) fn sample(&self, scene: BoundingSphere, from: Vec3, u: [f64; 2]) -> Option<Arrival> {
        let at_point = |position: Vec3, intensity: &dyn Fn(Vec3) -> Rgb| {
            let (direction, falloff) = Point::seen(position, from)?;
            Some(Arrival {
                direction,
                target: position,
                radiance: intensity(-direction) * falloff,
                density: 1.0,
            })
        };
        let at_infinity = |direction: Vec3, radiance: Rgb, density: f32| Arrival {
            direction,
            target: beyond(scene, from, direction),
            radiance,
            density,
        };
        match self {
            Self::Point(light) => at_point(light.position, &|_| light.intensity),
            Self::Spot(light) => at_point(light.position, &|away| light.intensity * light.profile(away)),
            Self::Directional(light) => Some(at_infinity(-light.direction, light.irradiance, 1.0)),
            Self::Constant(_) | Self::Image(_) | Self::Sun(_) | Self::Sky(_) => {
                let light = self.infinite()?;
                let direction = light.sample(u)?;
                Some(at_infinity(
                    direction,
                    light.radiance(direction),
                    light.density(direction),
                ))
            }
        }
    }

    /// A ray that leaves the light.
    pub(super) fn emit(&self, scene: BoundingSphere, u: [f64; 2], direction: [f32; 2]) -> Option<Departure> {
        let (origin, direction, value) = match self {
            Self::Point(light) => (light.position, Point::direction(direction), light.intensity),
            Self::Spot(light) => {
                let direction = light.direction(direction);
                (light.position, direction, light.intensity * light.profile(direction))
            }
            // Its place on the disc is all there is to draw.
            Self::Directional(light) => (
                on_disc(scene, light.direction, direction),
                light.direction,
                light.irradiance,
            ),
            Self::Constant(_) | Self::Image(_) | Self::Sun(_) | Self::Sky(_) => {
                let light = self.infinite()?;
                let towards = light.sample(u)?;
                (on_disc(scene, -towards, direction), -towards, light.radiance(towards))
            }
        };
        Some(Departure {
            origin,
            direction,
            value,
            densities: self.emission_densities(scene, direction),
        })
    }

    /// Densities of a ray that leaves along the unit direction `towards`.
    pub(super) fn emission_densities(&self, scene: BoundingSphere, towards: Vec3) -> EmissionDensities {
        let disc = || (1.0 / (PI * f64::from(scene.radius) * f64::from(scene.radius))) as f32;
        match self {
            Self::Point(_) => EmissionDensities {
                position: 1.0,
                direction: UNIFORM,
            },
            Self::Spot(light) => EmissionDensities {
                position: 1.0,
                direction: light.density(towards),
            },
            Self::Directional(_) => EmissionDensities {
                position: 1.0,
                direction: disc(),
            },
            Self::Constant(_) | Self::Image(_) | Self::Sun(_) | Self::Sky(_) => EmissionDensities {
                position: self.infinite().map_or(0.0, |light| light.density(-towards)),
                direction: disc(),
            },
        }
    }
}

/// A point in `direction` from `from`, outside the scene whichever side of it `from` is on.
pub(super) fn beyond(scene: BoundingSphere, from: Vec3, direction: Vec3) -> Vec3 {
    let (from, center) = (from.as_dvec3(), scene.center.as_dvec3());
    let distance = from.distance(center) + 2.0 * f64::from(scene.radius);
    (from + direction.as_dvec3() * distance).as_vec3()
}

/// A point uniform over the disc of the scene's radius that touches its sphere where light along `direction` arrives.
fn on_disc(scene: BoundingSphere, direction: Vec3, u: [f32; 2]) -> Vec3 {
    let direction = direction.as_dvec3();
    let radius = f64::from(scene.radius);
    let p = warp::disk(u).as_dvec2() * radius;
    let (x, y) = direction.normalize().any_orthonormal_pair();
    (scene.center.as_dvec3() - direction * radius + x * p.x + y * p.y).as_vec3()
}
