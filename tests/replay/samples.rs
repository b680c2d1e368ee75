//! Replays of independent samples.

use super::{SEED, SIZE, look, scene, summed};
use chainlight::path::{ChainTable, Contribution};
use chainlight::plan::{Plan, Technique};
use chainlight::render::{Render, Rendering};
use std::sync::Arc;

#[test]
fn a_pixels_sample_is_the_one_that_the_render_took() {
    let scene = scene();
    let whole_film = SIZE * SIZE;
    let plan = Plan::new(&scene, Technique::Pt, Some(whole_film));
    let mut render = Render::new(Arc::clone(&scene), plan, SEED, 1).expect("a small film");
    assert_eq!(render.tile_count(), 1);
    let mut lit = 0;
    for step in 0..4 {
        render.burst(1, &|_| ());
        for pixel in (0..whole_film).step_by(37) {
            let mut taken = None;
            render.for_each_world(&mut |_, world| taken = world.at::<Contribution, ChainTable>(pixel as usize));
            let taken = taken.expect("a sample").to_array().map(f32::to_bits);
            for tile in [None, Some(16)] {
                let replay = look(&scene, &Plan::new(&scene, Technique::Pt, tile), pixel, step);
                let booked = replay.proposal.booked.expect("samples are booked").to_array();
                assert_eq!(booked.map(f32::to_bits), taken, "pixel {pixel}, sample {step}");
                let light = replay
                    .proposal
                    .contribution
                    .expect("light")
                    .to_array()
                    .map(f32::to_bits);
                assert_eq!(light, taken, "pixel {pixel}, sample {step}");
                assert_eq!(summed(&replay).map(f32::to_bits), taken, "pixel {pixel}, sample {step}");
                let start = replay.proposal.film.expect("a start");
                assert_eq!(start.pixel, [pixel % SIZE, pixel / SIZE]);
                assert!(replay.before.is_none() && replay.decision.is_none() && replay.after.is_none());
            }
            lit += usize::from(taken != [0; 3]);
        }
    }
    assert!(lit > 20, "{lit} samples have light");
}

#[test]
fn vertices_lie_on_the_shapes_that_they_name() {
    let scene = scene();
    let plan = Plan::new(&scene, Technique::Pt, None);
    let (mut spheres, mut discrete) = (0, 0);
    for pixel in 0..SIZE * SIZE {
        for vertex in &look(&scene, &plan, pixel, 0).proposal.vertices[1..] {
            let surface = vertex.surface.as_ref().expect("on a surface");
            let material = surface.material.as_deref().expect("a material");
            match surface.shape.as_deref().expect("a shape") {
                "silver sphere" => {
                    assert_eq!(material, "silver");
                    spheres += 1;
                }
                "glass sphere" => assert_eq!(material, "glass"),
                "floor" | "ceiling" | "back wall" => assert!(["white", "light"].contains(&material), "{material}"),
                _ => {}
            }
            if vertex.kind == "discrete" {
                assert!(["silver", "glass"].contains(&material));
                discrete += 1;
            }
        }
    }
    assert!(spheres > 10 && discrete > 20, "{spheres} {discrete}");
}
