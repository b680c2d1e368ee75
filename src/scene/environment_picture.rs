//! Pictures of all directions: EXR and Radiance HDR files.

use super::at::At;
use super::error::SceneError;
use super::limits::MAX_RADIANCE;
use super::read::open_regular;
use crate::color::Rgb;
use crate::light::Image;
use crate::texture::in_words;
use glam::DVec3;
use image::{ImageFormat, ImageReader};
use std::io::BufReader;
use std::path::Path;

/// The most texels of a picture.
const MAX_TEXELS: u64 = 1 << 27;

/// Reads the picture `file`; `at` is the place of its name in the scene.
pub(super) fn read(at: &At, file: &Path, scale: f32, up: DVec3, rotate: f32) -> Result<Image, SceneError> {
    let path = at.source.base_dir.join(file);
    let cannot = |problem: String, help: &str| {
        at.error(
            format!("cannot read the environment {}: {problem}", path.display()),
            help,
        )
    };
    let input = open_regular(&path).map_err(|problem| cannot(problem, ""))?;
    let reader = ImageReader::new(BufReader::new(input));
    let mut reader = reader
        .with_guessed_format()
        .map_err(|error| cannot(error.to_string(), ""))?;
    if !matches!(reader.format(), Some(ImageFormat::OpenExr | ImageFormat::Hdr)) {
        let help = "radiance needs a format without an upper end: convert it to EXR";
        return Err(cannot(
            "it is neither an EXR nor a Radiance HDR picture".to_owned(),
            help,
        ));
    }
    let mut limits = image::Limits::no_limits();
    limits.max_alloc = Some(MAX_TEXELS * 16);
    reader.limits(limits);
    let picture = reader
        .decode()
        .map_err(|error| cannot(in_words(error), "write the picture anew"))?
        .into_rgb32f();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    if width == 0 || height == 0 {
        let problem = format!("it is empty: it has {width} x {height} texels");
        return Err(cannot(
            problem,
            "light of one colour is an `Environment(radiance: ...)`",
        ));
    }
    if width as u64 * height as u64 > MAX_TEXELS {
        let problem = format!("it has more than {MAX_TEXELS} texels");
        return Err(cannot(problem, "make it smaller"));
    }
    let texels: Vec<Rgb> = picture.pixels().map(|texel| Rgb::from(texel.0) * scale).collect();
    if let Some(bright) = texels
        .iter()
        .position(|texel| texel.max_channel() > MAX_RADIANCE && texel.is_finite())
    {
        let problem = format!(
            "the texel in column {} of row {} is brighter than {MAX_RADIANCE:e} with `scale`",
            bright % width,
            bright / width
        );
        return Err(cannot(problem, "choose a smaller `scale`"));
    }
    let image = Image::new((width, height), texels, up, rotate);
    image.map_err(|error| {
        cannot(
            error.to_string(),
            "correct the picture: radiance is finite and not negative",
        )
    })
}
