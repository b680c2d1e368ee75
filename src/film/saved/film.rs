//! The film with squares as bytes.

use super::{HEADER, Header, Reader, SavedFilmError, Writer};
use crate::film::accumulate::{Film, PixelSums};
use crate::film::fixed::{SquareSum, Unit};

/// A film with squares, version 1.
const KIND: [u8; 8] = *b"cl:film1";
/// Words of a pixel: three wide sums, three sums of squares, the samples.
const PIXEL: usize = 16;

impl Film {
    /// Appends the film to `out`, byte for byte: 128 bytes a pixel and some. Nothing may be added meanwhile, or what is saved
    /// is the film of no moment.
    pub fn save(&self, out: &mut Vec<u8>) {
        let pixels = self.width() as usize * self.height() as usize;
        let mut writer = Writer::begin(out, KIND, HEADER + 1 + pixels * PIXEL);
        writer.header(self.width(), self.height(), self.tally());
        writer.words([i64::from(self.unit().exponent()) as u64]);
        self.for_each_pixel(|pixel| {
            pixel.sum.iter().for_each(|&sum| writer.wide(sum));
            writer.words(pixel.squares.iter().flat_map(|squares| squares.limbs()));
            writer.words([pixel.samples]);
        });
        writer.finish();
    }

    /// The film that [`Film::save`] made `bytes` of.
    ///
    /// # Errors
    /// Where `bytes` are anything else, or there is no memory for the film.
    pub fn load(bytes: &[u8]) -> Result<Self, SavedFilmError> {
        let (header, unit, pixels) = open(bytes)?;
        let film = Self::with_unit(header.width, header.height, unit)?;
        film.fill(&header, pixels)?;
        Ok(film)
    }

    /// Puts what was saved in place of what the film holds: a render goes on from there as if it had never stopped.
    /// Nothing may be added meanwhile.
    ///
    /// # Errors
    /// Where `bytes` are no saved film, or that of a film of another size or another unit (whose scene's brightest light
    /// was another); the film then keeps what it has.
    pub fn restore(&self, bytes: &[u8]) -> Result<(), SavedFilmError> {
        let (header, unit, pixels) = open(bytes)?;
        let own = (self.width(), self.height(), self.unit());
        let saved = (header.width, header.height, unit);
        if own != saved {
            let words = |(width, height, unit): (u32, u32, Unit)| {
                format!("{width} x {height} pixels in units of 2^{}", unit.exponent())
            };
            return Err(SavedFilmError::Other {
                saved: words(saved),
                own: words(own),
            });
        }
        // Read once without keeping anything, so that a film that cannot be read leaves this one as it is.
        let mut rehearsal = pixels.clone();
        for _ in 0..header.pixels() {
            pixel_sums(&mut rehearsal)?;
        }
        self.fill(&header, pixels)
    }

    fn fill(&self, header: &Header, mut pixels: Reader<'_>) -> Result<(), SavedFilmError> {
        self.set_tally(&header.tally);
        self.try_set_pixels(|| pixel_sums(&mut pixels))
    }
}

/// Header and unit of a saved film, and a reader at its first pixel that has words for all of them.
fn open(bytes: &[u8]) -> Result<(Header, Unit, Reader<'_>), SavedFilmError> {
    let mut reader = Reader::open(bytes, KIND)?;
    let header = reader.header()?;
    let exponent = reader.word()? as i64;
    let unit = i32::try_from(exponent).ok().and_then(Unit::from_exponent);
    let unit = unit.ok_or(SavedFilmError::Damaged {
        what: "its unit is that of no radiance",
    })?;
    reader.expect(header.pixels().saturating_mul(PIXEL))?;
    Ok((header, unit, reader))
}

fn pixel_sums(reader: &mut Reader<'_>) -> Result<PixelSums, SavedFilmError> {
    let mut pixel = PixelSums::default();
    for sum in &mut pixel.sum {
        *sum = reader.wide()?;
    }
    for squares in &mut pixel.squares {
        *squares = SquareSum::from_limbs([reader.word()?, reader.word()?, reader.word()?]);
    }
    pixel.samples = reader.count()?;
    Ok(pixel)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::film::Splat;
    use crate::film::fixed::power_of_two;
    use crate::film::saved::forged;

    fn film(max_radiance: f32) -> Film {
        Film::new(40, 30, max_radiance).expect("a small film")
    }

    /// Splats over 40 x 30 pixels (two stripes) and beyond, of all sizes, some of which the film cannot take as they are.
    fn splats(numbers: std::ops::Range<u32>) -> Vec<Splat> {
        let mixed = |i: u32| {
            let z = (u64::from(i) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            (z ^ z >> 32).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 24
        };
        let channel = |i: u32| match mixed(i) {
            odd if odd % 97 == 0 => [f32::NAN, 1e30, -1e30, 1e-30][odd as usize / 97 % 4],
            m => ((m >> 8) as u32 as f32 - 2e9) * power_of_two(-((m % 60) as i32)) as f32,
        };
        numbers
            .map(|i| Splat {
                pixel: (mixed(i) % 1210) as u32,
                value: Rgb::new(channel(3 * i), channel(3 * i + 1), channel(3 * i + 2)),
            })
            .collect()
    }

    fn saved(film: &Film) -> Vec<u8> {
        let mut bytes = Vec::new();
        film.save(&mut bytes);
        bytes
    }

    #[test]
    fn a_render_goes_on_as_if_it_had_not_been_interrupted() {
        let straight = film(3.0);
        straight.add_samples(&splats(0..30_000));

        let interrupted = film(3.0);
        interrupted.add_samples(&splats(0..17_000));
        let bytes = saved(&interrupted);
        let used = film(3.0);
        used.add_samples(&splats(5..50));
        used.restore(&bytes).expect("sound bytes");
        for resumed in [used, Film::load(&bytes).expect("sound bytes")] {
            assert_eq!(saved(&resumed), bytes);
            assert_eq!(resumed.develop(), interrupted.develop());
            resumed.add_samples(&splats(17_000..30_000));
            let tally = resumed.tally();
            assert!(tally.non_finite > 0 && tally.outside > 0 && tally.saturated > 0 && tally.vanished > 0);
            assert_eq!(tally, straight.tally());
            assert_eq!(resumed.develop(), straight.develop());
            assert_eq!(saved(&resumed), saved(&straight));
        }
    }

    #[test]
    fn a_film_of_another_size_or_scene_is_refused_and_nothing_changes() {
        let other = film(3.0);
        other.add_samples(&splats(0..100));
        let [size, unit] = [Film::new(30, 40, 3.0).expect("small"), film(5.0)];
        for (own, what) in [(size, "30 x 40"), (unit, "2^3")] {
            own.add_samples(&splats(0..10));
            let before = saved(&own);
            let error = own.restore(&saved(&other)).expect_err("another render");
            assert!(error.to_string().contains(what), "{error}");
            assert_eq!(saved(&own), before);
        }
        assert!(film(4.0).restore(&saved(&other)).is_ok(), "the same unit");
    }

    #[test]
    fn a_film_cut_off_or_damaged_anywhere_is_refused_and_nothing_changes() {
        let small = Film::new(2, 2, 1.0).expect("a small film");
        small.add_samples(&splats(0..3000));
        let whole = saved(&small);
        let own = Film::new(2, 2, 1.0).expect("a small film");
        let refused = |bytes: &[u8]| own.restore(bytes).is_err() && Film::load(bytes).is_err();
        for length in 0..whole.len() {
            let error = Film::load(&whole[..length]).expect_err("cut off");
            assert!(
                matches!(error, SavedFilmError::Length { .. }) && refused(&whole[..length]),
                "{length}: {error}"
            );
        }
        for bit in 0..whole.len() * 8 {
            let mut damaged = whole.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(refused(&damaged), "bit {bit}");
        }
        let first = 2 + HEADER + 1;
        // Sides, a count, the unit, and the samples of the last pixel.
        for (word, value) in [
            (2, u64::MAX),
            (3, u64::MAX),
            (first - 1, 129),
            (first - 1, 1 << 40),
            (first + 63, 1 << 63),
        ] {
            assert!(refused(&forged(&whole, word, value)), "word {word}");
        }
        assert!(!refused(&forged(&whole, first, 77)), "the forger's checksums fit");
        own.restore(&saved(&Film::new(2, 2, 1.0).expect("small")))
            .expect("sound bytes");
        assert!(refused(&forged(&whole, first + 63, 1 << 63)));
        assert!(own.develop().weight.iter().all(|&weight| weight == 0.0));
    }

    #[test]
    fn the_two_kinds_of_film_are_told_apart() {
        let group = crate::film::GroupFilm::load(&saved(&film(1.0)));
        assert_eq!(group, Err(SavedFilmError::Kind));
    }
}
