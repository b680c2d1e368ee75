//! A tile's world: tables and schedules exactly as the plan lists them.

use crate::plan::TilePlan;
use crate::systems::tile::{Counters, Depths, Queues, TilePlace};
use crate::systems::{Profile, Run, build_schedules};
use crate::table::{Column, LANES, Rows};
use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::component::Component;
use bevy_ecs::query::With;
use bevy_ecs::world::World;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// One bevy world with the tables and schedules of a plan, through which tiles pass.
pub struct TileWorld {
    world: World,
    busy: Duration,
}

impl TileWorld {
    /// Builds the tables and the schedules that `plan` lists, and lets `insert` add the resources that its systems read.
    #[must_use]
    pub fn new(plan: &TilePlan, seed: u64, insert: impl FnOnce(&mut World)) -> Self {
        let mut world = World::new();
        for table in &plan.tables {
            for _ in 0..table.rows {
                let mut row = table.id.spawn(&mut world);
                for column in &table.columns {
                    (column.spec.insert)(&mut row);
                }
            }
        }
        let place = TilePlace {
            seed,
            first_chain: 0,
            chains: 0,
            capacity: plan.capacity(),
            lights_from: plan.lights_from(),
            first_coordinate: plan.first_coordinate(),
            heuristic: plan.heuristic,
            sought: plan.sought,
            shortest: plan.shortest,
            longest: plan.longest,
            step: 0,
        };
        world.insert_resource(place);
        world.insert_resource(Depths::new(plan));
        world.init_resource::<Queues>();
        world.init_resource::<Counters>();
        insert(&mut world);
        build_schedules(plan, &mut world);
        Self {
            world,
            busy: Duration::ZERO,
        }
    }

    /// Runs the given steps of the tile whose first chain is `first_chain`.
    pub fn run(&mut self, first_chain: u32, chains: u32, steps: Range<u64>) {
        for step in steps {
            self.run_once(Run::Step, first_chain, chains, step);
        }
    }

    /// Runs the stages once, in the phase of `run`.
    pub fn run_once(&mut self, run: Run, first_chain: u32, chains: u32, step: u64) {
        let start = Instant::now();
        let mut place = self.world.resource_mut::<TilePlace>();
        (place.first_chain, place.chains, place.step) = (first_chain, chains, step);
        self.world.run_schedule(run);
        self.busy += start.elapsed();
    }

    /// Copies the first values of column `C` of table `T`, as many as `values` has room for.
    pub fn read<C: Column, T: Component>(&mut self, values: &mut [C::Value]) {
        let mut column = self.world.query_filtered::<&C, With<T>>();
        let column = column.query(&self.world);
        if let Ok(mut tables) = column.contiguous_iter()
            && let Some(rows) = tables.next()
        {
            values.iter_mut().enumerate().for_each(|(i, value)| *value = rows.at(i));
        }
    }

    /// All values of column `C` of table `T`, those of rows that are not in use too; none if the plan has no such column.
    pub fn all<C: Column, T: Component>(&mut self) -> Vec<C::Value> {
        let mut column = self.world.query_filtered::<&C, With<T>>();
        let column = column.query(&self.world);
        let tables = column.contiguous_iter().into_iter().flatten();
        tables
            .flat_map(|rows| (0..rows.len() * LANES).map(|i| rows.at(i)))
            .collect()
    }

    /// The value of number `index` in column `C` of table `T`; none if the plan has no such column, or it is shorter.
    pub fn at<C: Column, T: Component>(&mut self, index: usize) -> Option<C::Value> {
        let mut column = self.world.query_filtered::<&C, With<T>>();
        let column = column.query(&self.world);
        let rows = column.contiguous_iter().ok()?.next()?;
        (index / LANES < rows.len()).then(|| rows.at(index))
    }

    /// Overwrites the first values of column `C` of table `T`.
    pub fn write<C: Column, T: Component>(&mut self, values: &[C::Value]) {
        let mut column = self.world.query_filtered::<&mut C, With<T>>();
        let mut column = column.query_mut(&mut self.world);
        if let Ok(mut tables) = column.contiguous_iter_mut()
            && let Some(rows) = tables.next()
        {
            let rows = ContiguousMut::bypass_change_detection_split(rows).0;
            values.iter().enumerate().for_each(|(i, value)| rows.put(i, *value));
        }
    }

    /// Zeroes column `C` of table `T`.
    pub fn clear<C: Column, T: Component>(&mut self) {
        let mut column = self.world.query_filtered::<&mut C, With<T>>();
        for mut lanes in column.iter_mut(&mut self.world) {
            *lanes = C::zeroed();
        }
    }

    /// Forgets what systems have cost so far.
    pub fn reset_costs(&mut self) {
        for cost in &mut self.world.resource_mut::<Profile>().systems {
            (cost.runs, cost.nanoseconds) = (0, 0);
        }
        self.busy = Duration::ZERO;
    }

    /// Wall time spent in steps.
    #[must_use]
    pub const fn busy(&self) -> Duration {
        self.busy
    }

    /// What this world has counted.
    #[must_use]
    pub fn counters(&self) -> Counters {
        *self.world.resource::<Counters>()
    }

    /// What this world's systems have cost.
    #[must_use]
    pub fn profile(&self) -> &Profile {
        self.world.resource::<Profile>()
    }

    /// Records up to `count` single runs of systems from now on.
    pub fn record_spans(&mut self, count: usize) {
        self.world.resource_mut::<Profile>().spans = Vec::with_capacity(count);
    }

    /// The world itself, to read back what was built.
    #[must_use]
    pub const fn world(&self) -> &World {
        &self.world
    }

    /// The world itself, for queries.
    pub const fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }
}

/// A lock that another thread panicked under still holds valid tables: every step writes before it reads.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
