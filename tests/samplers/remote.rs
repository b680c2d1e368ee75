//! Lights that are no shapes, for the tests of their samplers.

use chainlight::color::Rgb;
use chainlight::geometry::BoundingSphere;
use chainlight::light::{Constant, Directional, Image, Light, LightTable, Point, Sky, Spot, Sun};
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// The sphere of the scenes that they shine on.
pub const SCENE: BoundingSphere = BoundingSphere {
    center: Vec3::new(3.0, -1.0, 2.0),
    radius: 5.0,
};

/// A table of one light.
pub fn alone(light: Light) -> LightTable {
    LightTable::with_lights(Vec::new(), vec![light], SCENE)
}

/// An environment of texels by column and row.
pub fn image(width: usize, height: usize, up: Vec3, rotate: f32, texel: impl Fn(usize, usize) -> Rgb) -> Image {
    let texels = (0..width * height).map(|i| texel(i % width, i / width)).collect();
    Image::new((width, height), texels, up.as_dvec3(), rotate).expect("an environment")
}

fn picture(image: Image) -> Light {
    Light::Image(Arc::new(image))
}

/// Lights that rays meet over much of the sphere: of one radiance; pictures with smooth colours, with one hot texel in
/// the middle, in a corner at pole and seam, with dark and noisy parts, of a single texel and of a single row; skies.
pub fn wide() -> Vec<(&'static str, Light)> {
    let dim = Rgb::splat(0.01);
    let hot = |at: (usize, usize)| {
        move |c: usize, r: usize| {
            if (c, r) == at {
                Rgb::new(900.0, 500.0, 100.0)
            } else {
                dim
            }
        }
    };
    let smooth = |c: usize, r: usize| Rgb::new(1.0 + c as f32, 2.0 + r as f32, 3.0 + ((c * r) % 5) as f32);
    let noise = |c: usize, r: usize| {
        let bits = (c as u32 * 2_654_435_761).wrapping_add(r as u32 * 40_503) >> 13;
        if (8..20).contains(&c) || r > 12 {
            Rgb::BLACK
        } else {
            Rgb::new(0.0, (bits % 100) as f32, 3.0)
        }
    };
    let sky = |elevation: f64, turbidity: f32| {
        let sun = DVec3::new(libm::cos(elevation), libm::sin(elevation), 0.0);
        Light::Sky(Arc::new(Sky::new(sun, DVec3::Y, turbidity, Rgb::splat(0.3), 2.0)))
    };
    vec![
        (
            "constant",
            Light::Constant(Constant {
                radiance: Rgb::new(1.0, 2.0, 4.0),
            }),
        ),
        ("smooth picture", picture(image(7, 5, Vec3::Y, 0.0, smooth))),
        (
            "hot texel",
            picture(image(64, 32, Vec3::new(1.0, -2.0, 0.5), 50.0, hot((40, 11)))),
        ),
        (
            "hot texel at pole and seam",
            picture(image(32, 16, Vec3::Y, 0.0, hot((0, 0)))),
        ),
        (
            "noisy picture with dark parts",
            picture(image(24, 16, Vec3::NEG_Y, -20.0, noise)),
        ),
        ("single texel", picture(image(1, 1, Vec3::X, 0.0, |_, _| Rgb::ONE))),
        ("single row", picture(image(9, 1, Vec3::Z, 7.0, smooth))),
        ("clear evening sky", sky(0.1, 2.0)),
        ("hazy noon sky", sky(1.5, 8.0)),
    ]
}

/// Towards a sun that the axes of the world do not favour.
pub const SUNWARD: DVec3 = DVec3::new(0.3, 0.8, -0.4);

/// Discs.
pub fn discs() -> Vec<(&'static str, f32, Light)> {
    [
        ("the sun", 0.2665),
        ("a disc of a hundredth of a degree", 0.01),
        ("a wide disc", 40.0),
    ]
    .map(|(name, radius)| {
        (
            name,
            radius,
            Light::Sun(Sun::disc(SUNWARD, radius, Rgb::new(3.0, 2.0, 1.0))),
        )
    })
    .into()
}

/// Spots, with their half angles.
pub fn spots() -> Vec<(&'static str, [f32; 2], Light)> {
    [
        ("spot", [15.0, 20.0]),
        ("sharp spot", [30.0, 30.0]),
        ("soft spot", [0.0, 90.0]),
        ("narrow spot", [0.05, 0.1]),
    ]
    .map(|(name, [beam, cutoff])| {
        let spot = Spot::new(Vec3::new(1.0, 2.0, 3.0), SUNWARD, Rgb::new(3.0, 2.0, 1.0), cutoff, beam);
        (name, [beam, cutoff], Light::Spot(spot))
    })
    .into()
}

/// A point light.
pub fn point() -> Light {
    Light::Point(Point {
        position: Vec3::new(1.0, 2.0, 3.0),
        intensity: Rgb::new(3.0, 2.0, 1.0),
    })
}

/// Parallel light.
pub fn parallel() -> Light {
    Light::Directional(Directional {
        direction: -SUNWARD.normalize().as_vec3(),
        irradiance: Rgb::new(3.0, 2.0, 1.0),
    })
}
