//! Studies: runs as data, continued, compared with references that fit.

use super::{chainlight, cornell, fail, run, scene, succeed};
use chainlight::study::{Snapshot, Study, StudyError};
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A small study in `folder`, with these arguments more.
fn arguments<'a>(scene: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let mut all = vec![
        "study",
        scene,
        "--size",
        "16x16",
        "--time",
        "0.5",
        "-o",
        "study",
        "--threads",
        "2",
    ];
    all.extend_from_slice(more);
    all
}

fn read(folder: &Path) -> Study {
    let read = Study::read(&folder.join("study/study.json")).expect("a study");
    read.expect("it is there")
}

#[test]
fn a_study_has_runs_of_every_way_and_goes_on_where_it_ended() {
    let folder = TempDir::new().expect("a folder");
    let cornell = cornell();
    let way = "chains=--technique mlt --groups 4 --chains 64 --bootstrap 256";
    let with = |runs, last| {
        let more = [
            "--techniques",
            "pt,bdpt",
            "--way",
            way,
            "--make-reference=2",
            "--runs",
            runs,
            last,
        ];
        succeed(&arguments(&cornell, &more), folder.path())
    };
    let text = with("2", "--seed=1");
    for expected in [
        "cornell-box, 16 x 16 pixels",
        "\npt ",
        "\nbdpt ",
        "\nchains ",
        "efficiency",
        "squared bias",
    ] {
        assert!(text.contains(expected), "{text}");
    }
    let first = read(folder.path());
    let ways = &first.scenes[0].ways;
    assert_eq!(ways.iter().map(|way| way.runs.len()).collect::<Vec<_>>(), [2, 2, 2]);
    for way in ways {
        for run in &way.runs {
            let looks = &run.snapshots;
            let ordered = |w: &[Snapshot]| w[0].seconds <= w[1].seconds && w[0].steps <= w[1].steps;
            assert!(looks.windows(2).all(ordered), "{looks:?}");
            let last = looks.last().expect("looks");
            assert!(last.due == 0.5 && last.seconds >= 0.5, "{last:?}");
            // How many there are depends on the machine; chains may find a bright spot late.
            let longer = looks
                .iter()
                .find(|look| 8 * look.steps < last.steps && way.name != "chains");
            assert!(
                longer.is_none_or(|first| last.errors.rel_mse < first.errors.rel_mse),
                "{}",
                way.name
            );
            assert!(last.errors.flip > 0.0 && last.per_pixel > 0.0);
            assert!(last.errors.rel_mse_trimmed <= last.errors.rel_mse && last.errors.smape > 0.0);
            assert!(run.start_seconds < looks[0].seconds);
            let traced = run.stages.iter().find(|stage| stage.stage == "trace");
            assert!(traced.is_some_and(|stage| stage.seconds > 0.0), "{:?}", run.stages);
        }
        // The second has the pictures of the first to be held against.
        assert!(way.runs[0].snapshots.iter().all(|look| look.shared.is_none()));
        assert!(way.runs[1].snapshots.last().is_some_and(|look| look.shared.is_some()));
    }
    for plot in ["relmse", "relmse-samples", "flip", "spectrum"] {
        let svg = std::fs::read_to_string(folder.path().join(format!("study/cornell-box-{plot}.svg"))).expect(plot);
        assert!(
            svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && svg.contains("chains"),
            "{plot}"
        );
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{plot}: {svg}");
    }
    let page = std::fs::read_to_string(folder.path().join("study/report.html")).expect("a page");
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    // Three ways, the reference and three maps; five plots; and nothing that is somewhere else.
    assert_eq!(page.matches("class=\"layer").count(), 7);
    assert_eq!(page.matches("class=\"plot\"").count(), 5);
    assert!(!page.contains("http://") && !page.contains("https://"));
    let own = first.scenes[0].reference.own_rel_mse.expect("known");
    assert!(own > 0.0 && own < ways[0].runs[0].snapshots[0].errors.rel_mse);
    assert!(!page.contains("What every effect costs"));
    with("3", "--layers");
    let page = std::fs::read_to_string(folder.path().join("study/report.html")).expect("a page");
    assert!(page.contains("What every effect costs") && page.contains("C[DG]L"));
    let second = read(folder.path());
    for (before, after) in ways.iter().zip(&second.scenes[0].ways) {
        assert_eq!(after.runs.len(), 3);
        assert_eq!(before.runs, after.runs[..2]);
        let layers = &after.layers.as_ref().expect("one run more").layers;
        let names: Vec<&str> = layers.iter().map(|layer| layer.name.as_str()).collect();
        assert_eq!(names, ["emitted", "direct", "diffuse", "other"]);
        let shares: f64 = layers.iter().map(|layer| layer.light_share).sum();
        assert!((shares - 1.0).abs() < 1e-5, "{layers:?}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_keeps_its_runs() {
    let folder = TempDir::new().expect("a folder");
    let cornell = cornell();
    let more = ["--techniques", "pt", "--make-reference=0.5", "--runs", "400"];
    let mut child = chainlight(&arguments(&cornell, &more), folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let runs = || {
        let study = Study::read(&folder.path().join("study/study.json")).expect("never half-written");
        study.map_or(0, |study| study.scenes[0].ways[0].runs.len())
    };
    let limit = Instant::now() + Duration::from_secs(60);
    while runs() < 2 && Instant::now() < limit {
        std::thread::sleep(Duration::from_millis(50));
    }
    super::interrupt(&child);
    let status = child.wait().expect("an exit status");
    assert_eq!(status.code(), Some(130));
    let kept = runs();
    assert!((2..400).contains(&kept), "{kept}");
    let more = [
        "--techniques",
        "pt",
        "--make-reference=0.5",
        "--runs",
        &(kept + 1).to_string(),
    ];
    succeed(&arguments(&cornell, &more), folder.path());
    assert_eq!(runs(), kept + 1);
}

#[test]
fn what_does_not_fit_is_refused_in_words() {
    let cornell = cornell();
    let glass = scene("cornell-glass.ron").display().to_string();
    let reference = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/references/cornell-box.exr");
    let reference = reference.display().to_string();
    for (more, expected) in [
        (vec!["--reference", "nowhere.exr"], "cannot read nowhere.exr"),
        (vec!["--reference", &reference], "and the picture has 16 x 16"),
        (
            vec![&glass, "--reference", &reference],
            "--reference is of one scene, and there are 2",
        ),
        (vec!["--make-reference", "--techniques", "pt,best"], "best"),
        (
            vec!["--make-reference", "--way", "pt=--technique bdpt"],
            "two ways named pt",
        ),
        (vec!["--make-reference", "--way", "none"], "expected NAME=OPTIONS"),
        (vec!["--make-reference", "--way", "odd=--bad"], "--bad"),
        (vec!["--make-reference", "--runs", "1"], "2..=10000"),
        (vec![], "--reference"),
    ] {
        let error = fail(&arguments(&cornell, &more));
        assert!(error.contains(expected), "{more:?}: {error}");
    }
}

#[test]
fn another_study_is_not_continued() {
    let folder = TempDir::new().expect("a folder");
    let cornell = cornell();
    let with = |more: &[&str]| {
        let all = [&["--techniques", "pt", "--make-reference=0.3", "--runs", "2"], more].concat();
        run(&arguments(&cornell, &all), folder.path())
    };
    assert!(with(&[]).status.success());
    for (more, what) in [
        (["--seed", "7"], "--seed"),
        (["--way", "b=--technique bdpt"], "choice of ways"),
    ] {
        let output = with(&more);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && error.contains(what), "{error}");
    }
    // A file from which a way is gone.
    let path = folder.path().join("study/study.json");
    let whole = std::fs::read(&path).expect("a study");
    let mut edited = read(folder.path());
    edited.scenes[0].ways.clear();
    edited.write(&path).expect("written");
    let error = String::from_utf8_lossy(&with(&[]).stderr).into_owned();
    assert!(error.contains("number of ways in cornell-box: 0"), "{error}");
    std::fs::write(&path, whole).expect("written");
    // A reference that is no longer the same.
    let reference = folder.path().join("study/cornell-box-reference.exr");
    let again = [
        "render",
        &cornell,
        "--size",
        "16x16",
        "--spp",
        "8",
        "-o",
        "study/cornell-box-reference.exr",
    ];
    succeed(&again, folder.path());
    let error = String::from_utf8_lossy(&with(&[]).stderr).into_owned();
    assert!(
        reference.exists() && error.contains("reference of cornell-box"),
        "{error}"
    );
    std::fs::write(&path, "{}").expect("written");
    assert!(matches!(Study::read(&path), Err(StudyError::Format { .. })));
    let error = String::from_utf8_lossy(&with(&[]).stderr).into_owned();
    assert!(error.contains("not a study"), "{error}");
}
