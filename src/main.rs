//! The program: parse arguments, call one command, print one error.

use clap::Parser;
use std::process::ExitCode;

fn main() -> miette::Result<ExitCode> {
    chainlight::cli::run(&chainlight::cli::Cli::parse())
}
