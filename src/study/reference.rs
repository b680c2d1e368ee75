//! What pictures are compared with.

use super::Spectrum;
use super::spectrum::spectrum;
use super::study_file::Errors;
use crate::color::Rgb;
use crate::film::{ExrPicture, ImageView, ReadError, ToneMap, read_exr};
use crate::scene::Scene;
use crate::stats::flip::mean_flip;
use crate::stats::metrics::{Metrics, REL_MSE_EPSILON, compare};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// What is known of a reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceRecord {
    /// Its file.
    pub file: String,
    /// How it was made, where the file says so: technique and settings.
    pub made_by: Option<String>,
    /// Its own mean squared error, from its standard errors; absent where the file has none.
    pub own_mse: Option<f64>,
    /// Its own relative mean squared error.
    pub own_rel_mse: Option<f64>,
    /// Mean over pixels and channels.
    pub mean: f64,
}

/// A picture that is taken for the truth, and how near to it it is.
#[derive(Clone, Debug)]
pub struct Reference {
    picture: ExrPicture,
    tone: ToneMap,
    /// What a study's file says of it.
    pub record: ReferenceRecord,
}

/// Why a picture is no reference for a scene.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReferenceError {
    /// It cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// Its sides are others.
    #[error("{}: {} x {} pixels, and the picture has {} x {}", path.display(), reference.0, reference.1, picture.0, picture.1)]
    #[diagnostic(help("render at its size with --size, or make one with --make-reference"))]
    Size {
        /// The file.
        path: PathBuf,
        /// Its sides.
        reference: (u32, u32),
        /// The picture's.
        picture: (u32, u32),
    },
    /// It is of other light, by what it says of itself.
    #[error("{}: made with {had}, and the picture is with {asked}", path.display())]
    #[diagnostic(help("render with the same, or make a reference with --make-reference"))]
    Other {
        /// The file.
        path: PathBuf,
        /// What it says.
        had: String,
        /// What the picture will say.
        asked: String,
    },
    /// Nothing can be relative to it.
    #[error("{}: it is black, or has no finite pixel", path.display())]
    #[diagnostic(help("errors are relative to a reference: give one that shows something"))]
    Black {
        /// The file.
        path: PathBuf,
    },
}

impl Reference {
    /// The picture at `path`, as a reference for `scene`, whose pictures' settings begin with `settings`: size, depth and filter.
    ///
    /// # Errors
    /// A file that cannot be read, or that is not of this scene as far as it says what it is of.
    pub fn read(path: &Path, scene: &Scene, settings: &str) -> Result<Self, ReferenceError> {
        let picture = read_exr(path)?;
        let sides = [(picture.width, picture.height), (scene.width, scene.height)];
        if sides[0] != sides[1] {
            return Err(ReferenceError::Size {
                path: path.to_owned(),
                reference: sides[0],
                picture: sides[1],
            });
        }
        // Pictures of other renderers do not say.
        let ours = picture
            .metadata
            .get("software")
            .is_some_and(|software| software.starts_with("chainlight"));
        let of = |settings: &str| settings.split(' ').take(3).collect::<Vec<_>>().join(" ");
        if let (true, Some(had)) = (ours, picture.metadata.get("settings"))
            && of(had) != of(settings)
        {
            return Err(ReferenceError::Other {
                path: path.to_owned(),
                had: of(had),
                asked: of(settings),
            });
        }
        let finite = || picture.rgb.iter().filter(|color| color.is_finite());
        let sum: f64 = finite().flat_map(|color| color.to_array()).map(f64::from).sum();
        let mean = sum / (3 * finite().count()).max(1) as f64;
        if mean <= 0.0 {
            return Err(ReferenceError::Black { path: path.to_owned() });
        }
        let own = picture
            .error
            .as_ref()
            .and_then(|errors| own_error(&picture.rgb, errors));
        let made_by = ["technique", "settings"].map(|name| picture.metadata.get(name).cloned());
        let record = ReferenceRecord {
            file: path.display().to_string(),
            made_by: match made_by {
                [Some(technique), Some(settings)] => Some(format!("{technique} {settings}")),
                [Some(technique), None] => Some(technique),
                _ => None,
            },
            own_mse: own.map(|[mse, _]| mse),
            own_rel_mse: own.map(|[_, rel_mse]| rel_mse),
            mean,
        };
        Ok(Self {
            tone: ToneMap::automatic(picture.view()),
            picture,
            record,
        })
    }

    /// The exposure at which it is shown.
    #[must_use]
    pub const fn tone(&self) -> ToneMap {
        self.tone
    }

    /// Its colours.
    #[must_use]
    pub fn view(&self) -> ImageView<'_> {
        self.picture.view()
    }

    /// How far a picture of the same sides is from it; `None` if its sides are others.
    #[must_use]
    pub fn errors_of(&self, picture: ImageView<'_>) -> Option<(Errors, Spectrum)> {
        let Metrics {
            mse,
            rel_mse,
            rel_mse_trimmed,
            smape,
            mean_ratio,
            ..
        } = compare(picture, self.view()).ok()?;
        let flip = mean_flip(picture, self.view(), self.tone).ok()?;
        let errors = Errors {
            mse,
            rel_mse,
            rel_mse_trimmed,
            smape,
            flip,
            mean_ratio: mean_ratio.is_finite().then_some(mean_ratio),
        };
        Some((
            errors,
            spectrum(picture.rgb, &self.picture.rgb, self.picture.width as usize),
        ))
    }

    /// Mean over pixels and channels of (a − r)(b − r) / (r² + 0.01), over pixels that are finite in all three.
    #[must_use]
    pub fn shared_error(&self, a: &[Rgb], b: &[Rgb]) -> f64 {
        let (mut sum, mut count) = (0.0, 0_u64);
        for ((a, b), r) in a.iter().zip(b).zip(&self.picture.rgb) {
            if ![a, b, r].into_iter().all(|color| color.is_finite()) {
                continue;
            }
            let channels = a.to_array().into_iter().zip(b.to_array()).zip(r.to_array());
            for ((a, b), r) in channels {
                let [a, b, r] = [a, b, r].map(f64::from);
                sum += (a - r) * (b - r) / (r * r + REL_MSE_EPSILON);
            }
            count += 3;
        }
        sum / count.max(1) as f64
    }
}

/// Mean squared and relative mean squared error of colours with these standard errors; `None` where nothing is known of one.
fn own_error(colors: &[Rgb], errors: &[Rgb]) -> Option<[f64; 2]> {
    let (mut sums, mut count) = ([0.0; 2], 0_u64);
    for (color, error) in colors.iter().zip(errors).filter(|(color, _)| color.is_finite()) {
        for (r, e) in color.to_array().into_iter().zip(error.to_array()) {
            let (r, e) = (f64::from(r), f64::from(e));
            if !e.is_finite() {
                return None;
            }
            sums[0] += e * e;
            sums[1] += e * e / (r * r + REL_MSE_EPSILON);
            count += 1;
        }
    }
    (count > 0).then(|| sums.map(|sum| sum / count as f64))
}
