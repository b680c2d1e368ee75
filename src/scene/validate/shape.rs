//! Checks of the `shapes` block, before any transform.

use super::needs_material;
use crate::scene::at::{At, wide};
use crate::scene::description::{MaterialDescription, ShapeDescription, ShapeKind};
use crate::scene::error::{SceneError, nearest_name};
use crate::scene::mesh::MAX_COORDINATE;
use std::collections::BTreeMap;

/// The largest radiance: with it, the power of an emitter of any allowed size stays finite in `f32`.
pub(in crate::scene) const MAX_RADIANCE: f32 = 1.0e12;
/// How near to parallel the edges of a quad may be, as the sine of the angle between them.
const MIN_EDGE_SINE: f64 = 1.0e-6;

pub(super) fn check(
    at: &At,
    shape: &ShapeDescription,
    materials: &BTreeMap<String, MaterialDescription>,
) -> Result<(), SceneError> {
    match &shape.material {
        Some(name) if !materials.contains_key(name) => {
            let help = match materials.is_empty() {
                true => "the scene has no materials: add some to `materials`".to_owned(),
                false => nearest_name(name, materials.keys().map(String::as_str)),
            };
            return Err(at.key("material").error(format!("unknown material `{name}`"), help));
        }
        None if needs_material(&shape.shape) => {
            return Err(at.error("this shape has no material", "add `material: \"...\"`"));
        }
        _ => {}
    }
    if let Some(emission) = shape.emission {
        let help = "radiance in W sr^-1 m^-2; an office ceiling is near 1, the sun near 1e7";
        at.key("emission")
            .each_within(emission.to_array(), 0.0, MAX_RADIANCE, help)?;
    }
    kind(&at.key("shape"), &shape.shape)
}

fn kind(at: &At, kind: &ShapeKind) -> Result<(), SceneError> {
    match kind {
        ShapeKind::Quad { corner, edge_u, edge_v } => {
            let at = at.variant("Quad");
            at.key("corner").lengths(*corner)?;
            let u = at.key("edge_u").lengths(*edge_u)?;
            let v = at.key("edge_v").lengths(*edge_v)?;
            if u.cross(v).length() <= MIN_EDGE_SINE * u.length() * v.length() {
                let message = "this quad has no area: an edge is zero, or both are parallel";
                return Err(at.error(
                    message,
                    "`edge_u` and `edge_v` lead from `corner` along two of its sides",
                ));
            }
            Ok(())
        }
        ShapeKind::Box { min, max } => {
            let at = at.variant("Box");
            at.key("min").lengths(*min)?;
            at.key("max").lengths(*max)?;
            let size = wide(*max) - wide(*min);
            for (axis, size) in [("x", size.x), ("y", size.y), ("z", size.z)] {
                if size == 0.0 {
                    return Err(at.error(
                        format!("this box is flat along {axis}"),
                        "use a `Quad` for a flat shape",
                    ));
                }
                if size < 0.0 {
                    let message = format!("this box's `max` is below its `min` along {axis}");
                    return Err(at.error(message, "swap the two values"));
                }
            }
            Ok(())
        }
        ShapeKind::Sphere { center, radius } => {
            let at = at.variant("Sphere");
            at.key("center").lengths(*center)?;
            let at = at.key("radius");
            at.finite(*radius)?;
            if *radius <= 0.0 {
                return Err(at.error(format!("expected a radius above 0, found {radius}"), ""));
            }
            at.within(*radius, 0.0, MAX_COORDINATE, "choose a larger unit of length")
        }
        ShapeKind::Obj { file, smooth: _ } => {
            if file.as_os_str().is_empty() {
                return Err(at
                    .variant("Obj")
                    .key("file")
                    .error("expected the name of an OBJ file", ""));
            }
            Ok(())
        }
    }
}
