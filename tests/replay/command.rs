//! The command.

use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str]) -> Output {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/cornell-glass.ron");
    Command::new(env!("CARGO_BIN_EXE_chainlight"))
        .arg("replay")
        .arg(scene)
        .args(["--size", "16x16"])
        .args(arguments)
        .env("NO_COLOR", "1")
        .output()
        .expect("the program starts")
}

fn succeed(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn text_and_json_show_the_same_step() {
    let moment = ["--technique", "pssmlt", "--chain", "20", "--step", "7", "--seed", "3"];
    let text = succeed(&moment);
    let json = succeed(&[&moment[..], &["--json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((json["chain"].as_u64(), json["step"].as_u64()), (Some(20), Some(7)));
    for part in [
        "state before",
        "mutation",
        "vertex 1",
        "ln T(x→y)",
        "decision",
        "state after",
    ] {
        assert!(text.contains(part), "no `{part}` in: {text}");
    }
    let name = json["mutation"]["name"].as_str().expect("a name");
    assert!(text.contains(&format!("mutation       {name},")), "{text}");
    let reason = json["decision"]["reason"].as_str().expect("a reason");
    assert!(text.contains(reason), "{text}");
    let vertices = json["proposal"]["vertices"].as_array().expect("vertices");
    assert_eq!(vertices.len(), text.matches("  vertex ").count());
}

#[test]
fn a_pixel_is_replayed_without_states() {
    let text = succeed(&["--technique", "pt", "--chain", "100", "--step", "5"]);
    assert!(text.starts_with("pt, seed 0: pixel number 100, sample 5"), "{text}");
    assert!(text.contains("light") && !text.contains("state before") && !text.contains("decision"));
}

#[test]
fn what_there_is_not_fails_with_the_range() {
    let output = run(&["--technique", "pssmlt", "--chain", "4000000", "--step", "0"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && error.contains("0 to 1023"), "{error}");
}
