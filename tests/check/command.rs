//! `chainlight check` as a user runs it.

use serde_json::Value;
use std::process::{Command, Output, Stdio};

fn check(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_chainlight"));
    command.arg("check").args(arguments).stdin(Stdio::null());
    command.env("NO_COLOR", "1").output().expect("the program starts")
}

#[test]
fn all_tests_are_there_as_json() {
    let output = check(&["identity", "--json", "--threads", "2"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found["passed"], true);
    let report = &found["reports"][0];
    assert_eq!(report["mutation"], "identity");
    assert_eq!(report["density"], "point_mass");
    let tests = report["tests"].as_array().expect("tests");
    assert!(tests.len() > 100 && tests.iter().all(|test| test["passed"] == true));
}

#[test]
fn what_cannot_be_checked_is_said() {
    for (arguments, expected) in [
        (&["larg_step"][..], "did you mean `large_step`?"),
        (&["--mutation", "small_step:larges=0.1"], "did you mean `largest`?"),
        (&["--scene", "nowhere.ron"], "nowhere.ron"),
        (
            &["small_step", "--mutation", "small_step:weight=0.5"],
            "a weight has no effect",
        ),
        (
            &["identity", "--mutation", "small_step:largest=0.1"],
            "no effect on the check of `identity`",
        ),
    ] {
        let output = check(arguments);
        let error = String::from_utf8_lossy(&output.stderr).replace("\n  │", "");
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains(expected), "{error}");
    }
}
