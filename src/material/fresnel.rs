//! Fresnel's equations for unpolarised light.

use crate::color::Rgb;

/// What a smooth interface between two dielectrics does with light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricFresnel {
    /// Share of power that is reflected.
    pub reflectance: f32,
    /// Cosine of the angle of refraction, positive; 0 under total internal reflection.
    pub cos_transmitted: f32,
}

/// Reflectance and refraction angle at a dielectric interface.
///
/// `cos_incident` in [0, 1] is measured on the side the light path comes from; `relative_ior` is the index on the far
/// side divided by that on the near side. An interface between equal indices reflects exactly nothing.
#[inline]
#[must_use]
pub fn dielectric(cos_incident: f32, relative_ior: f32) -> DielectricFresnel {
    let cos_i = cos_incident.clamp(0.0, 1.0);
    let (reflectance, cos_transmitted) = dielectric_exact(f64::from(cos_i), f64::from(relative_ior));
    DielectricFresnel {
        reflectance: reflectance as f32,
        cos_transmitted: cos_transmitted as f32,
    }
}

/// [`dielectric`] in `f64`: reflectance and cosine of refraction. Near the critical angle, for nearly equal indices, and of
/// what is not reflected at grazing angles, f32 would cancel.
#[inline]
#[must_use]
pub fn dielectric_exact(cos_incident: f64, relative_ior: f64) -> (f64, f64) {
    let (ci, n) = (cos_incident.clamp(0.0, 1.0), relative_ior);
    if n == 1.0 {
        return (0.0, ci);
    }
    let sin2_t = (1.0 - ci * ci) / (n * n);
    if sin2_t >= 1.0 {
        return (1.0, 0.0);
    }
    let ct = (1.0 - sin2_t).sqrt();
    (dielectric_between(ci, ct, n), ct)
}

/// Reflectance for directions on both sides that Snell's law connects: near the critical angle the cosine behind, if it is
/// known, says more about what passes than the one before.
#[inline]
#[must_use]
pub fn dielectric_between(cos_incident: f64, cos_transmitted: f64, relative_ior: f64) -> f64 {
    let (ci, ct, n) = (cos_incident, cos_transmitted, relative_ior);
    let perpendicular = (ci - n * ct) / (ci + n * ct);
    let parallel = (n * ci - ct) / (n * ci + ct);
    0.5 * (perpendicular * perpendicular + parallel * parallel)
}

/// Share of diffuse light that an interface reflects: the mean of its reflectance over a hemisphere, weighted with the
/// cosine. `relative_ior` is the index on the far side divided by that on the near side, where the light is.
///
/// Simpson's rule for the side whose far medium is denser, where reflectance is smooth but for a steep rise at the horizon
/// (met by cos θ = t²); from the denser side 1 − F is smaller by the squared index, since what crosses either way is the
/// same light.
#[must_use]
pub fn diffuse_reflectance(relative_ior: f64) -> f64 {
    const INTERVALS: u32 = 4096;
    let denser = relative_ior.max(1.0 / relative_ior);
    let node = |i: u32| {
        let t = f64::from(i) / f64::from(INTERVALS);
        let weight = match i {
            0 | INTERVALS => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        // F · 2 cos θ d(cos θ) = F · 4 t³ dt.
        weight * 4.0 * t * t * t * dielectric_exact(t * t, denser).0
    };
    let from_outside = (0..=INTERVALS).map(node).sum::<f64>() / (3.0 * f64::from(INTERVALS));
    if relative_ior >= 1.0 {
        from_outside
    } else {
        1.0 - (1.0 - from_outside) * relative_ior * relative_ior
    }
}

/// [`conductor`] for every channel.
#[inline]
#[must_use]
pub fn conductor_rgb(cos_incident: f32, eta: Rgb, k: Rgb) -> Rgb {
    Rgb::new(
        conductor(cos_incident, eta.r, k.r),
        conductor(cos_incident, eta.g, k.g),
        conductor(cos_incident, eta.b, k.b),
    )
}

/// Share of power that a smooth conductor reflects, for the complex index `eta + i k` of the metal relative to the
/// medium before it, at an angle of incidence whose cosine is `cos_incident`.
#[inline]
#[must_use]
pub fn conductor(cos_incident: f32, eta: f32, k: f32) -> f32 {
    let (c, eta, k) = (f64::from(cos_incident.clamp(0.0, 1.0)), f64::from(eta), f64::from(k));
    let (c2, s2) = (c * c, 1.0 - c * c);
    let (eta2, k2) = (eta * eta, k * k);
    // η² − k² − sin², with the one of sin² = 1 − cos² taken off first: for an index near 1 at grazing incidence, where all
    // that is left is cos².
    let t0 = (eta2 - 1.0) - k2 + c2;
    let a2_b2 = (t0 * t0 + 4.0 * eta2 * k2).sqrt();
    let a = (0.5 * (a2_b2 + t0)).max(0.0).sqrt();
    let perpendicular = (a2_b2 + c2 - 2.0 * a * c) / (a2_b2 + c2 + 2.0 * a * c);
    let (t3, t4) = (c2 * a2_b2 + s2 * s2, 2.0 * a * c * s2);
    let parallel = perpendicular * (t3 - t4) / (t3 + t4);
    let reflectance = 0.5 * (perpendicular + parallel);
    // 0/0 at grazing incidence on an index of 1 with no absorption: nothing is there to reflect.
    if reflectance.is_nan() {
        1.0
    } else {
        reflectance.clamp(0.0, 1.0) as f32
    }
}
