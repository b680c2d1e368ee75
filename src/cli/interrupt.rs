//! Ctrl-C.

use super::output::note;
use miette::{IntoDiagnostic, Result, WrapErr};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The exit status of a program that was interrupted: 128 + SIGINT.
pub const EXIT_STATUS: u8 = 130;

/// A flag that the first Ctrl-C (or SIGTERM) sets; the second ends the program at once.
///
/// # Errors
/// If the operating system refuses the handler.
pub fn listen() -> Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&flag);
    ctrlc::set_handler(move || {
        if handler.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(EXIT_STATUS));
        }
        note("\nstopping after this step; once more to stop at once and write nothing");
    })
    .into_diagnostic()
    .wrap_err("cannot listen for Ctrl-C")?;
    Ok(flag)
}
