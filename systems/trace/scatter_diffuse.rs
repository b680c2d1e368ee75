//! Scattering off matt surfaces.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::scatter::Outcomes;
use crate::path::{ChainKey, ChainTable, DiffuseList};
use crate::sampling::Purpose;
use crate::table::{Read, Rows};
use bevy_ecs::system::{Res, ResMut};

/// Samples the direction in which every chain that stands on a diffuse material goes on.
pub fn scatter_diffuse(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    list: Read<DiffuseList, ChainTable>,
    keys: Read<ChainKey, ChainTable>,
    mut outcomes: Outcomes,
) {
    let scene = &*scene.0;
    let list = list.rows();
    let keys = keys.rows();
    let stream = |chain: usize, depth| place.key(chain, keys.at(chain)).stream(Purpose::SCATTER, depth);
    let count = std::mem::take(&mut queues.diffuse);
    outcomes.scatter(
        &place,
        &mut queues,
        count,
        |entry| list.at(entry),
        |material, wi, chain, depth| {
            scene
                .materials
                .sample_diffuse(material, wi, stream(chain, depth).next_pair())
        },
    );
}
