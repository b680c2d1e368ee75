//! Direct light: what path tracing renders better than any chain, and chains leave to it.
//!
//! Chains find bright light by walking there, which pays where light is hard to find. Direct light is not: a sample or two find
//! it in every pixel, and chains would spend most of their states on it, where it is most of the picture. So it is rendered apart
//! by path tracing, and the picture is the sum of both parts. Which paths bring it is told by one function,
//! [`is_direct`](crate::path::is_direct). What is seen in mirrors and through glass belongs to it: a lamp in glass fills a few pixels
//! with much light, where chains stay for longer than most renders take, and path tracing finds it as it finds the lamp itself.
//!
//! Samples are taken in proportion to mutations, so many per pixel for every hundred mutations per pixel, the first few before
//! the first step, as bootstraps are: of two or three samples of an edge of a lamp nobody could tell the error. But a fixed number
//! would leave an error that no time makes smaller, and a [target](crate::render::Goal::target_error) would never be reached; and
//! how many there are must not depend on a budget that nobody knows yet, or a render that was saved would go on to another picture.
//! So their number is a function of the steps taken, like everything else.

use super::path_tracing;
use super::{EffectPlan, PlanOptions, TilePlan};
use crate::path::Sought;
use crate::scene::Scene;
use std::fmt;
use std::str::FromStr;

/// Mutations per pixel for which [`Direct::Apart`] says how many samples there are.
pub const PER_MUTATIONS: u64 = 100;

/// Samples per pixel before the first step, where no fewer are [asked for](Direct::Apart).
const FIRST: u32 = 16;

/// Who renders direct light, for techniques with chains in path space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direct {
    /// The chains, as all other light.
    Chains,
    /// Path tracing, with so many samples per pixel for every [`PER_MUTATIONS`] mutations per pixel; 2 at least.
    Apart(u32),
}

impl Default for Direct {
    fn default() -> Self {
        Self::Apart(64)
    }
}

impl Direct {
    /// The fewest samples that can be asked for: of a single one nothing is known of its error.
    pub const FEWEST: u32 = 2;
    /// The most samples that can be asked for.
    pub const MOST: u32 = 1_000_000;

    /// Who renders direct light of paths of at most `max_depth` edges: the chains, where it is all there is, since a technique
    /// with chains that does without any would not be one.
    #[must_use]
    pub const fn within(self, max_depth: u32) -> Self {
        if max_depth < Sought::Indirect.shortest() {
            Self::Chains
        } else {
            self
        }
    }

    /// Who renders direct light of a scene where `asked` is to. If nobody is asked for, chains do behind a camera with an aperture: a
    /// small lamp out of focus is in many pixels at once, each of which finds it by a few of its paths through the lens, but chains
    /// walk along it.
    #[must_use]
    pub fn in_scene(asked: Option<Self>, scene: &Scene) -> Self {
        let by_scene = if scene.camera.has_aperture() {
            Self::Chains
        } else {
            Self::default()
        };
        asked.unwrap_or(by_scene).within(scene.max_depth)
    }

    /// The light that chains look for.
    #[must_use]
    pub const fn sought_by_chains(self) -> Sought {
        match self {
            Self::Chains => Sought::All,
            Self::Apart(_) => Sought::Indirect,
        }
    }
}

impl fmt::Display for Direct {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Chains => f.write_str("chains"),
            Self::Apart(samples) => write!(f, "{samples}"),
        }
    }
}

impl FromStr for Direct {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "chains" {
            return Ok(Self::Chains);
        }
        match text.parse() {
            Ok(samples @ Self::FEWEST..=Self::MOST) => Ok(Self::Apart(samples)),
            _ => Err(format!(
                "expected samples per pixel from {} to {}, such as 64, or `chains` to leave direct light to the chains",
                Self::FEWEST,
                Self::MOST
            )),
        }
    }
}

/// How direct light is rendered beside chains.
#[derive(Clone, Debug)]
pub struct DirectPlan {
    /// Samples per pixel for every [`PER_MUTATIONS`] mutations per pixel.
    pub samples: u32,
    /// What the worlds of its samples are built from.
    pub tile: TilePlan,
}

impl DirectPlan {
    /// Path tracing of the direct light of `scene`, which has these effects.
    pub(super) fn new(scene: &Scene, effects: &[EffectPlan], samples: u32, options: &PlanOptions) -> Self {
        // Without mirrors or glass, no path of direct light has more.
        let materials = scene.materials.kinds();
        let longest = if materials.iter().any(|kind| kind.has_discrete_lobe()) {
            scene.max_depth
        } else {
            scene.max_depth.min(2)
        };
        let mut systems = path_tracing::systems(scene, effects, longest);
        let mut tables = path_tracing::tables(scene, effects, longest);
        if let Some(layers) = &options.layers {
            super::layers::split(layers, &mut systems, &mut tables);
        }
        let mut tile = TilePlan::new(systems, tables, options.tile_size);
        tile.longest = longest;
        tile.sought = Sought::Direct;
        tile.heuristic = options.heuristic;
        Self { samples, tile }
    }

    /// The most edges of its paths.
    #[must_use]
    pub const fn longest(&self) -> u32 {
        self.tile.longest
    }

    /// Samples of all `pixels` pixels together, once `mutations` mutations are done.
    #[must_use]
    pub fn samples_after(&self, mutations: u64, pixels: u32) -> u64 {
        let in_proportion = (u128::from(mutations) * u128::from(self.samples)).div_ceil(u128::from(PER_MUTATIONS));
        u64::try_from(in_proportion)
            .unwrap_or(u64::MAX)
            .max(u64::from(self.samples.min(FIRST)) * u64::from(pixels))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_look_for_all_that_is_not_rendered_apart() {
        let apart = Direct::Apart(16);
        assert_eq!(
            (apart.sought_by_chains(), Direct::Chains.sought_by_chains()),
            (Sought::Indirect, Sought::All)
        );
        assert_eq!((apart.within(2), apart.within(3)), (Direct::Chains, apart));
        assert_eq!(Direct::Chains.within(9), Direct::Chains);
    }

    #[test]
    fn words_read_back_and_others_are_refused() {
        for direct in [
            Direct::Chains,
            Direct::Apart(2),
            Direct::default(),
            Direct::Apart(Direct::MOST),
        ] {
            assert_eq!(direct.to_string().parse(), Ok(direct));
        }
        for text in ["0", "1", "-1", "1.5", "1000001", "chain", ""] {
            let error = text.parse::<Direct>().expect_err(text);
            assert!(error.contains("`chains`"), "{text}: {error}");
        }
    }

    #[test]
    fn samples_follow_mutations_and_never_go_back() {
        let plan = DirectPlan {
            samples: 64,
            tile: TilePlan::new(Vec::new(), Vec::new(), Some(16)),
        };
        let pixels = 1000;
        let per_pixel = |mutations: u64| plan.samples_after(mutations * u64::from(pixels), pixels) / u64::from(pixels);
        assert_eq!([0, 1, 25, 50, 1000].map(per_pixel), [16, 16, 16, 32, 640]);
        let counts: Vec<u64> = (0..200_000).map(|m| plan.samples_after(m, pixels)).collect();
        assert!(counts.is_sorted() && counts[25_001] == 16_001);
        assert_eq!(plan.samples_after(u64::MAX, 1), u64::MAX / 100 * 64 + 10);
    }
}
