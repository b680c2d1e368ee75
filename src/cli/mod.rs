//! The program's commands, one file each.

mod auto;
mod budget;
mod chains;
pub mod check;
pub mod compare;
pub mod cost;
mod cost_table;
mod findings;
mod interrupt;
mod layers;
mod load;
mod memory;
mod output;
mod pilots;
pub mod plan;
pub mod profile;
pub mod render;
pub mod replay;
mod replay_text;
mod report;
pub mod schema;
pub mod study;
mod study_runs;
mod study_table;
mod target;
mod unused;
mod verdict;
mod ways;

use crate::plan::Registry;
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// An offline renderer for difficult light.
#[derive(Parser, Debug)]
#[command(name = "chainlight", version, about, max_term_width = 100)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Render a scene to an OpenEXR file and a PNG beside it.
    Render(render::RenderArgs),
    /// Show what a render of a scene would consist of, and why.
    Plan(plan::PlanArgs),
    /// Render for a while and show what every stage costs.
    Profile(profile::ProfileArgs),
    /// Show one step of one chain, or one sample of one pixel, as a render took it.
    Replay(replay::ReplayArgs),
    /// Compare a picture with a reference of the same size.
    Compare(compare::CompareArgs),
    /// Try to refute mutations: hold them against the target, detailed balance, and their own densities.
    Check(check::CheckArgs),
    /// Render scenes in several ways, again and again, and tell what accuracy costs in time.
    Study(study::StudyArgs),
    /// Try techniques on a scene for a few seconds each, and tell what accuracy will cost with them, and which to take.
    Cost(cost::CostArgs),
    /// Print the scene format as a JSON Schema, for editors, or as a reference page.
    Schema(schema::SchemaArgs),
}

/// Runs the command that the arguments name, with the mutations of this crate.
///
/// # Errors
/// Whatever the command cannot do, with what to do about it.
pub fn run(cli: &Cli) -> miette::Result<ExitCode> {
    run_with(cli, &crate::systems::propose::mutations())
}

/// Runs the command that the arguments name, with the mutations of `registry`: how a program that has mutations of its own
/// gets all commands with them.
///
/// # Errors
/// Whatever the command cannot do, with what to do about it.
pub fn run_with(cli: &Cli, registry: &Registry) -> miette::Result<ExitCode> {
    match &cli.command {
        Command::Render(args) => render::run(args, registry),
        Command::Plan(args) => plan::run(args, registry).map(|()| ExitCode::SUCCESS),
        Command::Profile(args) => profile::run(args, registry).map(|()| ExitCode::SUCCESS),
        Command::Check(args) => check::run(args, registry),
        Command::Replay(args) => replay::run(args, registry),
        Command::Compare(args) => compare::run(args).map(|()| ExitCode::SUCCESS),
        Command::Study(args) => study::run(args, registry),
        Command::Cost(args) => cost::run(args, registry),
        Command::Schema(args) => schema::run(args).map(|()| ExitCode::SUCCESS),
    }
}
