//! What a film's unit is to be, for independent samples that bring light to many pixels.
//!
//! Sums are in fixed point, so their unit has to be near what samples are like. How bright that is depends on what the camera
//! sees, and how near to a light at a point it lies; lights alone do not tell. So some samples are looked at first: the typical one
//! is their geometric mean, which neither a few very bright ones move nor many dim ones. It may be off by a factor of 2²⁰ before
//! anything is lost but time: brighter light is summed in wide numbers, dimmer light keeps 20 bits.

use super::tile_world::TileWorld;
use crate::film::{FilmError, GroupFilm};
use crate::path::{ChainTable, ProposedSplatCount, ProposedSplatTable, SplatColor, target_of};
use crate::plan::TilePlan;
use crate::systems::tile::{SplatFilms, TilePlace};
use bevy_ecs::world::World;
use std::sync::{Arc, Mutex};

/// Stretches of the film that are looked at, and samples of each.
const STRETCHES: u64 = 16;
const SAMPLES: u64 = 64;
/// Steps that are looked at, one after another, until one finds light.
const STEPS: u64 = 16;
/// The exponents that units are held to: their inverses, and what is multiplied with them, are `f32`s.
const LARGEST_EXPONENT: f64 = 100.0;

/// The power of two next to what a typical sample brings, summed over pixels and channels; next to `otherwise` where those
/// that are looked at bring no light. `insert` adds the resources that the systems read, but for the film.
pub(super) fn unit(
    tile: &TilePlan,
    pixels: u32,
    seed: u64,
    otherwise: f32,
    insert: impl FnOnce(&mut World),
) -> Result<f64, FilmError> {
    // What the samples splat is of no interest.
    let film = Mutex::new(GroupFilm::new(1, 1)?);
    let mut world = TileWorld::new(&tile.clone().without_layers(), seed, |world| {
        insert(world);
        world.insert_resource(SplatFilms {
            films: Arc::new([film]),
            scale: 1.0,
        });
    });
    for step in 0..STEPS {
        let (mut logarithms, mut lit) = (0.0, 0_u32);
        for stretch in 0..STRETCHES {
            let first = (u64::from(pixels) * stretch / STRETCHES) as u32;
            let end = pixels.min(first + SAMPLES as u32);
            // The chains are the same however large tiles are.
            for begin in (first..end).step_by(tile.size as usize) {
                world.run(begin, tile.size.min(end - begin), step..step + 1);
                for light in found(&mut world) {
                    logarithms += libm::log2(light);
                    lit += 1;
                }
            }
        }
        if lit > 0 {
            return Ok(power_of_two(logarithms / f64::from(lit)));
        }
    }
    Ok(if otherwise > 0.0 && otherwise.is_finite() {
        power_of_two(libm::log2(f64::from(otherwise)))
    } else {
        1.0
    })
}

/// The light of each sample of the tile that has any.
fn found(world: &mut TileWorld) -> Vec<f64> {
    let place = *world.world().resource::<TilePlace>();
    let counts = world.all::<ProposedSplatCount, ChainTable>();
    let colors = world.all::<SplatColor, ProposedSplatTable>();
    let chains = counts.iter().take(place.chains as usize).enumerate();
    let light = chains.map(|(chain, &count)| {
        let entries = (0..count).filter_map(|k| colors.get(place.vertex(chain, k)));
        entries.map(|&color| f64::from(target_of(color))).sum::<f64>()
    });
    light.filter(|light| *light > 0.0 && light.is_finite()).collect()
}

/// The power of two next to 2^`exponent`.
fn power_of_two(exponent: f64) -> f64 {
    libm::exp2(libm::round(exponent).clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT))
}
