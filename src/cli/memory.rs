//! Whether a render fits into memory.

use super::load::Loaded;
use super::output::bytes;
use crate::plan::Plan;
use miette::{Result, miette};

/// Bytes per pixel of the developed picture with its errors and weights, and of the files made of it.
const PICTURE_BYTES: u64 = 64;

/// Bytes of a bootstrap's sample: its weight and its class.
const SAMPLE_BYTES: u64 = 12;

/// Bytes of what a world of chains counts, beside its tables.
const COUNTS_BYTES: u64 = 64 << 10;

/// Memory that a render takes at its peak, beside the scene: film, picture, tree, and a tile's tables per thread.
pub fn needed(plan: &Plan, pixels: u32, threads: usize) -> u64 {
    let picture = PICTURE_BYTES * u64::from(pixels);
    let worlds = worlds(plan, pixels, threads);
    let of_direct = plan.direct.as_ref().map_or(0, |direct| direct.tile.most_bytes());
    let tables = plan.tile.most_bytes().saturating_mul(worlds);
    let tables = tables.saturating_add(of_direct.saturating_mul(threads as u64));
    // A bootstrap keeps what every sample weighs, and a world of chains what it counts.
    let samples = plan.chains.as_ref().map_or(0, |chains| {
        let counts = chains.counts;
        u64::from(counts.rounds) * u64::from(counts.chains) * u64::from(counts.groups) * SAMPLE_BYTES
            + worlds * COUNTS_BYTES
    });
    samples
        .saturating_add(plan.film_bytes)
        .saturating_add(picture)
        .saturating_add(plan.tree_bytes)
        .saturating_add(tables)
}

/// Worlds that a render keeps: of chains one for every tile, of independent samples one for every thread.
fn worlds(plan: &Plan, pixels: u32, threads: usize) -> u64 {
    if plan.chains.is_some() {
        u64::from(plan.tiles(pixels))
    } else {
        threads as u64
    }
}

/// Refuses a render that would take more memory than is available, before any of it is taken: operating systems promise
/// memory that they do not have, and end the program when it is used. Where the system does not tell how much is
/// available, nothing is refused.
///
/// # Errors
/// Too little memory.
pub fn check(loaded: &Loaded, threads: usize) -> Result<()> {
    judge(&loaded.plan, loaded.scene.pixel_count(), threads, available())
}

/// [`check`] for a given amount of available memory.
fn judge(plan: &Plan, pixels: u32, threads: usize, available: Option<u64>) -> Result<()> {
    let needed = needed(plan, pixels, threads);
    match available {
        Some(available) if needed > available => Err(miette!(
            help = "render a smaller picture (--size), with a smaller --tile or --max-depth, fewer --threads, or of chains fewer \
                    --groups, --chains or --bootstrap samples",
            "this render needs about {}, and {} are available: films {}, tables {} for each of {} worlds",
            bytes(needed),
            bytes(available),
            bytes(plan.film_bytes),
            bytes(plan.tile.most_bytes()),
            worlds(plan, pixels, threads)
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
    use super::{judge, needed, parse};
    use crate::plan::{Plan, Technique};
    use crate::scene::{Format, Scene, SceneOverrides, flatten, parse_scene};
    use std::path::Path;

    /// A lamp before a film of `size`, with tables for paths of `max_depth` edges in tiles of `tile` chains.
    fn plan(size: (u32, u32), max_depth: u32, tile: u32) -> Plan {
        let text = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 30),
            film: (width: 16, height: 16), materials: {"m": Diffuse(reflectance: (1, 1, 1))},
            shapes: [(shape: Sphere(radius: 1), material: "m", emission: (3, 2, 1))])"#;
        let source = parse_scene("lamp.ron", text, Format::Ron, Path::new(".")).expect("a valid scene");
        let overrides = SceneOverrides {
            size: Some(size),
            max_depth: Some(max_depth),
        };
        let flattened = flatten(&source).expect("a valid scene");
        let scene = Scene::compile(&source.description, &flattened, overrides).expect("a valid filter");
        Plan::new(&scene, Technique::Pt, Some(tile))
    }

    #[test]
    fn a_film_or_tables_that_do_not_fit_are_refused_with_what_to_do() {
        let gibibytes = |count: u64| Some(count << 30);
        let film = plan((65536, 4096), 2, 16);
        let error = judge(&film, 65536 * 4096, 1, gibibytes(24)).expect_err("48 GiB of film and picture");
        assert!(
            error.to_string().contains("24.0 GiB are available: films 32.0 GiB"),
            "{error}"
        );
        assert!(error.help().is_some_and(|help| help.to_string().contains("--size")));
        let tables = plan((16, 16), 1024, 1 << 20);
        assert!(
            judge(&tables, 256, 2, gibibytes(64)).is_err(),
            "{}",
            needed(&tables, 256, 2)
        );
        assert!(
            judge(&tables, 256, 2, None).is_ok(),
            "where nothing is known, nothing is refused"
        );
        assert!(judge(&plan((16, 16), 16, 1024), 256, 2, gibibytes(1)).is_ok());
    }

    #[test]
    fn available_memory_is_read_in_bytes() {
        let text = "MemTotal:  100 kB\nMemFree:   3 kB\nMemAvailable:   24 kB\n";
        assert_eq!(parse(text), Some(24 * 1024));
        assert_eq!(parse("MemAvailable: many kB"), None);
        assert_eq!(parse(""), None);
    }
}
