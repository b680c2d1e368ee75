//! From descriptions to rows of the tables.

use super::super::metals;
use super::super::microfacet::{Distribution, Microfacets};
use super::*;
use crate::color::Rgb;
use crate::scene::{ColorDescription, MaterialDescription};
use crate::texture::Color;

impl MaterialTable {
    /// Appends a material of a validated scene and returns its number; `named` finds other materials by name. One that
    /// differs by side becomes two, of which the second is the back.
    pub fn push<'a>(
        &mut self,
        name: String,
        description: &MaterialDescription,
        named: impl Fn(&str) -> Option<&'a MaterialDescription>,
    ) -> u32 {
        let MaterialDescription::TwoSided { front, back } = description else {
            return self.append(name, description, false);
        };
        // Validation has seen to it that both exist and are opaque.
        let missing = MaterialDescription::Diffuse {
            reflectance: Rgb::BLACK.into(),
            two_sided: true,
        };
        let first = self.append(format!("{name} (front)"), named(front).unwrap_or(&missing), false);
        let second = self.append(format!("{name} (back)"), named(back).unwrap_or(&missing), true);
        self.sides.put(first, second);
        first
    }

    /// Appends a material that is one; `behind` makes the back of an opaque one like its front, whatever it says.
    fn append(&mut self, name: String, description: &MaterialDescription, behind: bool) -> u32 {
        let (kind, row) = match description {
            MaterialDescription::Diffuse { reflectance, two_sided } => {
                let model = Diffuse {
                    reflectance: self.color(reflectance),
                    two_sided: *two_sided || behind,
                };
                add(&mut self.rows.diffuse, model)
            }
            MaterialDescription::Conductor {
                metal,
                eta,
                k,
                reflectance,
                two_sided,
            } => {
                let (eta, k) = complex_index(metal.as_deref(), *eta, *k);
                let model = Conductor {
                    eta,
                    k,
                    reflectance: self.color(reflectance),
                    two_sided: *two_sided || behind,
                };
                add(&mut self.rows.conductor, model)
            }
            MaterialDescription::RoughConductor {
                metal,
                eta,
                k,
                distribution,
                alpha,
                alpha_u,
                alpha_v,
                reflectance,
                two_sided,
            } => {
                let (eta, k) = complex_index(metal.as_deref(), *eta, *k);
                let model = RoughConductor {
                    microfacets: self.microfacets(*distribution, [*alpha, *alpha_u, *alpha_v]),
                    eta,
                    k,
                    reflectance: self.color(reflectance),
                    two_sided: *two_sided || behind,
                };
                add(&mut self.rows.rough_conductor, model)
            }
            MaterialDescription::Dielectric {
                interior_ior,
                exterior_ior,
                reflectance,
                transmittance,
            } => {
                let model = Dielectric {
                    relative_ior: interior_ior / exterior_ior,
                    reflectance: *reflectance,
                    transmittance: *transmittance,
                };
                add(&mut self.rows.dielectric, model)
            }
            // Facets between equal indices bend nothing: a rough interface is then a smooth one, and counts as one wherever
            // it matters that light passes straight.
            MaterialDescription::RoughDielectric {
                interior_ior,
                exterior_ior,
                reflectance,
                transmittance,
                ..
            } if interior_ior / exterior_ior == 1.0 => {
                let model = Dielectric {
                    relative_ior: 1.0,
                    reflectance: *reflectance,
                    transmittance: *transmittance,
                };
                add(&mut self.rows.dielectric, model)
            }
            MaterialDescription::RoughDielectric {
                interior_ior,
                exterior_ior,
                distribution,
                alpha,
                alpha_u,
                alpha_v,
                reflectance,
                transmittance,
            } => {
                let model = RoughDielectric {
                    microfacets: self.microfacets(*distribution, [*alpha, *alpha_u, *alpha_v]),
                    relative_ior: interior_ior / exterior_ior,
                    reflectance: *reflectance,
                    transmittance: *transmittance,
                };
                add(&mut self.rows.rough_dielectric, model)
            }
            MaterialDescription::Plastic {
                interior_ior,
                exterior_ior,
                diffuse_reflectance,
                specular_reflectance,
                nonlinear,
                two_sided,
            } => {
                let reflectances = [self.color(diffuse_reflectance), self.color(specular_reflectance)];
                let relative_ior = interior_ior / exterior_ior;
                let model = Plastic::new(relative_ior, reflectances, *nonlinear, *two_sided || behind);
                add(&mut self.rows.plastic, model)
            }
            // Two-sided materials do not nest: validation has seen to it.
            MaterialDescription::TwoSided { .. } => {
                let model = Diffuse {
                    reflectance: Rgb::BLACK.into(),
                    two_sided: true,
                };
                add(&mut self.rows.diffuse, model)
            }
        };
        self.names.push(name);
        self.index.push((kind, row));
        if let Err(place) = self.kinds.binary_search(&kind) {
            self.kinds.insert(place, kind);
            for (number, kind) in self.kinds.iter().enumerate() {
                self.numbers[*kind as usize] = number as u8;
            }
        }
        (self.index.len() - 1) as u32
    }

    /// A colour parameter; textures are noted as needed.
    fn color(&mut self, description: &ColorDescription) -> Color {
        let color = description.resolve(|name| self.textures.number(name));
        self.needs.textures |= color.is_texture();
        color
    }

    /// Facets; tangents are noted as needed where they are not the same all around.
    fn microfacets(&mut self, distribution: Distribution, [alpha, u, v]: [Option<f32>; 3]) -> Microfacets {
        // Validation has seen to it that there is one or the other.
        let all_around = alpha.unwrap_or(1.0);
        let microfacets = Microfacets::new(distribution, [u.unwrap_or(all_around), v.unwrap_or(all_around)]);
        self.needs.tangents |= !microfacets.is_isotropic();
        microfacets
    }
}

/// Appends a row; the model's kind, and the row's number.
fn add<M: Model>(rows: &mut Vec<M>, model: M) -> (MaterialKind, u32) {
    rows.push(model);
    (M::KIND, (rows.len() - 1) as u32)
}

/// The index of refraction of a metal that is named, or given in numbers; validation has seen to it that it is one.
fn complex_index(metal: Option<&str>, eta: Option<Rgb>, k: Option<Rgb>) -> (Rgb, Rgb) {
    match metal.and_then(metals::find) {
        Some(metal) => (metal.eta, metal.k),
        None => (eta.unwrap_or(Rgb::BLACK), k.unwrap_or(Rgb::ONE)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matt(grey: f32, two_sided: bool) -> MaterialDescription {
        MaterialDescription::Diffuse {
            reflectance: Rgb::splat(grey).into(),
            two_sided,
        }
    }

    #[test]
    fn a_material_that_differs_by_side_becomes_two() {
        let (front, back) = (matt(0.2, false), matt(0.7, false));
        let mut table = MaterialTable::default();
        let plain = table.push("plain".into(), &matt(0.5, true), |_| None);
        let sheet = MaterialDescription::TwoSided {
            front: "a".into(),
            back: "b".into(),
        };
        let sheet = table.push("sheet".into(), &sheet, |name| {
            Some(if name == "a" { &front } else { &back })
        });
        let last = table.push("last".into(), &matt(0.1, true), |_| None);
        let sides = |material| [table.facing(material, true), table.facing(material, false)];
        assert_eq!([sides(plain), sides(sheet), sides(last)], [[0, 0], [1, 2], [3, 3]]);
        assert_eq!((table.name(1), table.name(2)), ("sheet (front)", "sheet (back)"));
        // What is seen from behind is the back's own front, and the front's own back stays black.
        let below = Vec3::new(0.0, 0.6, -0.8);
        let draw = ScatterDraw {
            direction: [0.3, 0.4],
            lobe: 0.0,
        };
        let ratio = |material| {
            let sample = table.sample(material, Vec2::ZERO, below, draw, Transport::Radiance);
            sample.map(|sample| sample.ratio.g)
        };
        assert_eq!([ratio(1), ratio(2)], [None, Some(0.7)]);
    }

    #[test]
    fn a_rough_interface_between_equal_indices_is_a_smooth_one() {
        let kind = |interior_ior| {
            let rough = MaterialDescription::RoughDielectric {
                interior_ior,
                exterior_ior: 1.3,
                distribution: Distribution::Ggx,
                alpha: None,
                alpha_u: Some(0.1),
                alpha_v: Some(0.3),
                reflectance: Rgb::ONE,
                transmittance: Rgb::splat(0.5),
            };
            let mut table = MaterialTable::default();
            let number = table.push("glass".into(), &rough, |_| None);
            (table.kind(number), table.needs().tangents)
        };
        assert_eq!(kind(1.3), (MaterialKind::Dielectric, false));
        assert_eq!(kind(1.300_001), (MaterialKind::RoughDielectric, true));
    }

    #[test]
    fn tangents_are_needed_by_what_is_not_the_same_all_around() {
        let brushed = |alpha_v| MaterialDescription::RoughConductor {
            metal: Some("Al".into()),
            eta: None,
            k: None,
            distribution: Distribution::Ggx,
            alpha: None,
            alpha_u: Some(0.1),
            alpha_v: Some(alpha_v),
            reflectance: Rgb::ONE.into(),
            two_sided: true,
        };
        for (alpha_v, needed) in [(0.1, false), (0.3, true)] {
            let mut table = MaterialTable::default();
            table.push("metal".into(), &brushed(alpha_v), |_| None);
            assert_eq!(
                table.needs(),
                Needs {
                    textures: false,
                    tangents: needed
                }
            );
        }
    }
}
