//! The model against values that another implementation computes: those of the `sunsky` plugin of Mitsuba 3.9, in its
//! RGB mode.

use super::*;
use glam::DVec3;

/// Turbidity, albedo and solar elevation in degrees; a direction, the sun at azimuth 0 and the zenith at +z; radiance.
type Seen = ([f64; 3], [f64; 3], [f64; 3]);

/// The integral of ȳ that Mitsuba divides by, over the one that the tables are divided by.
const UNIT: f64 = 106.750_26 / 106.857_04;

#[rustfmt::skip]
const SKY_SEEN: [Seen; 39] = [
    ([1.0, 0.0, 2.0], [0.5, 0.0, 0.866025], [0.00849494, 0.0115723, 0.0132849]),
    ([1.0, 0.0, 10.0], [0.0, 0.996195, 0.087156], [0.066876, 0.0863603, 0.0758051]),
    ([1.0, 0.0, 51.0], [-0.0, -0.5, 0.866025], [0.0159666, 0.0331394, 0.0769621]),
    ([1.0, 0.0, 80.0], [0.706999, 0.706999, 0.017452], [0.103266, 0.147888, 0.178049]),
    ([1.0, 0.3, 10.0], [-0.866025, 0.0, 0.5], [0.0299543, 0.0488797, 0.0680234]),
    ([1.0, 0.3, 51.0], [0.258819, 0.0, 0.965926], [0.0217338, 0.0419566, 0.0959639]),
    ([1.0, 0.3, 80.0], [0.0, 0.965926, 0.258819], [0.0702896, 0.123081, 0.20933]),
    ([2.0, 0.0, 10.0], [-0.0, -0.258819, 0.965926], [0.00791089, 0.0162183, 0.0290478]),
    ([2.0, 0.0, 30.0], [0.704416, 0.704416, 0.087156], [0.118202, 0.170415, 0.20185]),
    ([2.0, 0.0, 80.0], [-0.5, 0.0, 0.866025], [0.0215534, 0.0409595, 0.0854158]),
    ([2.0, 0.3, 2.0], [0.999848, 0.0, 0.017452], [0.236315, 0.11544, 0.0267155]),
    ([2.0, 0.3, 30.0], [0.0, 0.866025, 0.5], [0.0319616, 0.0604032, 0.108021]),
    ([2.0, 0.3, 51.0], [-0.0, -0.999848, 0.017452], [0.137024, 0.1838, 0.207654]),
    ([3.0, 0.0, 2.0], [0.683013, 0.683013, 0.258819], [0.0424065, 0.0399592, 0.029252]),
    ([3.0, 0.0, 30.0], [-0.258819, 0.0, 0.965926], [0.0131365, 0.0258974, 0.0530087]),
    ([3.0, 0.0, 51.0], [0.996195, 0.0, 0.087156], [0.148705, 0.201173, 0.263795]),
    ([3.0, 0.3, 2.0], [0.0, 0.5, 0.866025], [0.00777455, 0.0108175, 0.0127269]),
    ([3.0, 0.3, 10.0], [-0.0, -0.996195, 0.087156], [0.0732147, 0.0902668, 0.0781477]),
    ([3.0, 0.3, 51.0], [0.612372, 0.612372, 0.5], [0.0647479, 0.101859, 0.171034]),
    ([3.0, 0.3, 80.0], [-0.999848, 0.0, 0.017452], [0.150411, 0.197131, 0.225556]),
    ([5.0, 0.0, 10.0], [0.965926, 0.0, 0.258819], [0.701911, 0.526969, 0.264307]),
    ([5.0, 0.0, 51.0], [0.0, 0.258819, 0.965926], [0.0406261, 0.056416, 0.0920542]),
    ([5.0, 0.0, 80.0], [-0.0, -0.965926, 0.258819], [0.0637909, 0.0971901, 0.155354]),
    ([5.0, 0.3, 10.0], [0.353553, 0.353553, 0.866025], [0.0188592, 0.0281685, 0.0397186]),
    ([5.0, 0.3, 30.0], [-0.996195, 0.0, 0.087156], [0.135302, 0.172781, 0.203195]),
    ([5.0, 0.3, 80.0], [0.866025, 0.0, 0.5], [0.0772709, 0.113453, 0.180067]),
    ([8.0, 0.0, 2.0], [0.0, 0.999848, 0.017452], [0.0104456, 0.00716637, 0.00416163]),
    ([8.0, 0.0, 30.0], [-0.0, -0.866025, 0.5], [0.0481989, 0.0644825, 0.093053]),
    ([8.0, 0.0, 80.0], [0.183013, 0.183013, 0.965926], [0.469893, 0.480576, 0.436947]),
    ([8.0, 0.3, 2.0], [-0.965926, 0.0, 0.258819], [0.0325292, 0.0303751, 0.0219082]),
    ([8.0, 0.3, 30.0], [0.5, 0.0, 0.866025], [0.144197, 0.148345, 0.148837]),
    ([8.0, 0.3, 51.0], [0.0, 0.996195, 0.087156], [0.152709, 0.174823, 0.199302]),
    ([10.0, 0.0, 2.0], [-0.0, -0.5, 0.866025], [0.0109689, 0.0118763, 0.0122063]),
    ([10.0, 0.0, 10.0], [0.706999, 0.706999, 0.017452], [0.112902, 0.0743557, 0.0423545]),
    ([10.0, 0.0, 51.0], [-0.866025, 0.0, 0.5], [0.0567765, 0.0773047, 0.106614]),
    ([10.0, 0.3, 2.0], [0.258819, 0.0, 0.965926], [0.00871525, 0.0100193, 0.0110221]),
    ([10.0, 0.3, 10.0], [0.0, 0.965926, 0.258819], [0.0464768, 0.0470467, 0.0480872]),
    ([10.0, 0.3, 51.0], [-0.0, -0.258819, 0.965926], [0.16861, 0.177968, 0.185356]),
    ([10.0, 0.3, 80.0], [0.704416, 0.704416, 0.087156], [0.19155, 0.202833, 0.195739]),
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
