//! Puts pictures side by side on one sheet, each with its name below it.
//!
//! `cargo run --release --example contact_sheet -- SHEET.png COLUMNS CELL PICTURE.png...`
//!
//! Every picture is scaled to fit a cell of CELL x CELL pixels; its name is that of its file, with hyphens as gaps.
//! `scenes/gallery.sh` makes the pictures with the program and the sheet with this.

#[path = "contact_sheet/letters.rs"]
mod letters;

use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};
use miette::{Context, IntoDiagnostic, Result, ensure, miette};
use std::path::{Path, PathBuf};

const PAPER: Rgb<u8> = Rgb([24, 24, 26]);
const INK: Rgb<u8> = Rgb([222, 220, 214]);
/// Pixels between cells and around the sheet.
const MARGIN: u32 = 8;
/// Height of a name's line below its picture.
const LINE: u32 = 2 * letters::HEIGHT + 6;

fn main() -> Result<()> {
    let mut arguments = std::env::args_os().skip(1);
    let usage = || miette!("usage: contact_sheet SHEET.png COLUMNS CELL PICTURE.png...");
    let sheet = PathBuf::from(arguments.next().ok_or_else(usage)?);
    let mut number = || -> Result<u32> {
        let text = arguments.next().ok_or_else(usage)?;
        let number = text.to_string_lossy().parse().into_diagnostic();
        number.wrap_err_with(|| format!("`{}` is no number of columns or pixels", text.to_string_lossy()))
    };
    let (columns, cell) = (number()?, number()?);
    let pictures: Vec<PathBuf> = arguments.map(PathBuf::from).collect();
    ensure!(
        (1..=64).contains(&columns) && (16..=4096).contains(&cell),
        "1 to 64 columns of 16 to 4096 pixels"
    );
    ensure!(!pictures.is_empty(), usage());
    compose(&pictures, columns, cell)?
        .save(&sheet)
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot write {}", sheet.display()))
}

/// The sheet of the pictures in the files, row by row.
fn compose(pictures: &[PathBuf], columns: u32, cell: u32) -> Result<RgbImage> {
    let columns = columns.min(pictures.len() as u32);
    let (mut cells, mut tallest) = (Vec::new(), 0);
    for path in pictures {
        let picture = fitted(path, cell)?;
        tallest = tallest.max(picture.height());
        cells.push((path, picture));
    }
    let rows = (pictures.len() as u32).div_ceil(columns);
    let (step_x, step_y) = (cell + MARGIN, tallest + LINE + MARGIN);
    let mut sheet = RgbImage::from_pixel(columns * step_x + MARGIN, rows * step_y + MARGIN, PAPER);
    for ((path, picture), index) in cells.iter().zip(0..) {
        let left = MARGIN + index % columns * step_x;
        let top = MARGIN + index / columns * step_y;
        let (across, down) = ((cell - picture.width()) / 2, (tallest - picture.height()) / 2);
        imageops::replace(&mut sheet, picture, i64::from(left + across), i64::from(top + down));
        write_name(&mut sheet, &name(path), left, top + tallest + 4, cell);
    }
    Ok(sheet)
}

/// The picture in a file, scaled so that its longer side is `cell`.
fn fitted(path: &Path, cell: u32) -> Result<RgbImage> {
    let read = image::open(path).into_diagnostic();
    let picture = read
        .wrap_err_with(|| format!("cannot read {}", path.display()))?
        .into_rgb8();
    let longer = picture.width().max(picture.height());
    ensure!(longer > 0, "{} has no pixels", path.display());
    if longer == cell {
        return Ok(picture);
    }
    let scaled = |side: u32| ((u64::from(side) * u64::from(cell) / u64::from(longer)) as u32).max(1);
    let (width, height) = (scaled(picture.width()), scaled(picture.height()));
    Ok(imageops::resize(&picture, width, height, FilterType::Triangle))
}

fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    stem.replace('-', " ")
}

/// Writes a name in the middle below a cell: dots of two pixels, or of one where it is too long for that.
fn write_name(sheet: &mut RgbImage, name: &str, left: u32, top: u32, cell: u32) {
    let dot = if 2 * letters::width(name) <= cell { 2 } else { 1 };
    let start = left + cell.saturating_sub(dot * letters::width(name)) / 2;
    letters::each_dot(name, |across, down| {
        for (x, y) in (0..dot).flat_map(|x| (0..dot).map(move |y| (x, y))) {
            let place = (start + dot * across + x, top + dot * down + y);
            if let Some(pixel) = sheet.get_pixel_mut_checked(place.0, place.1) {
                *pixel = INK;
            }
        }
    });
}
