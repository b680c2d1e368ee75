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
        .map_err(|e| e.to_string())?;

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

/// Refuses a picture too large to hold before anything is allocated for it.
fn check_size(bytes: &[u8]) -> Result<(), String> {
    let meta = MetaData::read_from_buffered(bytes, false).map_err(|e| e.to_string())?;
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
