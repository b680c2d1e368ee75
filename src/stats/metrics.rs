//! How far a picture is from a reference. All sums in `f64`, over the channels of all pixels that are finite in both.

use crate::color::Rgb;
use crate::film::ImageView;
use serde::Serialize;

/// ε of the relative squared error: keeps dark pixels from ruling it. In units of radiance squared.
pub const REL_MSE_EPSILON: f64 = 0.01;
/// ε of the relative absolute error. In units of radiance.
pub const MAPE_EPSILON: f64 = 0.01;
/// The share of the pixels, those with the largest relative squared error, that the trimmed error leaves out.
pub const TRIMMED_SHARE: f64 = 0.001;

/// How far a picture `a` is from a reference `r`. The means run over the channels of all compared pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Metrics {
    /// Mean squared error: mean (a − r)².
    pub mse: f64,
    /// Relative mean squared error: mean (a − r)² / (r² + 0.01).
    pub rel_mse: f64,
    /// The same without the 0.1 % of the pixels (rounded up to whole pixels) where it is largest: a few bright outliers
    /// cannot rule it. A picture of one pixel keeps it.
    pub rel_mse_trimmed: f64,
    /// Mean absolute relative error: mean |a − r| / (|r| + 0.01).
    pub mape: f64,
    /// mean a / mean r, all channels together: what a loss or gain of energy shows in. Not-a-number where r is black.
    pub mean_ratio: f64,
    /// mean a / mean r, per channel, red first.
    pub channel_mean_ratio: [f64; 3],
    /// The largest |a − r|.
    pub max_abs_error: f64,
    /// Pixels that were compared.
    pub compared: u64,
    /// Pixels with an infinite or not-a-number channel in the picture or the reference. They are left out.
    pub non_finite: u64,
}

/// The pictures have different sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("the picture is {} x {} pixels and the reference {} x {}", image.0, image.1, reference.0, reference.1)]
#[diagnostic(help("compare pictures of the same size: render one of them again at the other's"))]
pub struct SizeMismatch {
    /// Width and height of the picture.
    pub image: (u32, u32),
    /// Width and height of the reference.
    pub reference: (u32, u32),
}

/// Compares `image` with `reference`. Where no pixel is finite in both, every error is zero, and `compared` says so.
///
/// # Errors
/// Where their sides differ.
pub fn compare(image: ImageView<'_>, reference: ImageView<'_>) -> Result<Metrics, SizeMismatch> {
    let sides = |v: ImageView<'_>| (v.width, v.height);
    if sides(image) != sides(reference) || image.rgb.len() != reference.rgb.len() {
        return Err(SizeMismatch {
            image: sides(image),
            reference: sides(reference),
        });
    }
    let (mut mse, mut mape, mut max_abs_error) = (0.0, 0.0, 0.0_f64);
    let (mut image_sum, mut reference_sum) = ([0.0; 3], [0.0; 3]);
    let mut rel_mse_of_pixel = Vec::with_capacity(image.rgb.len());
    for (a, r) in image
        .rgb
        .iter()
        .zip(reference.rgb)
        .filter(|(a, r)| a.is_finite() && r.is_finite())
    {
        let mut rel_mse = 0.0;
        for (channel, (a, r)) in wide(*a).into_iter().zip(wide(*r)).enumerate() {
            let difference = a - r;
            let squared = difference * difference;
            mse += squared;
            rel_mse += squared / (r * r + REL_MSE_EPSILON);
            mape += difference.abs() / (r.abs() + MAPE_EPSILON);
            max_abs_error = max_abs_error.max(difference.abs());
            image_sum[channel] += a;
            reference_sum[channel] += r;
        }
        rel_mse_of_pixel.push(rel_mse);
    }
    let compared = rel_mse_of_pixel.len();
    let mean = |sum: f64, pixels: usize| if pixels == 0 { 0.0 } else { sum / (3 * pixels) as f64 };
    let rel_mse = mean(rel_mse_of_pixel.iter().sum(), compared);
    rel_mse_of_pixel.sort_by(f64::total_cmp);
    let left_out = (compared as f64 * TRIMMED_SHARE).ceil() as usize;
    let kept = compared.saturating_sub(left_out).max(compared.min(1));
    let ratio = |c: usize| image_sum[c] / reference_sum[c];
    Ok(Metrics {
        mse: mean(mse, compared),
        rel_mse,
        rel_mse_trimmed: mean(rel_mse_of_pixel[..kept].iter().sum(), kept),
        mape: mean(mape, compared),
        mean_ratio: image_sum.iter().sum::<f64>() / reference_sum.iter().sum::<f64>(),
        channel_mean_ratio: [ratio(0), ratio(1), ratio(2)],
        max_abs_error,
        compared: compared as u64,
        non_finite: (image.rgb.len() - compared) as u64,
    })
}

fn wide(c: Rgb) -> [f64; 3] {
    c.to_array().map(f64::from)
}
