//! The edges of the film: perturbations that leave it fail, and light that falls beside it counts for pixels whose filters reach there.
//! If any of that were forgotten, pixels at the edges would be too dark or too bright.

use super::paths;
use crate::support::scenes::as_written;
use crate::support::verdict::Family;
use chainlight::render::Rendering;
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use std::sync::Arc;

const SIDE: usize = 6;
const RUNS: u64 = 60;

/// A floor that fills the film, lit evenly from all sides: every pixel has the same radiance, whatever its filter.
fn scene(filter: &str) -> Arc<Scene> {
    as_written(&format!(
        "(version: 1, settings: (max_depth: 3),
          camera: Perspective(origin: (0, 0, 2), target: (0, 0, 0), up: (0, 1, 0), fov: 60),
          film: (width: {SIDE}, height: {SIDE}, filter: {filter}),
          materials: {{\"grey\": Diffuse(reflectance: (0.5, 0.5, 0.5))}},
          lights: [Environment(radiance: (1, 1, 1))],
          shapes: [(shape: Quad(corner: (-9, -9, 0), edge_u: (18, 0, 0), edge_v: (0, 18, 0)), material: \"grey\")])"
    ))
}

#[test]
fn pixels_at_the_edges_of_the_film_are_as_bright_as_those_in_the_middle() {
    let filters = [
        "Box(radius: 0.5)",
        "Tent(radius: 1.0)",
        "Gaussian(radius: 1.5, sigma: 0.5)",
    ];
    let family = Family {
        tests: filters.len() * 3,
    };
    for filter in filters {
        let scene = scene(filter);
        let pictures: Vec<Vec<f64>> = (1..=RUNS)
            .map(|seed| {
                let render = paths(1, 64, 1 << 12).seeded(seed).run(&scene, 40);
                render
                    .picture()
                    .rgb
                    .iter()
                    .map(|c| f64::from(c.to_array()[1]))
                    .collect()
            })
            .collect();
        let mean_where = |is_here: fn(bool, bool) -> bool| {
            let edge = |i: usize| i == 0 || i == SIDE - 1;
            let here: Vec<usize> = (0..SIDE * SIDE)
                .filter(|&pixel| is_here(edge(pixel % SIDE), edge(pixel / SIDE)))
                .collect();
            let of = |picture: &Vec<f64>| here.iter().map(|&pixel| picture[pixel]).sum::<f64>() / here.len() as f64;
            Estimate::of(&pictures.iter().map(of).collect::<Vec<f64>>())
        };
        family.is(&format!("{filter}, corners"), mean_where(|x, y| x && y), 0.5, 0.0, 0.2);
        let edges = mean_where(|x, y| x != y);
        family.is(&format!("{filter}, edges"), edges, 0.5, 0.0, 0.1);
        family.is_not(&format!("{filter}, edges 12 % darker"), edges, 0.5 / 0.88, 0.0);
        family.is(&format!("{filter}, inside"), mean_where(|x, y| !x && !y), 0.5, 0.0, 0.1);
    }
}
