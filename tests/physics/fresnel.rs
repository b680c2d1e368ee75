//! Fresnel's equations against values computed with Mitsuba 3.9.

use chainlight::material::fresnel;

/// The values are `f32`, and good to a few units in their last place.
const TOLERANCE: f32 = 2e-6;

/// (interior over exterior index, cosine of incidence, reflectance, cosine of transmission). A cosine below zero: from
/// inside; that of transmission then has the other sign, and is zero under total internal reflection.
const DIELECTRIC: [(f32, f32, f32, f32); 18] = [
    (1.5, 1.0, 0.04, -1.0),
    (1.5, 0.7, 0.050_916_93, -0.879_393_7),
    (1.5, 0.05, 0.752_130_5, -0.746_101),
    (1.5, 0.0, 1.0, -0.745_356),
    (1.5, -1.0, 0.039_999_99, 1.0),
    (1.5, -0.8, 0.114_141_1, 0.435_889_9),
    (1.5, -0.75, 0.500_000_1, 0.125),
    (1.5, -0.7, 1.0, 0.0),
    (1.5, -0.05, 1.0, 0.0),
    (1.33, 0.5, 0.059_125_61, -0.758_951_7),
    (1.33, -0.65, 1.0, 0.0),
    (1.33, -0.7, 0.155_863_6, 0.312_827_3),
    (2.4, 1.0, 0.169_550_2, -1.0),
    (2.4, 0.1, 0.585_988_7, -0.910_013_7),
    (2.4, -0.95, 0.182_873_2, 0.662_117_7),
    (2.4, -0.9, 1.0, 0.0),
    (1.0, 0.3, 0.0, -0.3),
    (1.0, -0.05, 0.0, 0.049_999_97),
];

/// (real index, absorption, cosine of incidence, reflectance).
const CONDUCTOR: [(f32, f32, f32, f32); 13] = [
    (0.200_438, 3.912_95, 0.0, 1.0),
    (0.200_438, 3.912_95, 0.05, 0.979_310_3),
    (0.200_438, 3.912_95, 0.3, 0.942_083_8),
    (0.200_438, 3.912_95, 1.0, 0.952_140_5),
    (0.924_033, 2.452_85, 0.05, 0.901_237_5),
    (0.924_033, 2.452_85, 0.5, 0.625_829),
    (0.924_033, 2.452_85, 1.0, 0.619_676),
    (1.102_21, 2.142_19, 0.2, 0.661_482_2),
    (1.657_46, 9.223_87, 0.1, 0.844_957_9),
    (1.657_46, 9.223_87, 0.7, 0.924_157_4),
    (2.865_6, 3.032_33, 0.05, 0.764_273_2),
    (2.865_6, 3.032_33, 0.4, 0.504_12),
    (2.865_6, 3.032_33, 1.0, 0.525_128_4),
];

#[test]
fn dielectrics_agree_with_reference_values() {
    for (ior, cosine, reflectance, transmitted) in DIELECTRIC {
        let relative = if cosine >= 0.0 { ior } else { 1.0 / ior };
        let fresnel = fresnel::dielectric(cosine.abs(), relative);
        let case = format!("index {ior}, cosine {cosine}: {fresnel:?}");
        assert!((fresnel.reflectance - reflectance).abs() < TOLERANCE, "{case}");
        assert!(
            (fresnel.cos_transmitted - transmitted.abs()).abs() < TOLERANCE,
            "{case}"
        );
        assert!(transmitted * cosine <= 0.0, "{case}");
    }
}

#[test]
fn conductors_agree_with_reference_values() {
    for (eta, k, cosine, reflectance) in CONDUCTOR {
        let ours = fresnel::conductor(cosine, eta, k);
        assert!((ours - reflectance).abs() < TOLERANCE, "{eta} {k} {cosine}: {ours}");
    }
}

/// Without absorption a conductor is a dielectric.
#[test]
fn a_conductor_that_does_not_absorb_is_a_dielectric() {
    for n in [0.1, 0.5, 1.0 / 1.5, 0.999_99, 1.0, 1.000_01, 1.33, 1.5, 2.4, 10.0] {
        for cosine in [1e-8, 1e-4, 1e-3, 0.05, 0.3, 0.7, 0.999, 1.0] {
            let (conductor, dielectric) = (
                fresnel::conductor(cosine, n, 0.0),
                fresnel::dielectric(cosine, n).reflectance,
            );
            assert!(
                (conductor - dielectric).abs() < TOLERANCE,
                "{n} {cosine}: {conductor} {dielectric}"
            );
        }
    }
}
