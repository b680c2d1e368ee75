//! How a mutation of primary sample space starts a proposal.

use crate::chain::{CommonDensity, ForwardDensity, ReverseDensity};
use crate::path::{ChainTable, FilmCoordinates, ProposedDepth, ProposedFilm};
use crate::table::{Rows, Write};
use bevy_ecs::system::SystemParam;

/// The columns that every proposal has to write.
#[derive(SystemParam)]
pub struct Proposals<'w, 's> {
    film: Write<'w, 's, ProposedFilm, ChainTable>,
    depths: Write<'w, 's, ProposedDepth, ChainTable>,
    forward: Write<'w, 's, ForwardDensity, ChainTable>,
    reverse: Write<'w, 's, ReverseDensity, ChainTable>,
    common: Write<'w, 's, CommonDensity, ChainTable>,
}

/// [`Proposals`] as slices.
pub struct ProposalColumns<'a> {
    film: &'a mut [ProposedFilm],
    depths: &'a mut [ProposedDepth],
    forward: &'a mut [ForwardDensity],
    reverse: &'a mut [ReverseDensity],
    common: &'a mut [CommonDensity],
}

impl Proposals<'_, '_> {
    /// The columns as slices.
    #[must_use]
    pub fn columns(&mut self) -> ProposalColumns<'_> {
        ProposalColumns {
            film: self.film.rows(),
            depths: self.depths.rows(),
            forward: self.forward.rows(),
            reverse: self.reverse.rows(),
            common: self.common.rows(),
        }
    }
}

impl ProposalColumns<'_> {
    /// Starts the proposal of a mutation that is as likely one way as the other: on the film at `film`, which it reached
    /// with the density `log_density`, and no vertex yet.
    #[inline]
    pub fn start(&mut self, chain: usize, film: FilmCoordinates, log_density: f64) {
        self.film.put(chain, film.0);
        self.depths.put(chain, 0);
        self.forward.put(chain, 0.0);
        self.reverse.put(chain, 0.0);
        if !self.common.is_empty() {
            self.common.put(chain, log_density);
        }
    }

    /// Whether densities are wanted that the acceptance does not need.
    #[inline]
    #[must_use]
    pub const fn wants_common(&self) -> bool {
        !self.common.is_empty()
    }
}
