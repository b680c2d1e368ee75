//! What splitting light into layers adds to a tile, whatever its technique.

use super::table::{Extent, TableId, TablePlan};
use super::{SystemPlan, SystemSpec};
use crate::layer::{LayerColor, Layers, SegmentLayer, SplatLayer, VertexConnectionEnd};
use crate::path::VertexConnection;
use crate::systems::list::*;

/// Adds the systems and columns that split what `systems` bring into `layers`. Without light there is nothing to split.
pub(super) fn split(layers: &Layers, systems: &mut Vec<SystemPlan>, tables: &mut Vec<TablePlan>) {
    let has = |systems: &[SystemPlan], spec: SystemSpec| systems.iter().any(|system| system.spec == spec);
    let starts = [START_CAMERA_PATHS, START_CAMERA_PATHS_DRAWN];
    let walks = has(systems, GATHER_CONTRIBUTION);
    let joins = has(systems, JOIN_LOOP);
    if !walks && !joins && !has(systems, EVALUATE_PATHS) {
        return;
    }
    let splits_own = walks || (joins && starts.iter().any(|&start| has(systems, start)));
    let is_state = has(systems, SPLAT_STATES);
    for (of_picture, spec, reason) in [
        (GATHER_CONTRIBUTION, SPLIT_LAYERS, "light is split among layers"),
        (SPLAT_SAMPLES, SPLAT_SAMPLE_LAYERS, "layers have films of their own"),
        (SPLAT_LISTS, SPLAT_LIST_LAYERS, "layers have films of their own"),
        // Before the states that are splatted are overwritten.
        (SPLAT_STATES, TAKE_LAYERS, "accepted proposals become states"),
        (SPLAT_STATES, SPLAT_STATE_LAYERS, "layers have films of their own"),
    ] {
        if let Some(place) = systems.iter().position(|system| system.spec == of_picture) {
            systems.insert(place + 1, SystemPlan::new(spec, reason));
        }
    }
    for table in tables.iter_mut() {
        if table.id == TableId::PROPOSALS && walks && table.has::<VertexConnection>() {
            table.column::<VertexConnectionEnd>("the layer of what a connection brings");
        } else if table.id == TableId::RAYS && joins {
            table.column::<SegmentLayer>("the layer of what a segment brings");
        } else if table.id == TableId::SPLATS || table.id == TableId::PROPOSED_SPLATS {
            table.column::<SplatLayer>("which layer a splat is in");
        }
    }
    if splits_own {
        let of_layers = |id| {
            let mut table = TablePlan::new(id, Extent::PerChain(layers.len() as u32));
            table.column::<LayerColor>("what a chain's own pixel has, layer by layer");
            table
        };
        tables.push(of_layers(TableId::PROPOSED_LAYERS));
        if is_state {
            tables.push(of_layers(TableId::LAYERS).holding_state());
        }
    }
}
