//! Whether states that were saved are some that systems can go on from: what a file says may be anything.

use super::{ChainRun, TileWorld};
use crate::path::whole::{PathEdges, PathLight, PathTable};
use crate::path::{ChainTable, PrimaryDepth, SplatCount, VERTEX_INFINITE, VertexKind, VertexMaterial};
use crate::plan::TableId;
use crate::scene::Scene;
use crate::systems::tile::{Depths, TilePlace};
use crate::table::Column;

/// Whether what the states of `run` count by, and the numbers of things that they name, are within their tables.
pub(super) fn are_sound(run: &ChainRun, scene: &Scene) -> bool {
    // Of the list that a state may bring.
    let splats = run.tile_plan().tables.iter().find(|table| table.id == TableId::SPLATS);
    let entries = splats.map_or(0, |table| table.extent.most_entries());
    let capacity = run.tile_plan().capacity() as usize;
    let mut sound = true;
    run.for_each_tile(&mut |chains, world| {
        let held = world.world().resource::<Depths>().held().min(scene.max_depth);
        let depths = first::<PrimaryDepth>(world, capacity);
        let splats = first::<SplatCount>(world, chains.len());
        sound &= depths.iter().all(|&depth| depth <= held) && splats.iter().all(|&count| count <= entries);
        sound &= paths_are_sound(world, chains.len(), scene);
    });
    sound
}

/// The first values of a column of chains; zeroes if there is no such column.
fn first<C: Column<Value = u32>>(world: &mut TileWorld, count: usize) -> Vec<u32> {
    let mut values = vec![0; count];
    world.read::<C, ChainTable>(&mut values);
    values
}

/// The same of whole paths, where states are some.
fn paths_are_sound(world: &mut TileWorld, chains: usize, scene: &Scene) -> bool {
    let edges = first::<PathEdges>(world, chains);
    let lights = first::<PathLight>(world, chains);
    let place = *world.world().resource::<TilePlace>();
    let kinds = world.all::<VertexKind, PathTable>();
    let materials = world.all::<VertexMaterial, PathTable>();
    let vertex_is_sound = |chain: usize, depth: usize, last: bool| {
        let row = place.path_vertex(chain, depth);
        let (kind, material) = (kinds.get(row), materials.get(row));
        // Ends scatter nothing, and name no material that counts.
        kind.is_some_and(|&kind| kind <= VERTEX_INFINITE)
            && (depth == 0 || last || material.is_some_and(|&material| (material as usize) < scene.materials.len()))
    };
    (0..chains).filter(|&chain| edges[chain] > 0).all(|chain| {
        let k = edges[chain] as usize;
        edges[chain] <= scene.max_depth
            && (lights[chain] as usize) < scene.lights.len()
            && (0..=k).all(|depth| vertex_is_sound(chain, depth, depth == k))
    })
}
