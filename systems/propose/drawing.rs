//! How a mutation of primary sample space draws the coordinates of a proposal's vertices: the loop that all of them share.

use super::super::chains::Keys;
use super::super::tile::{Queues, TilePlace};
use super::super::trace::draws::{CoordinatesMut, CurrentCoordinates};
use crate::chain::{ChosenMutation, CommonDensity, ForwardDensity};
use crate::path::{
    ChainTable, CoordinateSet, DrawList, PathLength, PrimaryDepth, ProposedDepth, ProposedPrimaryTable,
    VertexCoordinates,
};
use crate::sampling::StreamKey;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, SystemParam};

/// The vertices that wait for coordinates, and the columns that theirs are in.
#[derive(SystemParam)]
pub struct Drawing<'w, 's> {
    place: Res<'w, TilePlace>,
    queues: Res<'w, Queues>,
    list: Read<'w, 's, DrawList, ChainTable>,
    chosen: Read<'w, 's, ChosenMutation, ChainTable>,
    lengths: Read<'w, 's, PathLength, ChainTable>,
    current_depths: Read<'w, 's, PrimaryDepth, ChainTable>,
    keys: Keys<'w, 's>,
    current: CurrentCoordinates<'w, 's>,
    proposed: CoordinatesMut<'w, 's, ProposedPrimaryTable>,
    depths: Write<'w, 's, ProposedDepth, ChainTable>,
    common: Write<'w, 's, CommonDensity, ChainTable>,
    forward: Write<'w, 's, ForwardDensity, ChainTable>,
}

/// A vertex that waits for coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Waiting {
    /// Its depth as draws are keyed by it: different on the two subpaths of a chain.
    pub depth: u32,
    /// The key of the chain's draws.
    pub key: StreamKey,
    /// Which coordinates vertices have.
    pub set: CoordinateSet,
    /// Whether densities are wanted that the acceptance does not need.
    pub wants_common: bool,
    /// Whether this is the first vertex beyond the end of the current subpath.
    pub grows: bool,
}

/// Coordinates that were drawn.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// The coordinates.
    pub coordinates: VertexCoordinates,
    /// ln of the part of their density that is the same both ways.
    pub common: f64,
    /// ln of the part that is not.
    pub forward: f64,
}

impl Drawn {
    /// Coordinates drawn with a density of 1 both ways.
    #[must_use]
    pub const fn uniform(coordinates: VertexCoordinates) -> Self {
        Self {
            coordinates,
            common: 0.0,
            forward: 0.0,
        }
    }

    /// Coordinates drawn afresh, as every proposal's are that the current state does not have.
    #[inline]
    #[must_use]
    pub fn afresh(waiting: &Waiting) -> Self {
        Self::uniform(VertexCoordinates::independent(waiting.key, waiting.depth))
    }
}

impl Drawing<'_, '_> {
    /// Lets `draw` draw for every vertex that waits and whose chain tries mutation `number`: it is given the coordinates that
    /// the current state has for that vertex, if it has any.
    #[inline(always)]
    pub fn draw(&mut self, number: usize, draw: impl Fn(Option<VertexCoordinates>, &Waiting) -> Drawn) {
        let place = &*self.place;
        let (list, chosen, lengths) = (self.list.rows(), self.chosen.rows(), self.lengths.rows());
        let (current_depths, keys) = (self.current_depths.rows(), self.keys.columns());
        let (current, mut proposed) = (self.current.columns(), self.proposed.columns());
        let (depths, common, forward) = (self.depths.rows(), self.common.rows(), self.forward.rows());
        let set = current.set();
        for entry in 0..self.queues.draw {
            let path = list.at(entry) as usize;
            let chain = place.chain(path);
            if chosen.at(chain) as usize != number {
                continue;
            }
            let depth = lengths.at(path);
            let last = current_depths.at(path);
            let waiting = Waiting {
                depth: place.stream_depth(path, depth),
                key: keys.at(chain),
                set,
                wants_common: !common.is_empty(),
                grows: depth == last + 1,
            };
            let vertex = place.coordinate(path, depth);
            let drawn = draw((depth <= last).then(|| current.at(vertex)), &waiting);
            proposed.put(vertex, drawn.coordinates);
            depths.put(path, depth);
            if drawn.forward != 0.0 {
                forward.put(chain, forward.at(chain) + drawn.forward);
            }
            if waiting.wants_common {
                common.put(chain, common.at(chain) + drawn.common);
            }
        }
    }
}
