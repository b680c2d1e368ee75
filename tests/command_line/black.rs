//! What is missing from a picture is said: all of its light, or what its technique cannot find.

use super::{cornell, run, scene, succeed};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// A lamp behind a wall, and the camera on its other side.
const BEHIND: &str = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
    film: (width: 8, height: 8), materials: {"m": Diffuse(reflectance: (1, 1, 1))},
    shapes: [
        (shape: Box(min: (-3, -3, -3), max: (3, 3, 3)), material: "m"),
        (shape: Sphere(radius: 1), material: "m", emission: (1, 1, 1)),
    ])"#;

/// Standard error in one line, and the warnings of the report.
fn warnings(arguments: &[&str], folder: &Path) -> (String, Vec<String>) {
    let output = run(&[arguments, &["--json"]].concat(), folder);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {told}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("a report");
    let warnings = report["warnings"].as_array().expect("a list").iter();
    (told, warnings.map(|w| w.as_str().expect("text").to_owned()).collect())
}

#[test]
fn a_picture_without_light_is_told_with_what_to_try() {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("behind.ron"), BEHIND).expect("written");
    for (technique, advice) in [
        (&["pt"][..], "try --technique bdpt"),
        (&["pt-reference"], "try --technique bdpt"),
        (&["lt"], "a rough surface that the camera sees"),
        (&["bdpt"], "--technique pssmlt --base bdpt"),
        (&["bdpt", "--strategy", "1,2"], "strategy (1, 2) alone"),
    ] {
        let arguments = [&["render", "behind.ron", "--spp", "2", "--technique"], technique].concat();
        let (told, listed) = warnings(&arguments, folder.path());
        let black = "none of 128 samples brought any light: the picture is black";
        assert!(
            told.contains(black) && told.contains(advice) && told.contains("--max-depth 16"),
            "{told}"
        );
        let [only] = listed.as_slice() else {
            panic!("{listed:?}")
        };
        assert!(only.contains(black) && told.contains(only.as_str()), "{told}");
    }
}

/// Whatever kind they are of, and whatever is to find them: no chain finds more with a longer bootstrap.
#[test]
fn lights_without_power_are_told() {
    let folder = TempDir::new().expect("a folder");
    let black = image::Rgb32FImage::new(4, 2);
    black.save(folder.path().join("black.exr")).expect("a picture");
    for lights in [
        "Point(position: (0, 0, 0), intensity: (0, 0, 0)), Sun(direction: (0, 1, 0), scale: 0)",
        "Environment(file: \"black.exr\")",
        "Environment(radiance: (0, 0, 0)), Sky(sun_direction: (0, 1, 0), scale: 0)",
    ] {
        let scene = BEHIND.replace("emission: (1, 1, 1)", "emission: (0, 0, 0)");
        let scene = scene.replace("shapes:", &format!("lights: [{lights}], shapes:"));
        std::fs::write(folder.path().join("dark.ron"), scene).expect("written");
        let chains = ["pssmlt", "--groups", "2", "--chains", "8", "--bootstrap", "64"];
        for technique in [&["pt"][..], &["lt"], &["bdpt"], &chains] {
            let arguments = [&["render", "dark.ron", "--spp", "2", "--technique"], technique].concat();
            let (told, listed) = warnings(&arguments, folder.path());
            let [only] = listed.as_slice() else {
                panic!("{listed:?}")
            };
            assert!(
                only.contains("no light of this scene has any power") && only.contains("dark.ron:3:"),
                "{only}"
            );
            assert!(!told.contains("--bootstrap"), "{told}");
        }
    }
}

/// Light of a point through a ball of glass.
const BALL: &str = r#"(version: 1, settings: (max_depth: 8), camera: Perspective(origin: (0, 3, 5), target: (0, 1, 0), fov: 40),
    film: (width: 8, height: 8),
    materials: {"m": Diffuse(reflectance: (1, 1, 1)), "glass": Dielectric(interior_ior: 1.5)},
    lights: [Spot(position: (0, 5, 0), target: (0, 0, 0), intensity: (9, 9, 9))],
    shapes: [
        (shape: Quad(corner: (-5, 0, 5), edge_u: (10, 0, 0), edge_v: (0, 0, -10)), material: "m"),
        (shape: Sphere(center: (0, 1, 0), radius: 0.8), material: "glass"),
    ])"#;

/// Nothing is said of what finds all of it, and the way out where nothing does.
#[test]
fn light_of_points_through_glass_is_told_of_what_cannot_find_it() {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("ball.ron"), BALL).expect("written");
    let aside = BALL.replace(
        "origin: (0, 3, 5), target: (0, 1, 0), fov: 40",
        "origin: (4, 1, 1), target: (4, 0, 0), fov: 20",
    );
    std::fs::write(folder.path().join("aside.ron"), aside).expect("written");
    let chains = ["pssmlt", "--groups", "2", "--chains", "8", "--bootstrap", "64"];
    let over_bdpt = [&chains[..], &["--base", "bdpt"]].concat();
    let paths = [&["mlt"], &chains[1..]].concat();
    let light = "cannot find light of points and single directions (lights[0] (Spot)) that comes to matt surfaces by way of \
                 smooth ones (glass)";
    for (technique, both) in [
        (&["pt"][..], false),
        (&["pt-reference"], false),
        (&chains, false),
        (&["bdpt"], true),
        (&over_bdpt, true),
        (&paths, true),
    ] {
        let of = |scene: &'static str| {
            let arguments = [&["render", scene, "--spp", "1", "--technique"], technique].concat();
            warnings(&arguments, folder.path()).0
        };
        let (ball, aside) = (of("ball.ron"), of("aside.ron"));
        assert!(
            ball.contains(light) && ball.contains("a small sphere that emits"),
            "{technique:?}: {ball}"
        );
        assert_eq!(aside.contains(light), !both, "{technique:?}: {aside}");
        if !both {
            assert!(
                aside.contains("bdpt, lt, mlt and pssmlt --base bdpt find it"),
                "{technique:?}: {aside}"
            );
        }
    }
}

#[test]
fn a_picture_with_light_is_told_nothing_of_it() {
    let folder = TempDir::new().expect("a folder");
    let cornell = cornell();
    for technique in ["pt", "pt-reference", "lt", "bdpt"] {
        let (told, listed) = warnings(
            &[
                "render",
                &cornell,
                "--size",
                "16x16",
                "--spp",
                "4",
                "--technique",
                technique,
            ],
            folder.path(),
        );
        assert!(told.is_empty() && listed.is_empty(), "{technique}: {told}");
    }
}

/// A square of mirror before the sky.
const SKY: &str = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
    film: (width: 8, height: 8), materials: {"silver": Conductor(metal: "Ag")},
    lights: [Environment(radiance: (1, 1, 1))],
    shapes: [(shape: Quad(corner: (-0.5, -0.5, 0), edge_u: (1, 0, 0), edge_v: (0, 1, 0)), material: "silver")])"#;

/// Of light tracing, before it renders; by the plan too, and not of what finds everything.
#[test]
fn what_light_tracing_cannot_see_is_told() {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("sky.ron"), SKY).expect("written");
    let shipped = |name: &str| scene(name).display().to_string();
    let outside = "lt cannot find light from outside the scene that the camera sees directly, in ";
    let smooth = "lt cannot find what the camera sees in or through smooth surfaces (";
    for (path, missed) in [
        (shipped("cornell-glass.ron"), &[smooth][..]),
        (shipped("cornell-near-index-one.ron"), &[smooth]),
        ("sky.ron".to_owned(), &[smooth, outside]),
    ] {
        let of = |technique: &str| {
            let arguments = [
                "render",
                &path,
                "--size",
                "16x16",
                "--spp",
                "1",
                "--technique",
                technique,
            ];
            warnings(&arguments, folder.path())
        };
        let (told, listed) = of("lt");
        for missed in missed {
            assert!(
                told.contains(missed) && told.contains("bdpt and pt find it"),
                "{path}: {told}"
            );
            assert!(listed.iter().any(|warning| warning.starts_with(missed)), "{listed:?}");
        }
        let (told, _) = of("bdpt");
        assert!(!told.contains("cannot find"), "{path}: {told}");
        let plan = succeed(&["plan", &path, "--technique", "lt"], folder.path());
        assert!(plan.contains("\nmissing: lt cannot find\n"), "{plan}");
        let plan = succeed(&["plan", &path, "--technique", "lt", "--json"], folder.path());
        let plan: Value = serde_json::from_str(&plan).expect("JSON");
        assert!(plan["missing"][0]["share"].as_f64() > Some(0.0), "{}", plan["missing"]);
        assert!(!succeed(&["plan", &path], folder.path()).contains("cannot find"));
    }
}
