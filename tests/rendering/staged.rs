//! The staged path tracer against the depth-first one. With the same seed both draw the same numbers for the same
//! purposes, so they must find the same light bit for bit: a far sharper oracle than any statistics.

use super::{picture, shipped};
use crate::support::scenes::inline;
use chainlight::film::Picture;
use chainlight::plan::Technique;
use chainlight::render::Rendering;

fn bits(picture: &Picture) -> Vec<[u32; 3]> {
    picture.rgb.iter().map(|rgb| rgb.to_array().map(f32::to_bits)).collect()
}

#[test]
fn staged_and_depth_first_find_the_same_light_bit_for_bit() {
    for scene in ["cornell-box.ron", "cornell-glass.ron"] {
        let scene = shipped(scene, 40);
        let staged = picture(&scene, Technique::Pt, 7, 24);
        let depth_first = picture(&scene, Technique::PtReference, 7, 24);
        assert!(staged.rgb.iter().any(|rgb| !rgb.is_black()));
        assert_eq!(bits(&staged), bits(&depth_first));
        assert_eq!(staged.error, depth_first.error);
    }
}

/// Every model of materials, in a lit box.
const SHELF: &str = r#"(
    version: 1,
    camera: Perspective(origin: (0, 1.5, 5), target: (0, 0.8, 0), fov: 50),
    film: (width: 40, height: 40),
    materials: {
        "gold": RoughConductor(metal: "Au", alpha: 0.15),
        "brushed": RoughConductor(metal: "Al", alpha_u: 0.05, alpha_v: 0.3, distribution: Beckmann),
        "frosted": RoughDielectric(interior_ior: 1.5, alpha: 0.1),
        "ball": Plastic(diffuse_reflectance: (0.7, 0.1, 0.1), nonlinear: true),
        "copper": Conductor(metal: "Cu"),
        "glass": Dielectric(interior_ior: 1.5),
        "white": Diffuse(reflectance: (0.7, 0.7, 0.7), two_sided: false),
        "dark": Diffuse(reflectance: (0.2, 0.3, 0.5)),
        "sheet": TwoSided(front: "dark", back: "white"),
    },
    shapes: [
        (shape: Quad(corner: (-6, 0, -6), edge_u: (0, 0, 12), edge_v: (12, 0, 0)), material: "brushed"),
        (shape: Quad(corner: (-6, 0, -2), edge_u: (0, 6, 0), edge_v: (12, 0, 0)), material: "sheet"),
        (shape: Sphere(center: (-1.8, 0.6, 0), radius: 0.6), material: "gold"),
        (shape: Sphere(center: (-0.6, 0.6, 0.4), radius: 0.6), material: "frosted"),
        (shape: Sphere(center: (0.6, 0.6, 0.4), radius: 0.6), material: "ball"),
        (shape: Sphere(center: (1.8, 0.6, 0), radius: 0.6), material: "copper"),
        (shape: Sphere(center: (0, 1.7, 0), radius: 0.4), material: "glass"),
        (shape: Quad(corner: (-2, 4, -1), edge_u: (4, 0, 0), edge_v: (0, 0, 3)), material: "white", emission: (6, 6, 6)),
    ],
)"#;

#[test]
fn every_model_scatters_alike_in_stages_and_depth_first() {
    let scene = inline(SHELF, 40);
    let staged = picture(&scene, Technique::Pt, 11, 16);
    let depth_first = picture(&scene, Technique::PtReference, 11, 16);
    assert!(staged.rgb.iter().filter(|rgb| !rgb.is_black()).count() > 1200);
    assert!(staged.rgb.iter().all(|rgb| rgb.is_finite()));
    assert_eq!(bits(&staged), bits(&depth_first));
}

#[test]
fn both_count_the_same_rays() {
    let scene = shipped("cornell-glass.ron", 24);
    let counted = [Technique::Pt, Technique::PtReference].map(|technique| {
        let mut render = super::start(&scene, technique, 3, 1, None);
        render.burst(8, &|_| {});
        let counters = render.counters();
        assert_eq!(
            counters.decisions,
            8 * 24 * 24,
            "every chain decides exactly once a step"
        );
        assert_eq!(counters.non_finite, 0);
        (counters.rays, counters.segments, counters.vertices)
    });
    assert_eq!(counted[0], counted[1]);
}
