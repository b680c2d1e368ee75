//! Whether a render fits into memory.

use super::load::Loaded;
use super::output::bytes;
use crate::plan::Plan;
use miette::{Result, miette};

/// Bytes per pixel of the developed picture with its errors and weights, and of the files made of it.
const PICTURE_BYTES: u64 = 64;

/// Memory that a render takes at its peak, beside the scene: film, picture, tree, and a tile's tables per thread.
pub fn needed(plan: &Plan, pixels: u32, threads: usize) -> u64 {
    let picture = PICTURE_BYTES * u64::from(pixels);
    let tables = plan.tile_bytes().saturating_mul(threads as u64);
    plan.film_bytes
        .saturating_add(picture)
        .saturating_add(plan.tree_bytes)
        .saturating_add(tables)
}

/// Refuses a render that would take more memory than is available, before any of it is taken: operating systems promise
/// memory that they do not have, and end the program when it is used. Where the system does not tell how much is
/// available, nothing is refused.
///
/// # Errors
/// Too little memory.
pub fn check(loaded: &Loaded, threads: usize) -> Result<()> {
    let needed = needed(&loaded.plan, loaded.scene.pixel_count(), threads);
    match available() {
        Some(available) if needed > available => Err(miette!(
            help = "render a smaller picture (--size), with fewer threads, a smaller --tile or --max-depth",
            "this render needs about {}, and {} are available: film {}, tables {} for each of {threads} threads",
            bytes(needed),
            bytes(available),
            bytes(loaded.plan.film_bytes),
            bytes(loaded.plan.tile_bytes())
        )),
        _ => Ok(()),
    }
}

/// Bytes that can be taken without swapping, where Linux tells.
fn available() -> Option<u64> {
    parse(&std::fs::read_to_string("/proc/meminfo").ok()?)
}

fn parse(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn available_memory_is_read_in_bytes() {
        let text = "MemTotal:  100 kB\nMemFree:   3 kB\nMemAvailable:   24 kB\n";
        assert_eq!(parse(text), Some(24 * 1024));
        assert_eq!(parse("MemAvailable: many kB"), None);
        assert_eq!(parse(""), None);
    }
}
