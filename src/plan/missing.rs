//! Light that a technique cannot find in a scene, however long it renders.
//!
//! A path is found by a join, or where a subpath meets a light by chance. What scatters into a single direction (a mirror,
//! smooth glass, an interface of index 1.00001 too) cannot be joined to anything, and a point or a single direction that
//! shines cannot be met. So some paths have no way to be found:
//!
//! - Light tracing joins its paths to the lens alone: it misses what the camera sees in or through smooth surfaces, and
//!   light at infinity that the camera sees directly, which has no point that could be joined.
//! - Path tracing joins its paths to lights alone: it misses light of a point that comes to a matt surface by way of smooth
//!   ones.
//! - Both ends together join any two vertices, and miss the light of a point that comes so and is seen so: none of its paths
//!   has two neighbours that could be joined (Veach 1997, §8.3).
//!
//! There the picture is black, and right everywhere else. How much of the picture the camera sees so, a grid of rays through
//! the film tells.

use super::{Base, Technique};
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
    /// The share of the film where the camera sees it, from a grid of rays: 0 if it is smaller than that grid can tell.
    /// `None` where such rays do not tell it: it may be anywhere.
    pub share: Option<f64>,
    /// Techniques that find it, or what to do where none does.
    pub found_by: &'static str,
}

impl Missing {
    /// Whether the picture lacks it, as far as can be told.
    #[must_use]
    pub fn is_likely(&self) -> bool {
        self.share.is_none_or(|share| share > 0.0)
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, share, found_by } = self;
        match share {
            None => write!(f, "{what}; {found_by}"),
            Some(share) if *share > 0.0 => {
                write!(f, "{what}, in {:.2} % of the picture; {found_by}", 100.0 * share)
            }
            Some(_) => write!(
                f,
                "{what}, though none of {RAYS} rays from the camera meets it; {found_by}"
            ),
        }
    }
}

/// Who finds what light tracing misses, in scenes where all of it is found.
const NOT_LIGHTS_ALONE: &str = "bdpt and pt find it";
/// The same where light of points comes by way of smooth surfaces.
const NOT_LIGHTS_ALONE_BUT: &str =
    "bdpt and pt find it, but for light of points and single directions by way of smooth surfaces";
/// Who finds what path tracing misses.
const NOT_CAMERA_ALONE: &str = "bdpt, lt, mlt and pssmlt --base bdpt find it";
/// The same where the camera sees smooth surfaces too.
const NOT_CAMERA_ALONE_BUT: &str = "bdpt, lt, mlt and pssmlt --base bdpt find it, but for what the camera sees of it in or through \
                                    smooth surfaces: give the light a size for that (a small sphere that emits)";
/// What to do where no technique finds it.
const NOBODY: &str = "no technique finds it: give the light a size (a small sphere that emits)";

/// What `technique` cannot find in `scene`; chains run over `base`.
pub(super) fn missing(scene: &Scene, technique: Technique, base: Base) -> Vec<Missing> {
    if scene.lights.is_empty() {
        return Vec::new();
    }
    match (technique, base) {
        (Technique::Lt, _) => missed_by_lights_alone(scene),
        (Technique::Bdpt | Technique::Mlt | Technique::MltReference, _)
        | (Technique::Pssmlt | Technique::PssmltReference, Base::Bdpt) => missed_by_both(scene),
        (Technique::Pt | Technique::PtReference | Technique::Pssmlt | Technique::PssmltReference, _) => {
            missed_by_camera_alone(scene)
        }
    }
}

/// Light of points and single directions that comes to something matt by way of something smooth.
struct Unmet {
    /// Of which lights, and by way of what, in words.
    what: String,
    /// The share of the film where the camera sees something smooth; `None` if it sees none, or if paths are not long enough
    /// to come to the light from there.
    seen: Option<f64>,
}

impl Unmet {
    /// `None` where there is no such light.
    fn in_scene(scene: &Scene) -> Option<Self> {
        let materials = 0..scene.materials.len() as u32;
        let smooth: Vec<u32> = materials
            .clone()
            .filter(|&material| scene.materials.kind(material).has_discrete_lobe())
            .collect();
        let is_matt_somewhere = materials.into_iter().any(|m| !scene.materials.kind(m).is_discrete());
        // The last of them have names of their own; emitting primitives are more than shapes that have names.
        let first_named = scene.light_names.len().checked_sub(scene.lights.other_count())?;
        let lights: Vec<&str> = scene
            .lights
            .unmet()
            .filter_map(|light| {
                let place = (light as usize).checked_sub(scene.lights.emitter_count())?;
                scene.light_names.get(first_named + place).map(String::as_str)
            })
            .collect();
        // From the camera to the matt surface, to the smooth one, to the light.
        if lights.is_empty() || smooth.is_empty() || !is_matt_somewhere || scene.max_depth < 3 {
            return None;
        }
        let names: Vec<&str> = smooth.iter().map(|&material| scene.materials.name(material)).collect();
        let rays = if scene.max_depth < 4 {
            0
        } else {
            let seen = Seen::new(scene);
            smooth.iter().map(|&material| seen.materials[material as usize]).sum()
        };
        Some(Self {
            what: format!(
                "light of points and single directions ({}) that comes to matt surfaces by way of smooth ones ({})",
                super::effect::list(&lights),
                super::effect::list(&names)
            ),
            seen: (rays > 0).then(|| share(rays)),
        })
    }
}

fn share(rays: usize) -> f64 {
    rays as f64 / RAYS as f64
}

/// What path tracing misses.
fn missed_by_camera_alone(scene: &Scene) -> Vec<Missing> {
    let unmet = Unmet::in_scene(scene).map(|unmet| Missing {
        what: unmet.what,
        share: None,
        found_by: if unmet.seen.is_some() {
            NOT_CAMERA_ALONE_BUT
        } else {
            NOT_CAMERA_ALONE
        },
    });
    unmet.into_iter().collect()
}

/// What techniques with both ends miss.
fn missed_by_both(scene: &Scene) -> Vec<Missing> {
    let unmet = Unmet::in_scene(scene).and_then(|unmet| {
        unmet.seen.map(|seen| Missing {
            what: format!("{} and is seen in or through smooth ones", unmet.what),
            share: Some(seen),
            found_by: NOBODY,
        })
    });
    unmet.into_iter().collect()
}

/// What light tracing misses.
fn missed_by_lights_alone(scene: &Scene) -> Vec<Missing> {
    let seen = Seen::new(scene);
    let found_by = if Unmet::in_scene(scene).is_some() {
        NOT_LIGHTS_ALONE_BUT
    } else {
        NOT_LIGHTS_ALONE
    };
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
                share: Some(share(rays)),
                found_by,
            });
        }
        if let Some((names, rays)) = with(&|kind| kind == MaterialKind::Plastic) {
            missing.push(Missing {
                what: format!("what the camera sees mirrored in smooth coats ({names})"),
                share: Some(share(rays)),
                found_by,
            });
        }
    }
    if scene.lights.has_infinite() {
        missing.push(Missing {
            what: "light from outside the scene that the camera sees directly".to_owned(),
            share: Some(share(seen.outside)),
            found_by: NOT_LIGHTS_ALONE,
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
        scene_with(material, lights, max_depth, "")
    }

    fn scene_with(material: &str, lights: &str, max_depth: u32, shapes: &str) -> Scene {
        let text = format!(
            r#"(version: 1, settings: (max_depth: {max_depth}),
                camera: Orthographic(origin: (0, 0, 5), target: (0, 0, 0), height: 4),
                film: (width: 32, height: 32), materials: {{ "m": {material}, "lamp": Diffuse(reflectance: (0, 0, 0)) }},
                lights: [{lights}],
                shapes: [{shapes}
                    (shape: Quad(corner: (-1, -1, 0), edge_u: (2, 0, 0), edge_v: (0, 2, 0)), material: "m"),
                    (shape: Sphere(center: (0, 0, 9), radius: 1), material: "lamp", emission: (1, 1, 1)),
                ])"#
        );
        let source = parse_scene("square.ron", &text, Format::Ron, Path::new(".")).expect("a valid scene");
        let flattened = flatten(&source).expect("a valid scene");
        Scene::compile(&source.description, &flattened, SceneOverrides::default()).expect("a valid scene")
    }

    fn shares(material: &str, lights: &str, max_depth: u32) -> Vec<f64> {
        let missing = missing(&scene(material, lights, max_depth), Technique::Lt, Base::Pt);
        missing.iter().filter_map(|missing| missing.share).collect()
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

    /// Every technique but light tracing, over every base that it has.
    fn others() -> Vec<(Technique, Base)> {
        let mut others: Vec<(Technique, Base)> = Technique::ALL
            .into_iter()
            .filter(|&technique| technique != Technique::Lt)
            .map(|technique| (technique, Base::Pt))
            .collect();
        others.push((Technique::Pssmlt, Base::Bdpt));
        others
    }

    /// A matt floor under the square, which is above it.
    fn over_a_floor(material: &str, lights: &str, max_depth: u32) -> Scene {
        let floor = r#"(shape: Quad(corner: (-9, -9, -1), edge_u: (18, 0, 0), edge_v: (0, 18, 0)), material: "lamp"),"#;
        scene_with(material, lights, max_depth, floor)
    }

    const LIGHTS: [&str; 3] = [
        "Point(position: (0, 0, 3), intensity: (1, 1, 1))",
        "Spot(position: (0, 0, 3), target: (0, 0, 0), intensity: (1, 1, 1))",
        "Directional(direction: (0, 0, -1), irradiance: (1, 1, 1))",
    ];
    const SMOOTH: [&str; 4] = [
        "Dielectric(interior_ior: 1.5)",
        "Dielectric(interior_ior: 1.00001)",
        "Conductor(metal: \"Ag\")",
        "Plastic()",
    ];

    #[test]
    fn light_with_a_size_is_missed_by_light_tracing_alone() {
        for smooth in SMOOTH {
            for lights in ["", "Environment(radiance: (1, 1, 1))", "Sun(direction: (0, 0, 1))"] {
                let scene = over_a_floor(smooth, lights, 8);
                for (technique, base) in others() {
                    assert_eq!(missing(&scene, technique, base), [], "{smooth} {lights} {technique}");
                }
            }
        }
    }

    #[test]
    fn light_of_points_is_missed_where_nothing_could_be_joined() {
        for smooth in SMOOTH {
            for light in LIGHTS {
                let scene = over_a_floor(smooth, light, 8);
                for (technique, base) in others() {
                    let case = format!("{smooth} {light} {technique} {base}");
                    let [missed] = missing(&scene, technique, base).try_into().expect(&case);
                    assert!(
                        missed.is_likely() && missed.what.contains("(lights[0] ("),
                        "{case}: {missed}"
                    );
                    let with_both = matches!(technique, Technique::Bdpt | Technique::Mlt | Technique::MltReference)
                        || base == Base::Bdpt;
                    let (share, found_by) = if with_both {
                        (Some(0.25), NOBODY)
                    } else {
                        (None, NOT_CAMERA_ALONE_BUT)
                    };
                    assert_eq!((missed.share, missed.found_by), (share, found_by), "{case}");
                }
                let by_lt = missing(&scene, Technique::Lt, Base::Pt);
                assert!(
                    by_lt.iter().all(|missed| missed.found_by == NOT_LIGHTS_ALONE_BUT),
                    "{by_lt:?}"
                );
            }
        }
    }

    /// Three edges take light by way of one smooth surface to what the camera sees, and four to what it sees in another.
    #[test]
    fn light_of_points_is_missed_only_where_there_are_such_paths() {
        let count = |scene: &Scene, technique| missing(scene, technique, Base::Pt).len();
        let counts = |scene: &Scene| [count(scene, Technique::Pt), count(scene, Technique::Bdpt)];
        let [point, ..] = LIGHTS;
        let [glass, ..] = SMOOTH;
        let at = |max_depth| counts(&over_a_floor(glass, point, max_depth));
        assert_eq!([at(2), at(3), at(4)], [[0, 0], [1, 0], [1, 1]]);
        let rough = "RoughDielectric(interior_ior: 1.5, alpha: 0.1)";
        assert_eq!(counts(&over_a_floor(rough, point, 8)), [0, 0]);
        let dark = "Point(position: (0, 0, 3), intensity: (0, 0, 0))";
        assert_eq!(counts(&over_a_floor(glass, dark, 8)), [0, 0]);
    }

    #[test]
    fn shares_are_told_where_rays_met_it() {
        let glass = scene("Dielectric(interior_ior: 1.5)", "", 8);
        let missed = Missing {
            what: "what is seen in a mirror".to_owned(),
            share: Some(0.0),
            found_by: "bdpt finds it",
        };
        assert_eq!(
            missed.to_string(),
            "what is seen in a mirror, though none of 4096 rays from the camera meets it; bdpt finds it"
        );
        let [seen] = missing(&glass, Technique::Lt, Base::Pt).try_into().expect("one");
        assert_eq!(
            seen.to_string(),
            "what the camera sees in or through smooth surfaces (m), in 25.00 % of the picture; bdpt and pt find it"
        );
    }
}
