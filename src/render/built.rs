//! What was really built, read back from a tile's world.

use super::TileWorld;
use crate::plan::{Phases, Repeated, TableId, TilePlan};
use crate::systems::{JoinLoop, Run, TraceLoop};
use crate::table::LANES;
use bevy_ecs::component::ComponentId;
use bevy_ecs::schedule::{ScheduleLabel, Schedules};
use bevy_ecs::world::World;

/// A table of a world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BuiltTable {
    /// Which, by its marker.
    pub id: TableId,
    /// Lane-group rows.
    pub rows: usize,
    /// Its columns, sorted by name; markers are not columns.
    pub columns: Vec<BuiltColumn>,
}

/// A column of a world.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct BuiltColumn {
    /// The component's full type name.
    pub type_name: String,
    /// Bytes per entry.
    pub bytes: usize,
    /// Whether the component has drop glue: the sign of memory on the heap.
    pub needs_drop: bool,
}

/// A world as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Built {
    /// Its tables.
    pub tables: Vec<BuiltTable>,
    /// Full names of the systems of a step, in the order in which they run.
    pub step: Vec<String>,
    /// Full names of the systems of the trace loop, in the order in which they run.
    pub trace_loop: Vec<String>,
    /// Full names of the systems of the join loop, in the order in which they run.
    pub join_loop: Vec<String>,
    /// Full type names of the world's resources, sorted.
    pub resources: Vec<String>,
    /// Components on rows that are in none of the tables: must be empty.
    pub strays: Vec<String>,
}

impl Built {
    /// Reads back `tile`, which was built from `plan`.
    #[must_use]
    pub fn read(tile: &TileWorld, plan: &TilePlan) -> Self {
        let world = tile.world();
        let known: Vec<TableId> = plan.tables.iter().map(|table| table.id).collect();
        let markers: Vec<Option<ComponentId>> = known.iter().map(|id| id.marker(world)).collect();
        let mut built = Self {
            tables: Vec::new(),
            step: system_names(world, Run::Step),
            trace_loop: system_names(world, TraceLoop),
            join_loop: system_names(world, JoinLoop),
            resources: Vec::new(),
            strays: Vec::new(),
        };
        for archetype in world.archetypes().iter().filter(|archetype| !archetype.is_empty()) {
            let components = archetype.components();
            let columns = components.iter().filter(|id| !markers.contains(&Some(**id)));
            let mut columns: Vec<BuiltColumn> = columns.filter_map(|id| column(world, *id)).collect();
            columns.sort();
            let table = known
                .iter()
                .zip(&markers)
                .find(|(_, id)| id.is_some_and(|id| components.contains(&id)));
            match table {
                Some((id, _)) => {
                    built.tables.push(BuiltTable {
                        id: *id,
                        rows: archetype.len() as usize,
                        columns,
                    });
                }
                // bevy keeps each resource on an entity of its own; those are no rows.
                None if columns.iter().any(is_resource_marker) => {
                    let names = columns.into_iter().filter(|column| !is_resource_marker(column));
                    built.resources.extend(names.map(|column| column.type_name));
                }
                None => built.strays.extend(columns.into_iter().map(|column| column.type_name)),
            }
        }
        built
            .tables
            .sort_by_key(|table| known.iter().position(|id| *id == table.id));
        built
    }

    /// Whether this is what `plan` lists: the same tables with the same columns and rows, the same systems in the same
    /// order, nothing else; otherwise the first difference in words.
    ///
    /// # Errors
    /// The first difference.
    pub fn matches(&self, plan: &TilePlan) -> Result<(), String> {
        if let Some(stray) = self.strays.first() {
            return Err(format!("{stray} is in no table"));
        }
        for table in &plan.tables {
            let built = self
                .tables
                .iter()
                .filter(|built| built.id == table.id)
                .collect::<Vec<_>>();
            let [built] = built.as_slice() else {
                return Err(format!("{} archetypes hold the table {}", built.len(), table.id.name()));
            };
            let mut planned: Vec<(&str, usize)> = table
                .columns
                .iter()
                .map(|column| ((column.spec.type_name)(), column.spec.bytes))
                .collect();
            planned.sort_unstable();
            let real: Vec<(&str, usize)> = built.columns.iter().map(|c| (c.type_name.as_str(), c.bytes)).collect();
            if planned != real || built.rows != table.rows as usize {
                return Err(format!(
                    "table {}: planned {planned:?}, built {real:?}",
                    table.id.name()
                ));
            }
        }
        if self.tables.len() != plan.tables.len() {
            return Err(format!(
                "{} tables planned, {} built",
                plan.tables.len(),
                self.tables.len()
            ));
        }
        let planned = |repeated: Option<Repeated>| {
            let systems = plan.systems.iter().map(|system| system.spec);
            let here = systems.filter(|s| s.repeated() == repeated);
            let here = here.filter(|s| repeated.is_some() || s.phases().has(Phases::STEP));
            here.map(|s| s.name()).collect::<Vec<_>>()
        };
        for (built, repeated) in [
            (&self.step, None),
            (&self.trace_loop, Some(Repeated::Trace)),
            (&self.join_loop, Some(Repeated::Join)),
        ] {
            let names: Vec<&str> = built.iter().map(|name| short(name)).collect();
            if names != planned(repeated) {
                return Err(format!("systems planned {:?}, built {names:?}", planned(repeated)));
            }
        }
        Ok(())
    }
}

/// The last part of a path such as `chainlight::systems::trace::emit_rays`.
#[must_use]
pub fn short(name: &str) -> &str {
    name.rsplit("::").next().unwrap_or(name)
}

fn column(world: &World, id: ComponentId) -> Option<BuiltColumn> {
    let info = world.components().get_info(id)?;
    Some(BuiltColumn {
        type_name: info.name().to_string(),
        bytes: info.layout().size() / LANES,
        needs_drop: info.drop().is_some(),
    })
}

fn is_resource_marker(column: &BuiltColumn) -> bool {
    column.type_name.ends_with("IsResource")
}

fn system_names(world: &World, label: impl ScheduleLabel) -> Vec<String> {
    let schedules = world.resource::<Schedules>();
    let systems = schedules.get(label).and_then(|schedule| schedule.systems().ok());
    systems.map_or_else(Vec::new, |systems| {
        systems.map(|(_, system)| system.name().to_string()).collect()
    })
}
