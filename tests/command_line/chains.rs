//! Techniques with chains as a user runs them: budgets, what a render tells, saving and going on.

use super::{chainlight, cornell, fail, run, scene, succeed};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// A render of 32 x 24 pixels with few chains, and what it reports.
fn render(more: &[&str], folder: &Path) -> Value {
    let glass = scene("cornell-glass.ron").display().to_string();
    let mut arguments = vec!["render", &glass, "--technique", "pssmlt", "--size", "32x24", "--json"];
    arguments.extend(more);
    serde_json::from_str(&succeed(&arguments, folder)).expect("a report")
}

fn same_bytes(folder: &Path, a: &str, b: &str) -> bool {
    let read = |name: &str| std::fs::read(folder.join(name)).expect("a picture");
    read(a) == read(b)
}

#[test]
fn a_render_tells_what_came_of_its_chains() {
    let folder = TempDir::new().expect("a folder");
    let report = render(&["--spp", "64", "-o", "a.exr"], folder.path());
    let chains = &report["chains"];
    assert_eq!(
        (chains["groups"].as_u64(), chains["chains"].as_u64()),
        (Some(16), Some(1024))
    );
    let [low, high] = [0, 1].map(|i| chains["normalization_interval"][i].as_f64().expect("a bound"));
    let b = chains["normalization"].as_f64().expect("a number");
    assert!(0.0 < low && low < b && b < high);
    let error = &report["error"];
    let [rms, upper] = ["rms", "upper"].map(|key| error[key].as_f64().expect("a number"));
    assert!(0.0 < rms && rms < upper, "{error}");
    let mutations = chains["mutations"].as_array().expect("a list");
    let names: Vec<&str> = mutations.iter().filter_map(|m| m["name"].as_str()).collect();
    assert_eq!(names, ["large_step", "small_step"]);
    for mutation in mutations {
        let of = |value: &Value, key: &str| value[key].as_u64().expect("a count");
        let lengths = mutation["by_length"].as_array().expect("a list");
        assert!(lengths.len() > 2);
        for key in ["proposed", "accepted", "impossible"] {
            let sum: u64 = lengths.iter().map(|length| of(length, key)).sum();
            assert_eq!(sum, of(mutation, key), "{key}");
        }
        assert!(of(mutation, "accepted") > 0 && of(mutation, "accepted") < of(mutation, "proposed"));
    }
    assert!(chains["longest_rejections"].as_u64().expect("a count") > 1);
    let independent = chains["effective_samples"]["total"].as_f64().expect("a number");
    assert!(independent > 16.0 && independent < report["samples"].as_f64().expect("a number"));
    let layers = exr::prelude::MetaData::read_from_file(folder.path().join("a.exr"), false).expect("a picture");
    let channels: Vec<String> = layers.headers[0]
        .channels
        .list
        .iter()
        .map(|c| c.name.to_string())
        .collect();
    for layer in ["R", "error.R", "block_error.G", "agreement.Y", "weight.Y"] {
        assert!(channels.iter().any(|name| name == layer), "{layer}: {channels:?}");
    }
}

#[test]
fn the_summary_names_every_mutation_that_is_tried_and_no_other() {
    let folder = TempDir::new().expect("a folder");
    let arguments = [
        "render",
        &cornell(),
        "--technique",
        "pssmlt",
        "--size",
        "16x16",
        "--spp",
        "8",
    ];
    let summary = succeed(&arguments, folder.path());
    assert!(summary.contains("large_step") && summary.contains("small_step") && summary.contains("longest run"));
    assert!(!summary.contains("identity"));
    let with_identity = [&arguments[..], &["--mutation", "identity:weight=0.1"]].concat();
    let summary = succeed(&with_identity, folder.path());
    let line = summary
        .lines()
        .find(|line| line.starts_with("identity"))
        .expect("a line");
    assert!(
        line.contains("100.0 %"),
        "the current path again is always taken: {line}"
    );
    let profile = [
        "profile",
        &cornell(),
        "--technique",
        "pssmlt",
        "--size",
        "16x16",
        "--spp",
        "2",
    ];
    let table = succeed(
        &[&profile[..], &["--mutation", "identity:weight=0.1"]].concat(),
        folder.path(),
    );
    assert!(table.contains("propose_identities") && table.contains("draw_small_steps"));
}

#[test]
fn a_time_budget_is_reproduced_by_the_mutations_per_pixel_it_recorded() {
    let folder = TempDir::new().expect("a folder");
    let timed = render(&["--time", "0.3", "-o", "timed.exr"], folder.path());
    let spp = timed["samples_per_pixel"].as_f64().expect("a number").to_string();
    let again = render(
        &["--spp", &spp, "--threads", "1", "--tile", "16", "-o", "again.exr"],
        folder.path(),
    );
    assert_eq!(timed["steps"], again["steps"]);
    assert!(same_bytes(folder.path(), "timed.exr", "again.exr"));
}

/// Two processes with a file between them against one that never stopped.
#[test]
fn a_render_that_was_ended_goes_on_to_the_same_bytes() {
    let folder = TempDir::new().expect("a folder");
    for (technique, name) in [("pssmlt", "chains"), ("mlt", "chains of paths"), ("pt", "samples")] {
        let technique = ["--technique", technique];
        let run = |more: &[&str]| {
            let glass = scene("cornell-glass.ron").display().to_string();
            let scene = ["render", &glass, "--size", "32x24", "--seed", "5"];
            succeed(&[&scene[..], &technique, more].concat(), folder.path());
        };
        run(&["--spp", "24", "-o", "whole.exr"]);
        run(&["--spp", "7", "--save", "saved", "-o", "part.exr"]);
        run(&[
            "--spp",
            "24",
            "--resume",
            "saved",
            "--threads",
            "1",
            "-o",
            "resumed.exr",
        ]);
        assert!(same_bytes(folder.path(), "whole.exr", "resumed.exr"), "{name}");
        assert!(!same_bytes(folder.path(), "whole.exr", "part.exr"), "{name}");
    }
}

#[test]
fn what_was_saved_of_another_render_is_refused() {
    let folder = TempDir::new().expect("a folder");
    render(&["--spp", "2", "--save", "saved", "-o", "a.exr"], folder.path());
    let saved = folder.path().join("saved").display().to_string();
    let glass = scene("cornell-glass.ron").display().to_string();
    let refused = |more: &[&str]| {
        let arguments = [
            &[
                "render",
                glass.as_str(),
                "--size",
                "32x24",
                "--technique",
                "pssmlt",
                "--resume",
                &saved,
            ],
            more,
        ];
        fail(&arguments.concat())
    };
    assert!(refused(&["--seed", "1"]).contains("the seed is 0 there, and 1 here"));
    assert!(refused(&["--groups", "8"]).contains("the number of groups is 16 there, and 8 here"));
    assert!(refused(&["--mutation", "small_step:largest=0.1"]).contains("the mutation small_step is"));
    let bytes = std::fs::read(&saved).expect("a file");
    let damaged = |bytes: &[u8]| {
        std::fs::write(&saved, bytes).expect("written");
        refused(&[])
    };
    assert!(damaged(&bytes[..bytes.len() - 1]).contains("the saved render is damaged"));
    assert!(damaged(b"something else").contains("this is no saved render"));
    let mut flipped = bytes;
    let middle = flipped.len() / 2;
    flipped[middle] ^= 1;
    assert!(damaged(&flipped).contains("the saved render is damaged"));
    let missing = fail(&["render", &glass, "--technique", "pssmlt", "--resume", "nowhere"]);
    assert!(missing.contains("nowhere: cannot be read"), "{missing}");
}

#[test]
fn an_error_target_ends_a_render_and_says_so() {
    let folder = TempDir::new().expect("a folder");
    let report = render(&["--target-error", "0.4", "-o", "a.exr"], folder.path());
    assert_eq!(report["target_reached"], Value::Bool(true));
    assert!(report["error"]["upper"].as_f64().expect("a bound") <= 0.4);
    let capped = render(&["--target-error", "1e-6", "--spp", "2", "-o", "b.exr"], folder.path());
    assert_eq!(capped["target_reached"], Value::Bool(false));
}

#[test]
fn what_chains_cannot_be_run_with_is_said() {
    let cornell = cornell();
    let with = |more: &[&str]| fail(&[&["render", cornell.as_str(), "--technique", "pssmlt"], more].concat());
    let cases: [(&[&str], &str); 9] = [
        (&["--mutation", "smal_step:weight=1"], "did you mean `small_step`?"),
        (&["--mutation", "small_step:lagrest=1"], "did you mean `largest`?"),
        (&["--mutation", "small_step:largest=many"], "setting `largest`"),
        (&["--mutation", "small_step:largest=1e-9"], "small_step"),
        (
            &["--mutation", "small_step:weight=-1"],
            "its weight is a number from 0 up",
        ),
        (&["--mutation", "small_step"], "expected NAME:SETTING=VALUE"),
        (
            &["--mutation", "small_step:weight=0", "--mutation", "large_step:weight=0"],
            "has a weight above 0",
        ),
        (&["--groups", "0"], "0 is not in 1..=4096"),
        (&["--target-error", "2"], "below 1"),
    ];
    for (arguments, message) in cases {
        let error = with(arguments);
        assert!(error.contains(message), "{arguments:?}: {error}");
    }
    let broken = fail(&["render", &cornell, "--technique", "pt", "--spp", "1.5"]);
    assert!(broken.contains("whole samples per pixel, not 1.5"), "{broken}");
}

#[test]
fn a_scene_without_light_has_no_chains_to_start() {
    let folder = TempDir::new().expect("a folder");
    let text = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 30),
        film: (width: 16, height: 16), materials: {"m": Diffuse(reflectance: (1, 1, 1))},
        shapes: [(shape: Sphere(radius: 1), material: "m")])"#;
    std::fs::write(folder.path().join("dark.ron"), text).expect("written");
    let output = run(
        &["render", "dark.ron", "--technique", "pssmlt", "--spp", "2"],
        folder.path(),
    );
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success()
            && words.contains("nothing in this scene emits light")
            && !words.contains("--bootstrap"),
        "{words}"
    );
}

/// A render of 32 x 24 pixels by `mlt` and what it reports.
fn render_paths(more: &[&str], folder: &Path) -> Value {
    let glass = scene("cornell-glass.ron").display().to_string();
    let arguments = ["render", &glass, "--technique", "mlt", "--size", "32x24", "--json"];
    serde_json::from_str(&succeed(&[&arguments[..], more].concat(), folder)).expect("a report")
}

#[test]
fn direct_light_beside_chains_is_told_everywhere() {
    let folder = TempDir::new().expect("a folder");
    let apart = render_paths(&["--spp", "150", "-o", "a.exr"], folder.path());
    let samples = apart["direct_samples_per_pixel"].as_f64().expect("a number");
    let mutations = apart["samples_per_pixel"].as_f64().expect("a number");
    assert!(
        mutations >= 150.0 && (samples - 0.64 * mutations).abs() < 0.01,
        "{samples}"
    );
    let settings = apart["settings"].as_str().expect("text");
    assert!(
        settings.ends_with(" direct=64") && !settings.contains("base="),
        "{settings}"
    );
    let metadata = chainlight::film::read_exr(&folder.path().join("a.exr"))
        .expect("a picture")
        .metadata;
    assert_eq!(metadata["settings"], settings);
    assert_eq!(metadata["direct_samples_per_pixel"], samples.to_string());
    let all = render_paths(&["--spp", "50", "--direct", "chains", "-o", "b.exr"], folder.path());
    assert!(all["direct_samples_per_pixel"].is_null());
    assert!(
        all["settings"]
            .as_str()
            .is_some_and(|settings| settings.ends_with(" direct=chains"))
    );
    let of_b = |report: &Value| report["chains"]["normalization"].as_f64().expect("a number");
    assert!(of_b(&apart) < of_b(&all));

    let glass = scene("cornell-glass.ron").display().to_string();
    let shown = |command: &str, more: &[&str]| {
        let arguments = [command, &glass, "--technique", "mlt", "--size", "16x12"];
        succeed(&[&arguments[..], more].concat(), folder.path())
    };
    let plan = shown("plan", &[]);
    assert!(plan.contains("direct light, which chains leave out: pt, paths of at most 24 edges that scatter once at most but in mirrors and glass, 64 samples per pixel"));
    assert!(plan.contains("connect_lights") && plan.contains("evaluate_paths"));
    let json: Value = serde_json::from_str(&shown("plan", &["--json", "--direct", "5"])).expect("JSON");
    assert_eq!(json["direct"]["samples_per_100_mutations"].as_u64(), Some(5));
    assert!(
        json["direct"]["systems"]
            .as_array()
            .is_some_and(|systems| !systems.is_empty())
    );
    assert!(!shown("plan", &["--direct", "chains"]).contains("direct light, which"));
    let profile = shown("profile", &["--spp", "8"]);
    assert!(profile.contains("direct light by pt:") && profile.contains("connect_lights"));
    let json: Value = serde_json::from_str(&shown("profile", &["--spp", "8", "--json"])).expect("JSON");
    let share = |part: &Value| {
        let stages = part["stages"].as_array().expect("a list").iter();
        let schedule = part["schedule"]["share"].as_f64().expect("a share");
        stages
            .map(|stage| stage["share"].as_f64().expect("a share"))
            .sum::<f64>()
            + schedule
    };
    let (chains, direct) = (share(&json), share(&json["direct"]));
    assert!(
        direct > 0.0 && (chains + direct - 1.0).abs() < 1e-3,
        "{chains} {direct}"
    );
}

/// The error falls with steps, direct light's too.
#[test]
fn chains_beside_direct_light_reach_an_error_target() {
    let folder = TempDir::new().expect("a folder");
    let report = render_paths(&["--target-error", "0.3", "-o", "a.exr"], folder.path());
    assert_eq!(report["target_reached"], Value::Bool(true));
    assert!(report["error"]["upper"].as_f64().expect("a bound") <= 0.3);
}

#[test]
fn a_saved_render_of_paths_goes_on_with_its_own_direct_light_alone() {
    let folder = TempDir::new().expect("a folder");
    render_paths(&["--spp", "2", "--save", "saved", "-o", "a.exr"], folder.path());
    let saved = folder.path().join("saved").display().to_string();
    let glass = scene("cornell-glass.ron").display().to_string();
    let arguments = [
        "render",
        &glass,
        "--technique",
        "mlt",
        "--size",
        "32x24",
        "--resume",
        &saved,
    ];
    for (direct, told) in [
        ("chains", "--direct is 64 there, and chains here"),
        ("17", "--direct is 64 there, and 17 here"),
    ] {
        let error = fail(&[&arguments[..], &["--direct", direct]].concat());
        assert!(error.contains(told), "{error}");
    }
    let timed = render_paths(&["--time", "0.3", "-o", "timed.exr"], folder.path());
    let spp = timed["samples_per_pixel"].as_f64().expect("a number").to_string();
    let again = ["--spp", &spp, "--threads", "1", "--tile", "16", "-o", "again.exr"];
    assert_eq!(timed["steps"], render_paths(&again, folder.path())["steps"]);
    assert!(same_bytes(folder.path(), "timed.exr", "again.exr"));
}

#[cfg(unix)]
#[test]
fn an_interrupt_while_chains_run_keeps_what_they_have() {
    use std::time::Duration;
    let folder = TempDir::new().expect("a folder");
    let glass = scene("cornell-glass.ron").display().to_string();
    let arguments = [
        "render",
        &glass,
        "--technique",
        "pssmlt",
        "--size",
        "32x24",
        "--spp",
        "1e6",
        "--save",
        "saved",
    ];
    let mut child = chainlight(&arguments, folder.path())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(Duration::from_secs(2));
    super::interrupt(&child);
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert!(folder.path().join("cornell-glass.exr").exists() && folder.path().join("saved").exists());
}
