//! The command.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

fn replay(arguments: &[&str]) -> Command {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/cornell-glass.ron");
    let mut command = Command::new(env!("CARGO_BIN_EXE_chainlight"));
    command
        .arg("replay")
        .arg(scene)
        .args(["--size", "16x16"])
        .args(arguments)
        .env("NO_COLOR", "1");
    command
}

fn run(arguments: &[&str]) -> Output {
    replay(arguments).output().expect("the program starts")
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

/// Independent samples need nothing that was before them.
#[test]
fn a_sample_far_out_is_there_at_once() {
    let began = Instant::now();
    let text = succeed(&["--technique", "pt", "--chain", "100", "--step", "4000000000"]);
    assert!(
        text.starts_with("pt, seed 0: pixel number 100, sample 4000000000"),
        "{text}"
    );
    assert!(began.elapsed() < Duration::from_secs(30));
}

#[cfg(unix)]
#[test]
fn a_step_far_out_tells_how_long_it_takes_and_can_be_interrupted() {
    let mut command = replay(&["--technique", "pssmlt", "--chain", "20", "--step", "4000000000"]);
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let told = lines.next().expect("a line").expect("text");
    let words = ["the steps before step 4000000000 take about ", "Ctrl-C ends it"];
    assert!(words.iter().all(|word| told.contains(word)), "{told}");
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(killed.expect("kill").success());
    let began = Instant::now();
    let rest: Vec<String> = lines.map_while(Result::ok).collect();
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert!(began.elapsed() < Duration::from_secs(30));
    assert!(rest.iter().any(|line| line.contains("nothing to show")), "{rest:?}");
}
