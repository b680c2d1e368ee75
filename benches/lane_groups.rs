//! Rows of sixteen chains against rows of one chain: the same columns, the same work, in both layouts.
//!
//! The work is the pattern of a stage: read some columns of every chain, write others; a scalar multiply-add over a
//! position and a weight, so that memory decides. `cargo bench --bench lane_groups` prints criterion's figures, then a
//! table of interleaved medians and of what bevy keeps beside the values.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::prelude::*;
use bytemuck::Zeroable;
use chainlight::columns;
use chainlight::table::{LANES, Rows};
use criterion::Criterion;
use glam::Vec3;
use std::hint::black_box;
use std::time::Instant;

columns! {
    /// A position.
    pub Position: Vec3;
    /// A direction.
    pub Direction: Vec3;
    /// A distance.
    pub Distance: f32;
}

/// One chain's position.
#[derive(Component, Clone, Copy, Default)]
struct OnePosition(Vec3);
/// One chain's direction.
#[derive(Component, Clone, Copy, Default)]
struct OneDirection(Vec3);
/// One chain's distance.
#[derive(Component, Clone, Copy, Default)]
struct OneDistance(f32);

const CHAINS: usize = 1024;
/// Vertices per chain: a tile's working set.
const DEPTH: usize = 6;
const ROWS: usize = CHAINS * DEPTH;
/// bevy's bookkeeping per row: 8 bytes of ticks per component, and about 24 for the entity.
const PER_ROW: usize = 3 * 8 + 24;

struct Layout {
    world: World,
    schedule: Schedule,
}

impl Layout {
    fn groups() -> Self {
        let mut world = World::new();
        for _ in 0..ROWS / LANES {
            world.spawn((Position::zeroed(), Direction::zeroed(), Distance::zeroed()));
        }
        Self::new(world, advance_groups)
    }

    fn lanes() -> Self {
        let mut world = World::new();
        for _ in 0..ROWS / LANES {
            world.spawn((Position::zeroed(), Direction::zeroed(), Distance::zeroed()));
        }
        Self::new(world, advance_lanes)
    }

    fn singles() -> Self {
        let mut world = World::new();
        world.spawn_batch((0..ROWS).map(|_| (OnePosition::default(), OneDirection::default(), OneDistance(0.0))));
        Self::new(world, advance_singles)
    }

    fn new<M>(mut world: World, system: impl IntoScheduleConfigs<bevy_ecs::system::ScheduleSystem, M>) -> Self {
        let mut schedule = Schedule::default();
        schedule.add_systems(system);
        schedule.run(&mut world);
        Self { world, schedule }
    }

    fn run(&mut self) {
        self.schedule.run(&mut self.world);
    }
}

fn advance_groups(mut query: Query<(&mut Position, &Direction, &Distance)>) {
    for (positions, directions, distances) in query.contiguous_iter_mut().expect("a dense table") {
        let positions = ContiguousMut::bypass_change_detection_split(positions).0;
        for chain in 0..positions.len() * LANES {
            positions.put(chain, positions.at(chain) + directions.at(chain) * distances.at(chain));
        }
    }
}

/// The same, lane by lane: what a stage gains that is written for lanes.
fn advance_lanes(mut query: Query<(&mut Position, &Direction, &Distance)>) {
    for (positions, directions, distances) in query.contiguous_iter_mut().expect("a dense table") {
        let positions = ContiguousMut::bypass_change_detection_split(positions).0;
        for ((position, direction), distance) in positions.iter_mut().zip(directions).zip(distances) {
            for (to, along) in position.0.0.iter_mut().zip(&direction.0.0) {
                for lane in 0..LANES {
                    to.0[lane] += along.0[lane] * distance.0.0[lane];
                }
            }
        }
    }
}

fn advance_singles(mut query: Query<(&mut OnePosition, &OneDirection, &OneDistance)>) {
    for (positions, directions, distances) in query.contiguous_iter_mut().expect("a dense table") {
        let positions = ContiguousMut::bypass_change_detection_split(positions).0;
        for ((position, direction), distance) in positions.iter_mut().zip(directions).zip(distances) {
            position.0 += direction.0 * distance.0;
        }
    }
}

fn main() {
    let (mut groups, mut lanes, mut singles) = (Layout::groups(), Layout::lanes(), Layout::singles());
    let mut criterion = Criterion::default().configure_from_args();
    criterion.bench_function("lane groups of sixteen", |bencher| {
        bencher.iter(|| black_box(&mut groups).run())
    });
    criterion.bench_function("lane groups, by lanes", |bencher| {
        bencher.iter(|| black_box(&mut lanes).run())
    });
    criterion.bench_function("one chain per row", |bencher| {
        bencher.iter(|| black_box(&mut singles).run())
    });
    criterion.final_summary();

    let mut figures = [Vec::new(), Vec::new(), Vec::new()];
    for _ in 0..101 {
        for (layout, figures) in [&mut groups, &mut lanes, &mut singles].into_iter().zip(&mut figures) {
            let began = Instant::now();
            (0..16).for_each(|_| layout.run());
            figures.push(began.elapsed().as_nanos() as f64 / (16 * ROWS) as f64);
        }
    }
    let [grouped, laned, single] = figures.map(|mut figures| {
        figures.sort_by(f64::total_cmp);
        figures[figures.len() / 2]
    });
    let values = 28;
    println!("\nper vertex              lane groups   by lanes   one per row");
    println!("ns                      {grouped:11.2}   {laned:8.2}   {single:11.2}");
    println!("bytes of values         {values:11}   {values:8}   {values:11}");
    let shared = PER_ROW as f64 / LANES as f64;
    println!("bytes of bookkeeping    {shared:11.1}   {shared:8.1}   {PER_ROW:11}");
}
