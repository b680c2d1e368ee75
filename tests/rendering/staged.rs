//! The staged path tracer against the depth-first one. With the same seed both draw the same numbers for the same
//! purposes, so they must find the same light bit for bit: a far sharper oracle than any statistics.

use super::{picture, shipped};
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
