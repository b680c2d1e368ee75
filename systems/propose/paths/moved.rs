//! The systems of every mutation of whole paths: [`MovesPaths`] for all the chains that try it.

use super::super::super::chains::{Keys, MutationLists};
use super::super::super::tile::{SceneRef, TilePlace};
use super::moves_paths::{MovesPaths, Way};
use super::range::Ranges;
use super::steering::Steering;
use super::view::{ProposedPaths, StatePaths};
use crate::chain::{ForwardDensity, MutationList, ProposedTarget, ReverseDensity};
use crate::path::ChainTable;
use crate::path::whole::{CameraVertices, KeptFromCamera, KeptFromLight};
use crate::plan::{Mutation, Registered};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, SystemParam};

/// Says, for every chain that tries the mutation, what it keeps of the path, and how the subpaths begin that it steers.
pub fn propose_moved<M: Mutation + MovesPaths>(
    mutation: Res<Registered<M>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    current: StatePaths,
    mut ranges: Ranges,
) {
    let (list, keys, current) = (list.rows(), keys.columns(), current.columns());
    let mut ranges = ranges.columns();
    for chain in lists.entries(mutation.number).map(|entry| list.at(entry) as usize) {
        let path = current.of(&scene.0, &place, chain);
        // Before its first state a chain has nothing to move.
        let proposal = if path.edges == 0 && !M::INDEPENDENT {
            None
        } else {
            mutation.settings.propose(&path, keys.at(chain))
        };
        ranges.put(&scene.0, &place, chain, proposal.map(|proposal| (proposal, path)));
    }
}

/// Sends steered subpaths on: through the discrete lobes of the current path, and near its directions elsewhere.
pub fn steer_moved<M: Mutation + MovesPaths>(mutation: Res<Registered<M>>, mut steering: Steering) {
    steering.steer(mutation.number, &mutation.settings);
}

/// What proposals kept, and were made of.
#[derive(SystemParam)]
pub struct Made<'w, 's> {
    targets: Read<'w, 's, ProposedTarget, ChainTable>,
    camera_kept: Read<'w, 's, KeptFromCamera, ChainTable>,
    light_kept: Read<'w, 's, KeptFromLight, ChainTable>,
    camera_made: Read<'w, 's, CameraVertices, ChainTable>,
}

/// Writes ln (T / r) of both ways for every chain that tries the mutation.
pub fn weigh_moved<M: Mutation + MovesPaths>(
    mutation: Res<Registered<M>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    made: Made,
    current: StatePaths,
    proposed: ProposedPaths,
    mut forward: Write<ForwardDensity, ChainTable>,
    mut reverse: Write<ReverseDensity, ChainTable>,
) {
    let (list, keys, targets) = (list.rows(), keys.columns(), made.targets.rows());
    let (camera_kept, light_kept) = (made.camera_kept.rows(), made.light_kept.rows());
    let camera_made = made.camera_made.rows();
    let (current, proposed) = (current.columns(), proposed.columns());
    let (forward, reverse) = (forward.rows(), reverse.rows());
    for chain in lists.entries(mutation.number).map(|entry| list.at(entry) as usize) {
        forward.put(chain, 0.0);
        reverse.put(chain, 0.0);
        if targets.at(chain) <= 0.0 {
            continue;
        }
        let way = Way {
            from: current.of(&scene.0, &place, chain),
            to: proposed.of(&scene.0, &place, chain),
            kept: [camera_kept.at(chain), light_kept.at(chain)],
            made: camera_made.at(chain),
            is_back: false,
            key: keys.at(chain),
        };
        let (there, back) = log_densities(&mutation.settings, way);
        forward.put(chain, there);
        reverse.put(chain, back);
    }
}

/// ln (T / r) of the way to a proposal, and of the way back; 0 for that where there is no state to come back to.
pub fn log_densities(mutation: &dyn MovesPaths, way: Way<'_>) -> (f64, f64) {
    let forward = libm::log(mutation.density(&way));
    if way.from.edges == 0 {
        return (forward, 0.0);
    }
    let back = Way {
        from: way.to,
        to: way.from,
        is_back: true,
        ..way
    };
    (forward, libm::log(mutation.density(&back)))
}

/// The systems of a mutation of whole paths: `path_systems!(LensPerturbation, "lens": propose "why", steer "why", weigh "why")`, with
/// reasons for plans to tell, and without `steer` where it steers none of its subpaths. The systems are named for the mutation.
#[macro_export]
macro_rules! path_systems {
    ($mutation:ty, $name:literal: propose $propose:literal, $(steer $steer:literal,)? weigh $weigh:literal) => {{
        use $crate::plan::{Mutation, Phases, Place, Stage, SystemPlan};
        use $crate::systems::propose::paths::moved;
        let phases = if <$mutation as Mutation>::INDEPENDENT {
            Phases::ALL
        } else {
            Phases::STEP
        };
        vec![
            SystemPlan::new(
                $crate::system!(Place::Stage(Stage::Propose), concat!("propose_", $name) => moved::propose_moved::<$mutation>)
                    .in_phases(phases),
                $propose,
            ),
            $(SystemPlan::new(
                $crate::system!(
                    Place::Loop($crate::plan::TraceStep::Draw),
                    concat!("steer_", $name) => moved::steer_moved::<$mutation>
                ),
                $steer,
            ),)?
            SystemPlan::new(
                $crate::system!(Place::Stage(Stage::Evaluate), concat!("weigh_", $name) => moved::weigh_moved::<$mutation>)
                    .in_phases(phases),
                $weigh,
            ),
        ]
    }};
}
