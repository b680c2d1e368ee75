//! Facets as mirrors: directions that they reflect into, and the densities of those.

use super::Microfacets;
use glam::{DVec3, Vec3};

/// What facets of one normal do between two directions of one side, but for what each reflects.
#[derive(Clone, Copy, Debug)]
pub(in crate::material) struct Mirrored {
    /// Density of the second direction given the first, per solid angle, if all facets reflect.
    pub(in crate::material) density: f64,
    /// Density of the first direction given the second.
    pub(in crate::material) reverse: f64,
    /// The share of the light towards the second direction that no facet stops: f · |cos θₒ| / density.
    pub(in crate::material) ratio: f64,
}

impl Microfacets {
    /// The direction into which facets of the normal `h` reflect `w`.
    #[inline]
    pub(in crate::material) fn reflect(w: DVec3, h: DVec3) -> DVec3 {
        h * (2.0 * w.dot(h)) - w
    }

    /// Reflection between two directions by facets of the normal `h` halfway: the visible normals' density times the
    /// Jacobian 1 / (4 w·h) (Walter et al. 2007, eq. 14), in which w·h cancels.
    #[inline]
    pub(in crate::material) fn mirrored(&self, wi: DVec3, wo: DVec3, h: DVec3) -> Mirrored {
        let quarter = 0.25 * self.density(h);
        let area = self.projected_area(wo);
        Mirrored {
            density: quarter / self.projected_area(wi),
            reverse: quarter / area,
            ratio: wo.z / area,
        }
    }
}

/// A direction in `f64`, made unit again there, and turned over with the surface if `over`: x and y stay.
#[inline]
pub(in crate::material) fn above(direction: Vec3, over: bool) -> DVec3 {
    let wide = direction.as_dvec3().normalize();
    DVec3::new(wide.x, wide.y, if over { -wide.z } else { wide.z })
}

/// The inverse of [`above`], for a unit direction.
#[inline]
pub(in crate::material) fn outward(direction: DVec3, over: bool) -> Vec3 {
    DVec3::new(direction.x, direction.y, if over { -direction.z } else { direction.z }).as_vec3()
}

#[cfg(test)]
mod tests {
    use super::super::Distribution;
    use super::*;

    /// D(h) / (4 area) integrated over outgoing directions and over normals is the same: the Jacobian is right.
    #[test]
    fn what_facets_reflect_is_as_much_as_they_show() {
        let facets = Microfacets::new(Distribution::Ggx, [0.4, 0.2]);
        let wi = DVec3::new(0.6, -0.3, 0.5).normalize();
        const N: u32 = 1500;
        let (mut reflected, mut shown) = (0.0, 0.0);
        for i in 0..N {
            for j in 0..N {
                let z = (f64::from(i) + 0.5) / f64::from(N) * 2.0 - 1.0;
                let phi = (f64::from(j) + 0.5) / f64::from(N) * std::f64::consts::TAU;
                let r = (1.0 - z * z).sqrt();
                let d = DVec3::new(r * libm::cos(phi), r * libm::sin(phi), z);
                let h = (wi + d).normalize();
                if h.z > 0.0 {
                    reflected += facets.mirrored(wi, DVec3::new(d.x, d.y, d.z.abs()), h).density;
                }
                shown += facets.visible_density(wi, d);
            }
        }
        let cell = 4.0 * std::f64::consts::PI / f64::from(N * N);
        assert!((shown * cell - 1.0).abs() < 1e-3, "{}", shown * cell);
        assert!((reflected * cell - 1.0).abs() < 1e-3, "{}", reflected * cell);
    }
}
