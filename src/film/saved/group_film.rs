//! A group's film as bytes.

use super::{HEADER, Reader, SavedFilmError, Writer};
use crate::film::group_film::{GroupFilm, SPILL_ABOVE};

/// A group's film, version 1.
const KIND: [u8; 8] = *b"cl:group";
/// Words of a pixel's sums.
const SUMS: usize = 3;
/// Words of a pixel whose sums spilled: its index and three wide sums.
const SPILLED: usize = 7;
/// The largest total of a channel: 2³⁴ splats of the largest value (2⁹⁰ steps). Totals of films below it add safely.
const LARGEST_TOTAL: u128 = 1 << 124;

impl GroupFilm {
    /// Appends the film to `out`, byte for byte: 24 bytes a pixel and some. The bytes are a function of size, sums and tally,
    /// whatever the order in which the sums came about.
    pub fn save(&self, out: &mut Vec<u8>) {
        let spilled: Vec<(u32, [i128; 3])> = self
            .spilled
            .keys()
            .map(|&pixel| (pixel, self.total(pixel).map(|t| if fits(t) { 0 } else { t })))
            .filter(|(_, totals)| *totals != [0; 3])
            .collect();
        let body = HEADER + 1 + self.sums.len() * SUMS + spilled.len() * SPILLED;
        let mut writer = Writer::begin(out, KIND, body);
        writer.header(self.width, self.height, self.tally);
        writer.words([spilled.len() as u64]);
        for pixel in self.pixels() {
            writer.words(self.total(pixel).map(|t| if fits(t) { t as u64 } else { 0 }));
        }
        for (pixel, totals) in spilled {
            writer.words([u64::from(pixel)]);
            totals.into_iter().for_each(|total| writer.wide(total));
        }
        writer.finish();
    }

    /// The film that [`GroupFilm::save`] made `bytes` of.
    ///
    /// # Errors
    /// Where `bytes` are anything else, or there is no memory for the film.
    pub fn load(bytes: &[u8]) -> Result<Self, SavedFilmError> {
        let mut reader = Reader::open(bytes, KIND)?;
        let header = reader.header()?;
        let spilled = usize::try_from(reader.word()?).unwrap_or(usize::MAX);
        let words = header.pixels().saturating_mul(SUMS);
        reader.expect(words.saturating_add(spilled.saturating_mul(SPILLED)))?;
        let mut film = Self::new(header.width, header.height)?;
        film.tally = header.tally;
        for sum in film.sums.as_flattened_mut() {
            *sum = reader.word()? as i64;
            check(sum.unsigned_abs() <= SPILL_ABOVE, "a sum is out of its range")?;
        }
        for _ in 0..spilled {
            let place = u32::try_from(reader.word()?).unwrap_or(u32::MAX);
            let totals = [reader.wide()?, reader.wide()?, reader.wide()?];
            check(film.spilled_fit(place, &totals), "a large sum is not where one may be")?;
            film.spilled.insert(place, totals);
        }
        Ok(film)
    }

    /// Whether these large sums may follow those that the film has, as [`GroupFilm::save`] writes them: pixels in order,
    /// none without a large sum, and a channel either here or in the table of small ones.
    fn spilled_fit(&self, pixel: u32, totals: &[i128; 3]) -> bool {
        let in_order = self.spilled.last_key_value().is_none_or(|(&last, _)| last < pixel);
        let Some(small) = self.sums.get(pixel as usize) else {
            return false;
        };
        let sound = |(&total, &small): (&i128, &i64)| {
            total == 0 || (!fits(total) && total.unsigned_abs() <= LARGEST_TOTAL && small == 0)
        };
        in_order && *totals != [0; 3] && totals.iter().zip(small).all(sound)
    }
}

/// Whether a total is one of the small ones.
fn fits(total: i128) -> bool {
    total.unsigned_abs() <= u128::from(SPILL_ABOVE)
}

fn check(sound: bool, what: &'static str) -> Result<(), SavedFilmError> {
    sound.then_some(()).ok_or(SavedFilmError::Damaged { what })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::film::saved::{forged, mix};
    use crate::film::{FilmError, Splat};

    /// Three pixels by two: one dark, two lit, one with large sums in two channels, and something in every count.
    fn film() -> GroupFilm {
        let mut film = GroupFilm::new(3, 2).expect("a small film");
        let splat = |pixel, r, g, b| Splat {
            pixel,
            value: Rgb::new(r, g, b),
        };
        film.add(&[
            splat(0, 1.0, -0.3, 1e-7),
            splat(5, 3.5, 0.1, f32::NAN),
            splat(6, 1.0, 1.0, 1.0),
            splat(1, 1e-20, 0.0, 0.0),
        ]);
        for _ in 0..9 {
            film.add(&[splat(4, 1e6, 0.7, -1e6)]);
        }
        // Beyond the range, and out again.
        film.add(&[splat(4, 1e19, 0.0, 0.0), splat(4, -1e19, 0.0, 0.0)]);
        film
    }

    fn saved(film: &GroupFilm) -> Vec<u8> {
        let mut bytes = Vec::new();
        film.save(&mut bytes);
        bytes
    }

    #[test]
    fn a_film_comes_back_as_it_was_and_goes_on() {
        let film = film();
        assert_eq!(film.spilled.len(), 1);
        let bytes = saved(&film);
        let mut back = GroupFilm::load(&bytes).expect("sound bytes");
        assert_eq!((&back, back.tally()), (&film, film.tally()));
        assert_eq!(saved(&back), bytes);
        let (more, mut on) = (
            [Splat {
                pixel: 4,
                value: Rgb::splat(1e6),
            }; 20],
            film,
        );
        assert_eq!(back.add(&more), on.add(&more));
        assert_eq!(saved(&back), saved(&on));
    }

    #[test]
    fn bytes_do_not_tell_how_the_sums_came_about() {
        // Up by 2²⁶ and down again, or one pair at a time: only the first way spills.
        let of = |value| Splat {
            pixel: 2,
            value: Rgb::splat(value),
        };
        let (mut far, mut near) = (
            GroupFilm::new(2, 2).expect("small"),
            GroupFilm::new(2, 2).expect("small"),
        );
        far.add(&[of(1e6); 64]);
        far.add(&[of(-1e6); 64]);
        for _ in 0..64 {
            near.add(&[of(1e6), of(-1e6)]);
        }
        assert!(!far.spilled.is_empty() && near.spilled.is_empty());
        assert_eq!(far, near);
        assert_eq!(saved(&far), saved(&near));
    }

    #[test]
    fn saving_appends() {
        let mut bytes = b"head".to_vec();
        film().save(&mut bytes);
        assert_eq!((&bytes[..4], &bytes[4..]), (&b"head"[..], &saved(&film())[..]));
    }

    #[test]
    fn bytes_are_laid_out_as_documented() {
        let mut film = GroupFilm::new(1, 2).expect("a small film");
        film.add(&[Splat {
            pixel: 1,
            value: Rgb::new(1.0, -1.0, 0.0),
        }]);
        let words: Vec<u64> = saved(&film)
            .as_chunks::<8>()
            .0
            .iter()
            .map(|w| u64::from_le_bytes(*w))
            .collect();
        let body = [1 | 2 << 32, 0, 0, 0, 0, 0, 0, 0, 0, 1 << 40, u64::MAX << 40, 0];
        assert_eq!(words[0].to_le_bytes(), KIND);
        assert_eq!((words[1], &words[2..14]), (12, &body[..]));
        assert_eq!(
            (words[14], words.len()),
            (words[..14].iter().fold(0, |s, &w| mix(s, w)), 15)
        );
    }

    #[test]
    fn a_film_cut_off_at_any_byte_is_refused() {
        let whole = saved(&film());
        for length in 0..whole.len() {
            let error = GroupFilm::load(&whole[..length]).expect_err("cut off");
            assert!(matches!(error, SavedFilmError::Length { .. }), "{length}: {error}");
        }
        let longer = [&whole[..], &[0]].concat();
        assert_eq!(
            GroupFilm::load(&longer).expect_err("too long").to_string(),
            format!(
                "the saved film has {} bytes, where it should have {}",
                longer.len(),
                whole.len()
            )
        );
    }

    #[test]
    fn a_film_with_any_bit_flipped_is_refused() {
        let whole = saved(&film());
        for bit in 0..whole.len() * 8 {
            let mut damaged = whole.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(GroupFilm::load(&damaged).is_err(), "bit {bit}");
        }
    }

    #[test]
    fn contents_that_no_film_has_are_refused_whatever_the_checksum_says() {
        let whole = saved(&film());
        let sums = 2 + HEADER + 1;
        let large = sums + 6 * SUMS;
        let mut cases = vec![
            (2, u64::MAX),
            (2, 0),
            (3, u64::MAX),
            (2 + HEADER, u64::MAX),
            (2 + HEADER, 0),
        ];
        cases.extend([(sums, SPILL_ABOVE + 1), (sums, 1 << 63), (sums + 4 * SUMS, 1)]);
        // A large sum of a pixel that is not there; one that is small; one too large; three of none.
        cases.extend([
            (large, 6),
            (large, u64::MAX),
            (large + 1, 5),
            (large + 2, u64::MAX >> 1),
        ]);
        for (word, value) in cases {
            let error = GroupFilm::load(&forged(&whole, word, value)).expect_err("forged");
            assert!(matches!(error, SavedFilmError::Damaged { .. }), "word {word}: {error}");
        }
        assert!(
            GroupFilm::load(&forged(&whole, sums, 77)).is_ok(),
            "the forger's checksums fit"
        );
        assert_eq!(GroupFilm::load(&forged(&whole, 0, 77)), Err(SavedFilmError::Kind));
    }

    #[test]
    fn a_film_without_pixels_is_refused_as_such() {
        let words = [u64::from_le_bytes(KIND), 6, 5, 0, 0, 0, 0, 0, 0];
        let bytes: Vec<u8> = words.into_iter().flat_map(u64::to_le_bytes).collect();
        let empty = FilmError::Empty { width: 5, height: 0 };
        assert_eq!(GroupFilm::load(&forged(&bytes, 2, 5)), Err(SavedFilmError::Film(empty)));
    }
}
