//! Options that would change nothing are refused, and those that are taken have an effect.

use super::{check_refusals, copy_meshes, cornell, fail, scene, succeed};
use chainlight::color::Rgb;
use chainlight::film::{ExrPicture, read_exr};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// Every command that takes a scene refuses the same options, for the same reasons.
#[test]
fn options_without_effect_are_refused_with_what_to_do() {
    let scene = cornell();
    let scene = scene.as_str();
    let cases: [(&[&str], &[&str]); 26] = [
        (
            &["render", scene, "--strategy", "1,2"],
            &["--strategy 1,2 has no effect with pt", "--technique bdpt"],
        ),
        (
            &["plan", scene, "--technique", "lt", "--strategy", "2,1"],
            &["no effect with lt", "lens alone (t = 1)"],
        ),
        (
            &["profile", scene, "--technique", "pssmlt", "--strategy", "1,2"],
            &["no effect with pssmlt", "--base bdpt"],
        ),
        (
            &["render", scene, "--base", "bdpt"],
            &["--base bdpt has no effect with pt", "--technique pssmlt"],
        ),
        (
            &["render", scene, "--technique", "bdpt", "--base", "pt"],
            &["--base pt has no effect with bdpt"],
        ),
        (
            &["render", scene, "--technique", "lt", "--heuristic", "balance"],
            &["--heuristic balance has no effect with lt", "one way to be found"],
        ),
        (
            &[
                "render",
                scene,
                "--technique",
                "bdpt",
                "--heuristic",
                "power",
                "--strategy",
                "1,2",
            ],
            &["--heuristic power has no effect with --strategy 1,2", "weight one"],
        ),
        (
            &["render", scene, "--groups", "8"],
            &["--groups 8 has no effect with pt", "it has no chains"],
        ),
        (
            &["plan", scene, "--technique", "bdpt", "--chains", "64"],
            &["--chains 64 has no effect with bdpt", "--technique pssmlt"],
        ),
        (
            &["render", scene, "--technique", "lt", "--bootstrap", "64"],
            &["--bootstrap 64 has no effect with lt"],
        ),
        (
            &["replay", scene, "--chain", "0", "--step", "0", "--groups", "2"],
            &["--groups 2 has no effect with pt"],
        ),
        (
            &["render", scene, "--mutation", "small_step:weight=0.5"],
            &["--mutation small_step:weight=0.5 has no effect with pt"],
        ),
        (
            &["render", scene, "--technique", "bdpt", "--strategy", "12,6"],
            &[
                "its paths have S + T - 1 = 17 edges, and max_depth is 16",
                "at most 17",
                "--max-depth to 17",
            ],
        ),
        (
            &[
                "render",
                scene,
                "--technique",
                "bdpt",
                "--max-depth",
                "2",
                "--strategy",
                "4294967295,4294967295",
            ],
            &["8589934589 edges, and no path has more than 1024", "at most 3"],
        ),
        (
            &["render", scene, "--technique", "bdpt", "--strategy", "4294967295,1"],
            &["4294967295 edges, and no path has more than 1024", "at most 17"],
        ),
        (
            &["render", scene, "--technique", "bdpt", "--strategy", "2,0"],
            &["T is 1 or more"],
        ),
        (
            &["render", scene, "--technique", "bdpt", "--strategy", "0,1"],
            &["S + T is 2 or more"],
        ),
        (
            &["render", scene, "--technique", "pssmlt-reference", "--base", "bdpt"],
            &["pssmlt-reference runs over pt alone"],
        ),
        (
            &["render", scene, "--direct", "16"],
            &["--direct 16 has no effect with pt", "no chains", "--technique mlt"],
        ),
        (
            &["plan", scene, "--technique", "pssmlt", "--direct", "chains"],
            &["--direct chains has no effect with pssmlt", "paths of any length"],
        ),
        (
            &[
                "render",
                scene,
                "--technique",
                "mlt",
                "--max-depth",
                "2",
                "--direct",
                "8",
            ],
            &[
                "--direct 8 has no effect with paths of at most 2 edges",
                "nothing to chains",
            ],
        ),
        (
            &["render", scene, "--technique", "mlt", "--direct", "0"],
            &["samples per pixel from 2 to", "`chains`"],
        ),
        (
            &[
                "render",
                scene,
                "--technique",
                "mlt",
                "--direct",
                "chains",
                "--heuristic",
                "balance",
            ],
            &["--heuristic balance has no effect with mlt whose chains look for direct light too"],
        ),
        (
            &["profile", scene, "--technique", "mlt", "--base", "bdpt"],
            &["--base bdpt has no effect with mlt", "walk paths"],
        ),
        (
            &["render", scene, "--technique", "mlt", "--strategy", "1,2"],
            &["--strategy 1,2 has no effect with mlt"],
        ),
        (
            &[
                "render",
                scene,
                "--technique",
                "mlt",
                "--mutation",
                "small_step:weight=0.5",
            ],
            &["--mutation small_step:weight=0.5 has no effect with mlt"],
        ),
    ];
    check_refusals(&cases);
}

/// A scene may name the technique too.
#[test]
fn options_without_effect_on_the_scenes_own_technique_are_refused() {
    let own = scene("door-ajar.ron").display().to_string();
    let error = fail(&["render", &own, "--strategy", "1,2"]);
    assert!(error.contains("--strategy 1,2 has no effect with pssmlt"), "{error}");
}

#[test]
fn fewer_samples_than_a_saved_render_has_are_refused() {
    let folder = TempDir::new().expect("a folder");
    let scene = cornell();
    let start = ["render", &scene, "--size", "8x8", "--spp", "6", "--save", "saved"];
    succeed(&start, folder.path());
    let saved = folder.path().join("saved").display().to_string();
    let error = fail(&["render", &scene, "--size", "8x8", "--spp", "5", "--resume", &saved]);
    assert!(
        error.contains("--spp 5 has no effect") && error.contains("has taken 6"),
        "{error}"
    );
    succeed(
        &["render", &scene, "--size", "8x8", "--spp", "6", "--resume", &saved],
        folder.path(),
    );
    let error = fail(&[
        "render",
        &scene,
        "--size",
        "8x8",
        "--heuristic",
        "balance",
        "--resume",
        &saved,
    ]);
    assert!(
        error.contains("--heuristic is power there, and balance here"),
        "{error}"
    );
}

/// In the command line's own words.
#[test]
fn a_saved_render_goes_on_with_its_own_strategies_alone() {
    let folder = TempDir::new().expect("a folder");
    let scene = cornell();
    let of = |more: &[&str]| {
        let render = ["render", &scene, "--size", "8x8", "--spp", "2"];
        let all = [&render[..], more].concat();
        all.into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    let saved = folder.path().join("saved").display().to_string();
    let chains = [
        "--technique",
        "pssmlt",
        "--groups",
        "2",
        "--chains",
        "8",
        "--bootstrap",
        "64",
    ];
    let over_bdpt = [&chains[..], &["--base", "bdpt"]].concat();
    let bdpt = ["--technique", "bdpt"];
    let alone = ["--technique", "bdpt", "--strategy", "1,2"];
    for (first, then, told) in [
        (&chains[..], &over_bdpt[..], "--base is pt there, and bdpt here"),
        (&over_bdpt, &chains, "--base is bdpt there, and pt here"),
        (&bdpt, &alone, "--strategy is left out there, and 1,2 here"),
        (&alone, &bdpt, "--strategy is 1,2 there, and left out here"),
    ] {
        let first = of(&[first, &["--save", &saved]].concat());
        succeed(&first.iter().map(String::as_str).collect::<Vec<_>>(), folder.path());
        let then = of(&[then, &["--resume", &saved]].concat());
        let error = fail(&then.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(error.contains(told), "{told}: {error}");
    }
}

fn picture(more: &[&str], folder: &Path) -> ExrPicture {
    let glossy = scene("cornell-glossy.ron").display().to_string();
    let render = ["render", &glossy, "--size", "24x16", "--spp", "1024", "-o", "a.exr"];
    succeed(&[&render[..], more].concat(), folder);
    read_exr(&folder.join("a.exr")).expect("a picture")
}

/// The sum of all pixels and channels, and its standard error.
fn total(picture: &ExrPicture) -> [f64; 2] {
    let channels = |pixels: &[Rgb], power: i32| -> f64 {
        let channels = pixels.iter().flat_map(|rgb| rgb.to_array());
        channels
            .map(|c| {
                if power == 1 {
                    f64::from(c)
                } else {
                    f64::from(c) * f64::from(c)
                }
            })
            .sum()
    };
    let errors = picture.error.as_deref().expect("an error layer");
    // Channels of a pixel share their paths, which is all that they can share: at most, their errors add up.
    [channels(&picture.rgb, 1), (3.0 * channels(errors, 2)).sqrt()]
}

/// Pictures by both are of the same light, differ, and are the same bits staged and depth first.
#[test]
fn path_tracing_weighs_by_the_heuristic_that_is_asked_for() {
    let folder = TempDir::new().expect("a folder");
    let power = picture(&["--heuristic", "power"], folder.path());
    let default = picture(&[], folder.path());
    let balance = picture(&["--heuristic", "balance"], folder.path());
    let reference = picture(
        &["--heuristic", "balance", "--technique", "pt-reference"],
        folder.path(),
    );
    assert_eq!(power.rgb, default.rgb);
    assert_ne!(power.rgb, balance.rgb);
    assert_eq!(balance.rgb, reference.rgb);
    // The same light: within four standard errors (a right one fails with p = 6e-5), which 5 % of it are beyond.
    let ([a, error_a], [b, error_b]) = (total(&power), total(&balance));
    let error = (error_a * error_a + error_b * error_b).sqrt();
    assert!(
        (a - b).abs() < 4.0 * error && 4.0 * error < 0.05 * a,
        "{a} and {b} ± {error}"
    );
    assert!(balance.metadata["settings"].ends_with("heuristic=balance"));
    assert_eq!(power.metadata, default.metadata);
}

/// The PNG alone.
#[test]
fn exposure_scales_the_png_and_nothing_else() {
    let folder = TempDir::new().expect("a folder");
    let text = std::fs::read_to_string(scene("cornell-box.ron")).expect("a shipped scene");
    let bright = text.replacen("film: (", "film: (exposure: 2, ", 1);
    assert_ne!(bright, text);
    copy_meshes(folder.path());
    std::fs::write(folder.path().join("bright.ron"), bright).expect("written");
    std::fs::write(folder.path().join("plain.ron"), text).expect("written");
    let render = |scene: &str, more: &[&str]| {
        let arguments = [
            "render", scene, "--size", "24x24", "--spp", "4", "--json", "-o", "a.exr",
        ];
        let report: Value =
            serde_json::from_str(&succeed(&[&arguments[..], more].concat(), folder.path())).expect("JSON");
        let png = image::open(folder.path().join("a.png")).expect("a PNG").into_rgb8();
        let sum: u64 = png.as_raw().iter().map(|&code| u64::from(code)).sum();
        let light = read_exr(&folder.path().join("a.exr")).expect("a picture").rgb;
        (report["png_exposure"].as_f64().expect("stops"), sum, light)
    };
    let (automatic, plain, light) = render("plain.ron", &[]);
    for (scene, more, stops) in [
        ("bright.ron", &[][..], 2.0),
        ("plain.ron", &["--exposure", "2"], 2.0),
        ("plain.ron", &["--exposure", "-1.5"], -1.5),
        ("bright.ron", &["--exposure", "0"], 0.0),
    ] {
        let (exposure, sum, same_light) = render(scene, more);
        assert!(
            (exposure - automatic - stops).abs() < 1e-5,
            "{scene} {more:?}: {exposure}"
        );
        assert_eq!(sum.cmp(&plain), stops.total_cmp(&0.0), "{scene} {more:?}");
        assert!(same_light == light, "{scene} {more:?}");
    }
    for bad in ["33", "-32.1", "nan", "inf", "bright"] {
        let error = fail(&["render", &cornell(), "--exposure", bad]);
        assert!(error.contains("expected stops from -32 to 32"), "{error}");
    }
}
