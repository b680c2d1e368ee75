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

    /// The same by so many stops brighter.
    #[must_use]
    pub fn brighter(self, stops: f32) -> Self {
        Self {
            exposure: self.exposure + stops,
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

#[cfg(test)]
mod tests {
    use super::*;

    fn view(rgb: &[Rgb], width: u32) -> ImageView<'_> {
        ImageView {
            width,
            height: rgb.len() as u32 / width,
            rgb,
        }
    }

    #[test]
    fn known_values_have_their_srgb_codes() {
        let tone = ToneMap::default();
        // Code k covers the linear values that encode to k ± 1/2.
        for (linear, code) in [
            (0.0, 0),
            (0.0031308, 10),
            (0.214_041_14, 128),
            (0.18, 118),
            (0.5, 188),
            (1.0, 255),
        ] {
            assert_eq!(tone.encode(linear), code, "{linear}");
        }
        // Between the codes 0 and 1, where the function is linear.
        let half = 0.5 / 255.0 / 12.92;
        assert_eq!((tone.encode(half * 0.999), tone.encode(half * 1.001)), (0, 1));
    }

    #[test]
    fn every_code_comes_back_from_its_linear_value() {
        for code in 0..=255_u8 {
            let v = f64::from(code) / 255.0;
            let linear = if v <= 0.04045 {
                v / 12.92
            } else {
                libm::pow((v + 0.055) / 1.055, 2.4)
            };
            assert_eq!(ToneMap::default().encode(linear as f32), code);
        }
    }

    #[test]
    fn odd_values_are_shown_black_or_white() {
        let odd = [f32::NAN, f32::NEG_INFINITY, -1.0, f32::INFINITY, 7.0];
        for exposure in [0.0, 20.0, -3.0] {
            assert_eq!(
                odd[..4]
                    .iter()
                    .map(|&v| ToneMap { exposure }.encode(v))
                    .collect::<Vec<_>>(),
                [0, 0, 0, 255]
            );
        }
        assert_eq!(ToneMap::default().encode(7.0), 255);
        assert_eq!(
            ToneMap {
                exposure: f32::INFINITY
            }
            .encode(0.0),
            0
        );
    }

    #[test]
    fn exposure_is_in_stops() {
        for v in [0.01, 0.1, 0.2] {
            assert_eq!(ToneMap { exposure: 2.0 }.encode(v), ToneMap::default().encode(4.0 * v));
        }
    }

    #[test]
    fn automatic_exposure_brings_the_log_average_to_middle_grey() {
        let odd = [Rgb::BLACK, Rgb::splat(f32::NAN), Rgb::splat(f32::INFINITY)];
        let lit = [Rgb::splat(0.09), Rgb::splat(1.44), odd[0], odd[1], odd[2]];
        // The geometric mean of 0.09 and 1.44 is 0.36, one stop above 0.18.
        assert!((ToneMap::automatic(view(&lit, 5)).exposure + 1.0).abs() < 1e-5);
        assert_eq!(ToneMap::automatic(view(&odd, 3)), ToneMap::default());
        let brighter = ToneMap::automatic(view(&lit, 5)).brighter(3.0);
        assert!((brighter.exposure - 2.0).abs() < 1e-5);
    }

    #[test]
    fn a_tiny_picture_has_these_bytes() {
        let rgb = [
            Rgb::BLACK,
            Rgb::ONE,
            Rgb::new(0.18, 0.5, f32::NAN),
            Rgb::new(2.0, -1.0, 0.0031308),
        ];
        let bytes = encode_png(view(&rgb, 2), ToneMap::default()).expect("encoded");
        let decoded = image::load_from_memory(&bytes).expect("decoded").into_rgb8();
        assert_eq!(decoded.as_raw()[..], [0, 0, 0, 255, 255, 255, 118, 188, 0, 255, 0, 10]);
        assert_eq!(bytes, GOLDEN);
    }

    #[rustfmt::skip]
    const GOLDEN: [u8; 79] = [
        137, 80, 78, 71, 13, 10, 26, 10, // signature
        0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 2, 0, 0, 0, 2, 8, 2, 0, 0, 0, 253, 212, 154, 115, // IHDR
        0, 0, 0, 22, 73, 68, 65, 84, 120, 156, 99, 97, 96, 96, 248, 255, 255, 63, 75, 217, 30, 6, 6, 70, 110, 0, 33, 196,
        4, 68, 74, 32, 33, 185, // IDAT
        0, 0, 0, 0, 73, 69, 78, 68, 174, 66, 96, 130, // IEND
    ];

    #[test]
    fn pictures_that_are_not_are_refused() {
        assert!(
            encode_png(
                ImageView {
                    width: 0,
                    height: 4,
                    rgb: &[]
                },
                ToneMap::default()
            )
            .is_err()
        );
        assert!(
            encode_png(
                ImageView {
                    width: 2,
                    height: 2,
                    rgb: &[Rgb::ONE]
                },
                ToneMap::default()
            )
            .is_err()
        );
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("x.png");
        let error = write_png(
            &path,
            ImageView {
                width: 1,
                height: 0,
                rgb: &[],
            },
            ToneMap::default(),
        )
        .expect_err("empty");
        assert!(error.to_string().contains("x.png") && !path.exists());
    }
}
