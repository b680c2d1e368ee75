//! What accuracy will cost, and the technique that promises most.

use super::{chainlight, check_refusals, cornell, fail, run, scene, succeed};
use chainlight::film::read_exr;
use serde_json::Value;
use tempfile::TempDir;

/// Two ways are tried, one of them with options of its own.
#[test]
fn costs_are_told_with_their_intervals_and_a_choice() {
    let folder = TempDir::new().expect("a folder");
    let cornell = cornell();
    let way = "chains=--technique mlt --groups 4 --chains 64 --bootstrap 256";
    let common = [
        "cost",
        &cornell,
        "--size",
        "16x16",
        "--pilot",
        "0.3",
        "--techniques",
        "pt,bdpt",
        "--way",
        way,
        "--threads",
        "2",
    ];
    let text = succeed(&common, folder.path());
    for expected in [
        "cornell-box.ron, 16 x 16 pixels",
        "start-up",
        "\npt ",
        "\nbdpt ",
        "\nchains ",
        "relMSE without the worst 0.1 %",
        "--target-error",
        " to ",
    ] {
        assert!(text.contains(expected), "{expected}: {text}");
    }
    let more = ["--errors", "0.01,0.2", "--target-error", "0.05", "--json"];
    let json: Value = serde_json::from_str(&succeed(&[&common[..], &more].concat(), folder.path())).expect("JSON");
    let names: Vec<&str> = ["pt", "bdpt", "chains"].into();
    let choice = json["choice"].as_str().expect("a choice");
    assert!(names.contains(&choice) && json["why"].as_str().expect("why").starts_with(choice));
    assert!(json["goal"].as_str().expect("a goal").contains("--target-error 0.05"));
    let ways = json["ways"].as_array().expect("ways");
    assert_eq!(
        ways.iter()
            .map(|way| way["name"].as_str().expect("a name"))
            .collect::<Vec<_>>(),
        names
    );
    let number = |value: &Value| value.as_f64().expect("a number");
    for way in ways {
        let start = number(&way["start_seconds"]);
        for (measure, errors) in way["predicted"].as_array().expect("measures").iter().zip([2, 2, 3]) {
            let times = measure["times"].as_array().expect("times");
            assert_eq!(times.len(), errors, "{measure}");
            for time in times {
                let seconds = &time["seconds"];
                let [low, value, high] = [&seconds["bounds"][0], &seconds["value"], &seconds["bounds"][1]].map(number);
                assert!(start <= low && low < value && value < high, "{time}");
            }
            // The smaller the error, the longer it takes; errors are sorted.
            assert!(
                number(&times[0]["seconds"]["value"]) < number(&times[1]["seconds"]["value"]),
                "{times:?}"
            );
            let looks = measure["looks"].as_array().expect("looks");
            assert!(!looks.is_empty() && looks.len() <= 4);
        }
    }
    assert_eq!(
        folder.path().read_dir().expect("the folder").count(),
        0,
        "nothing is written"
    );
}

/// A spot's light through glass: path tracing alone cannot find what it draws on the floor.
#[test]
fn a_technique_that_misses_light_is_not_chosen_and_that_is_said() {
    let folder = TempDir::new().expect("a folder");
    let text = r#"(version: 1, settings: (max_depth: 6), camera: Perspective(origin: (0, 3, 6), target: (0, 0, 0), fov: 40),
        film: (width: 16, height: 16),
        materials: { "m": Diffuse(reflectance: (0.5, 0.5, 0.5)), "glass": Dielectric(interior_ior: 1.5) },
        lights: [Point(position: (0, 5, 0), intensity: (10, 10, 10))],
        shapes: [(shape: Quad(corner: (-5, 0, 5), edge_u: (10, 0, 0), edge_v: (0, 0, -10)), material: "m"),
                 (shape: Sphere(center: (0, 1, 0), radius: 0.7), material: "glass")])"#;
    std::fs::write(folder.path().join("spot.ron"), text).expect("written");
    let text = succeed(
        &[
            "cost",
            "spot.ron",
            "--pilot",
            "0.2",
            "--techniques",
            "pt,bdpt",
            "--threads",
            "2",
        ],
        folder.path(),
    );
    assert!(text.contains("pt cannot find light of points"), "{text}");
    assert!(text.contains("bdpt, by the time to 0.01"), "{text}");
    assert!(text.contains("pt left out"), "{text}");
}

#[test]
fn auto_takes_a_technique_says_why_and_renders_what_that_renders() {
    let folder = TempDir::new().expect("a folder");
    let cornell = cornell();
    let common = ["render", &cornell, "--size", "16x16", "--threads", "2", "--json"];
    let asked = ["--technique", "auto", "--time", "2", "-o", "auto.exr"];
    let output = run(&[&common[..], &asked].concat(), folder.path());
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(output.status.success(), "{said}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let technique = report["technique"].as_str().expect("a technique");
    assert!(said.contains(&format!("auto takes {technique}, by relMSE")), "{said}");
    assert!(report["auto"]["why"].as_str().expect("why").starts_with(technique));
    // Pilots count in the time: what is left is less by what they took.
    let [pilots, seconds] =
        [&report["auto"]["pilot_seconds"], &report["render_seconds"]].map(|value| value.as_f64().expect("seconds"));
    assert!(pilots > 0.0 && pilots < 1.5, "{report}");
    assert!(pilots + seconds > 1.9 && seconds < 3.0 - pilots, "{report}");
    let spp = report["samples_per_pixel"].as_f64().expect("samples").to_string();
    let again = ["--technique", technique, "--spp", &spp, "-o", "again.exr"];
    let plain = succeed(&[&common[..], &again].concat(), folder.path());
    assert!(!plain.contains("\"auto\""));
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).expect("a picture");
    assert!(bytes("auto.exr") == bytes("again.exr"));
    let picture = read_exr(&folder.path().join("auto.exr")).expect("a picture");
    assert_eq!(picture.metadata["technique"], technique);
}

#[test]
fn what_makes_no_sense_is_refused_in_words() {
    let cornell = cornell();
    let cornell = cornell.as_str();
    let cases: [(&[&str], &[&str]); 8] = [
        (
            &["plan", cornell, "--technique", "auto"],
            &["--technique auto is for `render` alone", "chainlight cost"],
        ),
        (
            &["replay", cornell, "--chain", "0", "--step", "0", "--technique", "auto"],
            &["--technique auto is for `render` alone"],
        ),
        (
            &["render", cornell, "--technique", "auto", "--groups", "4"],
            &["--groups 4 cannot go with --technique auto", "--way NAME=OPTIONS"],
        ),
        (
            &[
                "study",
                cornell,
                "--techniques",
                "pt,auto",
                "--make-reference",
                "-o",
                "s",
            ],
            &["`auto` is a choice among techniques"],
        ),
        (
            &["cost", cornell, "--techniques", "best"],
            &["there is no technique `best`"],
        ),
        (
            &["cost", cornell, "--errors", "0.1,2"],
            &["expected a relative error above 0 and below 1"],
        ),
        (
            &["cost", cornell, "--way", "pt=--technique bdpt"],
            &["two ways named pt"],
        ),
        (&["cost", "nowhere.ron"], &["nowhere.ron"]),
    ];
    check_refusals(&cases);
    let folder = TempDir::new().expect("a folder");
    let saved = folder.path().join("saved.bin");
    std::fs::write(&saved, "x").expect("written");
    let resumed = saved.display().to_string();
    let error = fail(&["render", cornell, "--technique", "auto", "--resume", &resumed]);
    assert!(error.contains("--technique auto cannot go with --resume"), "{error}");
}

/// Where nothing emits there is nothing to tell; that is no error.
#[test]
fn of_a_scene_without_light_nothing_is_told() {
    let folder = TempDir::new().expect("a folder");
    let text = r#"(version: 1, camera: Perspective(origin: (0, 0, 5), target: (0, 0, 0), fov: 40),
        film: (width: 8, height: 8), materials: { "m": Diffuse(reflectance: (0.5, 0.5, 0.5)) },
        shapes: [(shape: Sphere(center: (0, 0, 0), radius: 1), material: "m")])"#;
    std::fs::write(folder.path().join("dark.ron"), text).expect("written");
    let text = succeed(
        &["cost", "dark.ron", "--pilot", "0.1", "--techniques", "pt,bdpt"],
        folder.path(),
    );
    assert!(
        text.contains("no telling which is best") && text.contains("no telling"),
        "{text}"
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_pilot_ends_at_once() {
    let folder = TempDir::new().expect("a folder");
    let glass = scene("cornell-glass.ron").display().to_string();
    let mut child = chainlight(&["cost", &glass, "--size", "16x16", "--pilot", "60"], folder.path())
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(std::time::Duration::from_millis(1500));
    super::interrupt(&child);
    let began = std::time::Instant::now();
    assert_eq!(child.wait().expect("an exit status").code(), Some(130));
    assert!(began.elapsed() < std::time::Duration::from_secs(10));
}
