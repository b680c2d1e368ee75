//! Scattering off metal mirrors.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::scatter::Outcomes;
use crate::path::{ChainTable, ConductorList};
use crate::table::{Read, Rows};
use bevy_ecs::system::{Res, ResMut};

/// Samples the direction in which every chain that stands on a conductor material goes on.
pub fn scatter_conductor(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    list: Read<ConductorList, ChainTable>,
    mut outcomes: Outcomes,
) {
    let scene = &*scene.0;
    let list = list.rows();
    let count = std::mem::take(&mut queues.conductor);
    outcomes.scatter(
        &place,
        &mut queues,
        count,
        |entry| list.at(entry),
        |material, wi, _, _| scene.materials.sample_conductor(material, wi),
    );
}
