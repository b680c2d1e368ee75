//! How far a picture is from a reference. All sums in `f64`, over the channels of all pixels that are finite in both.

use crate::color::Rgb;
use crate::film::ImageView;
use serde::Serialize;

/// ε of the relative squared error: keeps dark pixels from ruling it. In units of radiance squared.
pub const REL_MSE_EPSILON: f64 = 0.01;
/// ε of the relative absolute errors. In units of radiance.
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
    /// Symmetric mean absolute relative error: mean 2 |a − r| / (|a| + |r| + 0.01). At most 2, however bright a pixel is.
    pub smape: f64,
    /// mean a / mean r, all channels together: what a loss or gain of energy shows in. Not a finite number where
    /// r is black (and then `null` in JSON).
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

impl SizeMismatch {
    /// Refuses pictures whose sides differ.
    ///
    /// # Errors
    /// That they do.
    pub fn refuse(image: ImageView<'_>, reference: ImageView<'_>) -> Result<(), Self> {
        let sides = |v: ImageView<'_>| (v.width, v.height);
        if sides(image) == sides(reference) && image.rgb.len() == reference.rgb.len() {
            return Ok(());
        }
        Err(Self {
            image: sides(image),
            reference: sides(reference),
        })
    }
}

/// Compares `image` with `reference`. Where no pixel is finite in both, every error is zero, and `compared` says so.
///
/// # Errors
/// Where their sides differ.
pub fn compare(image: ImageView<'_>, reference: ImageView<'_>) -> Result<Metrics, SizeMismatch> {
    SizeMismatch::refuse(image, reference)?;
    let (mut mse, mut mape, mut smape, mut max_abs_error) = (0.0, 0.0, 0.0, 0.0_f64);
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
            smape += 2.0 * difference.abs() / (a.abs() + r.abs() + MAPE_EPSILON);
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
        smape: mean(smape, compared),
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

#[cfg(test)]
mod tests {
    use super::*;

    fn view(rgb: &[Rgb]) -> ImageView<'_> {
        ImageView {
            width: rgb.len() as u32,
            height: 1,
            rgb,
        }
    }

    fn assert_near(got: f64, expected: f64) {
        assert!(
            (got - expected).abs() <= 1e-12 * expected.abs(),
            "{got} is not {expected}"
        );
    }

    #[test]
    fn metrics_are_as_computed_by_hand() {
        let a = [Rgb::new(1.0, 2.0, 0.5), Rgb::BLACK];
        let r = [Rgb::new(0.5, 2.0, 1.0), Rgb::new(0.0, 0.0, 0.25)];
        let m = compare(view(&a), view(&r)).expect("same size");
        // Differences: 0.5, 0, -0.5; 0, 0, -0.25.
        assert_near(m.mse, (0.25 + 0.25 + 0.0625) / 6.0);
        assert_near(m.rel_mse, (0.25 / 0.26 + 0.25 / 1.01 + 0.0625 / 0.0725) / 6.0);
        assert_near(m.mape, (0.5 / 0.51 + 0.5 / 1.01 + 0.25 / 0.26) / 6.0);
        assert_near(m.smape, 2.0 * (0.5 / 1.51 + 0.5 / 1.51 + 0.25 / 0.26) / 6.0);
        assert_near(m.mean_ratio, 3.5 / 3.75);
        assert_eq!(m.channel_mean_ratio, [2.0, 1.0, 0.4]);
        assert_eq!((m.max_abs_error, m.compared, m.non_finite), (0.5, 2, 0));
        // One of two pixels is left out: the first, with the larger error.
        assert_near(m.rel_mse_trimmed, 0.0625 / 0.0725 / 3.0);
    }

    #[test]
    fn one_outlier_in_a_thousand_rules_the_error_but_not_the_trimmed_one() {
        let r = vec![Rgb::ONE; 1000];
        let mut a = vec![Rgb::splat(1.1); 1000];
        a[123] = Rgb::splat(1e6);
        let m = compare(view(&a), view(&r)).expect("same size");
        assert!(m.rel_mse > 1e8);
        let pixel = f64::from(1.1_f32) - 1.0;
        assert!((m.rel_mse_trimmed - pixel * pixel / 1.01).abs() < 1e-12);
    }

    #[test]
    fn pixels_that_are_not_finite_are_left_out_and_counted() {
        let a = [Rgb::splat(2.0), Rgb::new(f32::NAN, 1.0, 1.0), Rgb::ONE];
        let r = [Rgb::ONE, Rgb::ONE, Rgb::new(1.0, 1.0, f32::INFINITY)];
        let m = compare(view(&a), view(&r)).expect("same size");
        assert_eq!((m.compared, m.non_finite, m.mse, m.mean_ratio), (1, 2, 1.0, 2.0));
        let m = compare(view(&a[1..]), view(&r[1..])).expect("same size");
        assert_eq!((m.compared, m.mse, m.rel_mse_trimmed), (0, 0.0, 0.0));
    }

    #[test]
    fn a_picture_equals_itself() {
        let a = [Rgb::new(0.1, 1e20, 0.0), Rgb::splat(3.0)];
        let m = compare(view(&a), view(&a)).expect("same size");
        assert_eq!(
            (m.mse, m.rel_mse, m.mape, m.max_abs_error, m.mean_ratio),
            (0.0, 0.0, 0.0, 0.0, 1.0)
        );
    }

    #[test]
    fn different_sizes_are_an_error_that_names_both() {
        let a = [Rgb::ONE; 6];
        let wide = ImageView {
            width: 3,
            height: 2,
            rgb: &a,
        };
        let tall = ImageView {
            width: 2,
            height: 3,
            rgb: &a,
        };
        let error = compare(wide, tall).expect_err("other sides").to_string();
        assert!(error.contains("3 x 2") && error.contains("2 x 3"), "{error}");
    }
}
