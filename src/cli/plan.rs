//! `plan`: what a render would consist of, read back from what was really built.

use super::load::SceneArgs;
use super::output::{bytes, print};
use crate::plan::{ChainPlan, Missing, MutationPlan, Plan, Registry, Stage, TablePlan};
use crate::render::{Built, BuiltTable, TileWorld, short};
use clap::Args;
use miette::{IntoDiagnostic, Result, miette};
use serde::Serialize;
use std::fmt::Write;

/// Arguments of `plan`.
#[derive(Args, Clone, Debug)]
pub struct PlanArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A plan as it was built, with the reasons that the plan gives.
#[derive(Serialize)]
struct Report<'a> {
    technique: &'static str,
    effects: Vec<EffectRow<'a>>,
    /// Light that the technique cannot find here.
    missing: Vec<MissingRow<'a>>,
    chains: Option<ChainRow>,
    systems: Vec<SystemRow<'a>>,
    tables: Vec<TableRow<'a>>,
    tile_chains: u32,
    tile_reason: &'a str,
    tile_bytes: u64,
    bytes_per_chain: u64,
    tiles: u32,
    tracer: &'static str,
    tracer_reason: &'a str,
    tree_bytes: u64,
    film_bytes: u64,
}

#[derive(Serialize)]
struct EffectRow<'a> {
    name: &'static str,
    on: bool,
    reason: &'a str,
}

#[derive(Serialize)]
struct MissingRow<'a> {
    what: &'a str,
    /// `null` where rays from the camera do not tell it.
    share: Option<f64>,
    found_by: &'static str,
    #[serde(skip)]
    text: String,
}

/// The chains of a plan and their mutations.
#[derive(Serialize)]
struct ChainRow {
    groups: u32,
    chains_per_group: u32,
    bootstrap_samples_per_group: u64,
    mutations: Vec<MutationRow>,
}

#[derive(Serialize)]
struct MutationRow {
    name: &'static str,
    about: &'static str,
    settings: serde_json::Value,
    reason: &'static str,
}

#[derive(Serialize)]
struct SystemRow<'a> {
    name: &'a str,
    stage: &'static str,
    in_trace_loop: bool,
    reason: &'static str,
}

#[derive(Serialize)]
struct TableRow<'a> {
    name: &'static str,
    rows: usize,
    lanes: usize,
    bytes: u64,
    columns: Vec<ColumnRow<'a>>,
}

#[derive(Serialize)]
struct ColumnRow<'a> {
    name: &'a str,
    bytes: usize,
    reason: &'static str,
}

/// Prints the plan.
///
/// # Errors
/// A scene that cannot be loaded.
pub fn run(args: &PlanArgs, registry: &Registry) -> Result<()> {
    let loaded = args.scene.load(registry)?;
    // A world is built as a render would build it, but for the scene and the film, which only running systems look at.
    let tile = TileWorld::new(&loaded.plan.tile, 0, |_| {});
    let built = Built::read(&tile, &loaded.plan.tile);
    built
        .matches(&loaded.plan.tile)
        .map_err(|difference| miette!("the tables built are not those planned: {difference}"))?;
    let report = report(&loaded.plan, &built, loaded.scene.pixel_count());
    if args.json {
        print(&serde_json::to_string_pretty(&report).into_diagnostic()?)
    } else {
        print(&text(&report))
    }
}

fn report<'a>(plan: &'a Plan, built: &'a Built, pixels: u32) -> Report<'a> {
    let effects = plan.effects.iter();
    let inner = built.trace_loop.iter().map(|name| (name, true));
    let mut systems: Vec<SystemRow<'_>> = Vec::new();
    for (name, in_loop) in built.step.iter().map(|name| (name, false)) {
        systems.extend(system_row(plan, name, in_loop));
        if short(name) == "trace_loop" {
            systems.extend(
                inner
                    .clone()
                    .filter_map(|(name, in_loop)| system_row(plan, name, in_loop)),
            );
        }
    }
    let tables: Vec<TableRow<'_>> = built.tables.iter().filter_map(|table| table_row(plan, table)).collect();
    let tile_bytes = tables.iter().map(|table| table.bytes).sum();
    Report {
        technique: plan.technique.name(),
        effects: effects
            .map(|e| EffectRow {
                name: e.effect.name(),
                on: e.on,
                reason: &e.reason,
            })
            .collect(),
        missing: plan.missing.iter().map(missing_row).collect(),
        chains: plan.chains.as_ref().map(chain_row),
        systems,
        tables,
        tile_chains: plan.tile.size,
        tile_reason: &plan.tile.reason,
        tile_bytes,
        bytes_per_chain: tile_bytes / u64::from(plan.tile.size),
        tiles: plan.tiles(pixels),
        tracer: plan.tracer,
        tracer_reason: &plan.tracer_reason,
        tree_bytes: plan.tree_bytes,
        film_bytes: plan.film_bytes,
    }
}

fn missing_row(missing: &Missing) -> MissingRow<'_> {
    MissingRow {
        what: &missing.what,
        share: missing.share,
        found_by: missing.found_by,
        text: missing.to_string(),
    }
}

fn chain_row(plan: &ChainPlan) -> ChainRow {
    let counts = plan.counts;
    let row = |planned: &MutationPlan| MutationRow {
        name: planned.mutation.name(),
        about: planned.mutation.about(),
        settings: planned.mutation.settings(),
        reason: planned.reason,
    };
    ChainRow {
        groups: counts.groups,
        chains_per_group: counts.chains,
        bootstrap_samples_per_group: u64::from(counts.rounds) * u64::from(counts.chains),
        mutations: plan.mutations.iter().map(row).collect(),
    }
}

fn system_row<'a>(plan: &Plan, name: &'a str, in_trace_loop: bool) -> Option<SystemRow<'a>> {
    let name = short(name);
    let planned = plan.tile.systems.iter().find(|system| system.spec.name() == name)?;
    Some(SystemRow {
        name,
        stage: planned.spec.stage().name(),
        in_trace_loop,
        reason: planned.reason,
    })
}

fn table_row<'a>(plan: &Plan, built: &'a BuiltTable) -> Option<TableRow<'a>> {
    let planned: &TablePlan = plan.tile.tables.iter().find(|table| table.id == built.id)?;
    let columns = built.columns.iter().filter_map(|column| {
        let reason = planned
            .columns
            .iter()
            .find(|c| (c.spec.type_name)() == column.type_name)?
            .reason;
        Some(ColumnRow {
            name: short(&column.type_name),
            bytes: column.bytes,
            reason,
        })
    });
    let lanes = crate::table::LANES;
    let entry: usize = built.columns.iter().map(|column| column.bytes).sum();
    Some(TableRow {
        name: planned.id.name(),
        rows: built.rows,
        lanes,
        bytes: (entry * built.rows * lanes) as u64,
        columns: columns.collect(),
    })
}

fn text(report: &Report<'_>) -> String {
    let mut out = format!("technique  {}\n\neffects\n", report.technique);
    for effect in &report.effects {
        let _ = writeln!(
            out,
            "  {:<20} {:<4} {}",
            effect.name,
            if effect.on { "on" } else { "off" },
            effect.reason
        );
    }
    if !report.missing.is_empty() {
        let _ = writeln!(out, "\nmissing: {} cannot find", report.technique);
        for missing in &report.missing {
            let _ = writeln!(out, "  {}", missing.text);
        }
    }
    if let Some(chains) = &report.chains {
        let _ = writeln!(
            out,
            "\n{} groups of {} chains, each with a bootstrap of {} samples\nmutations",
            chains.groups, chains.chains_per_group, chains.bootstrap_samples_per_group
        );
        for mutation in &chains.mutations {
            let (name, about, settings) = (mutation.name, mutation.about, &mutation.settings);
            let _ = writeln!(out, "  {name:<20} {about}; {settings}: {}", mutation.reason);
        }
    }
    out.push_str("\nsystems, in the order in which they run\n");
    for stage in Stage::ALL {
        for system in report.systems.iter().filter(|system| system.stage == stage.name()) {
            let name = if system.in_trace_loop {
                format!("  {}", system.name)
            } else {
                system.name.to_owned()
            };
            let _ = writeln!(out, "  {:<10} {:<26} {}", system.stage, name, system.reason);
        }
    }
    for table in &report.tables {
        let size = bytes(table.bytes);
        let _ = writeln!(
            out,
            "\ntable {}: {} rows of {} lanes, {size}",
            table.name, table.rows, table.lanes
        );
        for column in &table.columns {
            let _ = writeln!(out, "  {:<22} {:>3} B  {}", column.name, column.bytes, column.reason);
        }
    }
    let _ = write!(
        out,
        "\ntile       {} chains ({}), {} of tables, {} B a chain; {} tiles\ntracer     {} ({}), {}\nfilm       {}",
        report.tile_chains,
        report.tile_reason,
        bytes(report.tile_bytes),
        report.bytes_per_chain,
        report.tiles,
        report.tracer,
        report.tracer_reason,
        bytes(report.tree_bytes),
        bytes(report.film_bytes)
    );
    out
}
