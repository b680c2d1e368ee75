//! `schema`: the scene format as data, for editors and other programs, and as a page for people.

use crate::scene::schema::{reference, schema_text};
use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr};
use std::path::PathBuf;

/// Arguments of `schema`.
#[derive(Args, Clone, Debug)]
pub struct SchemaArgs {
    /// Write a file instead of printing
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The reference page (Markdown) instead of the schema
    #[arg(long)]
    reference: bool,
}

/// Prints or writes the JSON Schema of scene files, or the reference page.
///
/// # Errors
/// Where the file cannot be written.
pub fn run(args: &SchemaArgs) -> Result<()> {
    let text = if args.reference { reference() } else { schema_text() };
    match &args.output {
        Some(path) => std::fs::write(path, text)
            .into_diagnostic()
            .wrap_err_with(|| format!("cannot write {}", path.display())),
        None => super::output::print(text.trim_end()),
    }
}
