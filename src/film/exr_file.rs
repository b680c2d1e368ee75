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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{decode_exr, read_exr};

    /// A picture whose lines compress badly enough to matter, with odd values among them.
    fn picture(width: u32, height: u32) -> Picture {
        let pixels = width * height;
        let value = |i: u32, k: u32| (i.wrapping_mul(2_654_435_761).wrapping_add(k * 77) >> 8) as f32 / 65536.0;
        let mut rgb: Vec<Rgb> = (0..pixels)
            .map(|i| Rgb::new(value(i, 1), value(i, 2), -value(i, 3)))
            .collect();
        rgb[0].g = f32::INFINITY;
        Picture {
            width,
            height,
            rgb,
            error: (0..pixels).map(|i| Rgb::splat(value(i, 4))).collect(),
            weight: (0..pixels).map(|i| i as f32).collect(),
        }
    }

    fn metadata() -> PictureMetadata {
        PictureMetadata {
            scene: "scènes/Ω.ron".into(),
            technique: "pt".into(),
            settings: "(max_depth: 12,\n filter: Box(radius: 0.5))".into(),
            seed: u64::MAX,
            steps: 1024,
            software: "chainlight 0.1.0".into(),
        }
    }

    #[test]
    fn everything_comes_back_from_the_file() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("picture.exr");
        let (picture, metadata) = (picture(37, 41), metadata());
        write_exr(&path, &picture, &metadata).expect("written");
        let back = read_exr(&path).expect("read");
        assert_eq!((back.width, back.height), (37, 41));
        assert_eq!(back.rgb, picture.rgb);
        assert_eq!(back.error.as_ref(), Some(&picture.error));
        assert_eq!(back.weight.as_ref(), Some(&picture.weight));
        for (name, value) in metadata.attributes() {
            assert_eq!(back.metadata[name], value);
        }
        assert_eq!(back.metadata["software"], metadata.software);
    }

    #[test]
    fn bytes_are_the_same_however_often_and_on_however_many_threads_they_are_written() {
        let (picture, metadata) = (picture(64, 200), metadata());
        let first = encode_exr(&picture, &metadata).expect("encoded");
        for threads in [1, 2, 5, 1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("a pool");
            assert!(
                pool.install(|| encode_exr(&picture, &metadata)).expect("encoded") == first,
                "{threads} threads"
            );
        }
    }

    #[test]
    fn channels_and_attributes_lie_in_order() {
        let bytes = encode_exr(&picture(3, 2), &metadata()).expect("encoded");
        let place = |name: &str| bytes.windows(name.len()).position(|w| w == name.as_bytes());
        let attributes = [
            "displayWindow\0box2i\0",
            "lineOrder\0lineOrder\0",
            "scene\0string\0",
            "seed\0string\0",
            "settings\0string\0",
            "software\0string\0",
            "steps\0string\0",
            "technique\0string\0",
        ];
        let channels = [
            "\0G\0",
            "\0R\0",
            "\0error.B\0",
            "\0error.G\0",
            "\0error.R\0",
            "\0weight.Y\0",
        ];
        for places in [attributes.map(place).to_vec(), channels.map(place).to_vec()] {
            assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}");
        }
    }

    #[test]
    fn a_picture_that_is_not_is_refused() {
        let mut short = picture(4, 4);
        short.weight.pop();
        assert!(encode_exr(&short, &metadata()).is_err());
        let empty = Picture {
            width: 0,
            height: 0,
            rgb: vec![],
            error: vec![],
            weight: vec![],
        };
        let error = write_exr(Path::new("x.exr"), &empty, &metadata()).expect_err("empty");
        assert!(error.to_string().contains("x.exr"), "{error}");
        assert!(decode_exr(b"").is_err());
    }

    #[test]
    fn malformed_headers_are_left_alone() {
        for bytes in [
            &b""[..],
            b"12345678",
            b"12345678abc",
            b"12345678a\0b\0\xff\xff\xff\xffzz",
        ] {
            let mut copy = bytes.to_vec();
            assert_eq!(sort_attributes(&mut copy), None);
            assert_eq!(copy, bytes);
        }
    }
}
