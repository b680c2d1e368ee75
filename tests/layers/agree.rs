//! All techniques have the same light in every layer: each tells layers in its own way, from vertices that it found from its own end.
//!
//! Means of layers over 16 runs by Student's t with Welch's degrees of freedom; all comparisons of a scene are one family with a
//! significance of 1 %, and the smallest bias that is seen is stated. The same test refuses layers whose expressions confuse reflection with
//! transmission, and the camera's end with the light's.

use super::{begun, plan};
use crate::support::scenes::{glass_under_wide_lamp, inline};
use crate::support::verdict::{ALPHA, POWER, say};
use chainlight::layer::Layers;
use chainlight::plan::{Base, Technique};
use chainlight::scene::Scene;
use chainlight::stats::comparison::compare;
use chainlight::stats::normal::{sidak, upper_quantile};
use chainlight::stats::student::t_quantile;
use chainlight::stats::z_test::Estimate;
use rayon::prelude::*;
use std::sync::Arc;

const RUNS: u64 = 16;

/// Techniques that see all of it, with samples or steps a run.
const TECHNIQUES: [(Technique, Base, u64); 5] = [
    (Technique::Pt, Base::Pt, 400),
    (Technique::Bdpt, Base::Pt, 100),
    (Technique::Pssmlt, Base::Pt, 600),
    (Technique::Pssmlt, Base::Bdpt, 250),
    (Technique::Mlt, Base::Pt, 900),
];

/// Of every layer, the estimate of its mean over runs.
fn means(scene: &Arc<Scene>, (technique, base, steps): (Technique, Base, u64), layers: &Arc<Layers>) -> Vec<Estimate> {
    let run = |seed| {
        let mut render = begun(scene, plan(scene, (technique, base), Some(Arc::clone(layers))), seed, 1);
        render.burst(steps, &|_| {});
        let mean = |rgb: &[chainlight::color::Rgb]| {
            let channels = rgb.iter().flat_map(|rgb| rgb.to_array());
            channels.map(f64::from).sum::<f64>() / (3 * rgb.len()) as f64
        };
        render.layers().iter().map(|layer| mean(&layer.rgb)).collect::<Vec<_>>()
    };
    let runs: Vec<Vec<f64>> = (0..RUNS).into_par_iter().map(run).collect();
    let layer = |layer: usize| Estimate::of(&runs.iter().map(|run| run[layer]).collect::<Vec<_>>());
    (0..layers.len()).map(layer).collect()
}

/// How many layers differ, and the smallest relative bias that every comparison sees, by layer.
fn differing(a: &[Estimate], b: &[Estimate], tests: usize) -> (usize, Vec<f64>) {
    let freedom = [RUNS as f64 - 1.0; 2];
    let compared = a.iter().zip(b).map(|(&a, &b)| (compare(a, b, freedom), b.mean));
    let (mut failures, mut visible) = (0, Vec::new());
    for (test, mean) in compared {
        failures += usize::from(!test.passes(ALPHA, tests));
        let threshold = t_quantile(1.0 - 0.5 * sidak(ALPHA, tests), test.degrees_of_freedom);
        visible.push(test.error * (threshold + upper_quantile(1.0 - POWER)) / mean);
    }
    (failures, visible)
}

/// Holds that all techniques have the same light in every layer, and that the comparisons see the bias `sees` of every one; that
/// `mistaken`, layers of the same number whose expressions are wrong, have another.
fn agree(case: &str, scene: &Arc<Scene>, layers: &[(&str, &str)], mistaken: &[(&str, &str)], sees: f64) {
    let layers = Arc::new(Layers::new(layers.iter().copied()).expect("expressions"));
    layers.refuse_black(scene).expect("every layer has paths");
    let tests = (TECHNIQUES.len() - 1) * layers.len();
    let reference = means(scene, TECHNIQUES[1], &layers);
    for technique in TECHNIQUES {
        if technique.0 == Technique::Bdpt {
            continue;
        }
        let found = means(scene, technique, &layers);
        let (failures, visible) = differing(&found, &reference, tests);
        let seen = layers
            .names()
            .iter()
            .zip(&visible)
            .map(|(name, bias)| format!("{name} {:.1} %", 100.0 * bias));
        let seen: Vec<String> = seen.collect();
        say(&format!(
            "{case}, {} over {}: sees {}",
            technique.0,
            technique.1,
            seen.join(", ")
        ));
        assert_eq!(failures, 0, "{case}, {technique:?}: {found:?} {reference:?}");
        // The last layer is that of the rest, which may be empty.
        let last = visible.len() - 1;
        assert!(
            visible[..last].iter().all(|&bias| bias < sees),
            "{case}, {technique:?}: {visible:?}"
        );
    }
    let mistaken = Arc::new(Layers::new(mistaken.iter().copied()).expect("expressions"));
    let (failures, _) = differing(&means(scene, TECHNIQUES[0], &mistaken), &reference, tests);
    assert!(failures > 0, "{case}: mistaken layers go unnoticed");
}

#[test]
fn behind_smooth_glass() {
    agree(
        "glass under a wide lamp",
        &glass_under_wide_lamp(16, 6),
        &[
            ("emitted", "CL"),
            ("mirrored", "C<RS>.*L"),
            ("through", "C<TS>+.*L"),
            ("direct", "CDL"),
            ("caustic", "CD<TS>+L"),
            ("diffuse", "CDD+L"),
        ],
        &[
            ("emitted", "CL"),
            ("mirrored", "C<TS>.*L"),
            ("through", "C<RS>+.*L"),
            ("direct", "CDL"),
            ("caustic", "CD<TS>+L"),
            ("diffuse", "CDD+L"),
        ],
        0.35,
    );
}

#[test]
fn under_lights_of_all_kinds() {
    let scene = inline(
        r#"(version: 1, settings: (max_depth: 4),
        camera: Perspective(origin: (1.5, 3, 4), target: (0, 0.3, 0), fov: 30),
        film: (width: 16, height: 16),
        materials: {
            "white": Diffuse(reflectance: (0.7, 0.7, 0.7)),
            "gold": RoughConductor(metal: "Au", alpha: 0.3),
            "frost": RoughDielectric(interior_ior: 1.5, alpha: 0.4),
        },
        lights: [
            Point(position: (1.6, 1.8, 0.8), intensity: (3, 2.5, 2)),
            Environment(radiance: (0.2, 0.25, 0.3)),
        ],
        shapes: [
            (shape: Quad(corner: (-2, 0, 2), edge_u: (4, 0, 0), edge_v: (0, 0, -4)), material: "white"),
            (shape: Box(min: (-0.9, 0, -0.6), max: (-0.1, 0.9, 0.2)), material: "gold"),
            (shape: Sphere(center: (0.5, 0.45, 0.2), radius: 0.45), material: "frost"),
            (shape: Sphere(center: (-1.2, 1.6, 1), radius: 0.25), material: "white", emission: (10, 9, 8)),
        ])"#,
        16,
    );
    agree(
        "lights of all kinds",
        &scene,
        &[
            ("point", "C.P"),
            ("surroundings", "CDB"),
            ("lamp", "C.O"),
            ("frosted", "C<TG>.*B"),
            ("polished", "C<RG>+.*[OBP]"),
            ("last_glossy", "C.*D[GS]L"),
        ],
        &[
            ("point", "C.P"),
            ("surroundings", "CDB"),
            ("lamp", "C.O"),
            ("frosted", "C<TG>.*B"),
            ("polished", "C<RG>+.*[OBP]"),
            ("last_glossy", "C[GS]D.*L"),
        ],
        0.35,
    );
}
