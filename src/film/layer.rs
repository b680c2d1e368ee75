//! Further layers of a picture: more values per pixel beside colour, error and weight.

use crate::color::Rgb;

/// The longest channel or attribute name that every OpenEXR reader takes: longer ones need a flag in the file.
pub(super) const LONGEST_NAME: usize = 31;

/// A layer that a technique adds to its picture, such as what one kind of path brought.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureLayer {
    /// Its name, of the letters a to z and underscores; neither `error` nor `weight`, which every picture has.
    pub name: String,
    /// Its values.
    pub channels: LayerChannels,
}

/// The values of a layer, one entry per pixel, row-major, top left first.
#[derive(Clone, Debug, PartialEq)]
pub enum LayerChannels {
    /// One value: the channel `name.Y` of a file.
    Y(Vec<f32>),
    /// A colour: the channels `name.R`, `name.G` and `name.B`.
    Rgb(Vec<Rgb>),
}

impl PictureLayer {
    /// The channels as files name them.
    pub(super) fn planes(&self) -> Vec<(String, Vec<f32>)> {
        let plane = |suffix: char, values: Vec<f32>| (format!("{}.{suffix}", self.name), values);
        match &self.channels {
            LayerChannels::Y(values) => vec![plane('Y', values.clone())],
            LayerChannels::Rgb(colors) => vec![
                plane('R', colors.iter().map(|c| c.r).collect()),
                plane('G', colors.iter().map(|c| c.g).collect()),
                plane('B', colors.iter().map(|c| c.b).collect()),
            ],
        }
    }

    fn len(&self) -> usize {
        match &self.channels {
            LayerChannels::Y(values) => values.len(),
            LayerChannels::Rgb(colors) => colors.len(),
        }
    }
}

/// Refuses layers whose names cannot be written or are not their own, or that do not have `pixels` entries; in words.
pub(super) fn check_layers(layers: &[PictureLayer], pixels: usize) -> Result<(), String> {
    for (i, layer) in layers.iter().enumerate() {
        let name = &layer.name;
        if name.is_empty() || !name.bytes().all(|b| b.is_ascii_lowercase() || b == b'_') {
            return Err(format!(
                "its layer {name:?} is not named with the letters a to z and underscores"
            ));
        }
        if name.len() + ".R".len() > LONGEST_NAME {
            return Err(format!(
                "the name of its layer {name} is longer than {} letters",
                LONGEST_NAME - 2
            ));
        }
        if name == "error" || name == "weight" || layers[..i].iter().any(|other| other.name == *name) {
            return Err(format!("it has more than one layer named {name}"));
        }
        if layer.len() != pixels {
            return Err(format!(
                "its layer {name} holds {} values for {pixels} pixels",
                layer.len()
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(name: &str, pixels: usize) -> PictureLayer {
        PictureLayer {
            name: name.to_owned(),
            channels: LayerChannels::Y(vec![1.0; pixels]),
        }
    }

    #[test]
    fn names_and_lengths_are_checked_in_words() {
        let check = |layers: &[PictureLayer]| check_layers(layers, 6);
        assert_eq!(check(&[]), Ok(()));
        assert_eq!(
            check(&[layer("a", 6), layer("large_step", 6), layer(&"z".repeat(29), 6)]),
            Ok(())
        );
        for name in ["", "A", "a.b", "a b", "ä", "a1", "a\0"] {
            let refusal = check(&[layer(name, 6)]).expect_err("no name");
            assert!(refusal.contains(&format!("{name:?}")), "{refusal}");
        }
        let refusals = [
            (vec![layer("error", 6)], "more than one layer named error"),
            (vec![layer("weight", 6)], "more than one layer named weight"),
            (
                vec![layer("a", 6), layer("b", 6), layer("a", 6)],
                "more than one layer named a",
            ),
            (vec![layer(&"z".repeat(30), 6)], "longer than 29 letters"),
            (vec![layer("short", 5)], "its layer short holds 5 values for 6 pixels"),
        ];
        for (layers, words) in refusals {
            let refusal = check(&layers).expect_err("refused");
            assert!(refusal.contains(words), "{refusal}");
        }
    }
}
