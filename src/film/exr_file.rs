//! Pictures as OpenEXR files: colours, errors, weights and how they were made.
//!
//! One part with dotted channel names: `R`, `G`, `B` (the layer viewers show), `error.R`, `error.G`, `error.B` and
//! `weight.Y`, all 32-bit floats, ZIP-compressed scan lines. The metadata are text attributes. The bytes are a function
//! of the picture and its metadata alone: no date, lines in order, and attributes in order too ([`sort_attributes`]).

use super::picture::Picture;
use super::write::{WriteError, write_file};
use crate::color::Rgb;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, Text,
    WritableImage,
};
use std::io::Cursor;
use std::path::Path;

/// How a picture was made: enough to make it again, and nothing that differs between two makings.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PictureMetadata {
    /// The scene's name or description.
    pub scene: String,
    /// The rendering technique: `pt`, `mlt`, ...
    pub technique: String,
    /// The settings, as text.
    pub settings: String,
    /// The seed of every random number.
    pub seed: u64,
    /// Steps taken: samples per pixel, or mutations per pixel.
    pub steps: u64,
    /// Program and version; stored as the standard attribute `software`.
    pub software: String,
}

impl PictureMetadata {
    /// The attributes beside `software`, as they are named in the file.
    fn attributes(&self) -> [(&'static str, String); 5] {
        [
            ("scene", self.scene.clone()),
            ("technique", self.technique.clone()),
            ("settings", self.settings.clone()),
            ("seed", self.seed.to_string()),
            ("steps", self.steps.to_string()),
        ]
    }
}

/// Writes `picture` to `path`, whole or not at all.
///
/// # Errors
/// Where the picture has no pixel, or the file cannot be written.
pub fn write_exr(path: &Path, picture: &Picture, metadata: &PictureMetadata) -> Result<(), WriteError> {
    let bytes = encode_exr(picture, metadata).map_err(|reason| WriteError::Encode {
        path: path.to_owned(),
        format: "an OpenEXR file",
        reason,
    })?;
    write_file(path, &bytes)
}

/// The bytes of `picture` as an OpenEXR file.
///
/// # Errors
/// Where the picture has no pixel, or lists of another length than its sides say; the reason in words.
pub fn encode_exr(picture: &Picture, metadata: &PictureMetadata) -> Result<Vec<u8>, String> {
    let pixels = picture.width as usize * picture.height as usize;
    if pixels == 0 || [picture.rgb.len(), picture.error.len(), picture.weight.len()] != [pixels; 3] {
        return Err(format!(
            "its lists do not hold the {} x {} pixels it claims",
            picture.width, picture.height
        ));
    }
    let plane = |pixels: &[Rgb], channel: fn(&Rgb) -> f32| FlatSamples::F32(pixels.iter().map(channel).collect());
    let channels: [(&str, FlatSamples); 7] = [
        ("R", plane(&picture.rgb, |c| c.r)),
        ("G", plane(&picture.rgb, |c| c.g)),
        ("B", plane(&picture.rgb, |c| c.b)),
        ("error.R", plane(&picture.error, |c| c.r)),
        ("error.G", plane(&picture.error, |c| c.g)),
        ("error.B", plane(&picture.error, |c| c.b)),
        ("weight.Y", FlatSamples::F32(picture.weight.clone())),
    ];
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = channels
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, samples))
        .collect();

    let mut attributes = LayerAttributes {
        software_name: Some(text(&metadata.software)),
        ..Default::default()
    };
    for (name, value) in metadata.attributes() {
        attributes.other.insert(text(name), AttributeValue::Text(text(&value)));
    }
    let size = (picture.width as usize, picture.height as usize);
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .to_buffered(&mut bytes)
        .map_err(|e| e.to_string())?;
    let mut bytes = bytes.into_inner();
    sort_attributes(&mut bytes).ok_or("its header came out malformed")?;
    Ok(bytes)
}

/// Text in UTF-8, as OpenEXR defines it (the library's own conversion knows Latin-1 only).
fn text(s: &str) -> Text {
    Text::from_slice_unchecked(s.as_bytes())
}

/// Puts the attributes of a one-part file in the order of their names. The library writes them in the order of a hash
/// map, which is another in every run. An attribute is `name 0 type 0 length value`; an empty name ends the list. Sorting
/// moves them within the header, so no offset in the file changes. Nothing when the header is not of this form.
fn sort_attributes(file: &mut [u8]) -> Option<()> {
    const FIRST: usize = 8; // After the magic number and the version.
    let mut attributes = Vec::new();
    let mut start = FIRST;
    while *file.get(start)? != 0 {
        let name = start + file[start..].iter().position(|&b| b == 0)?;
        let kind = name + 1 + file[name + 1..].iter().position(|&b| b == 0)?;
        let length = file.get(kind + 1..kind + 5)?;
        let length = u32::from_le_bytes([length[0], length[1], length[2], length[3]]) as usize;
        let end = kind + 5 + length;
        attributes.push((file[start..name].to_vec(), file.get(start..end)?.to_vec()));
        start = end;
    }
    attributes.sort();
    let sorted: Vec<u8> = attributes.into_iter().flat_map(|(_, bytes)| bytes).collect();
    file[FIRST..start].copy_from_slice(&sorted);
    Some(())
}
