//! How rays are traced: over which data, how many at a time, by which instructions. Hits are the same whichever way.

use std::fmt;
use std::str::FromStr;

/// How rays are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tracer {
    /// `all`: every ray against all primitives, sixteen rays at a time; fewer than eight go through the tree, one by one.
    All,
    /// `one-by-one`: through the tree, one ray after another.
    OneByOne,
    /// `interleaved`, or `interleaved:RAYS`: through the tree, so many rays at a time, so that the processor works on several at once, and
    /// on others while what one needs is fetched.
    Interleaved(u32),
}

/// Rays on their way at a time. Measured from 8 to 64: more than 32 gain a few per cent on two million triangles and nothing on fewer.
const RAYS: u32 = 32;
/// The most rays on their way at a time.
pub(super) const MOST_RAYS: u32 = 64;
/// Without wide instructions, trees up to this size are walked by one ray after another: there is nothing to overlap that pays for
/// the bookkeeping, while a larger tree has memory to wait for.
const SMALL_TREE: usize = 4 << 20;

/// So many primitives that are no triangles do not slow down a look at everything: they are looked at ray by ray.
const FEW_OTHERS: usize = 2;

impl Tracer {
    /// The fastest way through a tree of so many bytes over so many triangles and other primitives.
    pub(super) fn fastest(triangles: usize, others: usize, bytes: usize, instructions: Instructions) -> Self {
        if triangles <= instructions.few_triangles() && others <= FEW_OTHERS {
            Self::All
        } else if instructions == Instructions::Plain && bytes <= SMALL_TREE {
            Self::OneByOne
        } else {
            Self::default()
        }
    }
}

impl Default for Tracer {
    fn default() -> Self {
        Self::Interleaved(RAYS)
    }
}

impl fmt::Display for Tracer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => f.write_str("all"),
            Self::OneByOne => f.write_str("one-by-one"),
            Self::Interleaved(rays) => write!(f, "interleaved:{rays}"),
        }
    }
}

/// A name that stands for no way to trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected all, one-by-one, interleaved or interleaved:RAYS with 1 to {MOST_RAYS} rays at a time")]
pub struct UnknownTracer;

impl FromStr for Tracer {
    type Err = UnknownTracer;

    fn from_str(name: &str) -> Result<Self, UnknownTracer> {
        match name.split_once(':') {
            None if name == "all" => Ok(Self::All),
            None if name == "one-by-one" => Ok(Self::OneByOne),
            None if name == "interleaved" => Ok(Self::Interleaved(RAYS)),
            Some(("interleaved", rays)) => match rays.parse() {
                Ok(rays @ 1..=MOST_RAYS) => Ok(Self::Interleaved(rays)),
                _ => Err(UnknownTracer),
            },
            _ => Err(UnknownTracer),
        }
    }
}

/// Which instructions rays are traced with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// `plain`: what every machine has.
    #[default]
    Plain,
    /// `avx2`: x86-64-v3, AVX2 and what came with it.
    Avx2,
    /// `avx512`: x86-64-v4, AVX-512 and what came with it.
    Avx512,
}

impl Instructions {
    /// All of them, the least first.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Avx2, Self::Avx512];

    /// Whether this machine has them.
    #[must_use]
    pub fn are_here(self) -> bool {
        match self {
            Self::Plain => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => pulp::x86::V3::try_new().is_some(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => pulp::x86::V4::try_new().is_some(),
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// The best that this machine has.
    #[must_use]
    pub fn best() -> Self {
        let here = Self::ALL.into_iter().rfind(|instructions| instructions.are_here());
        here.unwrap_or_default()
    }

    /// Up to so many triangles, a look at all of them is faster than a tree: with AVX-512 one costs half a nanosecond, with AVX2 one, where
    /// a tree over 38 takes 83 and 89 for a diffuse bounce and all of them 42 and 67.
    const fn few_triangles(self) -> usize {
        match self {
            Self::Plain => 0,
            Self::Avx2 => 40,
            Self::Avx512 => 64,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

impl fmt::Display for Instructions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name of instructions that this machine cannot be asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("this machine has {0}")]
pub struct MissingInstructions(String);

impl FromStr for Instructions {
    type Err = MissingInstructions;

    /// Instructions that this machine has.
    fn from_str(name: &str) -> Result<Self, MissingInstructions> {
        let mut here = Self::ALL.into_iter().filter(|instructions| instructions.are_here());
        let names: Vec<&str> = here.clone().map(Self::name).collect();
        here.find(|instructions| instructions.name() == name)
            .ok_or_else(|| MissingInstructions(names.join(", ")))
    }
}

/// How a scene's rays are traced, and whether that was asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tracing {
    /// Over which data, and how many at a time.
    pub tracer: Tracer,
    /// By which instructions.
    pub instructions: Instructions,
    /// Whether either was asked for, rather than chosen for the scene and the machine.
    pub asked_for: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for tracer in [
            Tracer::All,
            Tracer::OneByOne,
            Tracer::Interleaved(1),
            Tracer::Interleaved(64),
        ] {
            assert_eq!(tracer.to_string().parse(), Ok(tracer));
        }
        assert_eq!("interleaved".parse(), Ok(Tracer::default()));
        for name in [
            "",
            "tree",
            "interleaved:",
            "interleaved:0",
            "interleaved:65",
            "interleaved:x",
            "all:2",
        ] {
            assert_eq!(name.parse::<Tracer>(), Err(UnknownTracer), "{name}");
        }
        assert_eq!("plain".parse(), Ok(Instructions::Plain));
        assert_eq!(Instructions::best().to_string().parse(), Ok(Instructions::best()));
        let error = "mmx".parse::<Instructions>().expect_err("none of ours");
        assert!(error.to_string().starts_with("this machine has plain"), "{error}");
    }

    #[test]
    fn the_fastest_way_depends_on_the_scene_and_the_instructions() {
        let few = |instructions| Tracer::fastest(30, 0, 1000, instructions);
        assert_eq!(few(Instructions::Plain), Tracer::OneByOne);
        assert_eq!(few(Instructions::Avx2), Tracer::All);
        assert_eq!(
            Tracer::fastest(30, FEW_OTHERS + 1, 1000, Instructions::Avx512),
            Tracer::default()
        );
        let many = |bytes, instructions| Tracer::fastest(1000, 0, bytes, instructions);
        assert_eq!(many(SMALL_TREE, Instructions::Plain), Tracer::OneByOne);
        assert_eq!(many(SMALL_TREE + 1, Instructions::Plain), Tracer::default());
        assert_eq!(many(1000, Instructions::Avx2), Tracer::default());
    }
}
