//! Textures as a render shows them: a picture is on its quad the right way round and as bright as its texels, the same in
//! stages and depth first, and plans without textures say so.

use crate::support::render::{SIDE, mean, picture, picture_bytes};
use crate::support::verdict::Family;
use chainlight::plan::{Effect, Plan, Technique};
use chainlight::scene::{Format, Scene, SceneOverrides, flatten, parse_scene};
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use std::path::Path;
use std::sync::Arc;

/// Blocks of 4 x 4 pixels along each side of the film, a texel each.
const BLOCKS: u32 = 4;
const FAMILY: Family = Family {
    tests: 2 * (BLOCKS * BLOCKS) as usize,
};
const SEES: f64 = 0.05;

/// The linear value of the texel in a column and a row from the top: all different.
fn texel(column: u32, row: u32) -> f64 {
    f64::from(row * BLOCKS + column + 4) / 20.0
}

/// A quad that fills the film, under light from all directions; what it scatters leaves the scene.
fn scene(textures: &str, reflectance: &str, folder: &Path) -> Arc<Scene> {
    let text = format!(
        "(version: 1, settings: (max_depth: 2), film: (width: {SIDE}, height: {SIDE}),
        camera: Orthographic(origin: (0, 0, 3), target: (0, 0, 0), height: 2),
        textures: {{{textures}}},
        materials: {{\"paper\": Diffuse(reflectance: {reflectance})}},
        lights: [Environment(radiance: (1, 1, 1))],
        shapes: [(shape: Quad(corner: (-1, -1, 0), edge_u: (2, 0, 0), edge_v: (0, 2, 0)), material: \"paper\")])"
    );
    let source = parse_scene("test.ron", &text, Format::Ron, folder).unwrap_or_else(|e| panic!("{}", e.plain()));
    let flattened = flatten(&source).unwrap_or_else(|e| panic!("{}", e.plain()));
    let scene = Scene::compile(&source.description, &flattened, SceneOverrides::default());
    Arc::new(scene.expect("the box filter can be sampled"))
}

/// A folder with a linear 16-bit picture of 4 x 4 texels.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let codes = (0..BLOCKS * BLOCKS).map(|i| (texel(i % BLOCKS, i / BLOCKS) * 65_535.0).round() as u16);
    let samples: Vec<u8> = codes.flat_map(u16::to_ne_bytes).collect();
    let mut png = Vec::new();
    let encoded = PngEncoder::new(&mut png).write_image(&samples, BLOCKS, BLOCKS, ExtendedColorType::L16);
    encoded.expect("encoded");
    std::fs::write(folder.path().join("numbers.png"), png).expect("a file");
    folder
}

#[test]
fn a_picture_is_on_its_quad_the_right_way_round() {
    let folder = folder();
    let bitmap = "\"t\": Bitmap(file: \"numbers.png\", encoding: Linear, filter: Nearest)";
    let board = "\"t\": Checkerboard(even: (0.8, 0.8, 0.8), odd: (0.3, 0.3, 0.3), scale: (4, 4))";
    // Row 3 from the top holds u = v = 0 in its first column.
    let checked = |column: u32, row: u32| if (column + row) % 2 == 1 { 0.8 } else { 0.3 };
    let of_board = |&block: &u32| checked(block % BLOCKS, block / BLOCKS);
    let of_bitmap = |&block: &u32| texel(block % BLOCKS, block / BLOCKS);
    let blocks: Vec<u32> = (0..BLOCKS * BLOCKS).collect();
    let cases: [(&str, &str, Vec<f64>); 2] = [
        ("bitmap", bitmap, blocks.iter().map(of_bitmap).collect()),
        ("checkerboard", board, blocks.iter().map(of_board).collect()),
    ];
    for (name, texture, expected) in cases {
        let scene = scene(texture, "\"t\"", folder.path());
        let picture = picture(&scene, Technique::Pt, 3, 1024);
        for &block in &blocks {
            let (column, row) = (block % BLOCKS, block / BLOCKS);
            let size = SIDE / BLOCKS;
            let mean = mean(&picture, 1, |x, y| x / size == column && y / size == row);
            let case = format!("{name}, column {column}, row {row}");
            FAMILY.is(&case, mean, expected[block as usize], 1e-4, SEES);
            FAMILY.is_not(&case, mean, 1.06 * expected[block as usize], 1e-4);
        }
    }
}

#[test]
fn textures_look_the_same_in_stages_and_depth_first() {
    let folder = folder();
    let scene = scene("\"t\": Bitmap(file: \"numbers.png\")", "\"t\"", folder.path());
    let techniques = [Technique::Pt, Technique::PtReference];
    let [staged, depth_first] = techniques.map(|technique| picture_bytes(&picture(&scene, technique, 5, 16)));
    assert_eq!(staged, depth_first);
}

#[test]
fn the_plan_has_textures_where_a_material_has_one() {
    let folder = folder();
    let plan = |textures: &str, reflectance: &str| {
        Plan::new(&scene(textures, reflectance, folder.path()), Technique::Pt, None).has(Effect::Textures)
    };
    assert!(plan("\"t\": Checkerboard()", "\"t\""));
    assert!(!plan("\"t\": Checkerboard()", "(0.5, 0.5, 0.5)"));
}
