//! Scattering off matt surfaces.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::draws::Draws;
use super::scatter::Outcomes;
use crate::path::{ChainTable, DiffuseList};
use crate::table::{Read, Rows};
use bevy_ecs::system::{Res, ResMut};

/// Samples the direction in which every chain that stands on a diffuse material goes on.
pub fn scatter_diffuse(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    list: Read<DiffuseList, ChainTable>,
    draws: Draws,
    mut outcomes: Outcomes,
) {
    let scene = &*scene.0;
    let list = list.rows();
    let draws = draws.columns(&place);
    let count = std::mem::take(&mut queues.diffuse);
    outcomes.scatter(
        &place,
        &mut queues,
        count,
        |entry| list.at(entry),
        |material, wi, chain, depth| {
            scene
                .materials
                .sample_diffuse(material, wi, draws.scatter(chain, depth))
        },
    );
}
