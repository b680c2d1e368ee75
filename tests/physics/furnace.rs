//! The white furnace: in a closed room whose walls emit radiance 1 and reflect the share ρ, every ray sees
//! 1 + ρ + … + ρⁿ⁻¹ over paths of at most n edges, whatever the room's shape and however paths are sampled.

use super::enclosure::walls;
use crate::support::render::{picture, quarters, scene, whole};
use crate::support::verdict::Family;
use chainlight::plan::Technique;

/// Per channel.
const REFLECTANCES: [f64; 3] = [0.0, 0.5, 0.9];
/// Most edges of a path, and samples per pixel.
const DEPTHS: [(u32, u64); 5] = [(1, 16), (2, 256), (3, 256), (8, 512), (64, 512)];
const WHITE_DEPTHS: [(u32, u64); 3] = [(2, 256), (3, 256), (8, 512)];
/// Two techniques; per picture the whole and its quarters, per channel but for one of the white room.
const FAMILY: Family = Family {
    tests: 2 * 5 * (3 * DEPTHS.len() + WHITE_DEPTHS.len()),
};
/// A bias of the whole picture of 2 % is seen, and of a quarter of 4 %.
const SEES: [f64; 2] = [0.02, 0.04];

fn series(reflectance: f64, terms: u32) -> f64 {
    (0..terms).fold(0.0, |sum, _| 1.0 + reflectance * sum)
}

fn room(max_depth: u32, reflectance: [f64; 3]) -> std::sync::Arc<chainlight::scene::Scene> {
    let [r, g, b] = reflectance;
    let camera = "origin: (0.3, -0.4, 0.5), target: (-0.2, 0.1, -1), fov: 100";
    let material = format!("\"wall\": Diffuse(reflectance: ({r}, {g}, {b}))");
    scene(max_depth, camera, &material, &walls())
}

fn check(technique: Technique, max_depth: u32, steps: u64, reflectances: [f64; 3], channels: &[usize]) {
    let picture = picture(&room(max_depth, reflectances), technique, 11, steps);
    for &channel in channels {
        let reflectance = reflectances[channel];
        // A reflectance is an f32 and so is every product along a path: a rounding per edge.
        let expected = series(f64::from(reflectance as f32), max_depth);
        let slack = 2e-7 * expected * f64::from(max_depth);
        let name = format!("{technique}, {max_depth} edges, reflectance {reflectance}");
        let whole = whole(&picture, channel);
        FAMILY.is(&name, whole, expected, slack, SEES[0]);
        FAMILY.is_not(&name, whole, 1.02 * expected, slack);
        for (quarter, mean) in quarters(&picture, channel).into_iter().enumerate() {
            FAMILY.is(&format!("{name}, quarter {quarter}"), mean, expected, slack, SEES[1]);
        }
    }
}

#[test]
fn a_room_of_light_shows_the_geometric_series() {
    for technique in Technique::INDEPENDENT {
        for (depth, steps) in DEPTHS {
            check(technique, depth, steps, REFLECTANCES, &[0, 1, 2]);
        }
    }
}

#[test]
fn a_room_that_absorbs_nothing_shows_a_term_per_edge() {
    for technique in Technique::INDEPENDENT {
        for (depth, steps) in WHITE_DEPTHS {
            check(technique, depth, steps, [1.0; 3], &[0]);
        }
    }
}
