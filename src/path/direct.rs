//! Direct light: which paths bring it, and which of them a technique looks for.

use super::VERTEX_SURFACE;

/// Whether light is direct that comes by a path of so many edges, where `is_discrete(i)` says of vertex i whether the path goes through
/// it by a discrete lobe: E S* L and E S* D L in Heckbert's letters, light that the camera sees itself or on a surface, be it in
/// mirrors or through glass. This is the one place that tells it.
pub fn is_direct(edges: usize, is_discrete: impl Fn(usize) -> bool) -> bool {
    (1..edges.saturating_sub(1)).all(is_discrete)
}

/// The light that the paths of a tile look for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sought {
    /// All of it.
    #[default]
    All,
    /// Direct light alone, see [`is_direct`].
    Direct,
    /// What is not direct.
    Indirect,
}

impl Sought {
    /// The fewest edges of paths that bring such light: one or two edges bring direct light, whatever they meet.
    #[must_use]
    pub const fn shortest(self) -> u32 {
        match self {
            Self::All | Self::Direct => 1,
            Self::Indirect => 3,
        }
    }

    /// Whether a path ends at a vertex where its light may be met, but no longer path brings any: one behind a vertex of this kind that
    /// scattered with a density, where direct light alone is looked for.
    #[inline]
    #[must_use]
    pub const fn ends_behind(self, kind: u32) -> bool {
        matches!(self, Self::Direct) && kind == VERTEX_SURFACE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn direct_light_is_told_by_the_letters_of_its_path() {
        for (letters, expected) in [
            ("", true),
            ("D", true),
            ("S", true),
            ("SD", true),
            ("SS", true),
            ("DS", false),
            ("DD", false),
            ("SSSD", true),
            ("SSSS", true),
            ("SDSS", false),
            ("SSDD", false),
            ("SDSD", false),
        ] {
            let letters = letters.as_bytes();
            let direct = is_direct(letters.len() + 1, |i| letters[i - 1] == b'S');
            assert_eq!(direct, expected, "{letters:?}");
            if !direct {
                assert!(letters.len() + 1 >= Sought::Indirect.shortest() as usize);
            }
        }
    }
}
