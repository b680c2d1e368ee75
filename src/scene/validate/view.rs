//! Checks of the `camera` and `film` blocks.

use crate::film::SIGMA_PER_RADIUS;
use crate::scene::at::{At, wide};
use crate::scene::description::{
    CameraDescription, EXPOSURE, FilmDescription, FilterDescription, MAX_FILM_PIXELS, MAX_FILM_SIDE,
};
use crate::scene::error::SceneError;
use crate::scene::limits::{FILTER_RADIUS, FILTER_SIGMA, FOV_MARGIN, MIN_LENS_LENGTH};
use crate::scene::mesh::MAX_COORDINATE;

/// How near to parallel `up` may come to the view, as the sine of the angle between them: nearer, the picture's
/// rotation would be rounding noise of `f32`.
const MIN_UP_SINE: f64 = 1.0e-4;
/// The smallest distance from origin to target, relative to their coordinates: nearer, the direction of view would be
/// rounding noise of `f32`.
const MIN_VIEW_DISTANCE: f64 = 1.0e-6;

pub(super) fn camera(at: &At, camera: &CameraDescription) -> Result<(), SceneError> {
    match camera {
        CameraDescription::Perspective {
            origin,
            target,
            up,
            fov,
            fov_axis: _,
        } => {
            let at = at.variant("Perspective");
            pose(&at, *origin, *target, *up)?;
            angle_of_view(&at.key("fov"), *fov)
        }
        CameraDescription::ThinLens {
            origin,
            target,
            up,
            fov,
            fov_axis: _,
            aperture_radius,
            focus_distance,
        } => {
            let at = at.variant("ThinLens");
            let distance = pose(&at, *origin, *target, *up)?;
            angle_of_view(&at.key("fov"), *fov)?;
            let help = "the focal length over twice the f-number; a pinhole is a `Perspective`";
            positive_length(&at.key("aperture_radius"), *aperture_radius, help)?;
            if let Some(distance) = focus_distance {
                let help = "leave it out to focus on `target`";
                positive_length(&at.key("focus_distance"), *distance, help)?;
            }
            // Nearer to the lens than its own points are rounded, nothing could be focused on.
            let scale = wide(*origin).length().max(wide(*target).length());
            if focus_distance.map_or(distance, f64::from) <= MIN_VIEW_DISTANCE * scale {
                let message = "this lens focuses too near to itself for its distance from the world's origin";
                return Err(at
                    .key("focus_distance")
                    .error(message, "focus farther away, or move the scene to the origin"));
            }
            Ok(())
        }
        CameraDescription::Orthographic {
            origin,
            target,
            up,
            height,
        } => {
            let at = at.variant("Orthographic");
            pose(&at, *origin, *target, *up)?;
            positive_length(&at.key("height"), *height, "what the film's height spans in the scene")
        }
    }
}

/// Where a camera stands and looks; the distance to its target.
fn pose(at: &At, origin: [f32; 3], target: [f32; 3], up: [f32; 3]) -> Result<f64, SceneError> {
    let from = at.key("origin").lengths(origin)?;
    let to = at.key("target").lengths(target)?;
    let view = to - from;
    let scale = from.length().max(to.length());
    if view.length() <= (MIN_VIEW_DISTANCE * scale).max(1.0e-9) {
        let message = "the camera's target is its origin, so that it looks nowhere";
        return Err(at.key("target").error(message, "put the target in front of the camera"));
    }
    let upward = at.key("up").direction(up)?;
    if upward.cross(view).length() <= MIN_UP_SINE * upward.length() * view.length() {
        let message = "`up` is parallel to the view, so that the picture could be turned either way";
        return Err(at
            .key("up")
            .error(message, "for a view straight up or down, try `up: (0, 0, 1)`"));
    }
    Ok(view.length())
}

fn angle_of_view(at: &At, fov: f32) -> Result<(), SceneError> {
    at.finite(fov)?;
    if !(FOV_MARGIN..=180.0 - FOV_MARGIN).contains(&fov) {
        let message = format!("expected an angle of view between 0 and 180 degrees, found {fov}");
        return Err(at.error(message, "40 is usual"));
    }
    Ok(())
}

/// A length above zero, of a camera.
fn positive_length(at: &At, length: f32, help: &str) -> Result<(), SceneError> {
    at.within(length, MIN_LENS_LENGTH, MAX_COORDINATE, help)
}

pub(super) fn film(at: &At, film: &FilmDescription) -> Result<(), SceneError> {
    for (name, side) in [("width", film.width), ("height", film.height)] {
        if !(1..=MAX_FILM_SIDE).contains(&side) {
            let message = format!("expected from 1 to {MAX_FILM_SIDE} pixels, found {side}");
            return Err(at.key(name).error(message, ""));
        }
    }
    let pixels = u64::from(film.width) * u64::from(film.height);
    if pixels > MAX_FILM_PIXELS {
        let message = format!("a film has at most {MAX_FILM_PIXELS} pixels, this one {pixels}");
        return Err(at.error(message, "render a smaller picture, or parts of it"));
    }
    let [least, most] = EXPOSURE;
    at.key("exposure")
        .within(film.exposure, least, most, "in stops: each doubles what is shown")?;
    let at = at.key("filter");
    let (at, radius) = match film.filter {
        FilterDescription::Box { radius } => (at.variant("Box"), radius),
        FilterDescription::Tent { radius } => (at.variant("Tent"), radius),
        FilterDescription::Gaussian { radius, sigma } => {
            let at = at.variant("Gaussian");
            let [least, most] = FILTER_SIGMA;
            at.key("sigma")
                .within(sigma, least, most, "a standard deviation in pixels; 0.5 is usual")?;
            (at, radius)
        }
    };
    at.key("radius").within(
        radius,
        FILTER_RADIUS[0],
        FILTER_RADIUS[1],
        "in pixels; less than half a pixel would lose light between pixels",
    )?;
    match film.filter {
        FilterDescription::Gaussian { sigma, .. } => sigma_beside(&at.key("sigma"), sigma, radius),
        FilterDescription::Box { .. } | FilterDescription::Tent { .. } => Ok(()),
    }
}

/// A standard deviation that is neither too small nor too large for the radius beside it.
fn sigma_beside(at: &At, sigma: f32, radius: f32) -> Result<(), SceneError> {
    let [least, most] = SIGMA_PER_RADIUS;
    if (least..=most).contains(&(sigma / radius)) {
        return Ok(());
    }
    let message = format!("sigma: expected from {least} to {most} times the radius, {radius}, found {sigma}");
    Err(at.error(message, "a third of the radius is common"))
}
