//! Layers, as a user asks for them.

use super::{cornell, fail, scene, succeed};
use serde_json::Value;
use tempfile::TempDir;

/// Layers of a JSON report, and what they have of each.
fn layers(report: &str) -> Vec<(String, Value)> {
    let report: Value = serde_json::from_str(report).expect("JSON");
    let layers = report["layers"].as_array().expect("layers").iter();
    layers
        .map(|layer| (layer["name"].as_str().expect("a name").to_owned(), layer.clone()))
        .collect()
}

fn names(layers: &[(String, Value)]) -> Vec<&str> {
    layers.iter().map(|(name, _)| name.as_str()).collect()
}

#[test]
fn a_picture_has_its_layers_and_the_report_what_they_cost() {
    let folder = TempDir::new().expect("a folder");
    let glass = scene("cornell-glass.ron").display().to_string();
    let arguments = [
        "render",
        &glass,
        "--size",
        "16x16",
        "--spp",
        "20",
        "--layers",
        "-o",
        "glass.exr",
    ];
    let report = succeed(&[&arguments[..], &["--json"]].concat(), folder.path());
    let found = layers(&report);
    let expected = [
        "emitted",
        "specular",
        "direct",
        "diffuse",
        "sds",
        "caustic",
        "seen_specular",
        "other",
    ];
    assert_eq!(names(&found), expected);
    let of = |name: &str, key: &str| found.iter().find(|(other, _)| other == name).expect("a layer").1[key].clone();
    assert_eq!(of("direct", "expression"), "C[DG]L");
    let sum = |key: &str| found.iter().filter_map(|(_, layer)| layer[key].as_f64()).sum::<f64>();
    assert!(
        (sum("light_share") - 1.0).abs() < 1e-5 && (sum("error_share") - 1.0).abs() < 1e-5,
        "{report}"
    );
    assert!(of("direct", "error")["rms"].as_f64().expect("an error") > 0.0);
    let picture = exr::prelude::MetaData::read_from_file(folder.path().join("glass.exr"), false).expect("a picture");
    let channels = picture.headers[0].channels.list.iter();
    let channels: Vec<String> = channels.map(|channel| channel.name.to_string()).collect();
    for name in expected {
        let png = folder.path().join(format!("glass.{name}.png"));
        assert!(png.exists(), "{name} is not shown");
        assert!(channels.contains(&format!("{name}.R")), "{channels:?}");
    }
    let plan = succeed(&["plan", &glass, "--layers"], folder.path());
    assert!(plan.contains("\n  caustic              C.*[DG]S+L\n"), "{plan}");
    let text = succeed(&arguments, folder.path());
    assert!(
        text.contains("1 % after") && text.contains("\ncaustic        C.*[DG]S+L "),
        "{text}"
    );
}

#[test]
fn layers_of_ones_own_are_split_and_the_rest_is_kept() {
    let folder = TempDir::new().expect("a folder");
    let cornell = cornell();
    let arguments = [
        "profile",
        &cornell,
        "--size",
        "16x16",
        "--spp",
        "20",
        "--technique",
        "mlt",
        "--groups",
        "4",
        "--chains",
        "64",
        "--layer",
        "seen=CL",
        "--layer",
        "first = C D L",
        "--json",
    ];
    let error = fail(&arguments);
    assert!(error.contains("\"first \" is no name for a layer"), "{error}");
    let arguments = arguments.map(|argument| {
        if argument.starts_with("first") {
            "first=C D L"
        } else {
            argument
        }
    });
    let found = layers(&succeed(&arguments, folder.path()));
    assert_eq!(names(&found), ["seen", "first", "other"]);
    let share = |layer: usize| found[layer].1["time_share"].as_f64().expect("a share");
    assert!(
        share(2) > share(0),
        "chains spend their time where direct light is not: {found:?}"
    );
}

#[test]
fn what_makes_no_layers_is_refused_in_words() {
    let cornell = cornell();
    let render = |more: &[&str]| fail(&[&["render", &cornell, "--size", "8x8"], more].concat());
    let refusals = [
        (
            render(&["--layer", "CDL"]),
            "expected NAME=EXPRESSION, such as caustics=C.*DS+L",
        ),
        (
            render(&["--layer", "a=C[DL"]),
            "the light path expression `C[DL` cannot be read: this set is not closed",
        ),
        (
            render(&["--layer", "a=CDL", "--layer", "a=CL"]),
            "\"a\" is no name for a layer",
        ),
        (
            render(&["--layer", "a=CSL"]),
            "no path of this scene can be in the layer a=CSL",
        ),
        (render(&["--layer", "a=CDL", "--layers"]), "cannot be used with"),
        (
            render(&["--layers", "--technique", "pt-reference"]),
            "pt-reference does not split light into layers",
        ),
        (
            fail(&[
                "replay", &cornell, "--size", "8x8", "--chain", "0", "--step", "0", "--layers",
            ]),
            "layers have no effect on a replay",
        ),
    ];
    for (error, words) in refusals {
        assert!(error.contains(words), "{error}");
    }
}
