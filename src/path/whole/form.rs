//! What a path looks like to the mutations that perturb it: where subpaths through its discrete vertices begin and end.

use super::WholeVertex;
use crate::chain::{Signature, StateClass};
use crate::path::{VERTEX_DISCRETE, is_direct};

/// Trait of a state, see [`StateClass::traits`]: the first vertex that scatters with a density, if there is one, has a neighbour
/// towards the light that does too, or is the light: the form E S* D (D|L), or E S* L.
pub const LENS_TRAIT: u32 = 1;
/// Trait of a state: there are vertices that scatter with a density before one that does not, on the way to the first two neighbours
/// that do, or to the light.
pub const CHAIN_TRAIT: u32 = 2;
/// Trait of a state: the lens sees a vertex that scatters with a density: the form E D S* (D|L).
pub const CAUSTIC_TRAIT: u32 = 4;

/// Which vertices of a path scatter into one of a few directions.
#[derive(Clone, Copy, Debug)]
pub struct PathForm<'a> {
    /// x₀ … xₖ.
    pub vertices: &'a [WholeVertex],
}

impl PathForm<'_> {
    fn is_discrete(&self, i: usize) -> bool {
        self.vertices[i].kind == VERTEX_DISCRETE
    }

    /// t of the subpath from the camera that perturbations re-trace: up to the first edge that can be joined, or, if there is
    /// none, all of the path.
    #[must_use]
    pub fn camera_vertices(&self) -> usize {
        camera_vertices(self.vertices.len() - 1, |i| self.is_discrete(i))
    }

    /// s of the subpath from the light that the caustic perturbation re-traces, up to the vertex that the lens sees, and how many
    /// of its vertices it keeps: it begins at the first vertex from there that scatters with a density, or at the light. `None`
    /// where the lens does not see a vertex that scatters with a density.
    #[must_use]
    pub fn light_vertices(&self) -> Option<(usize, usize)> {
        light_vertices(self.vertices.len() - 1, |i| self.is_discrete(i))
    }

    /// Whether its light is [direct](crate::path::is_direct).
    #[must_use]
    pub fn is_direct(&self) -> bool {
        is_direct(self.vertices.len() - 1, |i| self.is_discrete(i))
    }

    /// Length, signature and traits.
    #[must_use]
    pub fn class(&self) -> StateClass {
        let k = self.vertices.len() - 1;
        let signature = (1..k).fold(Signature::default(), |signature, i| signature.then(self.is_discrete(i)));
        let stop = self.camera_vertices();
        let perturbed = (1..stop - 1).any(|i| !self.is_discrete(i));
        let mut traits = if perturbed { CHAIN_TRAIT } else { LENS_TRAIT };
        if self.light_vertices().is_some() {
            traits |= CAUSTIC_TRAIT;
        }
        StateClass::new(0, k as u32, signature).with_traits(traits)
    }
}

/// [`PathForm::camera_vertices`] of a path with k edges.
pub(crate) fn camera_vertices(k: usize, is_discrete: impl Fn(usize) -> bool) -> usize {
    (1..k)
        .find(|&i| !is_discrete(i) && (i + 1 == k || !is_discrete(i + 1)))
        .map_or(k + 1, |i| i + 1)
}

/// [`PathForm::light_vertices`] of a path with k edges.
pub(crate) fn light_vertices(k: usize, is_discrete: impl Fn(usize) -> bool) -> Option<(usize, usize)> {
    if k < 2 || is_discrete(1) {
        return None;
    }
    let start = (2..k).find(|&i| !is_discrete(i)).unwrap_or(k);
    Some((k, k + 1 - start))
}
