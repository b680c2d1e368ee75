//! All materials of a scene: one table per model, and an index over them.

use super::conductor::Conductor;
use super::dielectric::Dielectric;
use super::diffuse::Diffuse;
use super::{Evaluated, Scattered};
use crate::scene::MaterialDescription;
use glam::Vec3;

/// The models. A system per model scatters the chains that stand on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MaterialKind {
    /// [`Diffuse`].
    Diffuse,
    /// [`Conductor`].
    Conductor,
    /// [`Dielectric`].
    Dielectric,
}

impl MaterialKind {
    /// Every model.
    pub const ALL: [Self; 3] = [Self::Diffuse, Self::Conductor, Self::Dielectric];

    /// Whether the model scatters into a few directions alone, so that lights cannot be sampled through it.
    #[must_use]
    pub const fn is_discrete(self) -> bool {
        match self {
            Self::Diffuse => false,
            Self::Conductor | Self::Dielectric => true,
        }
    }

    /// The model's name as plans print it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse",
            Self::Conductor => "conductor",
            Self::Dielectric => "dielectric",
        }
    }
}

/// Materials by number.
#[derive(Clone, Debug, Default)]
pub struct MaterialTable {
    names: Vec<String>,
    index: Vec<(MaterialKind, u32)>,
    diffuse: Vec<Diffuse>,
    conductor: Vec<Conductor>,
    dielectric: Vec<Dielectric>,
}

impl MaterialTable {
    /// Appends a material and returns its number.
    pub fn push(&mut self, name: String, description: &MaterialDescription) -> u32 {
        let (kind, row) = match *description {
            MaterialDescription::Diffuse { reflectance, two_sided } => {
                self.diffuse.push(Diffuse { reflectance, two_sided });
                (MaterialKind::Diffuse, self.diffuse.len() - 1)
            }
            MaterialDescription::Conductor {
                eta,
                k,
                reflectance,
                two_sided,
            } => {
                self.conductor.push(Conductor {
                    eta,
                    k,
                    reflectance,
                    two_sided,
                });
                (MaterialKind::Conductor, self.conductor.len() - 1)
            }
            MaterialDescription::Dielectric {
                interior_ior,
                exterior_ior,
                reflectance,
                transmittance,
            } => {
                let relative_ior = interior_ior / exterior_ior;
                self.dielectric.push(Dielectric {
                    relative_ior,
                    reflectance,
                    transmittance,
                });
                (MaterialKind::Dielectric, self.dielectric.len() - 1)
            }
        };
        self.names.push(name);
        self.index.push((kind, row as u32));
        (self.index.len() - 1) as u32
    }

    /// Number of materials.
    #[must_use]
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// The model of a material.
    #[inline]
    #[must_use]
    pub fn kind(&self, material: u32) -> MaterialKind {
        self.index[material as usize].0
    }

    /// The name of a material.
    #[must_use]
    pub fn name(&self, material: u32) -> &str {
        &self.names[material as usize]
    }

    #[inline]
    fn row(&self, material: u32) -> usize {
        self.index[material as usize].1 as usize
    }

    /// Scatters off a diffuse material. See [`Diffuse::sample`].
    #[inline]
    #[must_use]
    pub fn sample_diffuse(&self, material: u32, wi: Vec3, u: [f32; 2]) -> Option<Scattered> {
        self.diffuse[self.row(material)].sample(wi, u)
    }

    /// Scatters off a conductor. See [`Conductor::sample`].
    #[inline]
    #[must_use]
    pub fn sample_conductor(&self, material: u32, wi: Vec3) -> Option<Scattered> {
        self.conductor[self.row(material)].sample(wi)
    }

    /// Scatters off a dielectric. See [`Dielectric::sample`].
    #[inline]
    #[must_use]
    pub fn sample_dielectric(&self, material: u32, wi: Vec3, u: f32) -> Option<Scattered> {
        self.dielectric[self.row(material)].sample(wi, u)
    }

    /// Value and density of a material for a pair of directions; zero for discrete materials.
    #[inline]
    #[must_use]
    pub fn evaluate(&self, material: u32, wi: Vec3, wo: Vec3) -> Evaluated {
        match self.kind(material) {
            MaterialKind::Diffuse => self.diffuse[self.row(material)].evaluate(wi, wo),
            MaterialKind::Conductor | MaterialKind::Dielectric => Evaluated::ZERO,
        }
    }
}
