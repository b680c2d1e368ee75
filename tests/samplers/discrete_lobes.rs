//! Discrete lobes asked for by name: bit for bit what sampling gives where it draws them.

use crate::support::draws::stream;
use crate::support::scenes::inline;
use chainlight::material::{DiscreteLobe, MaterialKind, ScatterDraw, Scattered, Transport};
use chainlight::scene::Scene;
use glam::{Vec2, Vec3};
use std::collections::BTreeSet;
use std::sync::Arc;

const SAMPLES: usize = 4000;

const MATERIALS: [&str; 11] = [
    "Diffuse(reflectance: (0.6, 0.4, 0.2))",
    "Conductor(metal: \"Ag\")",
    "Conductor(metal: \"Au\", two_sided: false)",
    "RoughConductor(metal: \"Cu\", alpha: 0.1)",
    "Dielectric(interior_ior: 1.5)",
    "Dielectric(interior_ior: 1.00001)",
    "Dielectric(interior_ior: 2.4, transmittance: (0.7, 0.9, 0.8))",
    "RoughDielectric(interior_ior: 1.5, alpha: 0.2)",
    "Plastic(diffuse_reflectance: (0.1, 0.3, 0.6))",
    "Plastic(interior_ior: 1.6, specular_reflectance: (0.5, 0.2, 0.1), nonlinear: true)",
    "Plastic(diffuse_reflectance: (1, 0, 0), two_sided: false)",
];

/// A scene with every material.
fn scene() -> Arc<Scene> {
    let numbered = || MATERIALS.iter().enumerate();
    let materials: String = numbered()
        .map(|(i, material)| format!("\"m{i}\": {material}, "))
        .collect();
    let quad = "Quad(corner: (0, 0, 0), edge_u: (1, 0, 0), edge_v: (0, 1, 0))";
    let shapes: String = numbered()
        .map(|(i, _)| format!("(shape: {quad}, material: \"m{i}\", transform: [Translate((0, 0, {i}))]), "))
        .collect();
    let text = format!(
        "(version: 1, camera: Perspective(origin: (0, 0, -9), target: (0, 0, 0), fov: 40), film: (width: 4, height: 4),
          lights: [Environment(radiance: (1, 1, 1))], materials: {{{materials}}}, settings: (max_depth: 4, technique: \"pt\"), shapes: [{shapes}])"
    );
    inline(&text, 4)
}

/// Every bit of a sample.
fn bits(sample: &Scattered) -> Vec<u32> {
    let (wo, ratio) = (sample.wo.to_array(), sample.ratio.to_array());
    let rest = [sample.density, sample.reverse, sample.relative_ior];
    wo.into_iter().chain(ratio).chain(rest).map(f32::to_bits).collect()
}

fn lobe(wi: Vec3, wo: Vec3) -> DiscreteLobe {
    if (wi.z > 0.0) == (wo.z > 0.0) {
        DiscreteLobe::Reflection
    } else {
        DiscreteLobe::Refraction
    }
}

#[test]
fn discrete_lobes_of_every_material_are_what_sampling_draws() {
    let scene = scene();
    let materials = &scene.materials;
    let mut stream = stream(1);
    let mut drawn = BTreeSet::new();
    for material in 0..materials.len() as u32 {
        for _ in 0..SAMPLES {
            let [a, b, c, direction, height, lobe_draw] = std::array::from_fn(|_| stream.next_f32());
            let (uv, wi) = (
                Vec2::new(a, b),
                Vec3::new(c - 0.5, direction - 0.5, 2.0 * height - 1.0).normalize(),
            );
            let draw = ScatterDraw {
                direction: [stream.next_f32(), stream.next_f32()],
                lobe: lobe_draw,
            };
            for transport in [Transport::Radiance, Transport::Importance] {
                let Some(sample) = materials
                    .sample(material, uv, wi, draw, transport)
                    .filter(|s| s.discrete)
                else {
                    continue;
                };
                let lobe = lobe(wi, sample.wo);
                let asked = materials
                    .discrete(material, uv, wi, lobe, transport)
                    .expect("a lobe that is drawn");
                assert_eq!(
                    bits(&asked),
                    bits(&sample),
                    "{}: {asked:?} {sample:?}",
                    materials.name(material)
                );
                drawn.insert((materials.kind(material), lobe == DiscreteLobe::Refraction));
            }
        }
    }
    let expected = [
        (MaterialKind::Conductor, false),
        (MaterialKind::Dielectric, false),
        (MaterialKind::Dielectric, true),
        (MaterialKind::Plastic, false),
    ];
    assert_eq!(drawn, BTreeSet::from(expected));
}

#[test]
fn probabilities_of_discrete_lobes_are_those_of_all_that_can_be_drawn() {
    let scene = scene();
    let materials = &scene.materials;
    let mut stream = stream(2);
    for material in 0..materials.len() as u32 {
        let kind = materials.kind(material);
        for _ in 0..SAMPLES {
            let [a, b, c, d, z] = std::array::from_fn(|_| stream.next_f32());
            let (uv, wi) = (Vec2::new(a, b), Vec3::new(c - 0.5, d - 0.5, 2.0 * z - 1.0).normalize());
            let probability = |lobe| {
                let found = materials.discrete(material, uv, wi, lobe, Transport::Radiance);
                found.map_or(0.0, |found| found.density)
            };
            let sum = probability(DiscreteLobe::Reflection) + probability(DiscreteLobe::Refraction);
            let draw = ScatterDraw {
                direction: [0.5; 2],
                lobe: 0.5,
            };
            match kind {
                MaterialKind::Plastic => assert!((0.0..1.0).contains(&sum), "{sum}"),
                _ if !kind.is_discrete() => assert_eq!(sum, 0.0, "{kind:?}"),
                // A one-sided mirror's back is black.
                _ if materials.sample(material, uv, wi, draw, Transport::Radiance).is_none() => assert_eq!(sum, 0.0),
                _ => assert!((sum - 1.0).abs() < 1e-6, "{kind:?}: {sum}"),
            }
        }
    }
}

/// What is said of a kind of material decides where subpaths end and how long direct light's paths are.
#[test]
fn kinds_of_materials_say_whether_they_have_discrete_lobes() {
    let scene = scene();
    let materials = &scene.materials;
    let mut kinds = [0, 0];
    for material in 0..materials.len() as u32 {
        let wi = Vec3::new(0.6, 0.0, 0.8);
        let found = [DiscreteLobe::Reflection, DiscreteLobe::Refraction]
            .into_iter()
            .any(|lobe| {
                let scattered = materials.discrete(material, Vec2::ZERO, wi, lobe, Transport::Radiance);
                scattered.is_some()
            });
        assert_eq!(found, materials.kind(material).has_discrete_lobe(), "{material}");
        kinds[usize::from(found)] += 1;
    }
    assert!(kinds.into_iter().all(|number| number > 2), "{kinds:?}");
}
