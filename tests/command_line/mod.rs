//! The program as a user runs it: arguments, files, messages, exit codes, interruption.

mod black;
mod chains;
mod cost;
mod layers;
mod options;
mod study;

use chainlight::film::read_exr;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

fn chainlight(arguments: &[&str], folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_chainlight"));
    command
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .env("NO_COLOR", "1");
    command
}

fn run(arguments: &[&str], folder: &Path) -> Output {
    chainlight(arguments, folder).output().expect("the program starts")
}

/// Sends what Ctrl-C sends.
#[cfg(unix)]
fn interrupt(child: &Child) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.expect("kill").success());
}

/// Standard output of a run that must succeed.
fn succeed(arguments: &[&str], folder: &Path) -> String {
    let output = run(arguments, folder);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("text")
}

/// Standard error of a run that must fail and leave no file behind.
fn fail(arguments: &[&str]) -> String {
    let folder = TempDir::new().expect("a folder");
    let output = run(arguments, folder.path());
    assert!(!output.status.success(), "{arguments:?} succeeded");
    let error = String::from_utf8(output.stderr).expect("text");
    assert!(!error.contains("panicked"), "{error}");
    assert_eq!(
        folder.path().read_dir().expect("the folder").count(),
        0,
        "{arguments:?} left something behind"
    );
    // Messages are wrapped to the terminal's width.
    error
        .split_whitespace()
        .filter(|word| *word != "│")
        .collect::<Vec<_>>()
        .join(" ")
}

fn cornell() -> String {
    scene("cornell-box.ron").display().to_string()
}

#[test]
fn rendering_writes_a_picture_a_preview_and_a_report() {
    let folder = TempDir::new().expect("a folder");
    let arguments = [
        "render",
        &cornell(),
        "--size",
        "32x24",
        "--spp",
        "4",
        "--seed",
        "9",
        "--json",
        "-o",
        "a.exr",
    ];
    let report: Value = serde_json::from_str(&succeed(&arguments, folder.path())).expect("a report");
    assert_eq!((report["steps"].as_u64(), report["seed"].as_u64()), (Some(4), Some(9)));
    assert_eq!(report["samples"].as_u64(), Some(4 * 32 * 24));
    assert_eq!(report["non_finite"].as_u64(), Some(0));
    let picture = read_exr(&folder.path().join("a.exr")).expect("a picture");
    assert_eq!((picture.width, picture.height), (32, 24));
    let mean = picture.rgb.iter().map(|rgb| f64::from(rgb.mean())).sum::<f64>() / (32.0 * 24.0);
    assert!((mean - report["mean"].as_f64().expect("a mean")).abs() < 1e-5 * mean);
    assert!(
        picture
            .weight
            .expect("sample counts")
            .iter()
            .all(|&weight| weight == 4.0)
    );
    assert!(picture.error.is_some());
    for (key, value) in [
        ("technique", "pt"),
        ("seed", "9"),
        ("steps", "4"),
        ("scene", "cornell-box.ron"),
    ] {
        assert_eq!(picture.metadata.get(key).map(String::as_str), Some(value), "{key}");
    }
    let preview = image_size(&folder.path().join("a.png"));
    assert_eq!(preview, (32, 24));
    assert_eq!(
        folder.path().read_dir().expect("the folder").count(),
        2,
        "nothing else is left"
    );
}

/// Width and height in a PNG's header.
fn image_size(path: &Path) -> (u32, u32) {
    let bytes = std::fs::read(path).expect("a file");
    assert_eq!(&bytes[1..4], b"PNG");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    (number(16), number(20))
}

#[test]
fn the_same_command_writes_the_same_bytes_and_so_do_the_steps_of_a_time_budget() {
    let folder = TempDir::new().expect("a folder");
    let render = |name: &str, budget: [&str; 2], threads: &str| {
        let common = [
            "render",
            &cornell(),
            "--size",
            "24x24",
            "--json",
            "--threads",
            threads,
            "-o",
            name,
        ];
        let report = succeed(&[&common[..], &budget[..]].concat(), folder.path());
        let report: Value = serde_json::from_str(&report).expect("a report");
        (
            report["steps"].to_string(),
            std::fs::read(folder.path().join(name)).expect("a picture"),
        )
    };
    let (steps, timed) = render("timed.exr", ["--time", "0.2"], "2");
    assert!(timed == render("counted.exr", ["--spp", &steps], "1").1);
    assert!(timed == render("again.exr", ["--spp", &steps], "2").1);
}

#[test]
fn standard_output_is_the_summary_alone_and_quiet_without_a_terminal() {
    let folder = TempDir::new().expect("a folder");
    let output = run(&["render", &cornell(), "--size", "8x8", "--spp", "1"], folder.path());
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(String::from_utf8_lossy(&output.stdout).ends_with("wrote cornell-box.exr and cornell-box.png\n"));
}

#[test]
fn what_cannot_be_done_is_said_before_rendering() {
    let scene = cornell();
    let cases: [(&[&str], &[&str]); 14] = [
        (&["render", "none.ron"], &["none.ron", "no such file"]),
        (&["render", "."], &["must end in `.ron` or `.json`"]),
        (
            &["render", &scene, "-o", "missing/a.exr"],
            &["no such folder", "make the folder first"],
        ),
        (
            &["render", &scene, "-o", "a.png"],
            &["does not end in .exr", "picture.exr"],
        ),
        (
            &["render", &scene, "--technique", "pd"],
            &["there is no technique `pd`", "`pt`"],
        ),
        (&["render", &scene, "--size", "64"], &["WIDTHxHEIGHT"]),
        (
            &["render", &scene, "--size", "0x9"],
            &["each side must be in 1..=65536"],
        ),
        (&["render", &scene, "--spp", "0"], &["--spp"]),
        (&["render", &scene, "--time", "nan"], &["above 0"]),
        (
            &["render", &scene, "--spp", "1", "--time", "1"],
            &["cannot be used with"],
        ),
        (&["render", &scene, "--max-depth", "0"], &["1..=1024"]),
        (&["render", &scene, "--threads", "1025"], &["0..=1024"]),
        (&["profile", &scene, "--trace", "missing/a.json"], &["no such folder"]),
        (&["compare", "a.exr", "b.exr"], &["a.exr"]),
    ];
    check_refusals(&cases);
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_to_is_said_before_rendering() {
    check_refusals(&[(&["render", &cornell(), "-o", "/proc/a.exr"], &["/proc", "may write"])]);
}

/// Each command must fail, leave nothing behind, and say all the expected parts.
fn check_refusals(cases: &[(&[&str], &[&str])]) {
    for (arguments, expected) in cases {
        let error = fail(arguments);
        for part in *expected {
            assert!(error.contains(part), "{arguments:?}: no `{part}` in: {error}");
        }
    }
}

#[test]
fn a_scene_that_names_no_technique_of_ours_is_refused_with_the_nearest() {
    let folder = TempDir::new().expect("a folder");
    let text = std::fs::read_to_string(scene("cornell-glass.ron")).expect("a shipped scene");
    let path = folder.path().join("scene.ron");
    let named = text.replacen("settings: (", "settings: (technique: \"pt-refrence\", ", 1);
    assert_ne!(named, text);
    copy_meshes(folder.path());
    std::fs::write(&path, named).expect("a file");
    let output = run(&["plan", "scene.ron"], folder.path());
    // The message is wrapped, also at hyphens.
    let error = String::from_utf8_lossy(&output.stderr).replace(['\n', '│'], " ");
    let error = error.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        !output.status.success() && error.contains("(did you mean") && error.contains("scene.ron:"),
        "{error}"
    );
}

fn copy_meshes(folder: &Path) {
    let target = folder.join("meshes");
    std::fs::create_dir(&target).expect("a folder");
    for entry in scene("meshes").read_dir().expect("meshes").flatten() {
        std::fs::copy(entry.path(), target.join(entry.file_name())).expect("a copy");
    }
}

#[test]
fn a_scene_without_light_is_a_warning_and_a_black_picture() {
    let folder = TempDir::new().expect("a folder");
    let text = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
        film: (width: 8, height: 8), materials: {"m": Diffuse(reflectance: (1, 1, 1))},
        shapes: [(shape: Sphere(radius: 1), material: "m")])"#;
    std::fs::write(folder.path().join("dark.ron"), text).expect("a file");
    let output = run(&["render", "dark.ron", "--spp", "2"], folder.path());
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("warning"));
    assert!(
        read_exr(&folder.path().join("dark.exr"))
            .expect("a picture")
            .rgb
            .iter()
            .all(|rgb| rgb.is_black())
    );
}

#[test]
fn plan_and_profile_speak_text_and_json() {
    let folder = TempDir::new().expect("a folder");
    let text = succeed(&["plan", &cornell()], folder.path());
    assert!(
        text.contains("refraction           off") && text.contains("scatter_diffuse"),
        "{text}"
    );
    assert!(!text.contains("scatter_dielectric"), "{text}");
    let plan: Value = serde_json::from_str(&succeed(&["plan", &cornell(), "--json"], folder.path())).expect("JSON");
    assert!(plan["bytes_per_chain"].as_u64() > Some(0) && plan["film_bytes"].as_u64() == Some(512 * 512 * 128));

    let profile = [
        "profile",
        &cornell(),
        "--size",
        "16x16",
        "--spp",
        "4",
        "--json",
        "--trace",
        "events.json",
    ];
    let profile: Value = serde_json::from_str(&succeed(&profile, folder.path())).expect("JSON");
    assert_eq!(profile["paths"].as_u64(), Some(1024));
    let shares = profile["stages"]
        .as_array()
        .expect("stages")
        .iter()
        .chain([&profile["schedule"]]);
    let total: f64 = shares.map(|stage| stage["share"].as_f64().expect("a share")).sum();
    assert!((total - 1.0).abs() < 1e-6, "shares sum to {total}");
    let events = std::fs::read(folder.path().join("events.json")).expect("events");
    let events: Value = serde_json::from_slice(&events).expect("JSON");
    let events = events.as_array().expect("a list of events");
    assert!(
        !events.is_empty()
            && events
                .iter()
                .all(|event| event["ph"] == "X" && event["dur"].is_number())
    );
}

#[test]
fn compare_measures_and_refuses_sizes_that_differ() {
    let folder = TempDir::new().expect("a folder");
    for (name, size) in [("a.exr", "8x8"), ("b.exr", "8x8"), ("c.exr", "8x9")] {
        succeed(
            &["render", &cornell(), "--size", size, "--spp", "2", "-o", name],
            folder.path(),
        );
    }
    let same: Value =
        serde_json::from_str(&succeed(&["compare", "a.exr", "b.exr", "--json"], folder.path())).expect("JSON");
    assert_eq!(
        (same["mse"].as_f64(), same["mean_ratio"].as_f64()),
        (Some(0.0), Some(1.0))
    );
    let output = run(&["compare", "a.exr", "c.exr"], folder.path());
    assert!(!output.status.success() && String::from_utf8_lossy(&output.stderr).contains("8 x 9"));
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_what_there_is_and_says_so() {
    let folder = TempDir::new().expect("a folder");
    let arguments = [
        "render",
        &cornell(),
        "--size",
        "64x64",
        "--time",
        "600",
        "-o",
        "part.exr",
    ];
    let mut command = chainlight(&arguments, folder.path());
    let child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(Duration::from_millis(700));
    let began = Instant::now();
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");
    assert!(began.elapsed() < Duration::from_secs(60));
    assert_eq!(output.status.code(), Some(130));
    assert!(String::from_utf8_lossy(&output.stdout).contains("interrupted"));
    let picture = read_exr(&folder.path().join("part.exr")).expect("a picture");
    let steps: f32 = picture.metadata["steps"].parse().expect("a number");
    assert!(
        steps >= 1.0
            && picture
                .weight
                .expect("sample counts")
                .iter()
                .all(|&weight| weight == steps)
    );
}

#[test]
fn schema_prints_and_writes_what_is_committed() {
    let folder = TempDir::new().expect("a folder");
    let committed = std::fs::read_to_string(scene("scene.schema.json")).expect("the schema");
    assert_eq!(succeed(&["schema"], folder.path()), committed);
    assert_eq!(succeed(&["schema", "-o", "own.json"], folder.path()), "");
    let own = std::fs::read_to_string(folder.path().join("own.json")).expect("written");
    assert_eq!(own, committed);
    let reference = std::fs::read_to_string(scene("REFERENCE.md")).expect("the page");
    assert_eq!(succeed(&["schema", "--reference"], folder.path()), reference);
    assert!(fail(&["schema", "--output", "nowhere/own.json"]).contains("cannot write nowhere/own.json"));
}
