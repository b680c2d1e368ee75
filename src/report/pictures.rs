//! Pictures in equal time, and maps of their errors.

use crate::color::Rgb;
use crate::film::{ExrPicture, ImageView, ReadError, ToneMap, encode_png, read_exr};
use crate::stats::flip::flip;
use crate::study::SceneStudy;
use std::path::{Path, PathBuf};

/// The pictures of a scene of a study: the first run's, way by way, and the reference.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The reference.
    reference: ExrPicture,
    /// The exposure at which all are shown.
    tone: ToneMap,
    /// Names and pictures.
    ways: Vec<(String, ExrPicture)>,
}

impl Shown {
    /// Reads the reference of a scene, and the pictures in the files that `file` names by the number of their way; those that are not there
    /// are left out.
    ///
    /// # Errors
    /// A file that is there and cannot be read as a picture, or no reference.
    pub fn read(scene: &SceneStudy, file: impl Fn(usize) -> PathBuf) -> Result<Self, ReadError> {
        let reference = read_exr(Path::new(&scene.reference.file))?;
        let mut ways = Vec::new();
        for (number, way) in scene.ways.iter().enumerate() {
            let path = file(number);
            if path.exists() {
                ways.push((way.name.clone(), read_exr(&path)?));
            }
        }
        Ok(Self {
            tone: ToneMap::automatic(reference.view()),
            reference,
            ways,
        })
    }

    /// Pixels in a row, and rows.
    pub(super) const fn size(&self) -> (u32, u32) {
        (self.reference.width, self.reference.height)
    }

    /// Names and PNG files of all pictures, the reference last, and of the maps of ꟻLIP.
    pub(super) fn layers(&self) -> Vec<(String, Vec<u8>)> {
        let mut layers = Vec::new();
        let mut add = |name: String, png: Result<Vec<u8>, String>| layers.extend(png.ok().map(|png| (name, png)));
        for (name, picture) in &self.ways {
            add(name.clone(), encode_png(picture.view(), self.tone));
        }
        add("reference".to_owned(), encode_png(self.reference.view(), self.tone));
        for (name, picture) in &self.ways {
            if let Ok(values) = flip(picture.view(), self.reference.view(), self.tone) {
                let colors: Vec<Rgb> = values.into_iter().map(heat).collect();
                let map = ImageView {
                    rgb: &colors,
                    ..picture.view()
                };
                add(format!("FLIP of {name}"), encode_png(map, ToneMap::default()));
            }
        }
        layers
    }
}

/// A colour for a value from 0 to 1 that grows lighter with it: black, violet, red, yellow, white, in linear light.
fn heat(value: f32) -> Rgb {
    const STOPS: [[f32; 3]; 5] = [
        [0.0, 0.0, 0.0],
        [0.08, 0.01, 0.22],
        [0.5, 0.03, 0.12],
        [0.97, 0.4, 0.05],
        [1.0, 1.0, 0.8],
    ];
    let place = value.clamp(0.0, 1.0) * (STOPS.len() - 1) as f32;
    let below = (place as usize).min(STOPS.len() - 2);
    let share = place - below as f32;
    let [r, g, b] = std::array::from_fn(|i| STOPS[below][i] + share * (STOPS[below + 1][i] - STOPS[below][i]));
    Rgb::new(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_grows_lighter() {
        let light: Vec<f32> = (0..=20).map(|i| heat(i as f32 / 20.0).luminance()).collect();
        assert!(light.windows(2).all(|w| w[0] < w[1]), "{light:?}");
        assert_eq!((heat(0.0), heat(-1.0)), (Rgb::BLACK, Rgb::BLACK));
        assert_eq!(heat(1.0), heat(2.0));
    }
}
