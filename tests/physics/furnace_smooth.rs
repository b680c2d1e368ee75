//! The furnace with something smooth in it: in a room whose black walls emit radiance 1, a mirror or a glass ball that
//! absorbs nothing cannot be seen.

use super::enclosure::walls;
use crate::support::render::{picture, scene, whole};
use crate::support::verdict::{Family, say};
use chainlight::film::Picture;
use chainlight::material::fresnel;
use chainlight::plan::Technique;

const MAX_DEPTH: u32 = 64;
/// Interior and exterior indices of the balls: the last is air in water.
const BALLS: [(f32, f32); 4] = [(1.5, 1.0), (1.0, 1.0), (1.000_01, 1.0), (1.0, 1.33)];
const FAMILY: Family = Family { tests: 2 * BALLS.len() };

fn with_ball(technique: Technique, material: &str) -> Picture {
    let camera = "origin: (0, 0, 0.9), target: (0, 0, 0), fov: 70";
    let materials = format!("\"wall\": Diffuse(reflectance: (0, 0, 0)), \"ball\": {material}");
    let ball = "(shape: Sphere(center: (0.05, -0.02, 0), radius: 0.5), material: \"ball\")";
    picture(
        &scene(MAX_DEPTH, camera, &materials, &(walls() + ball)),
        technique,
        12,
        256,
    )
}

/// The share of the light that falls on a ball and is still inside when paths end: over all places, of which one that
/// is hit under the cosine c stands for 2c dc, what enters times what every later crossing keeps. A ray meets a sphere
/// from inside always under the angle under which it entered, so that it keeps the same share each time.
fn truncated(interior: f32, exterior: f32) -> f64 {
    const CELLS: u32 = 100_000;
    let cell = |i| {
        let c = (f64::from(i) + 0.5) / f64::from(CELLS);
        let kept = f64::from(fresnel::dielectric(c as f32, interior / exterior).reflectance);
        // The camera's edge, one to enter, and every other one inside.
        2.0 * c * (1.0 - kept) * libm::pow(kept, f64::from(MAX_DEPTH - 3)) / f64::from(CELLS)
    };
    (0..CELLS).map(cell).sum()
}

#[test]
fn a_glass_ball_in_a_room_of_light_cannot_be_seen() {
    for (interior, exterior) in BALLS {
        let lost = truncated(interior, exterior);
        say(&format!(
            "index {interior} in {exterior}: {lost:e} of the light is truncated"
        ));
        assert!(lost < 2e-4, "{interior} in {exterior}: {lost}");
        for technique in Technique::INDEPENDENT {
            let picture = with_ball(
                technique,
                &format!("Dielectric(interior_ior: {interior}, exterior_ior: {exterior})"),
            );
            let name = format!("{technique}, ball of index {interior} in {exterior}");
            // Two roundings a crossing, of few crossings, besides.
            let slack = lost + 1e-6;
            let mean = whole(&picture, 1);
            FAMILY.is(&name, mean, 1.0, slack, 5e-3);
            FAMILY.is_not(&name, mean, 1.02, slack);
            // Where paths are short nothing is left to chance.
            let exact = picture.rgb.iter().filter(|rgb| (rgb.g - 1.0).abs() < 1e-6).count();
            assert!(exact > picture.rgb.len() / 4, "{name}: {exact} pixels");
        }
    }
}

#[test]
fn a_mirror_ball_in_a_room_of_light_cannot_be_seen() {
    for technique in Technique::INDEPENDENT {
        let picture = with_ball(technique, "Conductor(eta: (0, 0, 0), k: (1, 1, 1))");
        for (rgb, error) in picture.rgb.iter().zip(&picture.error) {
            assert_eq!((rgb.to_array(), error.to_array()), ([1.0; 3], [0.0; 3]), "{technique}");
        }
        let absorbing = with_ball(technique, "Conductor(eta: (0.2, 0.2, 0.2), k: (9, 9, 9))");
        assert!(
            whole(&absorbing, 1).mean < 0.999,
            "{technique}: the ball absorbs, and shows"
        );
    }
}
