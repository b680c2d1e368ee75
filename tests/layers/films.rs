//! What films of layers hold.

use super::{TECHNIQUES, begun, plan, standard_layers, tiled};
use crate::support::render::picture_bytes;
use crate::support::scenes::shipped;
use chainlight::color::Rgb;
use chainlight::film::Picture;
use chainlight::render::{LayerFinding, Rendering, resume};

/// Layers are rounded apart from the picture: by factors of 32 bits on the way to their films, and when they are written. Relative to the
/// pixel.
const ROUNDING: f64 = 16.0 / (1 << 23) as f64;
/// Films are in fixed point, those of layers and those of the picture. Relative to the brightest pixel.
const RESOLUTION: f64 = 1.0 / (1_u64 << 38) as f64;

/// The largest difference between the sum of the layers and the picture, relative to the pixel, that the films' resolution does not explain.
fn difference(layers: &[LayerFinding], picture: &Picture) -> f64 {
    let pixels = picture.rgb.iter().enumerate();
    let all = picture.rgb.iter().flat_map(|rgb| rgb.to_array());
    let explained = RESOLUTION * all.map(f64::from).fold(0.0, f64::max);
    let of_pixel = |(pixel, rgb): (usize, &Rgb)| {
        let channels = rgb.to_array().into_iter().enumerate();
        let differences = channels.map(|(channel, value)| {
            let parts = layers
                .iter()
                .map(|layer| f64::from(layer.rgb[pixel].to_array()[channel]));
            let (sum, value) = (parts.sum::<f64>(), f64::from(value));
            ((sum - value).abs() - explained).max(0.0) / value.abs().max(f64::MIN_POSITIVE)
        });
        differences.fold(0.0, f64::max)
    };
    pixels.map(of_pixel).fold(0.0, f64::max)
}

#[test]
fn layers_sum_to_the_picture_and_do_not_change_it() {
    for name in ["cornell-glass.ron", "island.ron", "veach-plates.ron"] {
        let scene = shipped(name, 24);
        for (technique, base) in TECHNIQUES {
            let case = format!("{name}, {technique} over {base}");
            let mut whole = begun(&scene, plan(&scene, (technique, base), None), 3, 1);
            let mut split = begun(&scene, plan(&scene, (technique, base), standard_layers(&scene)), 3, 2);
            // One film of layers more than once, and some not at all.
            let steps = if technique.has_chains() { 300 } else { 19 };
            whole.burst(steps, &|_| {});
            split.burst(steps, &|_| {});
            let picture = split.picture();
            assert!(
                picture_bytes(&picture) == picture_bytes(&whole.picture()),
                "{case}: layers change the picture"
            );
            assert!(whole.layers().is_empty());
            let layers = split.layers();
            assert!(picture.rgb.iter().any(|rgb| !rgb.is_black()), "{case} is black");
            let off = difference(&layers, &picture);
            assert!(off < ROUNDING, "{case}: layers are off by {off:e}");
            let sum = |of: &dyn Fn(&LayerFinding) -> f64| layers.iter().map(of).sum::<f64>();
            assert!((sum(&|layer| layer.record.light_share) - 1.0).abs() < 1e-6, "{case}");
            assert!((sum(&|layer| layer.record.error_share) - 1.0).abs() < 1e-9, "{case}");
            assert!(sum(&|layer| layer.record.time_share) <= 1.0 + 1e-9, "{case}");
            // The largest layer but one, forgotten, shows.
            let mut by_light = layers.clone();
            by_light.sort_by(|a, b| b.record.light_share.total_cmp(&a.record.light_share));
            assert!(by_light[1].record.light_share > 0.0, "{case} has one layer");
            by_light.remove(1);
            assert!(
                difference(&by_light, &picture) > ROUNDING,
                "{case}: a lost layer goes unnoticed"
            );
        }
    }
}

#[test]
fn threads_tiles_and_bursts_do_not_show_in_layers() {
    let scene = shipped("cornell-glass.ron", 20);
    for technique in TECHNIQUES {
        let light = |threads, tile, bursts: &[u64]| {
            let plan = tiled(&scene, technique, standard_layers(&scene), tile);
            let mut render = begun(&scene, plan, 5, threads);
            bursts.iter().for_each(|&steps| render.burst(steps, &|_| {}));
            let layers = render.layers();
            layers.into_iter().map(|layer| layer.rgb).collect::<Vec<_>>()
        };
        let expected = light(1, None, &[20]);
        assert!(expected == light(2, Some(16), &[7, 13]), "{technique:?}");
        assert!(
            expected != light(1, None, &[19]),
            "{technique:?}: another step changes nothing"
        );
    }
}

#[test]
fn saved_layers_go_on_as_if_nothing_had_happened() {
    let scene = shipped("cornell-glass.ron", 16);
    for technique in TECHNIQUES {
        let plan = || plan(&scene, technique, standard_layers(&scene));
        let light = |render: &dyn Rendering| render.layers().into_iter().map(|layer| layer.rgb).collect::<Vec<_>>();
        let mut whole = begun(&scene, plan(), 7, 1);
        whole.burst(20, &|_| {});
        let saved = whole.save();
        whole.burst(11, &|_| {});
        let mut taken_up = resume(scene.clone(), plan(), 7, 2, &saved).expect("what was saved");
        taken_up.burst(11, &|_| {});
        assert!(light(&*whole) == light(&*taken_up), "{technique:?}");
        let other = super::plan(&scene, technique, None);
        let refused = resume(scene.clone(), other, 7, 1, &saved)
            .err()
            .expect("another render");
        assert!(
            refused
                .to_string()
                .contains("the layer emitted is C[OP] there, and absent here"),
            "{refused}"
        );
    }
}
