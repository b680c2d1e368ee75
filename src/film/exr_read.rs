//! Reads OpenEXR pictures: our own, and those of others (half, float or integer samples, channels in any order, further
//! layers, luminance only, a data window that is not the display window).

use super::exr_channels::{Color, FlatLayer, Window, channel_named, interleave, missing_colors, string};
use super::picture::ImageView;
use crate::color::Rgb;
use exr::prelude::{AttributeValue, MetaData, ReadChannels, ReadLayers, read};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The largest picture that is read, in pixels: 16384 squared. A header may claim anything.
const MAX_PIXELS: u64 = 1 << 28;

/// What an OpenEXR file holds of a picture. Row-major, top left first, over the file's display window.
#[derive(Clone, Debug, PartialEq)]
pub struct ExrPicture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear colours; black where the display window has no data.
    pub rgb: Vec<Rgb>,
    /// Standard error of `rgb`, where the file has `error.R`, `error.G` and `error.B`.
    pub error: Option<Vec<Rgb>>,
    /// Samples of the pixel, where the file has `weight.Y`.
    pub weight: Option<Vec<f32>>,
    /// Text attributes by name; `software` among them.
    pub metadata: BTreeMap<String, String>,
}

impl ExrPicture {
    /// A look at the colours.
    #[must_use]
    pub fn view(&self) -> ImageView<'_> {
        ImageView {
            width: self.width,
            height: self.height,
            rgb: &self.rgb,
        }
    }
}

/// Why a picture cannot be read.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", path.display())]
    #[diagnostic(help("check that the file is there and may be read"))]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file is not a picture of a kind that is read.
    #[error("cannot read {} as an OpenEXR picture: {reason}", path.display())]
    #[diagnostic(help("expected a flat OpenEXR file with channels R, G and B, or Y"))]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}

/// Reads the picture in the file at `path`.
///
/// # Errors
/// Where the file cannot be read, is not a flat OpenEXR file, is larger than 2²⁸ pixels, or has neither R, G and B nor Y.
pub fn read_exr(path: &Path) -> Result<ExrPicture, ReadError> {
    let bytes = std::fs::read(path).map_err(|source| ReadError::Io {
        path: path.to_owned(),
        source,
    })?;
    decode_exr(&bytes).map_err(|reason| ReadError::Format {
        path: path.to_owned(),
        reason,
    })
}

/// Reads the picture in the bytes of an OpenEXR file.
///
/// # Errors
/// As [`read_exr`]; the reason in words.
pub fn decode_exr(bytes: &[u8]) -> Result<ExrPicture, String> {
    check_size(bytes)?;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(in_words)?;

    let window = image.attributes.display_window;
    let window = Window {
        x: window.position.0,
        y: window.position.1,
        width: window.size.0,
        height: window.size.1,
    };
    let layers = &image.layer_data;
    let (layer, color) = layers
        .iter()
        .find_map(|layer| Some((layer, Color::of(layer)?)))
        .ok_or_else(|| missing_colors(layers))?;

    // Further channels may sit in the colours' layer under a dotted name, or in a layer of that name.
    let plane = |group: &str, channel: &str| {
        let dotted = channel_named(layer, &format!("{group}.{channel}")).map(|c| (layer, c));
        dotted.or_else(|| {
            let named = |l: &&FlatLayer| {
                l.attributes
                    .layer_name
                    .as_ref()
                    .is_some_and(|n| n.as_slice() == group.as_bytes())
            };
            layers
                .iter()
                .filter(named)
                .find_map(|l| Some((l, channel_named(l, channel)?)))
        })
    };
    let error = match (plane("error", "R"), plane("error", "G"), plane("error", "B")) {
        (Some(r), Some(g), Some(b)) => Some(interleave([
            window.plane(r.0, r.1)?,
            window.plane(g.0, g.1)?,
            window.plane(b.0, b.1)?,
        ])),
        _ => None,
    };
    let weight = plane("weight", "Y").map(|(l, c)| window.plane(l, c)).transpose()?;

    let mut metadata = BTreeMap::new();
    for (name, value) in image.attributes.other.iter().chain(&layer.attributes.other) {
        if let AttributeValue::Text(value) = value {
            metadata.insert(string(name), string(value));
        }
    }
    if let Some(software) = &layer.attributes.software_name {
        metadata.insert("software".to_owned(), string(software));
    }
    let rgb = match color {
        Color::Rgb([r, g, b]) => interleave([
            window.plane(layer, r)?,
            window.plane(layer, g)?,
            window.plane(layer, b)?,
        ]),
        Color::Luminance(y) => window.plane(layer, y)?.into_iter().map(Rgb::splat).collect(),
    };
    Ok(ExrPicture {
        width: window.width as u32,
        height: window.height as u32,
        rgb,
        error,
        weight,
        metadata,
    })
}

/// What is wrong with a file that its decoder complains of.
fn in_words(error: exr::error::Error) -> String {
    match error {
        exr::error::Error::Invalid(cause) => damaged("OpenEXR", &cause),
        exr::error::Error::Io(cause) => damaged("OpenEXR", &cause.to_string()),
        // Flags that are damaged are features that nobody supports.
        exr::error::Error::NotSupported(cause) => {
            format!("it is damaged, or OpenEXR of a kind that is not read here ({cause})")
        }
        exr::error::Error::Aborted => damaged("OpenEXR", ""),
    }
}

/// Of a file of the given format that cannot be decoded; `cause` is what its decoder says.
#[must_use]
pub fn damaged(format: &str, cause: &str) -> String {
    let is_prose = |c: char| c.is_alphanumeric() || " ,.:;'-/()".contains(c);
    let says_something = !cause.is_empty() && cause.chars().all(is_prose) && !cause.contains("::");
    let cause = if says_something && !cause.contains("whole buffer") {
        format!(" ({cause})")
    } else {
        String::new()
    };
    format!("it cannot be decoded as {format}: the file is cut short or damaged{cause}")
}

/// Refuses a picture too large to hold before anything is allocated for it.
fn check_size(bytes: &[u8]) -> Result<(), String> {
    let meta = MetaData::read_from_buffered(bytes, false).map_err(in_words)?;
    for header in &meta.headers {
        for size in [header.layer_size, header.shared_attributes.display_window.size] {
            let pixels = (size.0 as u64).saturating_mul(size.1 as u64);
            if pixels > MAX_PIXELS {
                return Err(format!(
                    "it claims {} x {} pixels; at most {MAX_PIXELS} are read",
                    size.0, size.1
                ));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{
        AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer, LayerAttributes,
        SmallVec, Text, Vec2, WritableImage, f16,
    };

    fn layer(name: Option<&str>, size: (usize, usize), channels: Vec<(&str, FlatSamples)>) -> FlatLayer {
        let channels: SmallVec<[_; 4]> = channels.into_iter().map(|(name, s)| AnyChannel::new(name, s)).collect();
        let attributes = LayerAttributes {
            layer_name: name.map(Text::from),
            ..Default::default()
        };
        Layer::new(size, attributes, Encoding::UNCOMPRESSED, AnyChannels::sort(channels))
    }

    fn file(layers: Vec<FlatLayer>, window: IntegerBounds) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let image = Image::from_layers(ImageAttributes::new(window), layers);
        image.write().to_buffered(&mut bytes).expect("encoded");
        bytes.into_inner()
    }

    fn floats(values: &[f32]) -> FlatSamples {
        FlatSamples::F32(values.to_vec())
    }

    #[test]
    fn mixed_sample_types_and_further_channels_are_read() {
        let half = |v: [f32; 2]| FlatSamples::F16(v.map(f16::from_f32).to_vec());
        let channels = vec![
            ("Z", floats(&[9.0, 9.0])),
            ("R", half([0.5, -2.0])),
            ("B", FlatSamples::U32(vec![3, 7])),
            ("A", half([1.0, 1.0])),
            ("G", floats(&[0.1, 0.2])),
        ];
        let read = decode_exr(&file(
            vec![layer(None, (2, 1), channels)],
            IntegerBounds::from_dimensions((2, 1)),
        ));
        let read = read.expect("read");
        assert_eq!(read.rgb, [Rgb::new(0.5, 0.1, 3.0), Rgb::new(-2.0, 0.2, 7.0)]);
        assert_eq!((read.error, read.weight), (None, None));
    }

    #[test]
    fn luminance_alone_is_read_as_grey() {
        let y = layer(None, (1, 2), vec![("Y", floats(&[0.25, 4.0]))]);
        let read = decode_exr(&file(vec![y], IntegerBounds::from_dimensions((1, 2)))).expect("read");
        assert_eq!(read.rgb, [Rgb::splat(0.25), Rgb::splat(4.0)]);
    }

    #[test]
    fn colors_are_found_behind_other_layers_and_errors_in_a_layer_of_their_own() {
        let rgb = |v: f32| vec![("R", floats(&[v])), ("G", floats(&[v])), ("B", floats(&[v]))];
        let layers = vec![
            layer(Some("depth"), (1, 1), vec![("Z", floats(&[8.0]))]),
            layer(Some("beauty"), (1, 1), rgb(0.5)),
            layer(Some("error"), (1, 1), rgb(0.125)),
        ];
        let read = decode_exr(&file(layers, IntegerBounds::from_dimensions((1, 1)))).expect("read");
        assert_eq!(
            (read.rgb, read.error),
            (vec![Rgb::splat(0.5)], Some(vec![Rgb::splat(0.125)]))
        );
    }

    #[test]
    fn data_is_laid_over_the_display_window() {
        // The window spans x 10..13, y 20..22; the data x 12..14, y 19..21: one pixel of it is inside.
        let mut y = layer(None, (2, 2), vec![("Y", floats(&[1.0, 2.0, 3.0, 4.0]))]);
        y.attributes.layer_position = Vec2(12, 19);
        let read = decode_exr(&file(vec![y], IntegerBounds::new((10, 20), (3, 2)))).expect("read");
        let expected = [0.0, 0.0, 3.0, 0.0, 0.0, 0.0].map(Rgb::splat);
        assert_eq!((read.width, read.height, &read.rgb[..]), (3, 2, &expected[..]));
    }

    #[test]
    fn a_file_without_colors_says_what_it_has() {
        let z = layer(None, (1, 1), vec![("Z", floats(&[1.0])), ("R", floats(&[1.0]))]);
        let error = decode_exr(&file(vec![z], IntegerBounds::from_dimensions((1, 1)))).expect_err("no colors");
        assert!(error.contains("neither") && error.ends_with("R, Z"), "{error}");
    }

    #[test]
    fn a_header_that_claims_too_much_is_refused_before_anything_is_allocated() {
        let y = layer(None, (1, 1), vec![("Y", floats(&[1.0]))]);
        let window = IntegerBounds::from_dimensions((1_000_000, 1_000_000));
        let error = decode_exr(&file(vec![y], window)).expect_err("too large");
        assert!(error.contains("1000000 x 1000000"), "{error}");
    }

    #[test]
    fn truncated_files_are_refused() {
        let y = layer(None, (4, 4), vec![("Y", floats(&[1.5; 16]))]);
        let whole = file(vec![y], IntegerBounds::from_dimensions((4, 4)));
        for length in 0..whole.len() {
            assert!(
                decode_exr(&whole[..length]).is_err(),
                "{length} of {} bytes",
                whole.len()
            );
        }
    }

    #[test]
    fn damaged_files_are_read_or_refused_but_never_panic() {
        let y = layer(None, (4, 4), vec![("Y", floats(&[1.5; 16]))]);
        let whole = file(vec![y], IntegerBounds::from_dimensions((4, 4)));
        for i in 0..whole.len() {
            for flip in [0x01, 0x80, 0xff] {
                let mut damaged = whole.clone();
                damaged[i] ^= flip;
                if let Ok(read) = decode_exr(&damaged) {
                    assert_eq!(read.rgb.len(), read.width as usize * read.height as usize);
                }
            }
        }
    }

    #[test]
    fn errors_name_the_file() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("none.exr");
        let error = read_exr(&path).expect_err("not there");
        assert!(
            matches!(error, ReadError::Io { .. }) && error.to_string().contains("none.exr"),
            "{error}"
        );
        std::fs::write(&path, b"not a picture").expect("written");
        let error = read_exr(&path).expect_err("not a picture");
        assert!(
            matches!(error, ReadError::Format { .. }) && error.to_string().contains("none.exr"),
            "{error}"
        );
    }
}
