//! Light of one colour alone, and colours that no channel has: the target counts every channel, so that chains find a blue lamp as
//! they find a white one, in its own colour, whatever luminance would weigh it with.

use super::paths;
use crate::support::scenes::as_written;
use crate::support::verdict::Family;
use chainlight::render::Rendering;
use chainlight::scene::Scene;
use chainlight::stats::z_test::Estimate;
use std::sync::Arc;

const RUNS: u64 = 40;

/// A grey floor between a lamp of each primary colour, as bright as asked for.
fn scene(lamps: [f32; 3]) -> Arc<Scene> {
    let lamp = |channel: usize| {
        let mut emission = [0.0; 3];
        emission[channel] = lamps[channel];
        let x = channel as f32 * 2.0 - 3.0;
        format!(
            "(shape: Quad(corner: ({x}, 2, 1), edge_u: (0, 0, -2), edge_v: (2, 0, 0)), material: \"lamp\",
              emission: ({}, {}, {})),",
            emission[0], emission[1], emission[2]
        )
    };
    as_written(&format!(
        "(version: 1, settings: (max_depth: 3),
          camera: Perspective(origin: (0, 1.5, 4), target: (0, 0, 0), fov: 40),
          film: (width: 4, height: 4),
          materials: {{
              \"grey\": Diffuse(reflectance: (0.5, 0.5, 0.5)),
              \"lamp\": Diffuse(reflectance: (0, 0, 0)),
          }},
          shapes: [
              (shape: Quad(corner: (-9, 0, 9), edge_u: (18, 0, 0), edge_v: (0, 0, -18)), material: \"grey\"),
              {}{}{}
          ])",
        lamp(0),
        lamp(1),
        lamp(2)
    ))
}

fn means(lamps: [f32; 3]) -> [Estimate; 3] {
    let scene = scene(lamps);
    let mut values: [Vec<f64>; 3] = Default::default();
    for seed in 1..=RUNS {
        let render = paths(1, 256, 1 << 13).seeded(seed).run(&scene, 40);
        let picture = render.picture();
        for (channel, values) in values.iter_mut().enumerate() {
            let sum: f64 = picture.rgb.iter().map(|c| f64::from(c.to_array()[channel])).sum();
            values.push(sum / picture.rgb.len() as f64);
        }
    }
    values.map(|values| Estimate::of(&values))
}

#[test]
fn a_dim_blue_lamp_between_bright_ones_has_its_light() {
    let family = Family { tests: 2 };
    let (alone, among) = (means([0.0, 0.0, 1.0]), means([1.0, 1.0, 0.1]));
    assert_eq!([alone[0].mean, alone[1].mean], [0.0, 0.0], "there is no other light");
    assert!(alone[2].mean > 0.0);
    let both = Estimate {
        mean: 10.0 * among[2].mean,
        error: libm::hypot(10.0 * among[2].error, alone[2].error),
    };
    family.is("blue among others, times ten", both, alone[2].mean, 0.0, 0.2);
    family.is_not("as much as luminance leaves of it", both, 0.7 * alone[2].mean, 0.0);
}
