//! `plan`: what a render would consist of, read back from what was really built.

use super::load::SceneArgs;
use super::output::{bytes, print};
use crate::plan::{
    ChainPlan, Missing, MutationPlan, PER_MUTATIONS, Plan, Registry, Stage, TablePlan, Technique, TilePlan,
};
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
    /// Layers that light is split into, by name: their light path expressions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layers: Vec<LayerRow<'a>>,
    chains: Option<ChainRow>,
    #[serde(flatten)]
    tile: TileReport<'a>,
    /// Direct light, where it is rendered apart from all other.
    #[serde(skip_serializing_if = "Option::is_none")]
    direct: Option<DirectReport<'a>>,
    tracer: &'a str,
    tracer_reason: &'a str,
    tree_bytes: u64,
    film_bytes: u64,
}

/// What a tile is built of.
#[derive(Serialize)]
struct TileReport<'a> {
    systems: Vec<SystemRow<'a>>,
    tables: Vec<TableRow<'a>>,
    tile_chains: u32,
    tile_reason: &'a str,
    tile_bytes: u64,
    bytes_per_chain: u64,
    tiles: u32,
}

/// How direct light is rendered beside chains.
#[derive(Serialize)]
struct DirectReport<'a> {
    technique: &'static str,
    longest: u32,
    samples_per_100_mutations: u32,
    #[serde(flatten)]
    tile: TileReport<'a>,
}

#[derive(Serialize)]
struct EffectRow<'a> {
    name: &'static str,
    on: bool,
    reason: &'a str,
}

#[derive(Serialize)]
struct LayerRow<'a> {
    name: &'a str,
    expression: &'a str,
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
    let built = build(&loaded.plan.tile)?;
    let direct = loaded.plan.direct.as_ref().map(|direct| build(&direct.tile));
    let direct = direct.transpose()?;
    let report = report(&loaded.plan, &built, direct.as_ref(), loaded.scene.pixel_count());
    if args.json {
        print(&serde_json::to_string_pretty(&report).into_diagnostic()?)
    } else {
        print(&text(&report))
    }
}

/// What a tile really is made of.
fn build(plan: &TilePlan) -> Result<Built> {
    // A world is built as a render would build it, but for the scene and the film, which only running systems look at.
    let tile = TileWorld::new(plan, 0, |_| {});
    let built = Built::read(&tile, plan);
    built
        .matches(plan)
        .map_err(|difference| miette!("the tables built are not those planned: {difference}"))?;
    Ok(built)
}

fn tile_report<'a>(plan: &'a TilePlan, built: &'a Built, tiles: u32) -> TileReport<'a> {
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
    TileReport {
        systems,
        tables,
        tile_chains: plan.size,
        tile_reason: &plan.reason,
        tile_bytes,
        bytes_per_chain: tile_bytes / u64::from(plan.size),
        tiles,
    }
}

fn report<'a>(plan: &'a Plan, built: &'a Built, of_direct: Option<&'a Built>, pixels: u32) -> Report<'a> {
    let effects = plan.effects.iter();
    let direct = plan.direct.as_ref().zip(of_direct).map(|(direct, built)| DirectReport {
        technique: Technique::Pt.name(),
        longest: direct.longest(),
        samples_per_100_mutations: direct.samples,
        tile: tile_report(&direct.tile, built, pixels.div_ceil(direct.tile.size)),
    });
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
        layers: layer_rows(plan),
        chains: plan.chains.as_ref().map(chain_row),
        tile: tile_report(&plan.tile, built, plan.tiles(pixels)),
        direct,
        tracer: &plan.tracer,
        tracer_reason: &plan.tracer_reason,
        tree_bytes: plan.tree_bytes,
        film_bytes: plan.film_bytes,
    }
}

fn layer_rows(plan: &Plan) -> Vec<LayerRow<'_>> {
    let named = plan
        .layers
        .iter()
        .flat_map(|layers| layers.names().iter().zip(layers.expressions()));
    named.map(|(name, expression)| LayerRow { name, expression }).collect()
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

fn system_row<'a>(plan: &TilePlan, name: &'a str, in_trace_loop: bool) -> Option<SystemRow<'a>> {
    let name = short(name);
    let planned = plan.systems.iter().find(|system| system.spec.name() == name)?;
    Some(SystemRow {
        name,
        stage: planned.spec.stage().name(),
        in_trace_loop,
        reason: planned.reason,
    })
}

fn table_row<'a>(plan: &TilePlan, built: &'a BuiltTable) -> Option<TableRow<'a>> {
    let planned: &TablePlan = plan.tables.iter().find(|table| table.id == built.id)?;
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
    if !report.layers.is_empty() {
        out += "\nlayers: a path is in the first that it matches\n";
        for layer in &report.layers {
            let _ = writeln!(out, "  {:<20} {}", layer.name, layer.expression);
        }
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
    tile_text(&mut out, &report.tile);
    if let Some(direct) = &report.direct {
        let _ = writeln!(
            out,
            "\ndirect light, which chains leave out: {}, paths of at most {} edges that scatter once at most but in mirrors and glass, {} samples per pixel for every \
             {PER_MUTATIONS} mutations per pixel",
            direct.technique, direct.longest, direct.samples_per_100_mutations
        );
        tile_text(&mut out, &direct.tile);
    }
    let _ = write!(out, "\n{}\n", tile_line("tile", &report.tile));
    if let Some(direct) = &report.direct {
        let _ = writeln!(out, "{}", tile_line("direct", &direct.tile));
    }
    let _ = write!(
        out,
        "tracer     {} ({}), {}\nfilm       {}",
        report.tracer,
        report.tracer_reason,
        bytes(report.tree_bytes),
        bytes(report.film_bytes)
    );
    out
}

/// A tile's size, and why.
fn tile_line(name: &str, tile: &TileReport<'_>) -> String {
    format!(
        "{name:<10} {} chains ({}), {} of tables, {} B a chain; {} tiles",
        tile.tile_chains,
        tile.tile_reason,
        bytes(tile.tile_bytes),
        tile.bytes_per_chain,
        tile.tiles
    )
}

/// A tile's systems and tables.
fn tile_text(out: &mut String, report: &TileReport<'_>) {
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
}
