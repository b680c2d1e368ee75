//! Metals by name: complex indices of refraction in RGB.
//!
//! Measured spectra (the optical constants collected by luxpop.com, after Palik 1985 and others), averaged under the
//! illuminant D65 times the colour matching function of each channel; `tests/oracle/metals.py` makes the rows from a folder of
//! spectra. An index averaged over a channel is not what a spectral renderer computes: reflectances differ from theirs by
//! some thousandths, those of strongly coloured metals (gold and copper in blue) by a few hundredths.

use crate::color::Rgb;

/// A metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// Its symbol, as scenes name it.
    pub symbol: &'static str,
    /// Its name in words.
    pub name: &'static str,
    /// Real part of the index of refraction, per channel.
    pub eta: Rgb,
    /// Absorption coefficient, per channel.
    pub k: Rgb,
}

/// The metal of that symbol.
#[must_use]
pub fn find(symbol: &str) -> Option<&'static Metal> {
    METALS.iter().find(|metal| metal.symbol == symbol)
}

const fn metal(symbol: &'static str, name: &'static str, eta: [f32; 3], k: [f32; 3]) -> Metal {
    Metal {
        symbol,
        name,
        eta: Rgb::new(eta[0], eta[1], eta[2]),
        k: Rgb::new(k[0], k[1], k[2]),
    }
}

/// Every metal, by symbol.
#[rustfmt::skip]
pub const METALS: [Metal; 22] = [
    metal("Ag", "silver", [0.128_47, 0.123_54, 0.150_88], [4.064_9, 3.286_2, 2.392]),
    metal("Al", "aluminium", [1.407_4, 0.926_64, 0.584_11], [7.740_4, 6.602_4, 5.360_6]),
    metal("Au", "gold", [0.079_887, 0.405_13, 1.560_8], [3.390_2, 2.503_5, 1.771]),
    metal("Be", "beryllium", [3.485_5, 3.356_4, 3.072_5], [3.183_1, 3.174_6, 3.156_1]),
    metal("Cr", "chromium", [3.681_6, 3.065_9, 1.856_4], [4.310_1, 4.461, 4.150_3]),
    metal("Cu", "copper", [0.105_09, 0.977_94, 1.204_7], [3.273_5, 2.592_5, 2.369_3]),
    metal("Hg", "mercury", [2.027_7, 1.515_2, 1.016_3], [5.304, 4.604_6, 3.791_2]),
    metal("Ir", "iridium", [2.593_7, 2.192, 1.790_7], [4.674_1, 4.283_7, 3.615]),
    metal("K", "potassium", [0.053_684, 0.048_84, 0.042_148], [1.772_5, 1.419_5, 1.019_2]),
    metal("Li", "lithium", [0.220_95, 0.206_67, 0.241_21], [2.978_6, 2.433_1, 1.854_1]),
    metal("Mo", "molybdenum", [3.733_4, 3.712_8, 3.065_2], [3.384_4, 3.612_2, 3.475]),
    metal("Na", "sodium", [0.049_24, 0.059_287, 0.067_961], [2.670_8, 2.224_5, 1.753]),
    metal("Nb", "niobium", [2.837_4, 2.939_5, 2.645_4], [2.852_5, 2.887, 2.844_4]),
    metal("Ni", "nickel", [1.979_4, 1.753_6, 1.617_2], [3.775_5, 3.212_2, 2.599_5]),
    metal("Rh", "rhodium", [2.159_6, 1.960_1, 1.722_5], [5.680_5, 4.955_6, 4.390_1]),
    metal("Ta", "tantalum", [1.654_3, 2.525_7, 2.882_3], [1.994, 1.842_9, 2.132_2]),
    metal("TiC", "titanium carbide", [3.076_5, 2.991_7, 2.845_8], [2.728_3, 2.478_9, 2.390_8]),
    metal("TiN", "titanium nitride", [1.377_4, 1.215, 1.503_2], [2.856_9, 2.043_2, 1.237_4]),
    metal("V", "vanadium", [3.548_8, 3.699_2, 3.062_3], [2.876_5, 3.051_7, 3.415_3]),
    metal("VC", "vanadium carbide", [3.045_6, 2.902_2, 2.789], [2.564_7, 2.317_3, 2.163]),
    metal("VN", "vanadium nitride", [2.389_1, 2.234_2, 2.136_2], [2.545_6, 2.165_2, 1.789_5]),
    metal("W", "tungsten", [3.637_3, 3.480_4, 3.299_7], [2.916_9, 2.745_8, 2.509]),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::fresnel;

    #[test]
    fn every_metal_is_found_by_its_symbol_and_shines() {
        for metal in &METALS {
            assert_eq!(find(metal.symbol), Some(metal));
            for (eta, k) in metal.eta.to_array().into_iter().zip(metal.k.to_array()) {
                let head_on = fresnel::conductor(1.0, eta, k);
                assert!((0.2..1.0).contains(&head_on), "{}: {head_on}", metal.symbol);
            }
        }
        assert_eq!(find("au"), None);
        assert!(METALS.is_sorted_by_key(|metal| metal.symbol));
    }

    /// What everyone knows of their colours: gold and copper are warm, silver is the brightest.
    #[test]
    fn gold_and_copper_are_warm_and_silver_is_bright() {
        let colour = |symbol| {
            let metal = find(symbol).expect("a metal of the table");
            let channel = |eta, k| fresnel::conductor(1.0, eta, k);
            [
                channel(metal.eta.r, metal.k.r),
                channel(metal.eta.g, metal.k.g),
                channel(metal.eta.b, metal.k.b),
            ]
        };
        for symbol in ["Au", "Cu"] {
            let [r, g, b] = colour(symbol);
            assert!(r > 0.9 && g < 0.85 && b < 0.65, "{symbol}: {r} {g} {b}");
        }
        assert!(colour("Ag").into_iter().all(|share| share > 0.9));
    }
}
