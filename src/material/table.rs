//! All materials of a scene: one table per model, and an index over them.

mod build;

use super::conductor::Conductor;
use super::dielectric::Dielectric;
use super::diffuse::Diffuse;
use super::list::for_each_material;
use super::plastic::Plastic;
use super::rough_conductor::RoughConductor;
use super::rough_dielectric::RoughDielectric;
use super::two_sided::Sides;
use super::{DiscreteLobe, Evaluated, Event, Lobe, Model, ScatterDraw, Scattered, Transport};
use crate::texture::{Shading, TextureTable};
use glam::{Vec2, Vec3};

macro_rules! define {
    ($($Kind:ident, $table:ident, $name:literal, $scatter:ident, discrete: $discrete:literal, lobes: $lobes:literal,
        events: [$($event:ident),*];)*) => {
        /// The models. A system per model scatters the chains that stand on it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum MaterialKind {
            $(#[doc = concat!("[`", stringify!($Kind), "`].")] $Kind,)*
        }

        impl MaterialKind {
            /// Every model.
            pub const ALL: &[Self] = &[$(Self::$Kind),*];

            /// Whether the model scatters into a few directions alone, so that lights cannot be sampled through it.
            #[must_use]
            pub const fn is_discrete(self) -> bool {
                match self { $(Self::$Kind => $discrete),* }
            }

            /// Whether the model has a lobe that is a single direction, beside others or alone.
            #[must_use]
            pub const fn has_discrete_lobe(self) -> bool {
                let (mut i, events) = (0, self.events());
                while i < events.len() {
                    if matches!(events[i].lobe, Lobe::Specular) {
                        return true;
                    }
                    i += 1;
                }
                false
            }

            /// What the model's lobes do to paths.
            #[must_use]
            pub const fn events(self) -> &'static [Event] {
                match self { $(Self::$Kind => &[$(Event::$event),*]),* }
            }

            /// What scattering by the model is, discrete or with a density, through the surface or not.
            #[inline]
            #[must_use]
            pub const fn event(self, discrete: bool, transmits: bool) -> Event {
                // Lobes with a density stand first, and a model has one kind of them at most.
                let lobe = if discrete { Lobe::Specular } else { self.events()[0].lobe };
                Event::new(lobe, transmits)
            }

            /// Whether the model needs a number of its own to choose between its lobes.
            #[must_use]
            pub const fn chooses_lobes(self) -> bool {
                match self { $(Self::$Kind => $lobes),* }
            }

            /// The model's name as plans print it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$Kind => $name),* }
            }
        }

        /// The rows of every model.
        #[derive(Clone, Debug, Default)]
        struct Rows {
            $($table: Vec<$Kind>,)*
        }

        $(impl InTable for $Kind {
            fn rows(table: &MaterialTable) -> &[Self] {
                &table.rows.$table
            }
        })*

        impl MaterialTable {
            /// Draws the direction in which a path goes on from a material. See [`Model::sample`].
            #[inline]
            #[must_use]
            pub fn sample(&self, material: u32, uv: Vec2, wi: Vec3, draw: ScatterDraw, transport: Transport) -> Option<Scattered> {
                let (kind, row) = self.index[material as usize];
                let at = self.shading(uv);
                match kind {
                    $(MaterialKind::$Kind => self.rows.$table[row as usize].sample(&at, wi, draw, transport),)*
                }
            }

            /// How a discrete lobe of a material scatters. See [`Model::discrete`].
            #[inline]
            #[must_use]
            pub fn discrete(&self, material: u32, uv: Vec2, wi: Vec3, lobe: DiscreteLobe, transport: Transport) -> Option<Scattered> {
                let (kind, row) = self.index[material as usize];
                let at = self.shading(uv);
                match kind {
                    $(MaterialKind::$Kind => self.rows.$table[row as usize].discrete(&at, wi, lobe, transport),)*
                }
            }

            /// Value and densities of a material for a pair of directions. See [`Model::evaluate`]. Part of its callers, so
            /// that what they do not ask for is not computed; the costly models are calls.
            #[inline(always)]
            #[must_use]
            pub fn evaluate(&self, material: u32, uv: Vec2, wi: Vec3, wo: Vec3, transport: Transport) -> Evaluated {
                let (kind, row) = self.index[material as usize];
                let at = self.shading(uv);
                match kind {
                    $(MaterialKind::$Kind => self.rows.$table[row as usize].evaluate(&at, wi, wo, transport),)*
                }
            }
        }
    };
}

for_each_material!(define);

/// The most models that there can be: what lists by model have room for.
pub const KINDS: usize = MaterialKind::ALL.len();

/// A model that has a table of its own.
pub trait InTable: Model {
    /// The rows of the model's table.
    fn rows(table: &MaterialTable) -> &[Self];
}

/// What the materials of a scene ask of surface points, beyond normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Texture coordinates.
    pub textures: bool,
    /// Tangents.
    pub tangents: bool,
}

/// Materials by number.
#[derive(Clone, Debug)]
pub struct MaterialTable {
    names: Vec<String>,
    index: Vec<(MaterialKind, u32)>,
    sides: Sides,
    /// The models that some material has, in the order of [`MaterialKind::ALL`].
    kinds: Vec<MaterialKind>,
    /// The place of every model in `kinds`, or [`NO_MODEL`]: looked up at every vertex.
    numbers: [u8; KINDS],
    rows: Rows,
    needs: Needs,
    /// The scene's textures.
    pub textures: TextureTable,
}

/// No material has this model.
const NO_MODEL: u8 = u8::MAX;

impl Default for MaterialTable {
    fn default() -> Self {
        Self {
            names: Vec::new(),
            index: Vec::new(),
            sides: Sides::default(),
            kinds: Vec::new(),
            numbers: [NO_MODEL; KINDS],
            rows: Rows::default(),
            needs: Needs::default(),
            textures: TextureTable::default(),
        }
    }
}

impl MaterialTable {
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

    /// The row of a material in its model's table.
    #[inline]
    #[must_use]
    pub fn row(&self, material: u32) -> usize {
        self.index[material as usize].1 as usize
    }

    /// The models that some material has, in the order of [`MaterialKind::ALL`].
    #[must_use]
    pub fn kinds(&self) -> &[MaterialKind] {
        &self.kinds
    }

    /// What the materials ask of surface points.
    #[must_use]
    pub const fn needs(&self) -> Needs {
        self.needs
    }

    /// Whether some material needs a number to choose between its lobes.
    #[must_use]
    pub fn choose_lobes(&self) -> bool {
        self.kinds.iter().any(|kind| kind.chooses_lobes())
    }

    /// The number of a model among those of the scene: its place in [`kinds`](Self::kinds).
    #[inline]
    #[must_use]
    pub fn model(&self, kind: MaterialKind) -> Option<usize> {
        let number = self.numbers[kind as usize];
        (number != NO_MODEL).then_some(usize::from(number))
    }

    /// Whether some surface has another material on its back than on its front.
    #[inline]
    #[must_use]
    pub fn have_sides(&self) -> bool {
        !self.sides.are_alike()
    }

    /// The material that is seen from the front, or from the back, of a surface with this one.
    #[inline]
    #[must_use]
    pub fn facing(&self, material: u32, front: bool) -> u32 {
        self.sides.facing(material, front)
    }

    /// What materials may ask of a point with these texture coordinates.
    #[inline]
    #[must_use]
    pub const fn shading(&self, uv: Vec2) -> Shading<'_> {
        Shading {
            uv,
            textures: &self.textures,
        }
    }
}
