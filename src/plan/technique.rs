//! Techniques: ways to estimate the picture.

use super::mutation::StateSpace;
use std::fmt;
use std::str::FromStr;

/// A way to estimate the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Technique {
    /// Path tracing with next-event estimation, multiple importance sampling and Russian roulette, in stages over tables.
    ///
    /// It cannot find light of a point, a spot or a single direction that comes to a matt surface by way of smooth ones, such
    /// as a spot's caustic behind a glass ball: no ray meets such a light, and no smooth surface can be joined to it. The same
    /// holds of chains over it. `bdpt`, `lt` and chains over `bdpt` find it.
    #[default]
    Pt,
    /// The same estimator traced depth first, one path after another: the oracle of the staged one, and its baseline.
    PtReference,
    /// Light tracing (Dutré, Lafortune and Willems 1993): paths from lights, seen by the lens at each of their vertices.
    ///
    /// Good at caustics on matt surfaces. It cannot find what the lens sees by way of a vertex that scatters into a single
    /// direction: what stands in a mirror, behind smooth glass or an interface of index 1.00001, or is mirrored in a smooth
    /// coat, is missing from its picture; so is light from infinity that the lens sees directly. Plans say what that is in
    /// a scene ([`Missing`](super::Missing)). Shapes that emit are seen. `bdpt` and `pt` find all of it, but for light
    /// of points and single directions by way of smooth surfaces.
    Lt,
    /// Bidirectional path tracing (Veach and Guibas 1994; Lafortune and Willems 1993): a subpath from the camera and one from
    /// a light, joined in every way.
    ///
    /// It cannot find light of a point, a spot or a single direction that comes to a matt surface by way of smooth ones and is
    /// seen in or through smooth ones too: such a path has no two neighbours that could be joined. No technique here does; a
    /// light with a size, such as a small sphere that emits, is met by chance. The same holds of chains over it.
    Bdpt,
    /// Primary-sample-space Metropolis light transport (Kelemen, Szirmay-Kalos, Antal and Csonka 2002) over path tracing.
    Pssmlt,
    /// The same chains run depth first, one after another: the oracle of the staged ones, and their baseline.
    PssmltReference,
    /// Metropolis light transport in path space (Veach and Guibas 1997): a state is a path from the camera to a light, and mutations
    /// change it vertex by vertex.
    ///
    /// It finds what `bdpt` finds, and misses what that misses.
    Mlt,
    /// The same chains, whose proposals are made depth first, one after another: the oracle of the staged ones, and their baseline.
    MltReference,
}

/// What primary-sample-space chains run over: which light a list of numbers stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// A path of path tracing.
    #[default]
    Pt,
    /// A pair of subpaths, joined in every way.
    Bdpt,
}

impl Base {
    /// The name on the command line and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pt => "pt",
            Self::Bdpt => "bdpt",
        }
    }
}

impl fmt::Display for Base {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Base {
    type Err = &'static str;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        [Self::Pt, Self::Bdpt]
            .into_iter()
            .find(|base| base.name() == name)
            .ok_or("expected pt or bdpt")
    }
}

/// No technique has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no technique `{name}`; techniques are {}{}", names(), hint(.nearest))]
pub struct UnknownTechnique {
    /// The name that was asked for.
    pub name: String,
    /// The nearest name there is, if one is near.
    pub nearest: Option<&'static str>,
}

fn names() -> String {
    Technique::ALL.map(|t| format!("`{t}`")).join(", ")
}

fn hint(nearest: &Option<&'static str>) -> String {
    nearest
        .map(|name| format!(" (did you mean `{name}`?)"))
        .unwrap_or_default()
}

impl Technique {
    /// Every technique.
    pub const ALL: [Self; 8] = [
        Self::Pt,
        Self::PtReference,
        Self::Lt,
        Self::Bdpt,
        Self::Pssmlt,
        Self::PssmltReference,
        Self::Mlt,
        Self::MltReference,
    ];

    /// Those whose samples are independent, and each of one pixel.
    pub const INDEPENDENT: [Self; 2] = [Self::Pt, Self::PtReference];

    /// The kind of states that its chains move between; `None` where its samples are independent.
    #[must_use]
    pub const fn space(self) -> Option<StateSpace> {
        match self {
            Self::Pt | Self::PtReference | Self::Lt | Self::Bdpt => None,
            Self::Pssmlt | Self::PssmltReference => Some(StateSpace::PRIMARY),
            Self::Mlt | Self::MltReference => Some(StateSpace::PATH),
        }
    }

    /// Whether its samples are states of Markov chains, and not independent.
    #[must_use]
    pub const fn has_chains(self) -> bool {
        self.space().is_some()
    }

    /// Of a baseline, the technique in stages that it is held against.
    #[must_use]
    pub const fn staged(self) -> Option<Self> {
        match self {
            Self::PtReference => Some(Self::Pt),
            Self::PssmltReference => Some(Self::Pssmlt),
            Self::MltReference => Some(Self::Mlt),
            Self::Pt | Self::Lt | Self::Bdpt | Self::Pssmlt | Self::Mlt => None,
        }
    }

    /// The name on the command line and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pt => "pt",
            Self::PtReference => "pt-reference",
            Self::Lt => "lt",
            Self::Bdpt => "bdpt",
            Self::Pssmlt => "pssmlt",
            Self::PssmltReference => "pssmlt-reference",
            Self::Mlt => "mlt",
            Self::MltReference => "mlt-reference",
        }
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Technique {
    type Err = UnknownTechnique;

    fn from_str(name: &str) -> Result<Self, UnknownTechnique> {
        Self::ALL
            .into_iter()
            .find(|t| t.name() == name)
            .ok_or_else(|| UnknownTechnique {
                name: name.to_owned(),
                nearest: Self::ALL
                    .map(|t| (strsim::damerau_levenshtein(t.name(), name), t.name()))
                    .into_iter()
                    .filter(|(distance, known)| *distance <= known.len() / 2)
                    .min()
                    .map(|(_, known)| known),
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for technique in Technique::ALL {
            assert_eq!(technique.name().parse(), Ok(technique));
        }
    }

    #[test]
    fn a_wrong_name_is_answered_with_the_nearest() {
        let error = "pt-refernce".parse::<Technique>().expect_err("misspelt");
        assert_eq!(error.nearest, Some("pt-reference"));
        assert!(error.to_string().ends_with("(did you mean `pt-reference`?)"), "{error}");
    }
}
