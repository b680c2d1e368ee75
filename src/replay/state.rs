//! States of a chain, and the coordinates that they are made of.

use super::number::number;
use crate::chain::{Class, Rejections, StateClass, Target, to_f64};
use crate::color::Rgb;
use crate::film::BlockGrid;
use crate::path::*;
use crate::render::TileWorld;
use crate::scene::Scene;
use crate::systems::tile::TilePlace;
use crate::table::{Column, Table};
use serde::Serialize;

/// A state of a chain between two steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct State {
    /// The target f(x); 0 before the first state that has light.
    #[serde(serialize_with = "number")]
    pub target: f32,
    /// Its classes.
    pub class: Classes,
    /// Where its path starts.
    pub film: Option<FilmStart>,
    /// The primary coordinates of its vertices, to where its path ended.
    pub coordinates: Vec<Coordinates>,
    /// Those of its light subpath, where it has one.
    pub light_coordinates: Vec<Coordinates>,
    /// What it adds to the film, for a weight of one.
    pub splats: Vec<SplatAt>,
    /// Steps since the chain last moved.
    pub rejections: u32,
}

/// Classes of a state, as statistics keep them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Classes {
    /// The packed number.
    #[serde(skip)]
    pub number: u32,
    /// The block of the film that the state reaches.
    pub block: String,
    /// Edges of the path that carries most of its light.
    pub length: u32,
    /// What that path scatters from, from the eye on.
    pub signature: String,
}

/// Where on the film a path starts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FilmStart {
    /// Its primary coordinates, where it has any: shares of the film's width and height.
    pub coordinates: Option<[f64; 2]>,
    /// The same to the last bit, in units of 2⁻⁶⁴.
    #[serde(skip)]
    pub bits: Option<FilmCoordinates>,
    /// Column and row of the pixel that the path counts for.
    pub pixel: [u32; 2],
    /// The point on the film that the path goes through, in pixels from the top left.
    pub position: [f32; 2],
}

/// The primary coordinates of a vertex, as the numbers in [0, 1) that its path is made of.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coordinates {
    /// The vertex's depth.
    pub depth: u32,
    /// The same to the last bit.
    #[serde(skip)]
    pub bits: VertexCoordinates,
    /// Choose where it scatters to.
    pub scatter: [f32; 2],
    /// Chooses a light, where the plan connects to lights.
    pub light: Option<f64>,
    /// Choose the point on it.
    pub light_point: Option<[f32; 2]>,
    /// Plays roulette, from the depth on at which it is played.
    pub roulette: Option<f32>,
}

/// A splat.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SplatAt {
    /// Column and row of its pixel.
    pub pixel: [u32; 2],
    /// Its colour for a weight of one.
    #[serde(serialize_with = "number")]
    pub color: Rgb,
}

/// The current state of the only chain in `world`; none where there are no states.
pub(super) fn current(world: &mut TileWorld, scene: &Scene, blocks: &BlockGrid) -> Option<State> {
    let target = world.at::<Target, ChainTable>(0)?;
    let film = world.at::<PrimaryFilm, ChainTable>(0);
    let splats = world.at::<SplatCount, ChainTable>(0).unwrap_or(0);
    Some(State {
        target,
        class: classes(world.at::<Class, ChainTable>(0).unwrap_or_default(), blocks),
        film: film.map(|bits| film_start(FilmCoordinates(bits), scene)),
        coordinates: coordinates::<PrimaryDepth, PrimaryTable>(world, camera_path(world)),
        light_coordinates: coordinates::<PrimaryDepth, PrimaryTable>(world, light_path(world)),
        splats: self::splats::<SplatTable>(world, splats, scene),
        rejections: world.at::<Rejections, ChainTable>(0).unwrap_or(0),
    })
}

/// Classes by name.
pub(super) fn classes(number: u32, blocks: &BlockGrid) -> Classes {
    let class = StateClass(number);
    Classes {
        number,
        block: blocks.name(class.block() as usize),
        length: class.length(),
        signature: class.signature().name(),
    }
}

/// Where a path with these coordinates starts.
pub(super) fn film_start(bits: FilmCoordinates, scene: &Scene) -> FilmStart {
    let (pixel, position) = bits.on_film(scene);
    FilmStart {
        coordinates: Some(bits.0.map(to_f64)),
        bits: Some(bits),
        pixel: column_and_row(pixel, scene),
        position: position.to_array(),
    }
}

/// Column and row of a pixel.
pub(super) fn column_and_row(pixel: u32, scene: &Scene) -> [u32; 2] {
    let width = scene.width.max(1);
    [pixel % width, pixel / width]
}

/// The subpath of the only chain that starts at the camera, if there is one.
pub(super) fn camera_path(world: &TileWorld) -> Option<usize> {
    (world.world().resource::<TilePlace>().lights_from > 0).then_some(0)
}

/// The subpath of the only chain that starts at a light, if there is one.
pub(super) fn light_path(world: &TileWorld) -> Option<usize> {
    let place = world.world().resource::<TilePlace>();
    (place.lights_from < place.capacity).then_some(place.lights_from as usize)
}

/// The coordinates of a subpath's vertices in the table marked `T`, to the depth that column `D` has.
pub(super) fn coordinates<D: Column<Value = u32>, T: Table>(
    world: &mut TileWorld,
    path: Option<usize>,
) -> Vec<Coordinates> {
    let Some(path) = path else { return Vec::new() };
    let Some(last) = world.at::<D, ChainTable>(path) else {
        return Vec::new();
    };
    let place = *world.world().resource::<TilePlace>();
    let mut of_depth = |depth: u32| {
        let index = place.coordinate(path, depth);
        let choice = value::<PrimaryChoice, T>(world, index);
        let bits = VertexCoordinates {
            choice: choice.unwrap_or_default(),
            light: value::<PrimaryLight, T>(world, index).unwrap_or_default(),
            scatter: value::<PrimaryScatter, T>(world, index).unwrap_or_default(),
            roulette: value::<PrimaryRoulette, T>(world, index).unwrap_or_default(),
            lobe: value::<PrimaryLobe, T>(world, index).unwrap_or_default(),
        };
        let light = choice.map(|_| bits.light_draw());
        Coordinates {
            depth,
            bits,
            scatter: bits.scatter_draw(),
            light: light.map(|draw| draw.choice),
            light_point: light.map(|draw| draw.point),
            roulette: (depth >= roulette::FIRST_DEPTH).then(|| bits.roulette_draw()),
        }
    };
    (place.first_coordinate..=last).map(&mut of_depth).collect()
}

/// The first `count` splats in the table marked `T`.
pub(super) fn splats<T: Table>(world: &mut TileWorld, count: u32, scene: &Scene) -> Vec<SplatAt> {
    let place = *world.world().resource::<TilePlace>();
    let mut of_number = |number: u32| {
        let index = place.vertex(0, number);
        SplatAt {
            pixel: column_and_row(value::<SplatPixel, T>(world, index).unwrap_or_default(), scene),
            color: value::<SplatColor, T>(world, index).unwrap_or(Rgb::BLACK),
        }
    };
    (0..count).map(&mut of_number).collect()
}

fn value<C: Column, T: Table>(world: &mut TileWorld, index: usize) -> Option<C::Value> {
    world.at::<C, T>(index)
}
