//! Checks of the `shapes` block, before any transform.

use super::needs_material;
use crate::scene::at::{At, wide};
use crate::scene::description::{MaterialDescription, ShapeDescription, ShapeKind};
use crate::scene::error::{SceneError, nearest_name};
use crate::scene::limits::{MAX_RADIANCE, MIN_HEIGHTS, SEGMENTS};
use crate::scene::mesh::MAX_COORDINATE;
use crate::scene::shapes::height_field::MAX_HEIGHTS;
use std::collections::BTreeMap;

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
            parallelogram(&at.variant("Quad"), "quad", *corner, [*edge_u, *edge_v])
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
            self::radius(&at.key("radius"), *radius)
        }
        ShapeKind::Disk { center, normal, radius } => {
            let at = at.variant("Disk");
            at.key("center").lengths(*center)?;
            at.key("normal").direction(*normal)?;
            self::radius(&at.key("radius"), *radius)
        }
        ShapeKind::Cylinder { from, to, radius } => {
            let at = at.variant("Cylinder");
            let from = at.key("from").lengths(*from)?;
            let to = at.key("to").lengths(*to)?;
            if from == to {
                let message = "this cylinder has no length: `from` and `to` are the same point";
                return Err(at.key("to").error(message, "use a `Disk` for a flat shape"));
            }
            self::radius(&at.key("radius"), *radius)
        }
        ShapeKind::Torus {
            center,
            axis,
            major_radius,
            minor_radius,
            segments,
        } => {
            let at = at.variant("Torus");
            at.key("center").lengths(*center)?;
            at.key("axis").direction(*axis)?;
            self::radius(&at.key("major_radius"), *major_radius)?;
            self::radius(&at.key("minor_radius"), *minor_radius)?;
            if minor_radius >= major_radius {
                let message = format!(
                    "this torus would cross itself: its `minor_radius` {minor_radius} is not below its `major_radius` {major_radius}"
                );
                let help = "`major_radius` leads to the middle of the tube, `minor_radius` is that of the tube";
                return Err(at.key("minor_radius").error(message, help));
            }
            for (index, count) in segments.iter().enumerate() {
                let [least, most] = SEGMENTS;
                if !(least..=most).contains(count) {
                    let message = format!("expected from {least} to {most} segments, found {count}");
                    let at = at.key("segments").index(index);
                    return Err(at.error(message, "around the axis and around the tube; (64, 32) is usual"));
                }
            }
            let faces = u64::from(segments[0]) * u64::from(segments[1]);
            if faces > MAX_HEIGHTS as u64 {
                let message = format!("a torus has at most {MAX_HEIGHTS} segments in all, this one {faces}");
                return Err(at.key("segments").error(message, "(64, 32) is usual"));
            }
            Ok(())
        }
        ShapeKind::HeightField {
            file,
            heights,
            corner,
            edge_u,
            edge_v,
            height,
        } => {
            let at = at.variant("HeightField");
            parallelogram(&at, "height field", *corner, [*edge_u, *edge_v])?;
            at.key("height").within(
                *height,
                -MAX_COORDINATE,
                MAX_COORDINATE,
                "choose a larger unit of length",
            )?;
            match (file, heights) {
                (Some(_), Some(_)) => {
                    let message = "this height field has both a `file` and `heights`";
                    Err(at.key("heights").error(message, "leave one of them out"))
                }
                (None, None) => {
                    let help = "add `file: \"...\"`, or rows of numbers such as `heights: [[0, 1], [1, 2]]`";
                    Err(at.error("this height field has no heights", help))
                }
                (Some(file), None) if file.as_os_str().is_empty() => {
                    let help = "a PNG, JPEG, OpenEXR or Radiance HDR file";
                    Err(at.key("file").error("expected the name of a picture", help))
                }
                (Some(_), None) => Ok(()),
                (None, Some(rows)) => self::heights(&at.key("heights"), rows),
            }
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

/// A parallelogram that has an area.
fn parallelogram(at: &At, what: &str, corner: [f32; 3], [u, v]: [[f32; 3]; 2]) -> Result<(), SceneError> {
    at.key("corner").lengths(corner)?;
    let u = at.key("edge_u").lengths(u)?;
    let v = at.key("edge_v").lengths(v)?;
    if u.cross(v).length() <= MIN_EDGE_SINE * u.length() * v.length() {
        let message = format!("this {what} has no area: an edge is zero, or both are parallel");
        return Err(at.error(
            message,
            "`edge_u` and `edge_v` lead from `corner` along two of its sides",
        ));
    }
    Ok(())
}

fn radius(at: &At, radius: f32) -> Result<(), SceneError> {
    at.finite(radius)?;
    if radius <= 0.0 {
        return Err(at.error(format!("expected a radius above 0, found {radius}"), ""));
    }
    at.within(radius, 0.0, MAX_COORDINATE, "choose a larger unit of length")
}

/// Rows of numbers, all equally long.
fn heights(at: &At, rows: &[Vec<f32>]) -> Result<(), SceneError> {
    let columns = rows.first().map_or(0, Vec::len);
    if let Some(ragged) = rows.iter().position(|row| row.len() != columns) {
        let message = format!(
            "expected {columns} heights as in the first row, found {}",
            rows[ragged].len()
        );
        return Err(at
            .index(ragged)
            .error(message, "all rows of a height field are equally long"));
    }
    let count = rows.len() * columns;
    if rows.len() < MIN_HEIGHTS || columns < MIN_HEIGHTS || count > MAX_HEIGHTS {
        let message = format!(
            "expected 2 rows of 2 heights or more, and at most {MAX_HEIGHTS} heights in all; found {} rows of {columns}",
            rows.len()
        );
        return Err(at.error(message, "rows run along `edge_u`: `heights: [[0, 1], [1, 2]]`"));
    }
    let usable = |height: &f32| height.abs() <= MAX_COORDINATE;
    let first_bad = rows.iter().flatten().position(|height| !usable(height));
    first_bad.map_or(Ok(()), |bad| {
        let at = at.index(bad / columns).index(bad % columns);
        let height = rows[bad / columns][bad % columns];
        at.within(
            height,
            -MAX_COORDINATE,
            MAX_COORDINATE,
            "choose a larger unit of length",
        )
    })
}
