//! Pictures as OpenEXR files: colours, errors, weights and how they were made.
//!
//! One part with dotted channel names: `R`, `G`, `B` (the layer viewers show), `error.R`, `error.G`, `error.B` and
//! `weight.Y`, then those of the picture's further layers; all 32-bit floats, ZIP-compressed scan lines. The metadata are
//! text attributes. The bytes are a function
//! of the picture and its metadata alone: no date, lines in order, and attributes in order too ([`sort_attributes`]).

use super::layer::check_layers;
use super::metadata::PictureMetadata;
use super::picture::Picture;
use super::write::{WriteError, write_file};
use crate::color::Rgb;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, Text,
    WritableImage,
};
use std::io::Cursor;
use std::path::Path;

/// Writes `picture` to `path`, whole or not at all.
///
/// # Errors
/// As [`encode_exr`], or where the file cannot be written.
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
/// Where the picture has no pixel, or lists of another length than its sides say, or where a further layer or an extra
/// attribute has a name that is taken or cannot be one; the reason in words.
pub fn encode_exr(picture: &Picture, metadata: &PictureMetadata) -> Result<Vec<u8>, String> {
    let pixels = picture.width as usize * picture.height as usize;
    if pixels == 0 || [picture.rgb.len(), picture.error.len(), picture.weight.len()] != [pixels; 3] {
        return Err(format!(
            "its lists do not hold the {} x {} pixels it claims",
            picture.width, picture.height
        ));
    }
    check_layers(&picture.layers, pixels)?;
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
    let further = picture.layers.iter().flat_map(|layer| layer.planes());
    // Sorted below, by names that are all different: the order of the layers does not show.
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = channels
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, samples))
        .chain(further.map(|(name, samples)| AnyChannel::new(name.as_str(), FlatSamples::F32(samples))))
        .collect();

    let mut attributes = LayerAttributes {
        software_name: Some(text(&metadata.software)),
        ..Default::default()
    };
    for (name, value) in metadata.attributes()? {
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
    use crate::film::{LayerChannels, decode_exr, read_exr};
    use exr::prelude::{ReadChannels, ReadLayers};

    /// A picture whose lines compress badly enough to matter, with odd values among them.
    fn picture(width: u32, height: u32) -> Picture {
        let pixels = width * height;
        let value = |i: u32, k: u32| (i.wrapping_mul(2_654_435_761).wrapping_add(k * 77) >> 8) as f32 / 65536.0;
        let mut rgb: Vec<Rgb> = (0..pixels)
            .map(|i| Rgb::new(value(i, 1), value(i, 2), -value(i, 3)))
            .collect();
        rgb[0].g = f32::INFINITY;
        let error = (0..pixels).map(|i| Rgb::splat(value(i, 4))).collect();
        Picture::new(width, height, rgb, error, (0..pixels).map(|i| i as f32).collect())
    }

    fn metadata() -> PictureMetadata {
        PictureMetadata {
            scene: "scènes/Ω.ron".into(),
            technique: "pt".into(),
            settings: "(max_depth: 12,\n filter: Box(radius: 0.5))".into(),
            seed: u64::MAX,
            steps: 1024,
            software: "chainlight 0.1.0".into(),
            extra: vec![],
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
        for (name, value) in metadata.attributes().expect("sound names") {
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
    fn further_layers_and_attributes_come_back_and_their_order_does_not_show() {
        let mut picture = picture(5, 3);
        let plain = encode_exr(&picture, &metadata()).expect("encoded");
        let shine: Vec<f32> = (0..15).map(|i| i as f32 * 0.1).collect();
        let caustic: Vec<Rgb> = (0..15).map(|i| Rgb::new(i as f32, 0.5, -1.0)).collect();
        // One sorts before `error`, one between it and `weight`.
        picture = picture
            .with_layer("shine", LayerChannels::Y(shine.clone()))
            .with_layer("caustic", LayerChannels::Rgb(caustic.clone()));
        let metadata = metadata().with("groups", "16").with("acceptance", "0.25 of «large»");
        let bytes = encode_exr(&picture, &metadata).expect("encoded");
        assert!(bytes != plain);

        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(&bytes))
            .expect("an OpenEXR file");
        let list = &image.layer_data.channel_data.list;
        let channel = |name: &str| {
            let channel = list.iter().find(|c| c.name == *name).expect("the channel");
            channel.sample_data.values_as_f32().collect::<Vec<f32>>()
        };
        assert_eq!(list.len(), 7 + 4);
        assert_eq!(channel("shine.Y"), shine);
        assert_eq!(channel("caustic.R"), caustic.iter().map(|c| c.r).collect::<Vec<_>>());
        assert_eq!(
            (channel("caustic.G"), channel("caustic.B")),
            (vec![0.5; 15], vec![-1.0; 15])
        );

        let back = decode_exr(&bytes).expect("read");
        assert_eq!((&back.rgb, back.error.as_ref()), (&picture.rgb, Some(&picture.error)));
        assert_eq!(back.metadata["groups"], "16");
        assert_eq!(back.metadata["acceptance"], "0.25 of «large»");

        picture.layers.reverse();
        let mut turned = metadata;
        turned.extra.reverse();
        assert!(encode_exr(&picture, &turned).expect("encoded") == bytes);
    }

    #[test]
    fn layers_and_attributes_that_cannot_be_written_are_refused() {
        let long = picture(2, 2).with_layer("a", LayerChannels::Y(vec![0.0; 5]));
        assert!(encode_exr(&long, &metadata()).is_err_and(|e| e.contains("5 values for 4 pixels")));
        let taken = metadata().with("seed", "1");
        assert!(encode_exr(&picture(2, 2), &taken).is_err_and(|e| e.contains("attribute named seed")));
        // The longest names that are allowed are written and read.
        let fits = picture(2, 2).with_layer("l".repeat(29), LayerChannels::Y(vec![0.0; 4]));
        let bytes = encode_exr(&fits, &metadata().with("n".repeat(31), "x")).expect("encoded");
        assert_eq!(decode_exr(&bytes).expect("read").metadata[&"n".repeat(31)], "x");
    }

    #[test]
    fn a_picture_that_is_not_is_refused() {
        let mut short = picture(4, 4);
        short.weight.pop();
        assert!(encode_exr(&short, &metadata()).is_err());
        let empty = Picture::new(0, 0, vec![], vec![], vec![]);
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
