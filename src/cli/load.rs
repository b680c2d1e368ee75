//! What the commands that take a scene have in common: its arguments, and loading it.

use super::chains::ChainArgs;
use super::layers::LayerArgs;
use super::output::note;
use super::unused;
use crate::geometry::{Instructions, Tracer};
use crate::path::bidirectional::Weights;
use crate::path::mis::Heuristic;
use crate::plan::{Base, Direct, Plan, PlanOptions, Registry, StateSpace, Technique, UnknownTechnique};
use crate::scene::{
    FilterDescription, Scene, SceneOverrides, Step, description::MAX_DEPTH_LIMIT, description::MAX_FILM_PIXELS,
};
use crate::scene::{description::MAX_FILM_SIDE, flatten, read_scene};
use clap::Args;
use miette::{Result, miette};
use std::fmt::Write;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A scene and how to render it.
#[derive(Args, Clone, Debug)]
pub struct SceneArgs {
    /// The scene file: RON, or JSON by its extension
    pub scene: PathBuf,
    /// How to estimate the picture: pt, pt-reference, lt, bdpt, pssmlt, pssmlt-reference, mlt; for `render` also auto, which tries
    /// pt, mlt, bdpt and pssmlt first and takes what promises most [default: the scene's, or pt]
    #[arg(long, value_name = "NAME")]
    pub technique: Option<TechniqueChoice>,
    /// Film size in pixels instead of the scene's, such as 640x480
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// The most edges of a path instead of the scene's: 2 is direct light
    #[arg(long, value_name = "EDGES", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_DEPTH_LIMIT)))]
    pub max_depth: Option<u32>,
    /// Chains per tile instead of as many as fit the cache; the picture does not depend on it
    #[arg(long, value_name = "CHAINS", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub tile: Option<u32>,
    #[command(flatten)]
    pub tracing: TracingArgs,
    #[command(flatten)]
    pub strategies: StrategyArgs,
    #[command(flatten)]
    pub mutations: MutationArgs,
    #[command(flatten)]
    pub chains: ChainArgs,
    #[command(flatten)]
    pub layers: LayerArgs,
}

/// How rays are traced; pictures do not depend on it.
#[derive(Args, Clone, Debug, Default)]
pub struct TracingArgs {
    /// How rays are traced instead of as is fastest for the scene: `all` primitives for every ray, `one-by-one` through the tree, or
    /// `interleaved[:RAYS]`, so many rays at a time; the picture does not depend on it
    #[arg(long, value_name = "WAY")]
    pub tracer: Option<Tracer>,
    /// Which instructions they are traced with instead of the best that the machine has: plain, avx2 or avx512; the picture does
    /// not depend on them
    #[arg(long, value_name = "NAME")]
    pub instructions: Option<Instructions>,
}

impl TracingArgs {
    /// Lets the scene's rays be traced as asked for.
    fn apply(&self, scene: &mut Scene) {
        if self.tracer.is_some() || self.instructions.is_some() {
            let chosen = scene.geometry.tracing();
            let tracer = self.tracer.unwrap_or(chosen.tracer);
            let instructions = self.instructions.unwrap_or(chosen.instructions);
            scene.geometry.trace_with(tracer, instructions);
        }
    }
}

/// What `--technique` asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TechniqueChoice {
    /// This one.
    One(Technique),
    /// The one that promises most, by pilots.
    Auto,
}

impl FromStr for TechniqueChoice {
    type Err = UnknownTechnique;

    fn from_str(name: &str) -> Result<Self, UnknownTechnique> {
        if name == "auto" {
            return Ok(Self::Auto);
        }
        name.parse().map(Self::One)
    }
}

/// How techniques with both ends join subpaths.
#[derive(Args, Clone, Debug, Default)]
pub struct StrategyArgs {
    /// What the chains of pssmlt run over: pt or bdpt [default: pt]
    #[arg(long, value_name = "NAME")]
    pub base: Option<Base>,
    /// The only strategy of bdpt (or of pssmlt over it) to use, with weight one: S vertices from the light and T from the
    /// camera; for tests
    #[arg(long, value_name = "S,T", value_parser = parse_strategy)]
    pub strategy: Option<(u32, u32)>,
    /// How the ways in which pt and bdpt find a path share it: power or balance [default: power]
    #[arg(long, value_name = "NAME")]
    pub heuristic: Option<Heuristic>,
    /// Samples of direct light per pixel for every 100 mutations per pixel of mlt, by path tracing: light that the
    /// camera sees itself or on a surface, be it in mirrors or through glass, which its chains then leave out. `chains` leaves it to them [default: 64, or chains behind a lens with an aperture]
    #[arg(long, value_name = "N")]
    pub direct: Option<Direct>,
}

/// Settings of mutations.
#[derive(Args, Clone, Debug, Default)]
pub struct MutationArgs {
    /// Settings of a mutation, such as small_step:weight=0.5,largest=0.1; a weight of 0 leaves it out
    #[arg(long, value_name = "NAME:KEY=VALUE,...")]
    pub mutation: Vec<String>,
}

impl MutationArgs {
    /// The mutations of `registry` with these settings.
    ///
    /// # Errors
    /// A name, a key or a value that does not fit.
    pub fn apply(&self, registry: &Registry) -> Result<Registry> {
        let mut registry = registry.clone();
        for text in &self.mutation {
            registry
                .set(text)
                .map_err(|error| miette!("--mutation {text}: {error}"))?;
        }
        Ok(registry)
    }
}

/// A scene, ready to render, and how long that took.
pub struct Loaded {
    /// The compiled scene.
    pub scene: Arc<Scene>,
    /// The plan.
    pub plan: Plan,
    /// The reconstruction filter.
    pub filter: FilterDescription,
    /// Stops by which the picture is shown brighter than its automatic exposure.
    pub exposure: f32,
    /// What the reader warned of, one line each.
    pub warnings: Vec<String>,
    /// From file to tables.
    pub load_time: Duration,
}

impl SceneArgs {
    /// Reads, compiles and plans, with the mutations of `registry`. Warnings are printed to standard error.
    ///
    /// # Errors
    /// A file that is no valid scene, a technique that there is not, an option that would have no effect with it, or mutations
    /// that chains cannot run with.
    pub fn load(&self, registry: &Registry) -> Result<Loaded> {
        let start = Instant::now();
        let mutations = self.mutations.apply(registry)?;
        let source = read_scene(&self.scene)?;
        let flattened = flatten(&source)?;
        let named = source.description.settings.technique.as_deref();
        let technique = match (self.technique, named) {
            (Some(TechniqueChoice::One(technique)), _) => technique,
            (Some(TechniqueChoice::Auto), _) => return Err(no_choice()),
            (None, Some(name)) => name.parse().map_err(|error: UnknownTechnique| {
                let place = [Step::Key("settings"), Step::Key("technique")];
                source.error(
                    &place,
                    error.to_string(),
                    "--technique on the command line overrides it",
                )
            })?,
            (None, None) => Technique::default(),
        };
        let overrides = SceneOverrides {
            size: self.size,
            max_depth: self.max_depth,
        };
        let mut scene = Scene::compile(&source.description, &flattened, overrides)?;
        self.tracing.apply(&mut scene);
        let scene = Arc::new(scene);
        let plan = self.plan(&scene, technique, mutations)?;
        let warnings: Vec<String> = flattened.warnings.iter().map(|warning| warning.plain()).collect();
        for warning in &warnings {
            note(&format!("warning: {warning}"));
        }
        Ok(Loaded {
            scene,
            plan,
            filter: source.description.film.filter.clone(),
            exposure: source.description.film.exposure,
            warnings,
            load_time: start.elapsed(),
        })
    }

    /// [`load`](Self::load) of a scene that is loaded already: `loaded` is of the same file, size and depth.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn load_again(&self, technique: Technique, loaded: &Loaded, registry: &Registry) -> Result<Loaded> {
        let mutations = self.mutations.apply(registry)?;
        Ok(Loaded {
            scene: Arc::clone(&loaded.scene),
            plan: self.plan(&loaded.scene, technique, mutations)?,
            filter: loaded.filter.clone(),
            warnings: loaded.warnings.clone(),
            ..*loaded
        })
    }

    /// The plan of a scene.
    fn plan(&self, scene: &Scene, technique: Technique, mutations: Registry) -> Result<Plan> {
        unused::refuse(self, technique, scene, &mutations)?;
        let options = PlanOptions {
            tile_size: self.tile,
            chains: self.chains.settings()?,
            mutations,
            base: self.strategies.base.unwrap_or_default(),
            strategy: self.strategies.strategy,
            heuristic: self.strategies.heuristic.unwrap_or_default(),
            direct: self.strategies.direct,
            layers: self.layers.of(scene)?,
        };
        Ok(Plan::with(scene, technique, &options)?)
    }
}

/// Only `render` tries techniques first.
fn no_choice() -> miette::Report {
    miette!(
        help = "name a technique, such as --technique mlt; `chainlight cost SCENE` tells which promises most",
        "--technique auto is for `render` alone: what else there is needs to know the technique"
    )
}

/// Settings that shape the picture, as its metadata names them.
pub fn settings(loaded: &Loaded) -> String {
    let Scene {
        width,
        height,
        max_depth,
        ..
    } = &*loaded.scene;
    let filter = match loaded.filter {
        FilterDescription::Box { radius } => format!("box({radius})"),
        FilterDescription::Tent { radius } => format!("tent({radius})"),
        FilterDescription::Gaussian { radius, sigma } => format!("gaussian({radius}, {sigma})"),
    };
    let mut settings = format!("size={width}x{height} max_depth={max_depth} filter={filter}");
    if let Some(chains) = &loaded.plan.chains {
        let counts = chains.counts;
        let samples = u64::from(counts.rounds) * u64::from(counts.chains);
        // Writing to a String cannot fail.
        let _ = write!(
            settings,
            " groups={} chains={} bootstrap={samples}",
            counts.groups, counts.chains
        );
        for planned in &chains.mutations {
            let _ = write!(settings, " {}={}", planned.mutation.name(), planned.mutation.settings());
        }
        let space = loaded.plan.technique.space();
        if space == Some(StateSpace::PRIMARY) && loaded.plan.strategies.is_some() {
            let _ = write!(settings, " base={}", Base::Bdpt);
        }
        if space == Some(StateSpace::PATH) {
            let _ = write!(settings, " direct={}", loaded.plan.direct_by());
        }
    }
    if let Some(Weights::Only(s, t)) = loaded.plan.strategies.map(|strategies| strategies.weights) {
        let _ = write!(settings, " strategy={s},{t}");
    }
    let heuristic = loaded.plan.tile.heuristic;
    if heuristic != Heuristic::default() {
        let _ = write!(settings, " heuristic={heuristic}");
    }
    settings
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let form = || "expected WIDTHxHEIGHT in pixels, such as 640x480".to_owned();
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(form)?;
    let side = |digits: &str| digits.trim().parse::<u32>().map_err(|_| form());
    let (width, height) = (side(width)?, side(height)?);
    if !(1..=MAX_FILM_SIDE).contains(&width) || !(1..=MAX_FILM_SIDE).contains(&height) {
        return Err(format!("each side must be in 1..={MAX_FILM_SIDE} pixels"));
    }
    if u64::from(width) * u64::from(height) > MAX_FILM_PIXELS {
        return Err(format!("{width}x{height} has more than {MAX_FILM_PIXELS} pixels"));
    }
    Ok((width, height))
}

fn parse_strategy(text: &str) -> Result<(u32, u32), String> {
    let form = || "expected S,T such as 1,2: vertices from the light, and from the camera".to_owned();
    let (s, t) = text.split_once(',').ok_or_else(form)?;
    let vertices = |digits: &str| digits.trim().parse::<u32>().map_err(|_| form());
    let (s, t) = (vertices(s)?, vertices(t)?);
    if t == 0 || u64::from(s) + u64::from(t) < 2 {
        return Err(
            "T is 1 or more and S + T is 2 or more: a path has two vertices at least, and starts on the lens"
                .to_owned(),
        );
    }
    Ok((s, t))
}

#[cfg(test)]
mod tests {
    use super::parse_size;

    #[test]
    fn sizes_are_two_numbers_within_bounds() {
        assert_eq!(parse_size("640x480"), Ok((640, 480)));
        for bad in [
            "640",
            "x",
            "640x",
            "0x5",
            "-1x5",
            "1e3x5",
            "65537x1",
            "65536x65536",
            "4x4x4",
        ] {
            assert!(parse_size(bad).is_err(), "{bad}");
        }
    }
}
