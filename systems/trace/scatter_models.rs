//! The scatter systems: one per material model, all alike but for the model.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::draws::Draws;
use super::scatter::Outcomes;
use crate::material::{InTable, MaterialKind, for_each_material};
use crate::path::{ScatterList, ScatterTable};
use crate::plan::{Place, SystemSpec, TraceStep};
use crate::system;
use crate::table::{Read, Rows};
use bevy_ecs::system::{Res, ResMut};

macro_rules! define {
    ($($Kind:ident, $table:ident, $name:literal, $scatter:ident, discrete: $discrete:literal, lobes: $lobes:literal,
        events: [$($event:ident),*];)*) => {
        $(
            #[doc = concat!("Samples the direction in which every path that stands on a ", $name, " material goes on.")]
            pub fn $scatter(
                scene: Res<SceneRef>,
                place: Res<TilePlace>,
                queues: ResMut<Queues>,
                lists: Read<ScatterList, ScatterTable>,
                draws: Draws,
                outcomes: Outcomes,
            ) {
                scatter::<crate::material::$table::$Kind>(&scene, &place, queues, &lists, &draws, outcomes);
            }
        )*

        /// The system that scatters the chains on materials of a model.
        #[must_use]
        pub const fn scatter_system(kind: MaterialKind) -> SystemSpec {
            match kind {
                $(MaterialKind::$Kind => system!(Place::Loop(TraceStep::Scatter), $scatter),)*
            }
        }
    };
}

for_each_material!(define);

fn scatter<M: InTable>(
    scene: &SceneRef,
    place: &TilePlace,
    mut queues: ResMut<Queues>,
    lists: &Read<ScatterList, ScatterTable>,
    draws: &Draws,
    mut outcomes: Outcomes,
) {
    let materials = &scene.0.materials;
    let Some(model) = materials.model(M::KIND) else {
        return;
    };
    let (lists, draws, models) = (lists.rows(), draws.columns(place), M::rows(materials));
    let count = std::mem::take(&mut queues.scatter[model]);
    outcomes.scatter(
        place,
        &mut queues,
        count,
        |entry| lists.at(place.vertex(entry, model as u32)),
        |point, wi, path, depth, transport| {
            let draw = draws.scatter(path, depth, M::KIND.chooses_lobes());
            let at = materials.shading(point.uv);
            models[materials.row(point.material)].sample(&at, wi, draw, transport)
        },
    );
}
