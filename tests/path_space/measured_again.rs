//! The path that a chain keeps, measured again from its table, is worth what the chain says, bit for bit: nothing of a path is lost or
//! left behind from another when proposals are taken, however many were, and no density depends on how the path was made.

use super::paths;
use crate::support::chains::column;
use crate::support::scenes::{as_written, shipped};
use bevy_ecs::system::Res;
use chainlight::chain::{ProposedTarget, Target};
use chainlight::path::ChainTable;
use chainlight::path::whole::*;
use chainlight::plan::{Phases, Place, Plan, Stage, SystemPlan};
use chainlight::render::ChainRender;
use chainlight::scene::Scene;
use chainlight::system;
use chainlight::systems::paths::Vertices;
use chainlight::systems::tile::{SceneRef, TilePlace};
use chainlight::table::{Read, Rows, Write};
use std::sync::Arc;

/// Writes what every current path is worth where proposals' targets were, which nobody needs at the end of a step: not a number where
/// a density that is kept with the path is not that of the path.
fn measure_again(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    edges: Read<PathEdges, ChainTable>,
    lights: Read<PathLight, ChainTable>,
    vertices: Vertices<PathTable>,
    shares: Read<PathShare, PathTable>,
    onwards: Read<PathOnward, PathTable>,
    backs: Read<PathBack, PathTable>,
    kept_lights: Read<PathKeptLight, ChainTable>,
    mut targets: Write<ProposedTarget, ChainTable>,
) {
    let (edges, lights, vertices) = (edges.rows(), lights.rows(), vertices.columns());
    let (shares, onwards, backs) = (shares.rows(), onwards.rows(), backs.rows());
    let (kept_lights, targets) = (kept_lights.rows(), targets.rows());
    let mut measured = Measured::default();
    for chain in 0..place.chains as usize {
        let rows: Vec<usize> = (0..=edges.at(chain) as usize)
            .map(|depth| place.path_vertex(chain, depth))
            .collect();
        let whole: Vec<WholeVertex> = rows.iter().map(|&row| vertices.at(row)).collect();
        let path = WholePath {
            scene: &scene.0,
            vertices: &whole,
            light: lights.at(chain),
        };
        let value = path.measure(&mut measured);
        let kept = rows.iter().enumerate().all(|(depth, &row)| {
            let passage = &measured.passages[depth];
            shares.at(row).to_bits() == measured.share(depth + 1).to_bits()
                && onwards.at(row).to_bits() == passage.onward.to_bits()
                && backs.at(row).to_bits() == passage.back.to_bits()
        });
        let kept = kept && kept_lights.at(chain) == measured.kept_light;
        let target = value.filter(|_| kept).map_or(f32::NAN, chainlight::path::target_of);
        targets.put(chain, target);
    }
}

/// The plan of a test, with that at the end of its steps.
fn measuring(mut plan: Plan) -> Plan {
    let system = system!(Place::Stage(Stage::Splat), measure_again).in_phases(Phases::STEP);
    plan.tile.systems.push(SystemPlan::new(system, "planted"));
    plan
}

/// Chains whose target is not that of their path.
fn off(render: &ChainRender) -> usize {
    let (again, kept) = (column::<ProposedTarget>(render), column::<Target>(render));
    let pairs = again.iter().zip(&kept);
    pairs.filter(|(again, kept)| again.to_bits() != kept.to_bits()).count()
}

/// Coats over colours and checks, glass, frosted glass, gold and a mirror between lamps of all kinds.
fn coats() -> Arc<Scene> {
    as_written(
        r#"(version: 1, settings: (max_depth: 14),
          camera: ThinLens(origin: (0, 1.5, 4), target: (0, 0.6, 0), fov: 45, aperture_radius: 0.05, focus_distance: 4),
          film: (width: 16, height: 16, filter: Gaussian(radius: 1.5, sigma: 0.5)),
          textures: { "checks": Checkerboard(scale: (6, 6)) },
          materials: {
              "coat": Plastic(interior_ior: 1.9, diffuse_reflectance: "checks"),
              "lacquer": Plastic(diffuse_reflectance: (0.7, 0.3, 0.2), nonlinear: true),
              "gold": RoughConductor(metal: "Au", alpha_u: 0.1, alpha_v: 0.3),
              "frosted": RoughDielectric(interior_ior: 1.5, alpha: 0.1),
              "glass": Dielectric(interior_ior: 1.5),
              "mirror": Conductor(eta: (0, 0, 0), k: (1, 1, 1)),
              "lamp": Diffuse(reflectance: (0, 0, 0)),
          },
          lights: [
              Point(position: (1, 2.5, 1), intensity: (3, 3, 2)),
              Directional(direction: (0.3, -1, -0.2), irradiance: (0.5, 0.5, 0.6)),
              Environment(radiance: (0.2, 0.3, 0.4)),
          ],
          shapes: [
              (shape: Quad(corner: (-3, 0, 3), edge_u: (6, 0, 0), edge_v: (0, 0, -6)), material: "coat"),
              (shape: Quad(corner: (-3, 0, -2), edge_u: (6, 0, 0), edge_v: (0, 4, 0)), material: "lacquer"),
              (shape: Quad(corner: (-3, 0, 3), edge_u: (0, 0, -6), edge_v: (0, 4, 0)), material: "mirror"),
              (shape: Sphere(center: (-0.8, 0.6, 0), radius: 0.6), material: "glass"),
              (shape: Quad(corner: (3, 0, 3), edge_u: (0, 4, 0), edge_v: (0, 0, -6)), material: "gold"),
              (shape: Sphere(center: (0.8, 0.6, 0), radius: 0.6), material: "frosted"),
              (shape: Quad(corner: (-1, 3, 1), edge_u: (0, 0, -2), edge_v: (2, 0, 0)), material: "lamp", emission: (2, 2, 2)),
          ])"#,
    )
}

#[test]
fn the_current_path_measured_again_is_worth_what_its_chain_says() {
    let scenes = [
        ("coats", coats()),
        ("glass", shipped("cornell-glass.ron", 16)),
        ("gloss", shipped("cornell-glossy.ron", 16)),
        ("window", shipped("cornell-window.ron", 16)),
    ];
    for (name, scene) in scenes {
        let chains = paths(2, 128, 1 << 13);
        let mut render = chains.start_as(&scene, measuring(chains.plan(&scene)));
        let seeds = column::<Target>(&render);
        for burst in [1, 1, 1, 97, 100, 100] {
            render.run.burst(burst, &|_| {});
            assert_eq!(off(&render), 0, "{name}, after {} steps", render.run.steps());
        }
        let now = column::<Target>(&render);
        let moved = now.iter().zip(&seeds).filter(|(now, seed)| now != seed).count();
        assert!(moved > 200, "{name}: {moved} chains of 256 moved");

        // The planted mistake: a vertex of another path is left behind.
        render.run.for_each_tile(&mut |chains, tile| {
            let mut positions = tile.all::<chainlight::path::VertexPosition, PathTable>();
            positions[..chains.len()].rotate_left(1);
            let lights_from = tile.world().resource::<TilePlace>().lights_from as usize;
            positions[lights_from..lights_from + chains.len()].rotate_left(1);
            tile.write::<chainlight::path::VertexPosition, PathTable>(&positions);
        });
        render.run.burst(1, &|_| {});
        assert!(off(&render) > 100, "{name}: vertices of other paths go unnoticed");
    }
}
