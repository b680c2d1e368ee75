//! What a mutation of whole paths has to say, path by path: which ends of a path it keeps, and how likely it makes one path of
//! another. [`systems`](super::moved) do it for many chains at once.

use super::view::PathView;
use crate::sampling::StreamKey;
use glam::{Vec2, Vec3};
use std::fmt;

/// A mutation of whole paths. Its proposal keeps both ends of the path and has the middle drawn anew: two subpaths grow from what is
/// kept, one from the camera and one from the light, and one edge joins them.
pub trait MovesPaths: fmt::Debug + Send + Sync {
    /// What becomes of a path; draws come from `key`, for purposes of its own. `None` if it can do nothing with this one. What does not
    /// [fit](PathProposal::fits) the path is refused with a panic.
    fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal>;

    /// A direction near `direction`, in which the current path goes on from a vertex where it scatters with a density, for a subpath
    /// that is steered; as likely one way as the other. `depth` tells vertices apart in the chain's draws.
    fn near(&self, direction: Vec3, key: StreamKey, depth: u32) -> Vec3 {
        let _ = (key, depth);
        direction
    }

    /// T / r of one way, in the measure of [`whole`](crate::path::whole). What the densities of vertices that are kept contribute is
    /// the same both ways, and left out.
    fn density(&self, way: &Way<'_>) -> f64;
}

/// The ends of a path x₀ … xₖ that a proposal keeps, and the subpaths that it is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathProposal {
    /// t₀ and s₀: vertices that are kept from the camera, and from the light.
    pub kept: [u32; 2],
    /// t and s: vertices of the subpaths, at least as many as are kept, t at least 1. Where s is 1 and nothing is kept from the light, the light
    /// is chosen as seen from the last vertex of the camera subpath; where it is 0, the camera subpath is to meet one.
    pub made: [u32; 2],
    /// Whether the camera subpath ends at the first vertex that it does not go through by a discrete lobe, so that t is at most what
    /// [`made`](Self::made) says.
    pub to_joint: bool,
    /// The place on the film, in pixels, through which a camera subpath goes that is steered: along the discrete lobes of the
    /// current path, and [near](MovesPaths::near) its directions elsewhere. `None` where materials draw directions.
    pub film: Option<Vec2>,
    /// The same of the light subpath.
    pub light: Option<SteeredLight>,
}

/// How a light subpath leaves the last vertex that is kept of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeredLight {
    /// In which unit direction.
    pub direction: Vec3,
    /// From where, if it comes from infinity.
    pub origin: Vec3,
}

impl PathProposal {
    /// A proposal that is drawn by materials.
    #[must_use]
    pub const fn new(kept: [u32; 2], made: [u32; 2]) -> Self {
        Self {
            kept,
            made,
            to_joint: false,
            film: None,
            light: None,
        }
    }

    /// Whether it can be made of a path with `edges` edges, where paths have up to `longest`: what is not is a mistake of its mutation.
    #[must_use]
    pub const fn fits(&self, edges: u32, longest: u32) -> bool {
        let Self { kept, made, .. } = *self;
        let vertices = made[0] + made[1];
        kept[0] + kept[1] <= edges + 1
            && (kept[0] <= made[0] && kept[1] <= made[1])
            && (made[0] > 0 && vertices > 1 && vertices <= longest + 1)
            // Steered subpaths go where those of the path go.
            && (self.film.is_none() || (kept[0] == 1 && made[0] <= edges + 1 && !self.to_joint))
            && (self.light.is_none() || (kept[1] > 0 && made[1] <= edges + 1))
    }
}

/// One way: from a path to another, which a mutation makes of it.
#[derive(Clone, Copy)]
pub struct Way<'a> {
    /// The path that is left.
    pub from: PathView<'a>,
    /// The path that is proposed.
    pub to: PathView<'a>,
    /// t₀ and s₀: vertices that both have in common at their ends.
    pub kept: [u32; 2],
    /// t of the strategy by which the mutation has made its proposal: of both ways for mutations that keep it.
    pub made: u32,
    /// Whether it leads from the proposal to the current path.
    pub is_back: bool,
    /// What the proposal was drawn with.
    pub key: StreamKey,
}

impl<'a> Way<'a> {
    /// The current path, of which the proposal was made.
    #[must_use]
    pub const fn current(&self) -> &PathView<'a> {
        if self.is_back { &self.to } else { &self.from }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn proposals_fit_paths_that_have_what_they_keep() {
        let fits = |kept, made| PathProposal::new(kept, made).fits(4, 6);
        assert!(fits([0, 0], [1, 1]) && fits([2, 3], [3, 4]) && fits([0, 5], [2, 5]) && fits([0, 0], [7, 0]));
        // More than there is, more than is made, no camera, one vertex, too long.
        assert!(!fits([3, 3], [3, 3]) && !fits([2, 0], [1, 3]) && !fits([0, 3], [3, 2]));
        assert!(!fits([0, 0], [0, 3]) && !fits([0, 0], [1, 0]) && !fits([0, 0], [4, 4]));
        let film = Some(Vec2::ZERO);
        let steered = |kept, made| PathProposal {
            film,
            ..PathProposal::new(kept, made)
        };
        assert!(steered([1, 2], [3, 2]).fits(4, 6) && !steered([0, 2], [3, 2]).fits(4, 6));
        // There is nowhere that the sixth vertex could be near.
        assert!(steered([1, 0], [5, 0]).fits(4, 6) && !steered([1, 0], [6, 0]).fits(4, 6));
    }
}
