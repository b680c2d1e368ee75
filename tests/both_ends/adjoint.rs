//! Shading normals seen from both ends.
//!
//! A ball of twenty triangles with the normals of a sphere. Where a shading normal is not the geometric one, scattering from
//! light to camera is another function than from camera to light, and paths from lights need a factor (Veach 1997, §5.3.2) that
//! is 1 elsewhere.

use super::agreement::{BlockMeans, Contender, Pictures, statistics};
use super::{assert_same_light, block_means, subpath};
use crate::support::scenes::compile;
use crate::support::verdict::{Family, say};
use chainlight::path::bidirectional::{Join, Strategies, Weights};
use chainlight::path::{ChainTable, PathLength};
use chainlight::plan::{Base, Plan, Technique};
use chainlight::render::{Rendering, SplatRender};
use chainlight::scene::{Format, Scene, parse_scene};
use chainlight::stats::z_test::Estimate;
use chainlight::systems::tile::TilePlace;
use glam::Vec3;
use std::fmt::Write;
use std::sync::Arc;
use tempfile::TempDir;

const SIZE: u32 = 24;
const BLOCKS_PER_SIDE: u32 = 4;

/// An icosahedron of radius 1 about the origin with the normals of its sphere, as an OBJ file.
fn icosahedron() -> String {
    let golden = 0.5 * (1.0 + 5.0_f32.sqrt());
    let mut corners = Vec::new();
    for a in [-1.0, 1.0] {
        for b in [-golden, golden] {
            corners.extend([Vec3::new(0.0, a, b), Vec3::new(a, b, 0.0), Vec3::new(b, 0.0, a)]);
        }
    }
    let mut text = String::new();
    for corner in &corners {
        let n = corner.normalize();
        let _ = writeln!(text, "v {} {} {}\nvn {} {} {}", n.x, n.y, n.z, n.x, n.y, n.z);
    }
    // The faces are the triples of corners 2 apart.
    let near = |a: usize, b: usize| ((corners[a] - corners[b]).length() - 2.0).abs() < 1e-3;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    let outward = (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(corners[a]) > 0.0;
                    let (b, c) = if outward { (b, c) } else { (c, b) };
                    let _ = writeln!(text, "f {0}//{0} {1}//{1} {2}//{2}", a + 1, b + 1, c + 1);
                }
            }
        }
    }
    text
}

/// The ball of some material, with more around it.
fn scene(material: &str, max_depth: u32, around: &str) -> Arc<Scene> {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("ball.obj"), icosahedron()).expect("a file");
    let text = format!(
        r#"(version: 1, settings: (max_depth: {max_depth}),
        camera: Perspective(origin: (0, 0.3, 4.5), target: (0, 0, 0), fov: 32), film: (width: {SIZE}, height: {SIZE}),
        materials: {{"ball": {material}, "white": Diffuse(reflectance: (0.7, 0.7, 0.7))}},
        shapes: [(shape: Obj(file: "ball.obj"), material: "ball"), {around}])"#
    );
    let source = parse_scene("ball.ron", &text, Format::Ron, folder.path()).unwrap_or_else(|e| panic!("{}", e.plain()));
    compile(&source, SIZE)
}

const DIFFUSE: &str = "Diffuse(reflectance: (0.8, 0.6, 0.4))";
const ROUGH: &str = r#"RoughConductor(metal: "Cu", alpha: 0.4)"#;
/// A lamp to the left before the ball, out of the picture.
const LAMP: &str = r#"(shape: Quad(corner: (-2.55, 2.154, 1.985), edge_u: (0.566, 0, 0.566), edge_v: (-0.265, -0.707, 0.265)),
    material: "white", emission: (20, 20, 20)),"#;
const FLOOR: &str =
    r#"(shape: Quad(corner: (-4, -1.1, 4), edge_u: (8, 0, 0), edge_v: (0, 0, -8)), material: "white"),"#;

#[test]
fn smooth_normals_on_coarse_meshes_look_the_same_from_both_ends() {
    let counted = vec![true; (BLOCKS_PER_SIDE * BLOCKS_PER_SIDE) as usize];
    let tests = 4 * statistics(&counted);
    for (name, material) in [("diffuse", DIFFUSE), ("rough", ROUGH)] {
        let scene = scene(material, 4, &format!("{LAMP}{FLOOR}"));
        let of = |technique, samples, first_seed| {
            let pictures = Pictures {
                runs: 24,
                samples,
                first_seed,
                blocks_per_side: BLOCKS_PER_SIDE,
            };
            let contender = Contender::of(technique, Base::Pt);
            block_means(&scene, contender, &contender.options(), pictures)
        };
        let pt: BlockMeans = of(Technique::Pt, 64, 100);
        for (technique, samples) in [(Technique::Lt, 200), (Technique::Bdpt, 24)] {
            let means = of(technique, samples, 200);
            assert_same_light(
                &format!("{name}, {technique} and pt"),
                &means,
                &pt,
                &counted,
                tests,
                0.03,
            );
        }
    }
}

/// Light on the ball alone, found by its paths from the lamp, with and without the factor: a convex body hides none of its points
/// that face the camera, so that no segment needs to be traced. Held against path tracing.
#[test]
fn without_the_correction_paths_from_lights_are_wrong() {
    const BATCHES: usize = 64;
    const STEPS: u32 = 24;
    let scene = scene(DIFFUSE, 2, LAMP);
    let mut render = SplatRender::new(
        Arc::clone(&scene),
        Plan::new(&scene, Technique::Bdpt, Some(SIZE * SIZE)),
        1,
        1,
    )
    .expect("a small film");
    let strategies = Strategies {
        weights: Weights::Only(2, 1),
        ..Strategies::default()
    };
    let (mut with, mut without, mut strongest) = (Vec::new(), Vec::new(), 1.0_f32);
    for _ in 0..BATCHES {
        let mut sums = [0.0; 2];
        for _ in 0..STEPS {
            render.burst(1, &|_| {});
            render.for_each_world(&mut |_, world| {
                let place = *world.world().resource::<TilePlace>();
                for chain in 0..place.chains as usize {
                    let path = place.lights_from as usize + chain;
                    // Those that leave the lamp and meet nothing are many.
                    if !world
                        .at::<PathLength, ChainTable>(path)
                        .is_some_and(|length| (1..=2).contains(&length))
                    {
                        continue;
                    }
                    let (camera, light) = (subpath(world, chain), subpath(world, path));
                    let join = Join {
                        scene: &scene,
                        strategies,
                        camera: &camera[..1],
                        light: &light,
                    };
                    let Some(seen) = join.seen(2, 0.5) else {
                        continue;
                    };
                    let surface = light[1].surface;
                    let towards = (seen.offer.target - surface.position).normalize();
                    let factor = surface.adjoint_correction(towards);
                    strongest = strongest.max(factor.max(1.0 / factor));
                    let value = seen.offer.value.mean();
                    sums[0] += f64::from(value);
                    sums[1] += f64::from(value / factor);
                }
            });
        }
        let samples = f64::from(STEPS * SIZE * SIZE);
        with.push(sums[0] / samples);
        without.push(sums[1] / samples);
    }
    let truth = super::block_means(
        &scene,
        Contender::of(Technique::Pt, Base::Pt),
        &Default::default(),
        Pictures {
            runs: 24,
            samples: 400,
            first_seed: 300,
            blocks_per_side: 1,
        },
    );
    let means: Vec<f64> = truth.rows.iter().map(|row| row.iter().sum::<f64>() / 3.0).collect();
    let expected = Estimate::of(&means);
    let family = Family { tests: 2 };
    say(&format!("the factor is up to {strongest:.1}, or one over that"));
    let slack = 4.0 * expected.error;
    family.is("with the correction", Estimate::of(&with), expected.mean, slack, 0.04);
    family.is_not("without it", Estimate::of(&without), expected.mean, slack);
}
