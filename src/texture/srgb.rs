//! The transfer function of sRGB, from codes to linear values.

/// The linear value of an encoded one in [0, 1] (IEC 61966-2-1).
fn decode(encoded: f64) -> f64 {
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        libm::pow((encoded + 0.055) / 1.055, 2.4)
    }
}

/// The values of all codes from 0 to `last`, linear or encoded by sRGB.
pub(super) fn values(last: u16, encoded: bool) -> Vec<f32> {
    let share = |code: u16| f64::from(code) / f64::from(last);
    (0..=last)
        .map(|code| if encoded { decode(share(code)) } else { share(code) } as f32)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::ToneMap;

    #[test]
    fn known_codes_have_their_values() {
        let values = values(255, true);
        // From the standard's formula, in arithmetic of 30 digits.
        for (code, value) in [
            (0, 0.0),
            (1, 0.000_303_527),
            (10, 0.003_035_27),
            (11, 0.003_346_536),
            (55, 0.038_204_37),
            (128, 0.215_860_5),
            (188, 0.502_886_5),
            (255, 1.0),
        ] {
            let off: f32 = values[code] - value;
            assert!(off.abs() <= 2e-7 * value, "{code}: {} for {value}", values[code]);
        }
    }

    #[test]
    fn what_the_film_encodes_is_decoded_to_itself() {
        for (code, value) in values(255, true).into_iter().enumerate() {
            assert_eq!(usize::from(ToneMap::default().encode(value)), code);
        }
    }

    #[test]
    fn linear_codes_are_shares() {
        let values = values(u16::MAX, false);
        assert_eq!((values.len(), values[0], values[65_535]), (65_536, 0.0, 1.0));
        assert_eq!(values[13_107], 0.2);
    }
}
