//! From the steps of a transform to one affine map.

use super::at::At;
use super::description::TransformStep;
use super::error::SceneError;
use super::limits::MAX_ROTATION;
use super::mesh::MAX_COORDINATE;
use glam::{DAffine3, DMat3, DVec3};

/// The smallest determinant of a transform relative to the product of its columns' lengths: below, the columns lie in
/// a plane but for rounding.
const MIN_RELATIVE_DETERMINANT: f64 = 1.0e-10;
/// How far the columns of a similarity may be from orthogonal and from equally long, relative to their squared length.
/// Matrices written with six digits pass.
pub const SIMILARITY_TOLERANCE: f64 = 1.0e-4;

/// The map from a shape's own space to the world: `steps` in the order listed. `at` is the place of the steps.
pub(super) fn compose(at: &At, steps: &[TransformStep]) -> Result<DAffine3, SceneError> {
    let mut total = DAffine3::IDENTITY;
    for (index, step) in steps.iter().enumerate() {
        total = affine(&at.index(index), step)? * total;
    }
    let columns = total.matrix3;
    let volume = columns.x_axis.length() * columns.y_axis.length() * columns.z_axis.length();
    let independent = columns.determinant().abs() > MIN_RELATIVE_DETERMINANT * volume;
    if !independent || !total.is_finite() {
        let message = "this transform flattens the shape: it is singular";
        return Err(at.error(message, "scale by no zero, and give a matrix independent columns"));
    }
    Ok(total)
}

fn affine(at: &At, step: &TransformStep) -> Result<DAffine3, SceneError> {
    match step {
        TransformStep::Translate(offset) => Ok(DAffine3::from_translation(
            at.variant("Translate").content().lengths(*offset)?,
        )),
        TransformStep::Scale(factors) => {
            let at = at.variant("Scale").content();
            let scale = at.lengths(*factors)?;
            if let Some(axis) = factors.iter().position(|factor| *factor == 0.0) {
                let help = "use a `Quad` for a flat shape; negative factors mirror";
                return Err(at.index(axis).error("a scale factor is zero", help));
            }
            Ok(DAffine3::from_scale(scale))
        }
        TransformStep::Rotate { axis, degrees } => {
            let at = at.variant("Rotate");
            let axis = at.key("axis").direction(*axis)?.normalize();
            at.key("degrees")
                .within(*degrees, -MAX_ROTATION, MAX_ROTATION, "in degrees; 360 is a whole turn")?;
            Ok(DAffine3::from_mat3(rotation(axis, f64::from(*degrees))))
        }
        TransformStep::Matrix(rows) => {
            let at = at.variant("Matrix").content();
            for (index, row) in rows.iter().enumerate() {
                let at = at.index(index);
                for (column, value) in row.iter().enumerate() {
                    let at = at.index(column);
                    at.within(
                        *value,
                        -MAX_COORDINATE,
                        MAX_COORDINATE,
                        "choose a larger unit of length",
                    )?;
                }
            }
            let [x, y, z, last] = rows.map(|row| row.map(f64::from));
            if last != [0.0, 0.0, 0.0, 1.0] {
                let help = "the last of the four rows is (0, 0, 0, 1); a translation stands in the last column";
                return Err(at.index(3).error("this matrix is not affine", help));
            }
            let column = |index: usize| DVec3::new(x[index], y[index], z[index]);
            Ok(DAffine3::from_cols(column(0), column(1), column(2), column(3)))
        }
    }
}

/// Rotation about a unit axis (Rodrigues' formula).
fn rotation(axis: DVec3, degrees: f64) -> DMat3 {
    let angle = degrees.to_radians();
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let turn = |v: DVec3| v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine));
    DMat3::from_cols(turn(DVec3::X), turn(DVec3::Y), turn(DVec3::Z))
}

/// By how much a map scales all lengths alike; `None` where it does not.
pub(super) fn similarity_scale(map: &DAffine3) -> Option<f64> {
    let gram = map.matrix3.transpose() * map.matrix3;
    let square = (gram.x_axis.x + gram.y_axis.y + gram.z_axis.z) / 3.0;
    let off = gram - DMat3::from_diagonal(DVec3::splat(square));
    let worst = off
        .to_cols_array()
        .into_iter()
        .fold(0.0, |worst: f64, value| worst.max(value.abs()));
    (worst <= SIMILARITY_TOLERANCE * square).then(|| square.sqrt())
}
