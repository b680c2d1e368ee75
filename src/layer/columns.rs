//! Columns that exist only where layers are split.

use super::End;
use crate::color::Rgb;
use crate::columns;
use crate::table::Table;
use bevy_ecs::component::Component;
use bevy_ecs::query::Without;

/// Marks the rows of the table of what proposals bring to the pixel that their camera subpath was started through, layer by layer: layer
/// l of chain c has number l · capacity + c.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct ProposedLayerTable;

impl Table for ProposedLayerTable {
    type Apart = Without<LayerTable>;
}

/// Marks the rows of the same table of current states.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct LayerTable;

impl Table for LayerTable {
    type Apart = Without<ProposedLayerTable>;
}

/// The [`SplatLayer`] of the splat that is split among layers in the table of layers.
pub const OWN_LAYERS: u32 = u32::MAX;

columns! {
    /// What a layer has of the splat to the path's own pixel.
    pub LayerColor: Rgb;
    /// The layer of a splat, or [`OWN_LAYERS`].
    pub SplatLayer: u32;
    /// The layer of the path that a segment completes.
    pub SegmentLayer: u32;
    /// On what light a vertex's connection ends, and on which side of the surface: a [`ConnectionEnd`], packed; 0 where there is no
    /// connection.
    pub VertexConnectionEnd: u32;
}

/// How the path that a connection completes ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConnectionEnd {
    /// Whether it goes through the surface of its last vertex but one.
    pub transmits: bool,
    /// The light.
    pub end: End,
}

impl ConnectionEnd {
    /// As a column keeps it; never 0.
    #[inline]
    #[must_use]
    pub const fn packed(self) -> u32 {
        1 + (self.end as u32) * 2 + self.transmits as u32
    }

    /// From what a column keeps; `None` of 0.
    #[inline]
    #[must_use]
    pub fn unpacked(bits: u32) -> Option<Self> {
        let number = bits.checked_sub(1)?;
        Some(Self {
            transmits: number & 1 == 1,
            end: *End::ALL.get(number as usize / 2)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn connections_survive_their_column() {
        assert_eq!(ConnectionEnd::unpacked(0), None);
        for end in End::ALL {
            for transmits in [false, true] {
                let connection = ConnectionEnd { transmits, end };
                assert_eq!(ConnectionEnd::unpacked(connection.packed()), Some(connection));
            }
        }
    }
}
