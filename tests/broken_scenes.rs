//! Scenes with one mistake each, and the exact words that a user reads about it: file, line, column, what was
//! expected, and the nearest valid name.

use chainlight::scene::{Format, SceneError, flatten, parse_scene, read_scene};
use std::fs;
use std::path::Path;

/// A valid scene, for cases to break.
pub const RON: &str = r#"(
    version: 1, // the format's
    settings: (max_depth: 16, technique: "pt"),
    camera: Perspective(origin: (278, 273, -800), target: (278, 273, 0), fov: 39.3, fov_axis: Horizontal),
    film: (width: 512, height: 512, filter: Gaussian(radius: 1.5, sigma: 0.5)),
    materials: {
        "white": Diffuse(reflectance: (0.7, 0.7, 0.7)),
        "gold": Conductor(eta: (0.14, 0.38, 1.44), k: (3.98, 2.39, 1.6)),
        "glass": Dielectric(interior_ior: 1.5),
    },
    shapes: [
        (
            name: "floor",
            shape: Quad(corner: (0, 0, 0), edge_u: (560, 0, 0), edge_v: (0, 0, -560)),
            material: "white",
        ),
        (name: "block", shape: Box(min: (1, 2, 3), max: (4, 5, 6)), material: "gold"),
        (
            shape: Sphere(center: (0, 1, 0), radius: 2),
            material: "glass",
            emission: (17, 12, 4),
            transform: [Scale((2, 2, 2)), Rotate(axis: (0, 1, 0), degrees: 15), Translate((1, 2, 3))],
        ),
    ],
)
"#;

/// The same in JSON, as far as the cases need it.
pub const JSON: &str = r#"{
  "version": 1,
  "camera": {"Perspective": {"origin": [0, 1, 5], "target": [0, 1, 0], "fov": 40}},
  "film": {"width": 64, "height": 64, "filter": {"Tent": {"radius": 1}}},
  "materials": {
    "white": {"Diffuse": {"reflectance": [0.7, 0.7, 0.7]}}
  },
  "shapes": [
    {"shape": {"Quad": {"corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0]}}, "material": "white"},
    {"name": "lamp", "shape": {"Sphere": {"radius": 1}}, "material": "white", "emission": [1, 1, 1],
     "transform": [{"Scale": [2, 2, 2]}, {"Rotate": {"axis": [0, 1, 0], "degrees": 15}}]}
  ]
}
"#;

fn findings(name: &str, text: &str, format: Format, base_dir: &Path) -> String {
    let run = || -> Result<Vec<String>, SceneError> {
        let source = parse_scene(name, text, format, base_dir)?;
        Ok(flatten(&source)?
            .warnings
            .iter()
            .map(|warning| format!("warning: {}", warning.plain()))
            .collect())
    };
    match run() {
        Err(error) => format!("error: {}", error.plain()),
        Ok(warnings) if warnings.is_empty() => "accepted".to_owned(),
        Ok(warnings) => warnings.join("\n"),
    }
}

/// What is said of `valid` after each replacement of (what is wrong, what stood there, what stands there now).
fn broken(name: &str, valid: &str, format: Format, cases: &[(&str, &str, &str)]) -> String {
    assert_eq!(findings(name, valid, format, Path::new("")), "accepted");
    let mut report = String::new();
    for (what, from, to) in cases {
        assert!(valid.contains(from), "{from:?} does not stand in the scene");
        let text = valid.replacen(from, to, 1);
        report.push_str(&format!(
            "{what}\n  {}\n",
            findings(name, &text, format, Path::new("")).replace('\n', "\n  ")
        ));
    }
    report
}

fn broken_ron(cases: &[(&str, &str, &str)]) -> String {
    broken("scene.ron", RON, Format::Ron, cases)
}

#[test]
fn mistakes_of_ron_syntax() {
    let report = broken_ron(&[
        ("a field misspelt", "fov: 39.3", "fow: 39.3"),
        ("a field of the scene misspelt", "settings:", "setings:"),
        ("a field of a material misspelt", "reflectance", "colour"),
        (
            "a field of a shape misspelt",
            "material: \"gold\"",
            "materiel: \"gold\"",
        ),
        ("a kind of shape misspelt", "Sphere(", "Shpere("),
        ("a material model misspelt", "Conductor(", "Metal("),
        ("a camera misspelt", "Perspective(", "perspective("),
        ("an axis misspelt", "Horizontal", "horizontl"),
        ("a transform misspelt", "Translate(", "Move("),
        ("a required field left out", "version: 1,", ""),
        ("a required field of a variant left out", "fov: 39.3,", ""),
        ("a field twice", "fov: 39.3", "fov: 39.3, fov: 40"),
        ("a material twice", "\"gold\":", "\"white\":"),
        ("two numbers for three", "(278, 273, 0)", "(278, 273)"),
        ("four numbers for three", "(278, 273, 0)", "(278, 273, 0, 1)"),
        ("one number for three", "(17, 12, 4)", "17"),
        ("square brackets around numbers", "(17, 12, 4)", "[17, 12, 4]"),
        ("a bracket left out", "Translate((1, 2, 3))", "Translate(1, 2, 3)"),
        (
            "a variant without brackets",
            "Gaussian(radius: 1.5, sigma: 0.5)",
            "Tent",
        ),
        ("a word for a number", "fov: 39.3", "fov: wide"),
        ("a fraction for a whole number", "width: 512", "width: 51.2"),
        ("a negative whole number", "width: 512", "width: -512"),
        ("a whole number too large", "width: 512", "width: 99999999999"),
        ("a name without quotes", "material: \"gold\"", "material: gold"),
        ("a comma left out", "fov: 39.3, ", "fov: 39.3 "),
        ("a colon left out", "fov: 39.3", "fov 39.3"),
        ("a list not closed", "    ],\n)", ")"),
        ("the end left out", "    ],\n)\n", ""),
        ("a string not closed", "\"pt\"", "\"pt"),
        ("a comment not closed", "// the format's", "/* the format's"),
        ("a bracket too many", ")\n", ")\n)\n"),
        (
            "a name before the outermost bracket",
            "(\n    version",
            "Scene(\n    version",
        ),
        ("brackets without end", "(278, 273, 0)", &"(".repeat(100_000)),
        ("another version", "version: 1,", "version: 2,"),
    ]);
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_json_syntax() {
    let report = broken(
        "scene.json",
        JSON,
        Format::Json,
        &[
            ("a field misspelt", "\"fov\"", "\"fow\""),
            ("a kind of shape misspelt", "\"Sphere\"", "\"Shpere\""),
            ("a required field left out", "\"version\": 1,", ""),
            ("a required field of a variant left out", ", \"fov\": 40", ""),
            ("a field twice", "\"fov\": 40", "\"fov\": 40, \"fov\": 40"),
            (
                "a material twice",
                "\"white\": {",
                "\"white\": {\"Diffuse\": {\"reflectance\": [1, 1, 1]}}, \"white\": {",
            ),
            ("two numbers for three", "[0, 1, 5]", "[0, 1]"),
            ("four numbers for three", "[0, 1, 5]", "[0, 1, 5, 6]"),
            ("a string for a number", "\"fov\": 40", "\"fov\": \"40\""),
            ("a fraction for a whole number", "\"width\": 64", "\"width\": 6.4"),
            ("a number too large for any", "\"fov\": 40", "\"fov\": 1e400"),
            ("not a number", "\"fov\": 40", "\"fov\": NaN"),
            ("a comma left out", "\"version\": 1,", "\"version\": 1"),
            ("the end left out", "  ]\n}\n", ""),
            ("a comment", "\"version\": 1,", "\"version\": 1, // the format's"),
            (
                "an unknown material",
                "\"material\": \"white\"",
                "\"material\": \"withe\"",
            ),
            ("a value out of its range", "\"fov\": 40", "\"fov\": 240"),
            (
                "a value out of its range in a variant",
                "\"Scale\": [2, 2, 2]",
                "\"Scale\": [2, 0, 2]",
            ),
            (
                "a value out of its range in a map",
                "[0.7, 0.7, 0.7]",
                "[0.7, 1.7, 0.7]",
            ),
            ("a number too large for f32", "\"degrees\": 15", "\"degrees\": 1e39"),
        ],
    );
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_the_camera_the_film_and_the_settings() {
    let report = broken_ron(&[
        ("a depth of nothing", "max_depth: 16", "max_depth: 0"),
        ("a depth too large", "max_depth: 16", "max_depth: 2000"),
        (
            "a camera that looks nowhere",
            "target: (278, 273, 0)",
            "target: (278, 273, -800)",
        ),
        ("up along the view", "fov: 39.3", "up: (0, 0, -2), fov: 39.3"),
        ("no up", "fov: 39.3", "up: (0, 0, 0), fov: 39.3"),
        ("an angle of view too wide", "fov: 39.3", "fov: 180"),
        ("an angle of view of nothing", "fov: 39.3", "fov: 0"),
        ("an infinite number", "fov: 39.3", "fov: inf"),
        ("not a number", "(278, 273, -800)", "(278, NaN, -800)"),
        ("a number too large for f32", "(278, 273, -800)", "(278, 273, 1e39)"),
        (
            "a number too large to compute with",
            "(278, 273, -800)",
            "(278, 273, 1e12)",
        ),
        ("a film without width", "width: 512", "width: 0"),
        ("a film too high", "height: 512", "height: 70000"),
        (
            "a film too large",
            "width: 512, height: 512",
            "width: 65536, height: 65536",
        ),
        ("a filter too narrow", "radius: 1.5", "radius: 0.1"),
        ("a filter too sharp", "sigma: 0.5", "sigma: 0"),
        (
            "a filter too sharp for its radius",
            "radius: 1.5, sigma: 0.5",
            "radius: 16, sigma: 0.05",
        ),
        ("an exposure too bright", "height: 512", "height: 512, exposure: 33"),
        (
            "an exposure that is no number",
            "height: 512",
            "height: 512, exposure: NaN",
        ),
    ]);
    insta::assert_snapshot!(report);
}

/// What the cases of materials put others in place of.
const GOLD: &str = "Conductor(eta: (0.14, 0.38, 1.44), k: (3.98, 2.39, 1.6))";

#[test]
fn mistakes_of_lenses_and_parallel_cameras() {
    let pinhole = "Perspective(origin: (278, 273, -800), target: (278, 273, 0), fov: 39.3, fov_axis: Horizontal)";
    let place = "origin: (278, 273, -800), target: (278, 273, 0)";
    let lens = |rest: &str| format!("ThinLens({place}, fov: 39.3, {rest})");
    let parallel = |rest: &str| format!("Orthographic({place}, {rest})");
    let cases = [
        ("a lens", lens("aperture_radius: 5")),
        ("a lens of no radius", lens("aperture_radius: 0")),
        (
            "a lens of negative radius",
            lens("aperture_radius: -1, focus_distance: 800"),
        ),
        ("a lens of infinite radius", lens("aperture_radius: inf")),
        ("a lens without a radius", lens("focus_distance: 800")),
        (
            "a lens that focuses on itself",
            lens("aperture_radius: 5, focus_distance: 0"),
        ),
        (
            "a lens that focuses too near",
            lens("aperture_radius: 5, focus_distance: 1e-5"),
        ),
        (
            "a lens that focuses behind itself",
            lens("aperture_radius: 5, focus_distance: -800"),
        ),
        (
            "a lens too wide",
            lens("aperture_radius: 5, fov: 200").replace("fov: 39.3, ", ""),
        ),
        (
            "a lens misspelt",
            lens("aperture_radius: 5").replace("ThinLens", "Thinlens"),
        ),
        ("parallel rays", parallel("height: 560")),
        ("parallel rays over nothing", parallel("height: 0")),
        ("parallel rays without a height", parallel("up: (0, 1, 0)")),
        ("parallel rays with an angle", parallel("height: 560, fov: 40")),
        (
            "parallel rays upright along the view",
            parallel("height: 560, up: (0, 0, 1)"),
        ),
        (
            "parallel rays to nowhere",
            parallel("height: 560").replace("(278, 273, 0)", "(278, 273, -800)"),
        ),
    ];
    let cases: Vec<_> = cases
        .iter()
        .map(|(what, camera)| (*what, pinhole, camera.as_str()))
        .collect();
    insta::assert_snapshot!(broken_ron(&cases));
}

#[test]
fn mistakes_of_materials() {
    let report = broken_ron(&[
        ("a reflectance above one", "(0.7, 0.7, 0.7)", "(0.7, 1.2, 0.7)"),
        ("a reflectance below zero", "(0.7, 0.7, 0.7)", "(0.7, 0.7, -0.1)"),
        (
            "a metal that is no medium",
            "eta: (0.14, 0.38, 1.44), k: (3.98, 2.39, 1.6)",
            "eta: (0, 1, 1), k: (0, 1, 1)",
        ),
        ("a negative index", "eta: (0.14", "eta: (-0.14"),
        ("an index of zero", "interior_ior: 1.5", "interior_ior: 0"),
        ("an unknown metal", GOLD, "Conductor(metal: \"Gold\")"),
        ("a metal misspelt", GOLD, "Conductor(metal: \"Aut\")"),
        (
            "a metal by name and in numbers",
            "eta: (0.14",
            "metal: \"Au\", eta: (0.14",
        ),
        (
            "a metal by name and with a k",
            GOLD,
            "Conductor(metal: \"Au\", k: (1, 1, 1))",
        ),
        ("neither metal nor index", GOLD, "Conductor()"),
        ("an index without absorption", GOLD, "Conductor(eta: (1, 1, 1))"),
        (
            "absorption without an index",
            GOLD,
            "RoughConductor(k: (1, 1, 1), alpha: 0.1)",
        ),
        ("no roughness", GOLD, "RoughConductor(metal: \"Au\")"),
        (
            "two kinds of roughness",
            GOLD,
            "RoughConductor(metal: \"Au\", alpha: 0.1, alpha_v: 0.2)",
        ),
        (
            "roughness in one direction",
            GOLD,
            "RoughConductor(metal: \"Au\", alpha_u: 0.1)",
        ),
        (
            "roughness in the other",
            "Dielectric(interior_ior: 1.5)",
            "RoughDielectric(interior_ior: 1.5, alpha_v: 0.1)",
        ),
        (
            "a roughness below zero",
            GOLD,
            "RoughConductor(metal: \"Au\", alpha: -0.1)",
        ),
        (
            "a roughness of zero",
            "Dielectric(interior_ior: 1.5)",
            "RoughDielectric(interior_ior: 1.5, alpha: 0)",
        ),
        (
            "a roughness above one",
            GOLD,
            "RoughConductor(metal: \"Au\", alpha_u: 0.1, alpha_v: 1.5)",
        ),
        (
            "an unknown distribution",
            GOLD,
            "RoughConductor(metal: \"Au\", alpha: 0.1, distribution: Phong)",
        ),
        ("a coat too dense", GOLD, "Plastic(interior_ior: 11)"),
        (
            "a base that makes light",
            GOLD,
            "Plastic(diffuse_reflectance: (1, 1.1, 1))",
        ),
        (
            "a texture that there is not",
            "reflectance: (0.7, 0.7, 0.7)",
            "reflectance: \"wood\"",
        ),
        (
            "a number for a colour",
            "reflectance: (0.7, 0.7, 0.7)",
            "reflectance: 0.7",
        ),
        (
            "two numbers for a colour",
            "reflectance: (0.7, 0.7, 0.7)",
            "reflectance: (0.7, 0.7)",
        ),
        (
            "four numbers for a colour",
            "reflectance: (0.7, 0.7, 0.7)",
            "reflectance: (0.7, 0.7, 0.7, 1)",
        ),
        (
            "a name for a channel",
            "reflectance: (0.7, 0.7, 0.7)",
            "reflectance: (0.7, \"wood\", 0.7)",
        ),
        (
            "a sheet with an unknown side",
            GOLD,
            "TwoSided(front: \"white\", back: \"whit\")",
        ),
        ("a sheet of sheets", GOLD, "TwoSided(front: \"gold\", back: \"white\")"),
        (
            "a sheet with a clear side",
            GOLD,
            "TwoSided(front: \"white\", back: \"glass\")",
        ),
        ("a sheet with one side", GOLD, "TwoSided(front: \"white\")"),
        ("an empty name", "\"gold\"", "\"\""),
        ("an unused material", "material: \"gold\"", "material: \"white\""),
    ]);
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_shapes() {
    let report = broken_ron(&[
        ("an unknown material", "material: \"gold\"", "material: \"golden\""),
        (
            "a material of nothing like the known ones",
            "material: \"gold\"",
            "material: \"a\"",
        ),
        ("no material", "material: \"gold\"", ""),
        ("a name twice", "\"block\"", "\"floor\""),
        ("an empty name", "\"block\"", "\"\""),
        (
            "no shapes",
            &RON[RON.find("        (\n            name").unwrap_or(0)..RON.len() - 8],
            "",
        ),
        (
            "a quad with parallel edges",
            "edge_v: (0, 0, -560)",
            "edge_v: (-1, 0, 0)",
        ),
        ("a quad without an edge", "edge_v: (0, 0, -560)", "edge_v: (0, 0, 0)"),
        ("a flat box", "max: (4, 5, 6)", "max: (4, 2, 6)"),
        ("a box inside out", "max: (4, 5, 6)", "max: (4, 5, -6)"),
        (
            "a box too thin for its distance",
            "min: (1, 2, 3), max: (4, 5, 6)",
            "min: (0, 0, 0), max: (1e-25, 1, 1)",
        ),
        ("a sphere without a radius", "radius: 2)", "radius: 0)"),
        ("a negative emission", "(17, 12, 4)", "(17, -12, 4)"),
        ("an emission too bright", "(17, 12, 4)", "(17, 12, 4e20)"),
        ("no light", "emission: (17, 12, 4),", ""),
        ("black light", "emission: (17, 12, 4),", "emission: (0, 0, 0),"),
    ]);
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_round_shapes_and_height_fields() {
    let ball = "Sphere(center: (0, 1, 0), radius: 2)";
    let cases = [
        ("a disk", "Disk(normal: (0, 2, 0), radius: 1)"),
        ("a disk without a radius", "Disk(normal: (0, 1, 0), radius: 0)"),
        ("a disk without a side", "Disk(normal: (0, 0, 0), radius: 1)"),
        ("a disk whose normal is forgotten", "Disk(radius: 1)"),
        ("a cylinder", "Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 1)"),
        (
            "a cylinder without a length",
            "Cylinder(from: (0, 1, 0), to: (0, 1, 0), radius: 1)",
        ),
        (
            "a cylinder turned inside out",
            "Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: -1)",
        ),
        (
            "a cylinder too short for where it is",
            "Cylinder(from: (1e6, 0, 0), to: (1e6, 1e-3, 0), radius: 1)",
        ),
        ("a torus", "Torus(major_radius: 2, minor_radius: 0.5)"),
        (
            "a torus that crosses itself",
            "Torus(major_radius: 1, minor_radius: 1.5)",
        ),
        ("a torus without a tube", "Torus(major_radius: 1, minor_radius: 0)"),
        (
            "a torus without an axis",
            "Torus(axis: (0, 0, 0), major_radius: 2, minor_radius: 0.5)",
        ),
        (
            "a torus of two segments",
            "Torus(major_radius: 2, minor_radius: 0.5, segments: (64, 2))",
        ),
        (
            "a torus of too many segments",
            "Torus(major_radius: 2, minor_radius: 0.5, segments: (100000, 8))",
        ),
        (
            "a torus of too many segments in all",
            "Torus(major_radius: 2, minor_radius: 0.5, segments: (16384, 16384))",
        ),
        (
            "a height field",
            "HeightField(heights: [[0, 1], [1, 2]], edge_u: (1, 0, 0), edge_v: (0, 0, -1))",
        ),
        ("no heights", "HeightField(edge_u: (1, 0, 0), edge_v: (0, 0, -1))"),
        (
            "heights twice",
            "HeightField(file: \"h.png\", heights: [[0, 1], [1, 2]], edge_u: (1, 0, 0), edge_v: (0, 0, -1))",
        ),
        (
            "ragged heights",
            "HeightField(heights: [[0, 1], [1, 2, 3]], edge_u: (1, 0, 0), edge_v: (0, 0, -1))",
        ),
        (
            "one row of heights",
            "HeightField(heights: [[0, 1]], edge_u: (1, 0, 0), edge_v: (0, 0, -1))",
        ),
        (
            "a height that is no number",
            "HeightField(heights: [[0, 1], [1, NaN]], edge_u: (1, 0, 0), edge_v: (0, 0, -1))",
        ),
        (
            "a height beyond the world",
            "HeightField(heights: [[0, 1], [1, 5e9]], edge_u: (1, 0, 0), edge_v: (0, 0, -1))",
        ),
        (
            "heights scaled beyond the world",
            "HeightField(heights: [[0, 9], [1, 5]], edge_u: (1, 0, 0), edge_v: (0, 0, -1), height: 1e9)",
        ),
        (
            "a height field without an area",
            "HeightField(heights: [[0, 1], [1, 2]], edge_u: (1, 0, 0), edge_v: (-1, 0, 0))",
        ),
        (
            "a file of heights that is not there",
            "HeightField(file: \"h.png\", edge_u: (1, 0, 0), edge_v: (0, 0, -1))",
        ),
    ];
    let cases: Vec<_> = cases.map(|(what, shape)| (what, ball, shape)).into();
    let mut report = broken_ron(&cases);
    let shear = "Scale((2, 1, 2))";
    let made = RON.replace("Scale((2, 2, 2))", shear);
    for (what, _, shape) in [cases[0], cases[4]] {
        let text = made.replace(ball, shape);
        let said = findings("scene.ron", &text, Format::Ron, Path::new(""));
        report.push_str(&format!("{what} under {shear}\n  {said}\n"));
    }
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_textures() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).expect("a file");
    write("text.png", b"not a picture");
    let mut small = Vec::new();
    let texels = [image::Rgb([0.5, 0.5, 0.5]), image::Rgb([0.25, 2.0, 0.5])];
    let encoded = image::codecs::hdr::HdrEncoder::new(&mut small).encode(&texels, 2, 1);
    encoded.expect("encoded");
    write("bright.hdr", &small);
    write("cut.hdr", &small[..small.len() - 5]);
    write("huge.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n");
    let mut junk = b"\x89PNG\r\n\x1a\n".to_vec();
    junk.extend([b'x'; 50]);
    write("junk.png", &junk);
    write("junk.exr", &[b"\x76\x2f\x31\x01".as_slice(), &[b'x'; 80]].concat());
    let cases = [
        ("a damaged file", "\"t\": Bitmap(file: \"junk.png\")"),
        ("another damaged file", "\"t\": Bitmap(file: \"junk.exr\")"),
        ("a checkerboard", "\"t\": Checkerboard(scale: (8, 8))"),
        ("a kind misspelt", "\"t\": Checkers()"),
        ("a colour above one", "\"t\": Checkerboard(even: (1, 1.5, 1))"),
        ("a scale that is no number", "\"t\": Checkerboard(scale: (NaN, 1))"),
        ("a scale too large", "\"t\": Checkerboard(scale: (1, 1e9))"),
        ("an empty name", "\"\": Checkerboard()"),
        ("a name twice", "\"t\": Checkerboard(), \"t\": Checkerboard()"),
        ("no file", "\"t\": Bitmap()"),
        ("an empty file name", "\"t\": Bitmap(file: \"\")"),
        ("a file that is not there", "\"t\": Bitmap(file: \"none.png\")"),
        ("a folder for a file", "\"t\": Bitmap(file: \".\")"),
        ("a file that is no picture", "\"t\": Bitmap(file: \"text.png\")"),
        ("a file that ends too early", "\"t\": Bitmap(file: \"cut.hdr\")"),
        ("a file that claims too much", "\"t\": Bitmap(file: \"huge.hdr\")"),
        ("a texel above one", "\"t\": Bitmap(file: \"bright.hdr\")"),
        (
            "a linear file that is said to be sRGB",
            "\"t\": Bitmap(file: \"bright.hdr\", encoding: Srgb)",
        ),
        (
            "a texture that nothing uses",
            "\"t\": Checkerboard(), \"unused\": Bitmap(file: \"none.png\")",
        ),
        ("another name", "\"tt\": Checkerboard()"),
        ("a wrap misspelt", "\"t\": Bitmap(file: \"bright.hdr\", wrap: repeat)"),
    ];
    let mut report = String::new();
    let place = format!("{}/", folder.path().display());
    for (what, texture) in cases {
        let text = RON
            .replace(
                "    materials: {",
                &format!("    textures: {{{texture}}},\n    materials: {{"),
            )
            .replace(
                "\"white\": Diffuse(reflectance: (0.7, 0.7, 0.7))",
                "\"white\": Diffuse(reflectance: \"t\")",
            );
        let said = findings("scene.ron", &text, Format::Ron, folder.path()).replace(&place, "");
        report.push_str(&format!("{what}\n  {}\n", said.replace('\n', "\n  ")));
    }
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_transforms() {
    let report = broken_ron(&[
        ("a scale of zero", "Scale((2, 2, 2))", "Scale((2, 0, 2))"),
        ("a sphere made an ellipsoid", "Scale((2, 2, 2))", "Scale((2, 1, 2))"),
        ("a rotation about nothing", "axis: (0, 1, 0)", "axis: (0, 0, 0)"),
        ("a rotation without end", "degrees: 15", "degrees: inf"),
        (
            "a singular matrix",
            "Scale((2, 2, 2))",
            "Matrix(((1, 2, 0, 0), (2, 4, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))",
        ),
        (
            "a projective matrix",
            "Scale((2, 2, 2))",
            "Matrix(((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 1, 1)))",
        ),
        (
            "a matrix of three rows",
            "Scale((2, 2, 2))",
            "Matrix(((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)))",
        ),
        ("a shape moved too far", "Scale((2, 2, 2))", "Scale((1e9, 1e9, 1e9))"),
        (
            "a shape shrunk to nothing",
            "Scale((2, 2, 2))",
            "Scale((1e-20, 1e-20, 1e-20))",
        ),
    ]);
    insta::assert_snapshot!(report);
}

/// The scene's quad and box replaced by a mesh; `material` and the rest of the shape as given.
fn with_mesh(rest: &str) -> String {
    RON.replace(
        "shape: Box(min: (1, 2, 3), max: (4, 5, 6)), material: \"gold\"",
        &format!("shape: Obj({rest}"),
    )
}

#[test]
fn mistakes_of_meshes() {
    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let cases: [(&str, &str, &str); 26] = [
        ("no such file", "file: \"missing.obj\"), material: \"gold\"", ""),
        ("a directory", "file: \".\"), material: \"gold\"", ""),
        ("no name", "file: \"\"), material: \"gold\"", ""),
        ("an empty file", "file: \"mesh.obj\"), material: \"gold\"", ""),
        (
            "a file of another kind",
            "file: \"mesh.obj\"), material: \"gold\"",
            "ply\nformat ascii 1.0\nend_header\n",
        ),
        (
            "an index out of range",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f 1 2 4\n",
        ),
        (
            "an index of zero",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f 0 1 2\n",
        ),
        (
            "a negative index out of range",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f -1 -2 -4\n",
        ),
        (
            "an index beyond all integers",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f 1 2 99999999999999999999\n",
        ),
        (
            "a normal out of range",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f 1//1 2//1 3//1\n",
        ),
        (
            "too many indices",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f 1/1/1/1 2 3\n",
        ),
        (
            "a word for a corner",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f a b c\n",
        ),
        (
            "a word for a number",
            "file: \"mesh.obj\"), material: \"gold\"",
            "v 1 2 x\n",
        ),
        (
            "two numbers for three",
            "file: \"mesh.obj\"), material: \"gold\"",
            "v 1 2\n",
        ),
        ("not a number", "file: \"mesh.obj\"), material: \"gold\"", "v 1 2 nan\n"),
        (
            "an infinite number",
            "file: \"mesh.obj\"), material: \"gold\"",
            "vn 1 2 1e39\n",
        ),
        ("a weight", "file: \"mesh.obj\"), material: \"gold\"", "v 1 2 3 0\n"),
        ("no area", "file: \"mesh.obj\"), material: \"gold\"", "f 1 2 2\n"),
        (
            "too far",
            "file: \"mesh.obj\"), material: \"gold\"",
            "v 1e10 0 0\nf 1 2 4\n",
        ),
        (
            "some without area",
            "file: \"mesh.obj\"), material: \"gold\"",
            "f 1 2 2\nf 1 2 3\n",
        ),
        (
            "opposed normals",
            "file: \"mesh.obj\"), material: \"gold\"",
            "vn 0 0 -1\nf 1//1 2//1 3//1\n",
        ),
        (
            "lines and points",
            "file: \"mesh.obj\"), material: \"gold\"",
            "l 1 2 3\np 1\nf 1 2\nf 1 2 3\n",
        ),
        ("no material anywhere", "file: \"mesh.obj\")", "f 1 2 3\n"),
        ("no library", "file: \"mesh.obj\")", "usemtl red\nf 1 2 3\n"),
        (
            "a missing library",
            "file: \"mesh.obj\")",
            "mtllib missing.mtl\nusemtl red\nf 1 2 3\n",
        ),
        (
            "a material misspelt",
            "file: \"mesh.obj\")",
            "mtllib good.mtl\nusemtl rde\nf 1 2 3\n",
        ),
    ];
    let folder = tempfile::tempdir().expect("a folder for the meshes");
    fs::write(folder.path().join("good.mtl"), "newmtl red\nKd 1 0 0\n").expect("a library");
    let mut report = String::new();
    for (what, rest, content) in cases {
        let content = if content.is_empty() {
            String::new()
        } else {
            format!("{TRIANGLE}{content}")
        };
        fs::write(folder.path().join("mesh.obj"), content).expect("a mesh");
        let found = findings("scene.ron", &with_mesh(rest), Format::Ron, folder.path());
        // What is said about the material that the box no longer uses is not the point.
        let found: Vec<&str> = found.lines().filter(|line| !line.contains("no shape uses")).collect();
        report.push_str(&format!("{what}\n  {}\n", found.join("\n  ")));
    }
    let report = report.replace(&format!("{}/", folder.path().display()), "FOLDER/");
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_material_libraries() {
    let cases = [
        ("a colour of two numbers", "newmtl red\nKd 1 0\n"),
        ("a spectral colour", "newmtl red\nKd spectral red.rfl\n"),
        ("a colour above one", "newmtl red\nKd 1 2 0\n"),
        ("a colour that is not a number", "newmtl red\nKd nan 0 0\n"),
        ("an index of refraction out of range", "newmtl red\nKd 1 0 0\nNi 0\n"),
        ("an unknown illumination model", "newmtl red\nillum 300\n"),
        ("a material without a name", "newmtl\nKd 1 0 0\n"),
        ("a texture", "newmtl red\nKd 1 0 0\nmap_Kd red.png\nNs 20\n"),
        ("another material", "newmtl blue\nKd 0 0 1\n"),
        ("nothing", ""),
    ];
    let folder = tempfile::tempdir().expect("a folder for the meshes");
    let mesh = "mtllib lib.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(folder.path().join("mesh.obj"), mesh).expect("a mesh");
    let mut report = String::new();
    for (what, library) in cases {
        fs::write(folder.path().join("lib.mtl"), library).expect("a library");
        let found = findings(
            "scene.ron",
            &with_mesh("file: \"mesh.obj\")"),
            Format::Ron,
            folder.path(),
        );
        let found: Vec<&str> = found.lines().filter(|line| !line.contains("no shape uses")).collect();
        report.push_str(&format!("{what}\n  {}\n", found.join("\n  ")));
    }
    insta::assert_snapshot!(report);
}

/// [`RON`] with one light.
fn with_light(light: &str) -> String {
    RON.replacen("    shapes: [", &format!("    lights: [{light}],\n    shapes: ["), 1)
}

#[test]
fn mistakes_of_lights() {
    let cases = [
        ("valid", "Point(position: (1, 2, 3), intensity: (1, 2, 3))"),
        (
            "a kind of light misspelt",
            "Pont(position: (1, 2, 3), intensity: (1, 2, 3))",
        ),
        ("a field misspelt", "Point(positon: (1, 2, 3), intensity: (1, 2, 3))"),
        ("no intensity", "Point(position: (1, 2, 3))"),
        (
            "a negative intensity",
            "Point(position: (1, 2, 3), intensity: (1, -2, 3))",
        ),
        (
            "an intensity that is no number",
            "Point(position: (1, 2, 3), intensity: (1, NaN, 3))",
        ),
        (
            "an infinite intensity",
            "Point(position: (1, 2, 3), intensity: (1, 1e40, 3))",
        ),
        (
            "a position too far away",
            "Point(position: (1, 2e9, 3), intensity: (1, 1, 3))",
        ),
        (
            "a valid spot",
            "Spot(position: (1, 2, 3), target: (0, 0, 0), intensity: (1, 1, 1))",
        ),
        (
            "a spot that aims nowhere",
            "Spot(position: (1, 2, 3), target: (1, 2, 3), intensity: (1, 1, 1))",
        ),
        (
            "a cutoff of zero",
            "Spot(position: (1, 2, 3), target: (0, 0, 0), intensity: (1, 1, 1), cutoff: 0)",
        ),
        (
            "a cutoff beyond a right angle",
            "Spot(position: (1, 2, 3), target: (0, 0, 0), intensity: (1, 1, 1), cutoff: 91)",
        ),
        (
            "a beam beyond the cutoff",
            "Spot(position: (1, 2, 3), target: (0, 0, 0), intensity: (1, 1, 1), cutoff: 10, beam: 11)",
        ),
        (
            "a negative beam",
            "Spot(position: (1, 2, 3), target: (0, 0, 0), intensity: (1, 1, 1), beam: -1)",
        ),
        (
            "no direction",
            "Directional(direction: (0, 0, 0), irradiance: (1, 1, 1))",
        ),
        (
            "a negative irradiance",
            "Directional(direction: (0, 0, 1), irradiance: (1, 1, -1))",
        ),
        ("an environment of nothing", "Environment(scale: 2)"),
        (
            "an environment of two things",
            "Environment(radiance: (1, 1, 1), file: \"sky.exr\")",
        ),
        ("a negative radiance", "Environment(radiance: (-1, 1, 1))"),
        ("a negative scale", "Environment(radiance: (1, 1, 1), scale: -1)"),
        (
            "a radiance too bright with its scale",
            "Environment(radiance: (1, 1e8, 1), scale: 1e8)",
        ),
        ("no way up", "Environment(radiance: (1, 1, 1), up: (0, 0, 0))"),
        ("a turn without end", "Environment(radiance: (1, 1, 1), rotate: inf)"),
        ("a picture without a name", "Environment(file: \"\")"),
        ("a sun without a direction", "Sun(direction: (0, 0, 0))"),
        ("a sun below the horizon", "Sun(direction: (1, -0.1, 0))"),
        ("air too clear", "Sun(direction: (1, 1, 0), turbidity: 0.5)"),
        ("air too thick", "Sky(sun_direction: (1, 1, 0), turbidity: 11)"),
        (
            "a sky's sun below its own horizon",
            "Sky(sun_direction: (1, 1, 0), up: (0, -1, 0))",
        ),
        (
            "ground that makes light",
            "Sky(sun_direction: (1, 1, 0), albedo: (1, 1, 2))",
        ),
        (
            "a valid sky and sun",
            "Sky(sun_direction: (1, 1, 0)), Sun(direction: (1, 1, 0))",
        ),
    ];
    let mut report = String::new();
    for (what, light) in cases {
        let found = findings("scene.ron", &with_light(light), Format::Ron, Path::new(""));
        report.push_str(&format!("{what}\n  {}\n", found.replace('\n', "\n  ")));
    }
    insta::assert_snapshot!(report);
}

#[test]
fn mistakes_of_environments() {
    let folder = tempfile::tempdir().expect("a folder for the pictures");
    let at = |name: &str| folder.path().join(name);
    let write = |name: &str, bad: Option<[f32; 3]>| {
        let mut picture = image::Rgb32FImage::from_pixel(4, 2, image::Rgb([1.0, 2.0, 3.0]));
        if let Some(bad) = bad {
            picture.put_pixel(2, 1, image::Rgb(bad));
        }
        picture.save(at(name)).expect("a picture");
    };
    write("good.exr", None);
    write("good.hdr", None);
    write("nan.exr", Some([1.0, f32::NAN, 1.0]));
    write("negative.exr", Some([1.0, 1.0, -0.5]));
    write("infinite.exr", Some([f32::INFINITY, 1.0, 1.0]));
    write("bright.exr", Some([2e12, 1.0, 1.0]));
    image::RgbImage::new(4, 2).save(at("sdr.png")).expect("a picture");
    fs::write(at("text.exr"), "no picture").expect("a file");
    fs::create_dir(at("folder.exr")).expect("a folder");
    let whole = fs::read(at("good.exr")).expect("a picture");
    fs::write(at("cut.exr"), &whole[..whole.len() - 20]).expect("a file");
    let head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    fs::write(at("empty.hdr"), format!("{head}-Y 0 +X 0\n")).expect("a file");
    fs::write(at("cut.hdr"), format!("{head}-Y 1 +X 2\n123")).expect("a file");
    fs::write(at("junk.exr"), [&whole[..8], &[b'x'; 76]].concat()).expect("a file");
    let mut report = String::new();
    for name in [
        "empty.hdr",
        "cut.hdr",
        "junk.exr",
        "good.exr",
        "good.hdr",
        "missing.exr",
        "folder.exr",
        "text.exr",
        "cut.exr",
        "sdr.png",
        "nan.exr",
        "negative.exr",
        "infinite.exr",
        "bright.exr",
    ] {
        let light = format!("Environment(file: \"{name}\")");
        let found = findings("scene.ron", &with_light(&light), Format::Ron, folder.path());
        report.push_str(&format!("{found}\n"));
    }
    let report = report.replace(&format!("{}/", folder.path().display()), "FOLDER/");
    insta::assert_snapshot!(report);
}

#[test]
fn files_that_are_no_scenes() {
    let folder = tempfile::tempdir().expect("a folder for the scenes");
    fs::create_dir(folder.path().join("folder.ron")).expect("a folder");
    fs::write(folder.path().join("latin.ron"), b"(version: 1, // caf\xe9\n").expect("a file");
    fs::write(folder.path().join("empty.ron"), "").expect("a file");
    fs::write(folder.path().join("empty.json"), "").expect("a file");
    let huge = fs::File::create(folder.path().join("huge.ron")).expect("a file");
    huge.set_len((64 << 20) + 1).expect("a sparse file");
    let mut report = String::new();
    for name in [
        "missing.ron",
        "folder.ron",
        "latin.ron",
        "empty.ron",
        "empty.json",
        "huge.ron",
        "scene.rom",
        "scene.yaml",
        "scene",
    ] {
        let error = read_scene(&folder.path().join(name)).expect_err("no scene");
        report.push_str(&format!("{}\n", error.plain()));
    }
    let report = report.replace(&format!("{}/", folder.path().display()), "FOLDER/");
    insta::assert_snapshot!(report);
}

#[test]
fn an_error_shows_its_line() {
    let text = RON.replace("material: \"gold\"", "material: \"golden\"");
    let source = parse_scene("scene.ron", &text, Format::Ron, Path::new("")).expect("right in its syntax");
    let error = flatten(&source).expect_err("an unknown material");
    let mut shown = String::new();
    let handler = miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::unicode_nocolor());
    handler.render_report(&mut shown, &error).expect("a report");
    insta::assert_snapshot!(shown);
}
