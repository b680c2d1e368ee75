//! Pictures as PNG files: what a display shows. The one place where light is clamped.

use super::picture::ImageView;
use super::write::{WriteError, write_file};
use crate::color::Rgb;
use image::ImageEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use std::path::Path;

/// Linear radiance to what a display shows: scaled by 2^exposure, clipped to 0..1, and encoded by the transfer function
/// of sRGB (IEC 61966-2-1). There is no curve beside that one, so that pixel values can be compared and read back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToneMap {
    /// Stops: each doubles what is shown.
    pub exposure: f32,
}

impl ToneMap {
    /// The exposure that brings the geometric mean of the picture's luminance to 0.18, middle grey (the log-average of
    /// Reinhard et al. 2002, over the pixels that are finite and not black). Zero for a picture without such pixels.
    #[must_use]
    pub fn automatic(picture: ImageView<'_>) -> Self {
        let lit = picture
            .rgb
            .iter()
            .map(|c| f64::from(c.luminance()))
            .filter(|&y| y > 0.0 && y.is_finite());
        let (sum, count) = lit.fold((0.0, 0_u64), |(sum, count), y| (sum + libm::log2(y), count + 1));
        if count == 0 {
            return Self::default();
        }
        Self {
            exposure: (libm::log2(0.18) - sum / count as f64) as f32,
        }
    }

    /// The 8-bit sRGB code of a linear value, rounded to nearest. Not-a-number is shown as black.
    #[must_use]
    pub fn encode(self, linear: f32) -> u8 {
        quantize(linear, self.scale())
    }

    fn scale(self) -> f64 {
        libm::exp2(f64::from(self.exposure))
    }
}

fn quantize(linear: f32, scale: f64) -> u8 {
    let v = f64::from(linear) * scale;
    // Not-a-number fails both comparisons with itself on the dark side. Zero times an endless exposure is one too.
    if v.is_nan() || v <= 0.0 {
        return 0;
    }
    let v = v.min(1.0);
    let encoded = if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * libm::pow(v, 1.0 / 2.4) - 0.055
    };
    (encoded * 255.0 + 0.5) as u8
}

/// Writes `picture` to `path` as it is displayed, whole or not at all.
///
/// # Errors
/// Where the picture has no pixel, or the file cannot be written.
pub fn write_png(path: &Path, picture: ImageView<'_>, tone: ToneMap) -> Result<(), WriteError> {
    let bytes = encode_png(picture, tone).map_err(|reason| WriteError::Encode {
        path: path.to_owned(),
        format: "a PNG file",
        reason,
    })?;
    write_file(path, &bytes)
}

/// The bytes of `picture` as an 8-bit sRGB PNG file.
///
/// # Errors
/// Where the picture has no pixel, or a list of another length than its sides say; the reason in words.
pub fn encode_png(picture: ImageView<'_>, tone: ToneMap) -> Result<Vec<u8>, String> {
    let pixels = picture.width as usize * picture.height as usize;
    if pixels == 0 || picture.rgb.len() != pixels {
        return Err(format!(
            "its list does not hold the {} x {} pixels it claims",
            picture.width, picture.height
        ));
    }
    let scale = tone.scale();
    let codes: Vec<u8> = picture
        .rgb
        .iter()
        .flat_map(|c: &Rgb| c.to_array().map(|channel| quantize(channel, scale)))
        .collect();
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Default, FilterType::Adaptive)
        .write_image(&codes, picture.width, picture.height, image::ExtendedColorType::Rgb8)
        .map_err(|e| e.to_string())?;
    Ok(bytes)
}
