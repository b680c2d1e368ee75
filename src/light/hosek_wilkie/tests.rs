//! The model against values that another implementation computes: those of the `sunsky` plugin of Mitsuba 3.9, in its
//! RGB mode.

use super::*;
use glam::DVec3;

/// Turbidity, albedo and solar elevation in degrees; a direction, the sun at azimuth 0 and the zenith at +z; radiance.
type Seen = ([f64; 3], [f64; 3], [f64; 3]);

/// The integral of ȳ that Mitsuba divides by, over the one that the tables are divided by.
const UNIT: f64 = 106.750_26 / 106.857_04;

#[rustfmt::skip]
const SKY_SEEN: [Seen; 35] = [
    ([1.0, 0.0, 2.0], [0.0, 0.5, 0.866025], [0.00735959, 0.0103114, 0.0121895]),
    ([1.0, 0.0, 10.0], [-0.999848, 0.0, 0.017452], [0.139597, 0.152019, 0.0979578]),
    ([1.0, 0.0, 51.0], [-0.0, -0.965926, 0.258819], [0.0459853, 0.0836882, 0.149922]),
    ([1.0, 0.3, 2.0], [0.866025, 0.0, 0.5], [0.0238216, 0.0283142, 0.0270306]),
    ([1.0, 0.3, 30.0], [0.353553, 0.353553, 0.866025], [0.0183155, 0.0387215, 0.077287]),
    ([1.0, 0.3, 51.0], [0.0, 0.999848, 0.017452], [0.139497, 0.187295, 0.214349]),
    ([2.0, 0.0, 2.0], [-0.965926, 0.0, 0.258819], [0.0404333, 0.0390374, 0.0282565]),
    ([2.0, 0.0, 30.0], [-0.0, -0.707107, 0.707107], [0.0186132, 0.0369921, 0.0719255]),
    ([2.0, 0.0, 80.0], [0.5, 0.0, 0.866025], [0.0409466, 0.06178, 0.110302]),
    ([2.0, 0.3, 2.0], [0.706999, 0.706999, 0.017452], [0.0782174, 0.049914, 0.0169047]),
    ([2.0, 0.3, 30.0], [0.0, 0.965926, 0.258819], [0.0552869, 0.0965263, 0.152276]),
    ([2.0, 0.3, 80.0], [-0.707107, 0.0, 0.707107], [0.0302542, 0.059578, 0.119229]),
    ([3.0, 0.0, 10.0], [-0.0, -0.258819, 0.965926], [0.00851204, 0.0169395, 0.0294267]),
    ([3.0, 0.0, 30.0], [0.999848, 0.0, 0.017452], [0.334433, 0.340442, 0.272422]),
    ([3.0, 0.0, 80.0], [0.683013, 0.683013, 0.258819], [0.0569198, 0.0945831, 0.161364]),
    ([3.0, 0.3, 10.0], [0.0, 0.707107, 0.707107], [0.0164433, 0.0290473, 0.0443958]),
    ([3.0, 0.3, 51.0], [-0.258819, 0.0, 0.965926], [0.0218402, 0.0406945, 0.0867425]),
    ([3.0, 0.3, 80.0], [-0.0, -0.996195, 0.087156], [0.133364, 0.194596, 0.264854]),
    ([5.0, 0.0, 10.0], [0.965926, 0.0, 0.258819], [0.701911, 0.526969, 0.264307]),
    ([5.0, 0.0, 51.0], [0.5, 0.5, 0.707107], [0.0966908, 0.118515, 0.158983]),
    ([5.0, 0.3, 2.0], [0.0, 0.258819, 0.965926], [0.00613345, 0.00873786, 0.010736]),
    ([5.0, 0.3, 10.0], [-0.996195, 0.0, 0.087156], [0.0960058, 0.109092, 0.0949857]),
    ([5.0, 0.3, 51.0], [-0.0, -0.866025, 0.5], [0.0551454, 0.0864723, 0.147696]),
    ([8.0, 0.0, 2.0], [0.707107, 0.0, 0.707107], [0.0220719, 0.0204178, 0.0178551]),
    ([8.0, 0.0, 30.0], [0.183013, 0.183013, 0.965926], [0.0495215, 0.0591845, 0.0774165]),
    ([8.0, 0.0, 51.0], [0.0, 0.996195, 0.087156], [0.107505, 0.126753, 0.152192]),
    ([8.0, 0.3, 2.0], [-0.866025, 0.0, 0.5], [0.0237384, 0.0242822, 0.0206811]),
    ([8.0, 0.3, 30.0], [-0.0, -0.5, 0.866025], [0.0406393, 0.0543186, 0.0795935]),
    ([8.0, 0.3, 80.0], [0.258819, 0.0, 0.965926], [0.664702, 0.679328, 0.597033]),
    ([10.0, 0.0, 2.0], [0.704416, 0.704416, 0.087156], [0.0230605, 0.0153182, 0.00913455]),
    ([10.0, 0.0, 30.0], [0.0, 0.866025, 0.5], [0.0662499, 0.0766151, 0.0966775]),
    ([10.0, 0.0, 80.0], [-0.5, 0.0, 0.866025], [0.157638, 0.172266, 0.189497]),
    ([10.0, 0.3, 2.0], [-0.0, -0.999848, 0.017452], [0.00335974, 0.00334654, 0.0027883]),
    ([10.0, 0.3, 30.0], [0.996195, 0.0, 0.087156], [0.894327, 0.73238, 0.550853]),
    ([10.0, 0.3, 80.0], [0.612372, 0.612372, 0.5], [0.163624, 0.189441, 0.215053]),
];

/// Turbidity and solar elevation in degrees; mean radiance of the disc.
#[rustfmt::skip]
const SUN_SEEN: [([f64; 2], [f64; 3]); 16] = [
    ([1.0, 10.0], [16739.7, 10278.2, 3633.49]),
    ([1.0, 30.0], [21305.2, 16844.6, 11185.8]),
    ([1.0, 51.0], [22315.4, 18564.1, 13949.5]),
    ([1.0, 80.0], [22712.9, 19264.5, 15177.9]),
    ([3.0, 10.0], [14494.3, 8789.18, 3141.14]),
    ([3.0, 30.0], [20274.4, 15949.6, 10618.1]),
    ([3.0, 51.0], [21615.7, 17924.2, 13492.6]),
    ([3.0, 80.0], [22149.8, 18738.4, 14784.2]),
    ([5.0, 10.0], [10672.7, 6303.67, 2301.45]),
    ([5.0, 30.0], [18239.1, 14190.1, 9504.71]),
    ([5.0, 51.0], [20196.1, 16624.4, 12563.4]),
    ([5.0, 80.0], [20996.7, 17660.0, 13974.5]),
    ([8.0, 10.0], [5792.17, 3246.72, 1236.41]),
    ([8.0, 30.0], [14753.2, 11229.0, 7611.91]),
    ([8.0, 51.0], [17626.5, 14302.9, 10891.0]),
    ([8.0, 80.0], [18860.8, 15681.9, 12486.0]),
];

fn deviation(found: Rgb, expected: [f64; 3]) -> f64 {
    let pairs = found.to_array().into_iter().zip(expected);
    pairs
        .map(|(found, expected)| (f64::from(found) / expected - 1.0).abs())
        .fold(0.0, f64::max)
}

#[test]
fn the_sky_is_that_of_another_implementation() {
    let mut worst = 0.0_f64;
    for ([turbidity, albedo, elevation], direction, mut expected) in SKY_SEEN {
        let elevation = elevation.to_radians();
        let sun = DVec3::new(libm::cos(elevation), 0.0, libm::sin(elevation));
        let direction = DVec3::from_array(direction).normalize();
        let state = SkyState::new(elevation, turbidity as f32, Rgb::splat(albedo as f32));
        expected.iter_mut().for_each(|value| *value *= UNIT);
        worst = worst.max(deviation(state.radiance(direction.z, direction.dot(sun)), expected));
    }
    assert!(worst < 5e-5, "{worst}");
}

/// That implementation's sun in RGB mode is brighter than its own spectra are when seen by the observer: by 5 % in red, 7 % in
/// green and 8 % in blue, whatever the air; where the sun stands low and interpolation between elevations shows, by up to
/// another 3 %. Ours is the spectrum as seen.
#[test]
fn the_sun_is_that_of_another_implementation_but_for_a_constant() {
    for ([turbidity, elevation], mut expected) in SUN_SEEN {
        let constant = [0.950, 0.930, 0.922];
        expected
            .iter_mut()
            .zip(constant)
            .for_each(|(value, constant)| *value *= constant);
        let found = sun(elevation.to_radians(), turbidity as f32);
        let tolerance = if elevation < 20.0 { 0.04 } else { 0.005 };
        let deviation = deviation(found, expected);
        assert!(deviation < tolerance, "{turbidity} {elevation}: {deviation}");
    }
}

#[test]
fn radiance_is_finite_and_not_negative_everywhere() {
    for turbidity in [1.0, 1.7, 5.5, 9.9, 10.0] {
        for elevation in [0.0, 1e-6, 0.1, 0.8, FRAC_PI_2] {
            let light = sun(elevation, turbidity);
            assert!(
                light.is_finite() && light.min_channel() >= 0.0,
                "{turbidity} {elevation}: {light:?}"
            );
            let state = SkyState::new(elevation, turbidity, Rgb::new(0.0, 0.5, 1.0));
            for height in [0.0, 1e-9, 0.01, 0.5, 1.0] {
                for cos_gamma in [-1.0, 0.0, 0.999, 1.0, 1.0 + 1e-12] {
                    let light = state.radiance(height, cos_gamma);
                    assert!(
                        light.is_finite() && light.min_channel() >= 0.0,
                        "{turbidity} {elevation}: {light:?}"
                    );
                }
            }
            assert_eq!(state.radiance(-1e-9, 0.0), Rgb::BLACK);
        }
    }
}

#[test]
fn turbidities_between_those_of_the_tables_are_mixed() {
    let [low, mid, high] = [3.0, 3.25, 4.0].map(|turbidity| sun(0.6, turbidity).g);
    assert!((mid / (0.75 * low + 0.25 * high) - 1.0).abs() < 1e-6);
    let [below, at] = [10.0_f32.next_down(), 10.0].map(|turbidity| sun(0.6, turbidity).g);
    assert!((below / at - 1.0).abs() < 1e-6);
}
