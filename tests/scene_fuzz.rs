//! The scene reader against text that nobody meant: it returns, whatever it is given.

use super::broken_scenes::{JSON, RON};
use chainlight::scene::{Format, Geometry, SceneSource, Step, flatten, parse_scene};
use proptest::prelude::*;
use std::fs;
use std::path::Path;

const CASES: u32 = 400;

/// What the scene that others break has not: cameras with a lens, textures, round shapes and height fields.
const OTHER: &str = r#"(
    version: 1,
    camera: ThinLens(origin: (0, 1, 5), target: (0, 1, 0), fov: 40, aperture_radius: 0.1, focus_distance: 5),
    film: (width: 16, height: 16),
    textures: {"board": Checkerboard(even: (0.1, 0.2, 0.3), odd: (0.5, 0.5, 0.5), scale: (8, 4))},
    materials: {"white": Diffuse(reflectance: "board")},
    shapes: [
        (shape: Disk(center: (0, 3, 0), normal: (0, -1, 0), radius: 1), material: "white", emission: (1, 1, 1)),
        (shape: Cylinder(from: (0, 0, 0), to: (0, 2, 1), radius: 0.5), material: "white",
            transform: [Scale((2, 2, 2)), Rotate(axis: (0, 1, 0), degrees: 15), Translate((1, 2, 3))]),
        (shape: Torus(center: (0, 1, 0), axis: (1, 1, 0), major_radius: 2, minor_radius: 0.5, segments: (12, 6)), material: "white",
            transform: [Matrix(((1, 2, 0, 0), (0, 4, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))]),
        (shape: HeightField(heights: [[0, 1, 2], [1, 0, -3]], corner: (0, 0, 0), edge_u: (1, 0, 0), edge_v: (0, 0, -1), height: 2),
            material: "white"),
    ],
)"#;

fn config() -> ProptestConfig {
    // Fixed seeds: the same cases in every run.
    let rng_seed = proptest::test_runner::RngSeed::Fixed(0x5ce7e);
    ProptestConfig {
        cases: CASES,
        failure_persistence: None,
        rng_seed,
        ..ProptestConfig::default()
    }
}

/// Reads and flattens, checks what every flattened scene promises, and says what came of it.
fn exercise(text: &str, format: Format, base_dir: &Path) -> String {
    let source = match parse_scene("scene", text, format, base_dir) {
        Ok(source) => source,
        Err(error) => return error.plain(),
    };
    let flattened = match flatten(&source) {
        Ok(flattened) => flattened,
        Err(error) => return error.plain(),
    };
    for instance in &flattened.instances {
        let Geometry::Mesh(mesh) = &instance.geometry else {
            continue;
        };
        assert!(!mesh.triangles.is_empty());
        assert_eq!(mesh.materials.len(), mesh.triangles.len());
        assert!(mesh.normals.is_empty() || mesh.normals.len() == mesh.positions.len());
        assert!(mesh.uvs.is_empty() || mesh.uvs.len() == mesh.positions.len());
        assert!(
            mesh.materials
                .iter()
                .all(|material| (*material as usize) < flattened.materials.len())
        );
        for triangle in 0..mesh.triangles.len() {
            let area = mesh.area(triangle);
            let normal = mesh.geometric_normal(triangle);
            assert!(
                area > 0.0 && area.is_finite() && normal.is_normalized(),
                "{area} {normal}"
            );
            for vertex in mesh.triangles[triangle] {
                if let Some(shading) = mesh.normals.get(vertex as usize) {
                    assert!(
                        shading.is_normalized() && shading.dot(normal) > 0.0,
                        "{shading} {normal}"
                    );
                }
            }
        }
    }
    flattened.warnings.iter().map(|warning| warning.plain()).collect()
}

/// Cuts a scene into words, brackets and the rest.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut start = 0;
    let is_word = |c: char| c.is_alphanumeric() || "_.-+".contains(c);
    let mut last = None;
    for (at, character) in text.char_indices() {
        if last.is_some_and(|last| !is_word(last) || !is_word(character)) {
            tokens.push(&text[start..at]);
            start = at;
        }
        last = Some(character);
    }
    tokens.push(&text[start..]);
    tokens
}

/// What a number or a bracket may be replaced by.
const ODDITIES: [&str; 28] = [
    "nan",
    "NaN",
    "inf",
    "-inf",
    "1e39",
    "-1e39",
    "1e400",
    "-0",
    "0",
    "-1",
    "1e-45",
    "1e9",
    "1e-20",
    "180",
    "99999999999999999999999",
    "4294967296",
    "\"\"",
    "\"white\"",
    "()",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "\u{0}é",
];

/// A scene after some deletions, repetitions and replacements of its tokens.
fn mutated(text: &'static str) -> impl Strategy<Value = String> {
    let count = tokens(text).len();
    let edit = (0..count, 0..4_u8, 0..ODDITIES.len(), 0..count);
    proptest::collection::vec(edit, 1..6).prop_map(move |edits| {
        let mut words: Vec<String> = tokens(text).into_iter().map(str::to_owned).collect();
        for (at, action, oddity, other) in edits {
            match action {
                0 => words[at].clear(),
                1 => words[at] = words[at].repeat(2),
                2 => words[at] = ODDITIES[oddity].to_owned(),
                _ => words.swap(at, other),
            }
        }
        words.concat()
    })
}

/// A number of a scene replaced, so that most results pass the parser and reach the checks of values.
fn renumbered(text: &'static str) -> impl Strategy<Value = String> {
    let number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit() || c == '-');
    let places: Vec<usize> = tokens(text)
        .iter()
        .enumerate()
        .filter(|(_, word)| number(word))
        .map(|(at, _)| at)
        .collect();
    let edit = (proptest::sample::select(places), 0..15_usize);
    proptest::collection::vec(edit, 1..4).prop_map(move |edits| {
        let mut words = tokens(text);
        for (at, oddity) in edits {
            words[at] = ODDITIES[oddity];
        }
        words.concat()
    })
}

/// Lines that look like those of an OBJ or an MTL file.
fn wavefront(keywords: &'static [&'static str]) -> impl Strategy<Value = String> {
    let word = prop_oneof![
        6 => (-4..9_i32).prop_map(|index| index.to_string()),
        3 => "[0-9]{1,2}\\.[0-9]{1,2}",
        2 => "[1-4](/[1-4]?){1,3}",
        2 => "-?[0-9]{1,20}/-?[0-9]{1,20}/-?[0-9]{1,20}",
        2 => proptest::sample::select(&ODDITIES[..]).prop_map(str::to_owned),
        1 => proptest::sample::select(vec!["red", "blue", "mesh.mtl", "missing.mtl", "\\", "#", "spectral"])
            .prop_map(str::to_owned),
        1 => ".{0,4}",
    ];
    let line = (
        proptest::sample::select(keywords),
        proptest::collection::vec(word, 0..7),
    )
        .prop_map(|(keyword, words)| format!("{keyword} {}", words.join(" ")));
    proptest::collection::vec(line, 0..24).prop_map(|lines| lines.join("\n"))
}

/// A mesh that is right in most of its lines, so that most reach the triangles and their normals.
fn nearly_right_mesh() -> impl Strategy<Value = String> {
    let number =
        prop_oneof![8 => (-3..4_i32).prop_map(|n| n.to_string()), 1 => "-?[0-9]\\.[0-9]{1,7}", 1 => "-?[1-9]e-?[0-9]"];
    let vector = |keyword: &'static str, count: usize| {
        proptest::collection::vec(number.clone(), count)
            .prop_map(move |numbers| format!("{keyword} {}", numbers.join(" ")))
    };
    let corner = prop_oneof![
        "[1-3]",
        "-[1-3]",
        "[1-3]/[12]",
        "[1-3]//[12]",
        "[1-3]/[12]/[12]",
        "-[1-3]/-1/-1"
    ];
    let face = proptest::collection::vec(corner, 3..6).prop_map(|corners| format!("f {}", corners.join(" ")));
    let line = prop_oneof![
        4 => vector("v", 3),
        2 => vector("vn", 3),
        1 => vector("vt", 2),
        6 => face,
        1 => proptest::sample::select(vec!["usemtl red", "usemtl blue", "o thing", "# word", "l 1 2"]).prop_map(str::to_owned),
    ];
    proptest::collection::vec(line, 0..40).prop_map(|lines| {
        format!(
            "mtllib mesh.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 1\n{}\nf 1 2 3\n",
            lines.join("\n")
        )
    })
}

const OBJ: [&str; 14] = [
    "v",
    "v",
    "v",
    "vt",
    "vn",
    "f",
    "f",
    "f",
    "o",
    "g",
    "usemtl",
    "mtllib mesh.mtl\nusemtl red\n#",
    "l",
    "p",
];
const MTL: [&str; 14] = [
    "newmtl red\n#",
    "newmtl",
    "Kd",
    "Kd",
    "Ks",
    "Ke",
    "Ke",
    "Ka",
    "d",
    "Tr",
    "Ni",
    "illum",
    "map_Kd",
    "map_Bump",
];

proptest! {
    #![proptest_config(config())]

    #[test]
    fn any_text_is_read_or_refused(text in any::<String>(), json in any::<bool>()) {
        exercise(&text, if json { Format::Json } else { Format::Ron }, Path::new(""));
    }

    #[test]
    fn brackets_and_quotes_are_read_or_refused(text in "[(){}\\[\\]\"'r#,:/* \n\\\\a1!éx-]{0,60}", json in any::<bool>()) {
        exercise(&text, if json { Format::Json } else { Format::Ron }, Path::new(""));
    }

    #[test]
    fn a_mutated_scene_is_read_or_refused(ron in mutated(RON), json in mutated(JSON)) {
        exercise(&ron, Format::Ron, Path::new(""));
        exercise(&json, Format::Json, Path::new(""));
    }

    #[test]
    fn a_scene_with_odd_numbers_is_flattened_or_refused(ron in renumbered(RON), json in renumbered(JSON)) {
        exercise(&ron, Format::Ron, Path::new(""));
        exercise(&json, Format::Json, Path::new(""));
    }

    #[test]
    fn other_scenes_mutated_or_with_odd_numbers_are_flattened_or_refused(ron in mutated(OTHER), odd in renumbered(OTHER)) {
        exercise(&ron, Format::Ron, Path::new(""));
        exercise(&odd, Format::Ron, Path::new(""));
    }

    #[test]
    fn a_place_is_found_in_any_text(text in "[(){}\\[\\]\"r#,:/* \na1é]{0,60}", json in any::<bool>(), index in 0..4_usize) {
        let valid = parse_scene("scene", RON, Format::Ron, Path::new("")).expect("a valid scene");
        let format = if json { Format::Json } else { Format::Ron };
        let source = SceneSource { text: text.into(), format, ..valid };
        for steps in [
            &[Step::Key("a"), Step::Index(index), Step::Variant("a"), Step::Content, Step::Index(1)][..],
            &[Step::Index(index), Step::Name("a")],
            &[],
        ] {
            let (line, column) = source.error(steps, "wrong", "").line_and_column().expect("a place");
            prop_assert!(line >= 1 && line <= source.text.split('\n').count() && column >= 1);
        }
    }

    #[test]
    fn any_mesh_file_is_read_or_refused(obj in wavefront(&OBJ), mtl in wavefront(&MTL), own in any::<bool>()) {
        let folder = tempfile::tempdir().expect("a folder");
        let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib mesh.mtl\n";
        fs::write(folder.path().join("mesh.obj"), format!("{triangle}{obj}\nf 1 2 3\n")).expect("a mesh");
        fs::write(folder.path().join("mesh.mtl"), format!("newmtl red\n{mtl}")).expect("a library");
        let material = if own { "" } else { ", material: \"gold\"" };
        let mesh = format!("shape: Obj(file: \"mesh.obj\"){material}");
        let text = RON.replace("shape: Box(min: (1, 2, 3), max: (4, 5, 6)), material: \"gold\"", &mesh);
        let said = exercise(&text, Format::Ron, folder.path());
        prop_assert!(!said.contains("the OBJ reader stopped"), "not caught before: {said}");
    }

    #[test]
    fn a_nearly_right_mesh_is_placed_as_promised(
        obj in nearly_right_mesh(), scale in proptest::array::uniform3(-2.0_f32..2.0), own in any::<bool>(), smooth in any::<bool>()
    ) {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("mesh.obj"), obj).expect("a mesh");
        fs::write(folder.path().join("mesh.mtl"), "newmtl red\nKd 1 0 0\nnewmtl blue\nKe 0 0 1\n").expect("a library");
        let [x, y, z] = scale.map(|factor| if factor.abs() < 1.0e-3 { 1.0e-12 } else { factor });
        let material = if own { "" } else { ", material: \"gold\"" };
        let mesh = format!(
            "shape: Obj(file: \"mesh.obj\", smooth: {smooth}){material}, transform: [Scale(({x}, {y}, {z}))]"
        );
        let text = RON.replace("shape: Box(min: (1, 2, 3), max: (4, 5, 6)), material: \"gold\"", &mesh);
        let said = exercise(&text, Format::Ron, folder.path());
        prop_assert!(!said.contains("expected") && !said.contains("refers"), "refused: {said}");
    }

    #[test]
    fn any_bytes_as_a_mesh_are_read_or_refused(obj in proptest::collection::vec(any::<u8>(), 0..200)) {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("mesh.obj"), obj).expect("a mesh");
        let mesh = "shape: Obj(file: \"mesh.obj\")";
        let text = RON.replace("shape: Box(min: (1, 2, 3), max: (4, 5, 6)), material: \"gold\"", mesh);
        exercise(&text, Format::Ron, folder.path());
    }
}
