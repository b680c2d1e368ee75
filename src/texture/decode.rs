//! Pictures from files: PNG, JPEG, OpenEXR and Radiance HDR, told apart by their first bytes.

use super::picture::Picture;
use super::srgb;
use crate::color::Rgb;
use crate::film::{damaged, decode_exr};
use crate::scene::TextureEncoding;
use image::error::ImageFormatHint;
use image::{DynamicImage, ImageError, ImageFormat, ImageReader, Limits};
use std::error::Error;
use std::io::Cursor;

/// The most texels of a picture: 8192 x 8192.
pub const MAX_TEXELS: u64 = 1 << 26;
/// The longest side of a picture, in texels.
const MAX_SIDE: u32 = 65_536;
/// Memory for decoding, in bytes: four channels of `f32` for each of the most texels.
const MAX_DECODER_BYTES: u64 = MAX_TEXELS * 16;

/// Reads a picture from the bytes of a file.
///
/// # Errors
/// What is wrong with it, in words.
pub fn decode(bytes: &[u8], encoding: TextureEncoding) -> Result<Picture, String> {
    const EXR: [u8; 4] = [0x76, 0x2F, 0x31, 0x01];
    let refuse_srgb = |what: &str| {
        let refused = encoding == TextureEncoding::Srgb;
        let message = format!("{what} holds linear light: `encoding: Srgb` is for PNG and JPEG files");
        if refused { Err(message) } else { Ok(()) }
    };
    if bytes.starts_with(&EXR) {
        refuse_srgb("an OpenEXR file")?;
        let read = decode_exr(bytes)?;
        check_size(read.width, read.height)?;
        return Picture::linear(read.width as usize, read.height as usize, read.rgb);
    }
    let format = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::Hdr)) => format,
        _ => return Err("it is no PNG, JPEG, OpenEXR or Radiance HDR file".to_owned()),
    };
    if format == ImageFormat::Hdr {
        refuse_srgb("a Radiance HDR file")?;
    }
    let reader = || ImageReader::with_format(Cursor::new(bytes), format);
    let (width, height) = reader().into_dimensions().map_err(in_words)?;
    check_size(width, height)?;
    let mut reader = reader();
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_DECODER_BYTES);
    reader.limits(limits);
    let image = reader.decode().map_err(in_words)?;
    let (width, height) = (image.width() as usize, image.height() as usize);
    let encoded = encoding != TextureEncoding::Linear;
    match rows(image)? {
        Rows::Bytes(codes) => Picture::coded(width, height, codes, srgb::values(u16::from(u8::MAX), encoded)),
        Rows::Words(codes) => {
            let values = srgb::values(u16::MAX, encoded);
            let colors = codes.iter().map(|code| Rgb::from(code.map(|c| values[usize::from(c)])));
            Picture::linear(width, height, colors.collect())
        }
        Rows::Floats(colors) => Picture::linear(width, height, colors),
    }
}

/// What is wrong with a picture that its decoder complains of. The decoder's own words stand beside it where people can
/// read them.
pub fn in_words(error: ImageError) -> String {
    match error {
        ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "it ends too early: the file is cut short".to_owned()
        }
        ImageError::Decoding(error) => {
            let format = match error.format_hint() {
                ImageFormatHint::Exact(ImageFormat::OpenExr) => "OpenEXR".to_owned(),
                ImageFormatHint::Exact(ImageFormat::Hdr) => "Radiance HDR".to_owned(),
                ImageFormatHint::Exact(format) => format!("{format:?}").to_uppercase(),
                _ => "a picture".to_owned(),
            };
            damaged(&format, &error.source().map(ToString::to_string).unwrap_or_default())
        }
        other => other.to_string(),
    }
}

fn check_size(width: u32, height: u32) -> Result<(), String> {
    if width == 0 || height == 0 {
        return Err("it has no texels".to_owned());
    }
    if width > MAX_SIDE || height > MAX_SIDE || u64::from(width) * u64::from(height) > MAX_TEXELS {
        return Err(format!(
            "it has {width} x {height} texels; at most {MAX_SIDE} in a row or column and {MAX_TEXELS} in all are read"
        ));
    }
    Ok(())
}

/// Texels as they stand in a file, without alpha; grey ones three times.
enum Rows {
    Bytes(Vec<[u8; 3]>),
    Words(Vec<[u16; 3]>),
    Floats(Vec<Rgb>),
}

fn rows(image: DynamicImage) -> Result<Rows, String> {
    fn grey<T: Copy>(samples: &[T], channels: usize) -> Vec<[T; 3]> {
        samples.chunks_exact(channels).map(|texel| [texel[0]; 3]).collect()
    }
    fn rgb<T: Copy>(samples: &[T], channels: usize) -> Vec<[T; 3]> {
        let texels = samples.chunks_exact(channels);
        texels.map(|texel| [texel[0], texel[1], texel[2]]).collect()
    }
    let colors = |texels: Vec<[f32; 3]>| texels.into_iter().map(Rgb::from).collect();
    Ok(match image {
        DynamicImage::ImageLuma8(image) => Rows::Bytes(grey(image.as_raw(), 1)),
        DynamicImage::ImageLumaA8(image) => Rows::Bytes(grey(image.as_raw(), 2)),
        DynamicImage::ImageRgb8(image) => Rows::Bytes(rgb(image.as_raw(), 3)),
        DynamicImage::ImageRgba8(image) => Rows::Bytes(rgb(image.as_raw(), 4)),
        DynamicImage::ImageLuma16(image) => Rows::Words(grey(image.as_raw(), 1)),
        DynamicImage::ImageLumaA16(image) => Rows::Words(grey(image.as_raw(), 2)),
        DynamicImage::ImageRgb16(image) => Rows::Words(rgb(image.as_raw(), 3)),
        DynamicImage::ImageRgba16(image) => Rows::Words(rgb(image.as_raw(), 4)),
        DynamicImage::ImageRgb32F(image) => Rows::Floats(colors(rgb(image.as_raw(), 3))),
        DynamicImage::ImageRgba32F(image) => Rows::Floats(colors(rgb(image.as_raw(), 4))),
        other => return Err(format!("its texels are of an unknown kind, {:?}", other.color())),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::encode_exr;
    use image::codecs::hdr::HdrEncoder;
    use image::codecs::jpeg::JpegEncoder;
    use image::codecs::png::PngEncoder;
    use image::{ExtendedColorType, ImageEncoder};

    fn png(samples: &[u8], width: u32, color: ExtendedColorType) -> Vec<u8> {
        let mut bytes = Vec::new();
        let texel = usize::from(color.bits_per_pixel()) / 8;
        let height = samples.len() as u32 / width / texel as u32;
        let encoded = PngEncoder::new(&mut bytes).write_image(samples, width, height, color);
        encoded.expect("encoded");
        bytes
    }

    fn read(bytes: &[u8]) -> Picture {
        decode(bytes, TextureEncoding::Auto).expect("a picture")
    }

    fn all(picture: &Picture) -> Vec<Rgb> {
        (0..picture.width() * picture.height())
            .map(|i| picture.at(i % picture.width(), i / picture.width()))
            .collect()
    }

    const HALF: f32 = 0.215_860_5;

    #[test]
    fn eight_bit_files_are_decoded_unless_they_are_linear() {
        let file = png(&[0, 128, 255, 255, 0, 128], 1, ExtendedColorType::Rgb8);
        let picture = read(&file);
        assert_eq!((picture.width(), picture.height()), (1, 2));
        let found = all(&picture);
        assert!(
            (found[0].g - HALF).abs() < 1e-7 && found[0].r == 0.0 && found[0].b == 1.0,
            "{found:?}"
        );
        assert!(
            found[1].r == 1.0 && found[1].g == 0.0,
            "the top row comes first: {found:?}"
        );
        let linear = decode(&file, TextureEncoding::Linear).expect("a picture");
        assert_eq!(linear.at(0, 0), Rgb::new(0.0, 128.0 / 255.0, 1.0));
        assert_eq!(decode(&file, TextureEncoding::Srgb).as_ref(), Ok(&picture));
        assert_eq!(picture.bytes(), 6);
    }

    #[test]
    fn sixteen_bit_grey_and_transparent_files_are_read() {
        let words: Vec<u8> = [0_u16, 32_896, 65_535].into_iter().flat_map(u16::to_ne_bytes).collect();
        let picture = read(&png(&words, 3, ExtendedColorType::L16));
        let found = all(&picture);
        // 32896 is 257 times 128.
        assert!(
            (found[1].r - HALF).abs() < 1e-7 && found[1].r == found[1].b,
            "{found:?}"
        );
        assert_eq!((found[0], found[2]), (Rgb::BLACK, Rgb::ONE));
        let seen_through = read(&png(&[255, 128, 0, 0], 1, ExtendedColorType::Rgba8));
        assert!((seen_through.at(0, 0).g - HALF).abs() < 1e-7 && seen_through.at(0, 0).r == 1.0);
        let grey = read(&png(&[128, 7, 255, 9], 2, ExtendedColorType::La8));
        assert!((grey.at(0, 0).b - HALF).abs() < 1e-7 && grey.at(1, 0) == Rgb::ONE);
    }

    #[test]
    fn jpeg_files_are_read_up_to_their_losses() {
        let mut file = Vec::new();
        let samples: Vec<u8> = (0..32 * 16)
            .flat_map(|i| if i % 32 < 16 { [200, 100, 50] } else { [20, 128, 230] })
            .collect();
        let encoded = JpegEncoder::new_with_quality(&mut file, 100).encode(&samples, 32, 16, ExtendedColorType::Rgb8);
        encoded.expect("encoded");
        let picture = read(&file);
        assert_eq!((picture.width(), picture.height()), (32, 16));
        assert!((picture.at(28, 8).g - HALF).abs() < 0.02, "{:?}", picture.at(28, 8));
        assert!((picture.at(3, 8).r - 0.577_58).abs() < 0.02, "{:?}", picture.at(3, 8));
    }

    #[test]
    fn float_files_are_linear_and_keep_what_is_above_one() {
        let colors = vec![Rgb::new(0.25, 1.5, 40.0), Rgb::new(0.0, 1e-3, 0.5)];
        let view = crate::film::ImageView {
            width: 1,
            height: 2,
            rgb: &colors,
        };
        let picture = crate::film::Picture {
            width: 1,
            height: 2,
            rgb: colors.clone(),
            error: vec![Rgb::BLACK; 2],
            weight: vec![1.0; 2],
            layers: Vec::new(),
        };
        let exr = encode_exr(&picture, &Default::default()).expect("encoded");
        assert_eq!(all(&read(&exr)), colors);
        let mut hdr = Vec::new();
        let pixels: Vec<_> = view.rgb.iter().map(|c| image::Rgb(c.to_array())).collect();
        HdrEncoder::new(&mut hdr).encode(&pixels, 1, 2).expect("encoded");
        for (found, expected) in all(&read(&hdr)).into_iter().zip(&colors) {
            // A shared exponent: eight bits for the largest channel.
            let off = (found - *expected).map(f32::abs).max_channel();
            assert!(off <= expected.max_channel() / 128.0, "{found:?} for {expected:?}");
        }
        for file in [&exr, &hdr] {
            let refused = decode(file, TextureEncoding::Srgb).expect_err("linear");
            assert!(refused.contains("holds linear light"), "{refused}");
        }
    }

    #[test]
    fn damaged_files_are_read_or_refused_but_never_panic() {
        let mut jpeg = Vec::new();
        let encoded = JpegEncoder::new(&mut jpeg).encode(&[100; 192], 8, 8, ExtendedColorType::Rgb8);
        encoded.expect("encoded");
        let mut hdr = Vec::new();
        HdrEncoder::new(&mut hdr)
            .encode(&[image::Rgb([1.0, 2.0, 3.0]); 16], 4, 4)
            .expect("encoded");
        for whole in [png(&[9; 48], 4, ExtendedColorType::Rgb8), jpeg, hdr] {
            assert!(decode(&whole, TextureEncoding::Auto).is_ok());
            for i in 0..whole.len() {
                let _ = decode(&whole[..i], TextureEncoding::Auto);
                for flip in [0x01, 0x80, 0xff] {
                    let mut damaged = whole.clone();
                    damaged[i] ^= flip;
                    if let Ok(picture) = decode(&damaged, TextureEncoding::Auto) {
                        assert!(picture.at(0, 0).is_finite());
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_no_picture_or_too_large_is_refused() {
        let error = decode(b"solid teapot", TextureEncoding::Auto).expect_err("no picture");
        assert!(error.contains("no PNG, JPEG"), "{error}");
        let claim = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n";
        let error = decode(claim, TextureEncoding::Auto).expect_err("too large");
        assert!(error.contains("60000 x 60000"), "{error}");
    }
}
