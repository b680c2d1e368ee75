//! Light that a technique cannot find in a scene, however long it renders.
//!
//! Light tracing joins paths from lights to the lens. Where the last vertex before the lens scatters into a single direction
//! (a mirror, smooth glass, an interface of index 1.00001 too), no join can hit it; and a light at infinity has no point
//! that could be joined. So its picture is black where the camera sees such surfaces or surroundings, and right everywhere
//! else. How much of the picture that is, a grid of rays through the film tells.

use super::Technique;
use crate::color::Rgb;
use crate::geometry::{
    Hit, HitColumns, HitDistance, HitInstance, HitPrimitive, HitUv, NO_HIT, RayColumns, RayDirection, RayOrigin,
};
use crate::material::MaterialKind;
use crate::path::LENS_CENTER;
use crate::scene::Scene;
use crate::table::{LANES, Rows};
use bytemuck::Zeroable;
use glam::Vec2;
use std::fmt;

/// Rays along a side of the film that are looked along.
const RAYS_PER_SIDE: usize = 64;
const RAYS: usize = RAYS_PER_SIDE * RAYS_PER_SIDE;

/// Light that a technique cannot find.
#[derive(Clone, Debug, PartialEq)]
pub struct Missing {
    /// Which.
    pub what: String,
    /// The share of the film where the camera sees it, from a grid of rays; 0 if it is smaller than that grid can tell.
    pub share: f64,
    /// Techniques that find it.
    pub found_by: &'static str,
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, share, found_by } = self;
        if *share > 0.0 {
            write!(f, "{what}, in {:.2} % of the picture; {found_by}", 100.0 * share)
        } else {
            write!(
                f,
                "{what}, though none of {RAYS} rays from the camera meets it; {found_by}"
            )
        }
    }
}

/// What `technique` cannot find in `scene`.
pub(super) fn missing(scene: &Scene, technique: Technique) -> Vec<Missing> {
    if technique != Technique::Lt || scene.lights.is_empty() {
        return Vec::new();
    }
    let seen = Seen::new(scene);
    let share = |rays: usize| rays as f64 / RAYS as f64;
    let mut missing = Vec::new();
    // A path by way of a surface has two edges at least.
    if scene.max_depth >= 2 {
        let with = |wanted: &dyn Fn(MaterialKind) -> bool| {
            let all = 0..scene.materials.len() as u32;
            let mut with: Vec<u32> = all.filter(|&m| wanted(scene.materials.kind(m))).collect();
            let rays = with.iter().map(|&m| seen.materials[m as usize]).sum::<usize>();
            // Those that are seen, if any is.
            with.retain(|&m| rays == 0 || seen.materials[m as usize] > 0);
            let names: Vec<&str> = with.iter().map(|&m| scene.materials.name(m)).collect();
            (!names.is_empty()).then(|| (super::effect::list(&names), rays))
        };
        if let Some((names, rays)) = with(&MaterialKind::is_discrete) {
            missing.push(Missing {
                what: format!("what the camera sees in or through smooth surfaces ({names})"),
                share: share(rays),
                found_by: "bdpt and pt find it",
            });
        }
        if let Some((names, rays)) = with(&|kind| kind == MaterialKind::Plastic) {
            missing.push(Missing {
                what: format!("what the camera sees mirrored in smooth coats ({names})"),
                share: share(rays),
                found_by: "bdpt and pt find it",
            });
        }
    }
    if scene.lights.has_infinite() {
        missing.push(Missing {
            what: "light from outside the scene that the camera sees directly".to_owned(),
            share: share(seen.outside),
            found_by: "bdpt and pt find it",
        });
    }
    missing
}

/// What a grid of rays from the camera meets first.
struct Seen {
    /// Rays that met each material.
    materials: Vec<usize>,
    /// Rays that met nothing, and light from there.
    outside: usize,
}

impl Seen {
    fn new(scene: &Scene) -> Self {
        let groups = RAYS.div_ceil(LANES);
        let mut origins = vec![RayOrigin::zeroed(); groups];
        let mut directions = vec![RayDirection::zeroed(); groups];
        let cell = Vec2::new(scene.width as f32, scene.height as f32) / RAYS_PER_SIDE as f32;
        for ray in 0..RAYS {
            let place = Vec2::new((ray % RAYS_PER_SIDE) as f32, (ray / RAYS_PER_SIDE) as f32);
            let from = scene.camera.ray((place + 0.5) * cell, LENS_CENTER);
            origins.put(ray, from.origin);
            directions.put(ray, from.direction);
        }
        let mut distance = vec![HitDistance::zeroed(); groups];
        let mut instance = vec![HitInstance::zeroed(); groups];
        let mut primitive = vec![HitPrimitive::zeroed(); groups];
        let mut uv = vec![HitUv::zeroed(); groups];
        let rays = RayColumns {
            origin: &origins,
            direction: &directions,
            len: RAYS,
        };
        let hits = HitColumns {
            distance: &mut distance,
            instance: &mut instance,
            primitive: &mut primitive,
            uv: &mut uv,
        };
        scene.geometry.closest_hits(rays, hits);
        let mut seen = Self {
            materials: vec![0; scene.materials.len()],
            outside: 0,
        };
        for ray in 0..RAYS {
            let direction = directions.at(ray);
            if instance.at(ray) == NO_HIT {
                let lights = scene.lights.infinite();
                let light = lights.fold(Rgb::BLACK, |sum, light| {
                    sum + scene.lights.radiance(light, -direction, -direction)
                });
                seen.outside += usize::from(!light.is_black());
                continue;
            }
            let point = scene.geometry.surface_point(Hit {
                instance: instance.at(ray),
                primitive: primitive.at(ray),
                uv: uv.at(ray),
            });
            let front = point.geometric_normal.dot(direction) < 0.0;
            if let Some(rays) = seen
                .materials
                .get_mut(scene.materials.facing(point.material, front) as usize)
            {
                *rays += 1;
            }
        }
        seen
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Format, SceneOverrides, flatten, parse_scene};
    use std::path::Path;

    /// A camera of parallel rays, 4 x 4, looks down on a square of the given material, 2 x 2, in the middle of its view.
    fn scene(material: &str, lights: &str, max_depth: u32) -> Scene {
        let text = format!(
            r#"(version: 1, settings: (max_depth: {max_depth}),
                camera: Orthographic(origin: (0, 0, 5), target: (0, 0, 0), height: 4),
                film: (width: 32, height: 32), materials: {{ "m": {material}, "lamp": Diffuse(reflectance: (0, 0, 0)) }},
                lights: [{lights}],
                shapes: [
                    (shape: Quad(corner: (-1, -1, 0), edge_u: (2, 0, 0), edge_v: (0, 2, 0)), material: "m"),
                    (shape: Sphere(center: (0, 0, 9), radius: 1), material: "lamp", emission: (1, 1, 1)),
                ])"#
        );
        let source = parse_scene("square.ron", &text, Format::Ron, Path::new(".")).expect("a valid scene");
        let flattened = flatten(&source).expect("a valid scene");
        Scene::compile(&source.description, &flattened, SceneOverrides::default()).expect("a valid scene")
    }

    fn shares(material: &str, lights: &str, max_depth: u32) -> Vec<f64> {
        let missing = missing(&scene(material, lights, max_depth), Technique::Lt);
        missing.iter().map(|missing| missing.share).collect()
    }

    #[test]
    fn light_tracing_misses_what_is_seen_in_smooth_surfaces_and_beyond_all() {
        let sky = "Environment(radiance: (1, 1, 1))";
        assert_eq!(shares("Diffuse(reflectance: (1, 1, 1))", "", 8), [0.0; 0]);
        for smooth in [
            "Dielectric(interior_ior: 1.5)",
            "Dielectric(interior_ior: 1.00001)",
            "Conductor(metal: \"Ag\")",
            "Plastic()",
        ] {
            assert_eq!(shares(smooth, "", 8), [0.25], "{smooth}");
            assert_eq!(shares(smooth, sky, 8), [0.25, 0.75], "{smooth}");
            assert_eq!(shares(smooth, sky, 1), [0.75], "{smooth}");
        }
        assert_eq!(shares("RoughConductor(metal: \"Ag\", alpha: 0.1)", "", 8), [0.0; 0]);
    }

    #[test]
    fn other_techniques_miss_nothing() {
        let glass = scene("Dielectric(interior_ior: 1.5)", "Environment(radiance: (1, 1, 1))", 8);
        for technique in Technique::ALL.into_iter().filter(|&t| t != Technique::Lt) {
            assert_eq!(missing(&glass, technique), []);
        }
    }

    #[test]
    fn shares_are_told_where_rays_met_it() {
        let glass = scene("Dielectric(interior_ior: 1.5)", "", 8);
        let missed = Missing {
            what: "what is seen in a mirror".to_owned(),
            share: 0.0,
            found_by: "bdpt finds it",
        };
        assert_eq!(
            missed.to_string(),
            "what is seen in a mirror, though none of 4096 rays from the camera meets it; bdpt finds it"
        );
        let [seen] = missing(&glass, Technique::Lt).try_into().expect("one");
        assert_eq!(
            seen.to_string(),
            "what the camera sees in or through smooth surfaces (m), in 25.00 % of the picture; bdpt and pt find it"
        );
    }
}
