//! Material libraries of OBJ files (MTL): what they say, in terms of the scene's own materials.
//!
//! | MTL | material |
//! |---|---|
//! | `d` below 1 (or `Tr` above 0), or `illum` 4, 6, 7, 9 | `Dielectric` with `Ni` inside (1.5 where there is none) |
//! | else `illum` 3, 5 | `Conductor` that mirrors every direction alike, scaled by `Ks` (1 where there is none) |
//! | else | `Diffuse` with `Kd` (black where there is none) |
//!
//! `Ke` is emission, in W sr⁻¹ m⁻². Everything else, textures above all, is left out with a warning.

use crate::color::Rgb;
use crate::scene::description::MaterialDescription;
use crate::scene::limits::MAX_RADIANCE;
use crate::scene::read::read_bounded;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::obj_lines::MaterialNames;

/// The largest material library, in bytes.
const MAX_LIBRARY_BYTES: u64 = 16 << 20;

/// The material libraries of one OBJ file, read when `tobj` asks for them.
pub(super) struct Libraries<'a> {
    folder: &'a Path,
    /// The names that they define.
    pub(super) names: MaterialNames,
    /// What was wrong with the first that could not be read.
    pub(super) problem: RefCell<Option<String>>,
    /// What was left out, by file.
    pub(super) ignored: RefCell<BTreeMap<String, BTreeSet<String>>>,
}

impl<'a> Libraries<'a> {
    pub(super) fn new(folder: &'a Path) -> Self {
        Self {
            folder,
            names: RefCell::default(),
            problem: RefCell::default(),
            ignored: RefCell::default(),
        }
    }

    /// Reads the library `file`, relative to the OBJ file's folder.
    pub(super) fn load(&self, file: &Path) -> tobj::MTLLoadResult {
        let shown = file.display().to_string();
        let read = read_bounded(&self.folder.join(file), MAX_LIBRARY_BYTES);
        let plain = read.and_then(|bytes| plain_library(&String::from_utf8_lossy(&bytes)));
        let plain = plain.map_err(|problem| {
            let problem = format!("material library {shown}: {problem}");
            self.problem.borrow_mut().get_or_insert(problem);
            tobj::LoadError::ReadError
        })?;
        let loaded = tobj::load_mtl_buf(&mut plain.text.as_bytes())?;
        self.names
            .borrow_mut()
            .extend(loaded.0.iter().map(|material| material.name.clone()));
        if !plain.ignored.is_empty() {
            self.ignored
                .borrow_mut()
                .entry(shown)
                .or_default()
                .extend(plain.ignored);
        }
        Ok(loaded)
    }
}

/// A library in the form that `tobj` can take, and the statements left out of it.
struct PlainLibrary {
    text: String,
    ignored: BTreeSet<String>,
}

/// Checks a library line by line: `tobj` panics where a colour has fewer than three numbers.
fn plain_library(text: &str) -> Result<PlainLibrary, String> {
    let mut plain = PlainLibrary {
        text: String::new(),
        ignored: BTreeSet::new(),
    };
    let mut inside = false;
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        let at = |message: String| format!("line {}: {message}", index + 1);
        let plain_line = match keyword {
            "newmtl" if rest.is_empty() => return Err(at("`newmtl` without a name".to_owned())),
            "newmtl" => {
                inside = true;
                Some(format!("newmtl {rest}"))
            }
            _ if keyword.is_empty() || keyword.starts_with('#') => None,
            "Kd" | "Ks" if inside => Some(colour(keyword, rest, 1.0).map_err(at)?),
            "Ke" if inside => Some(colour(keyword, rest, MAX_RADIANCE).map_err(at)?),
            "d" if inside => Some(format!("d {}", number(keyword, rest, 0.0, 1.0).map_err(at)?)),
            "Tr" if inside => Some(format!("d {}", 1.0 - number(keyword, rest, 0.0, 1.0).map_err(at)?)),
            "Ni" if inside => Some(format!("Ni {}", number(keyword, rest, 0.1, 10.0).map_err(at)?)),
            "illum" if inside => Some(format!("illum {}", number(keyword, rest, 0.0, 10.0).map_err(at)? as u8)),
            // The ambient term of a lighting model without light transport.
            "Ka" => None,
            _ => {
                if plain.ignored.len() < 20 {
                    plain.ignored.insert(keyword.chars().take(20).collect());
                }
                None
            }
        };
        if let Some(line) = plain_line {
            plain.text.push_str(&line);
            plain.text.push('\n');
        }
    }
    Ok(plain)
}

/// One number from `least` to `most`.
fn number(keyword: &str, rest: &str, least: f32, most: f32) -> Result<f32, String> {
    let word = rest.split_whitespace().next().unwrap_or_default();
    match word.parse::<f32>() {
        Ok(number) if (least..=most).contains(&number) => Ok(number),
        _ => {
            let word: String = word.chars().take(20).collect();
            Err(format!(
                "expected a number from {least} to {most} after `{keyword}`, found `{word}`"
            ))
        }
    }
}

/// A colour line: one number or three, each from 0 to `most`.
fn colour(keyword: &str, rest: &str, most: f32) -> Result<String, String> {
    let words: Vec<&str> = rest
        .split_whitespace()
        .take_while(|word| !word.starts_with('#'))
        .take(4)
        .collect();
    let words = match words[..] {
        [all] => [all; 3],
        [r, g, b] => [r, g, b],
        _ => return Err(format!("expected three numbers after `{keyword}`")),
    };
    let mut line = keyword.to_owned();
    for word in words {
        line.push_str(&format!(" {}", number(keyword, word, 0.0, most)?));
    }
    Ok(line)
}

/// The scene's material for one of a library.
pub(super) fn describe(material: &tobj::Material) -> MaterialDescription {
    let colour = |colour: Option<[f32; 3]>, default| colour.map_or(default, Rgb::from);
    let clear = material.dissolve.is_some_and(|dissolve| dissolve < 1.0);
    match material.illumination_model {
        Some(4 | 6 | 7 | 9) => {}
        _ if clear => {}
        Some(3 | 5) => {
            // With eta = 0, Fresnel's equations reflect everything at any angle.
            return MaterialDescription::Conductor {
                metal: None,
                eta: Some(Rgb::BLACK),
                k: Some(Rgb::ONE),
                reflectance: colour(material.specular, Rgb::ONE).into(),
                two_sided: true,
            };
        }
        _ => {
            let reflectance = colour(material.diffuse, Rgb::BLACK);
            return MaterialDescription::Diffuse {
                reflectance: reflectance.into(),
                two_sided: true,
            };
        }
    }
    MaterialDescription::Dielectric {
        interior_ior: material.optical_density.unwrap_or(1.5),
        exterior_ior: 1.0,
        reflectance: Rgb::ONE,
        transmittance: Rgb::ONE,
    }
}

/// The radiance that a library's material emits.
pub(super) fn emission(material: &tobj::Material) -> Rgb {
    material.emissive.map_or(Rgb::BLACK, Rgb::from)
}
