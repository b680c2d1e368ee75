//! Options that would change nothing with the technique they are given for: refused, since whoever gives one expects it to.

use super::load::{SceneArgs, StrategyArgs};
use crate::path::mis::Heuristic;
use crate::plan::{Base, Direct, Registry, StateSpace, Technique};
use crate::scene::Scene;
use crate::scene::description::MAX_DEPTH_LIMIT;
use miette::{Result, miette};

/// Refuses options that have no effect on a render of `scene` with `technique`. `mutations` are those there are.
///
/// # Errors
/// The first such option: why it has no effect, and what to do.
pub fn refuse(args: &SceneArgs, technique: Technique, scene: &Scene, mutations: &Registry) -> Result<()> {
    let max_depth = scene.max_depth;
    refuse_of_chains(args, technique, mutations)?;
    let strategies = &args.strategies;
    let has_base = technique.space() == Some(StateSpace::PRIMARY);
    if let Some(base) = strategies.base
        && !has_base
    {
        let own = match technique {
            Technique::Mlt | Technique::MltReference => "those of mlt walk paths",
            _ => "it has none",
        };
        return Err(miette!(
            help = format!("leave --base out; for chains over {base} add --technique pssmlt"),
            "--base {base} has no effect with {technique}: it says what chains in primary sample space run over, and {own}"
        ));
    }
    if let Some(direct) = strategies.direct {
        refuse_direct(direct, technique, max_depth)?;
    }
    let both_ends = technique == Technique::Bdpt || (has_base && strategies.base == Some(Base::Bdpt));
    if let Some((s, t)) = strategies.strategy {
        if !both_ends {
            let own = match technique {
                Technique::Lt => "joins paths to the lens alone (t = 1)",
                Technique::Pssmlt | Technique::PssmltReference => "runs over pt here, which joins no subpaths",
                Technique::Mlt | Technique::MltReference => "has chains that need all of them",
                _ => "joins no subpaths",
            };
            let instead = if technique == Technique::Pssmlt {
                "--base bdpt"
            } else {
                "--technique bdpt"
            };
            return Err(miette!(
                help = format!("leave --strategy out, or add {instead}"),
                "--strategy {s},{t} has no effect with {technique}: {technique} {own}"
            ));
        }
        let edges = u64::from(s) + u64::from(t) - 1;
        if edges > u64::from(max_depth) {
            let most = u64::from(max_depth) + 1;
            if edges > u64::from(MAX_DEPTH_LIMIT) {
                return Err(miette!(
                    help = format!("take S,T whose sum is at most {most}"),
                    "--strategy {s},{t} finds nothing: its paths have S + T - 1 = {edges} edges, and no path has more than \
                     {MAX_DEPTH_LIMIT}"
                ));
            }
            return Err(miette!(
                help = format!("take S,T whose sum is at most {most}, or raise --max-depth to {edges}"),
                "--strategy {s},{t} finds nothing: its paths have S + T - 1 = {edges} edges, and max_depth is {max_depth}"
            ));
        }
    }
    if let Some(heuristic) = strategies.heuristic {
        refuse_heuristic(heuristic, technique, scene, strategies)?;
    }
    Ok(())
}

/// Refuses to render direct light apart where nothing else would be left, or where chains do not tell it from other light.
fn refuse_direct(direct: Direct, technique: Technique, max_depth: u32) -> Result<()> {
    if technique.space() != Some(StateSpace::PATH) {
        let own = if technique.has_chains() {
            "a state of its chains may bring light of paths of any length"
        } else {
            "it has no chains that could leave direct light out"
        };
        return Err(miette!(
            help = "leave --direct out, or render with --technique mlt",
            "--direct {direct} has no effect with {technique}: {own}"
        ));
    }
    if direct != direct.within(max_depth) {
        return Err(miette!(
            help = "leave --direct out for chains, take --technique pt, or raise --max-depth",
            "--direct {direct} has no effect with paths of at most {max_depth} edges: all of it is direct light, which leaves \
             nothing to chains, so they look for all of it"
        ));
    }
    Ok(())
}

/// Refuses a heuristic where no weights are made of it.
fn refuse_heuristic(
    heuristic: Heuristic,
    technique: Technique,
    scene: &Scene,
    strategies: &StrategyArgs,
) -> Result<()> {
    let direct = Direct::in_scene(strategies.direct, scene);
    if technique.space() == Some(StateSpace::PATH) && direct == Direct::Chains {
        return Err(miette!(
            help = "leave --heuristic out; pt, bdpt and pssmlt weigh their ways to find a path by it, and mlt those of direct \
                    light that is rendered apart",
            "--heuristic {heuristic} has no effect with mlt whose chains look for direct light too: they sample paths in \
             proportion to their light, however they were found"
        ));
    }
    if technique == Technique::Lt {
        return Err(miette!(
            help = "leave --heuristic out; pt, bdpt and pssmlt weigh their ways to find a path by it",
            "--heuristic {heuristic} has no effect with lt: every path has one way to be found, and counts fully"
        ));
    }
    if let Some((s, t)) = strategies.strategy {
        return Err(miette!(
            help = "leave --heuristic or --strategy out",
            "--heuristic {heuristic} has no effect with --strategy {s},{t}: the only strategy has weight one"
        ));
    }
    Ok(())
}

/// Refuses what is said of chains where there are none, and of mutations that no chain can try.
fn refuse_of_chains(args: &SceneArgs, technique: Technique, mutations: &Registry) -> Result<()> {
    if let Some(space) = technique.space() {
        for text in &args.mutations.mutation {
            let name = text.split(':').next().unwrap_or_default().trim();
            let Ok(mutation) = mutations.get(name) else { continue };
            let (StateSpace(own), StateSpace(here)) = (mutation.space(), space);
            if own != here {
                return Err(miette!(
                    help = format!("leave it out, or render with a technique whose states are {own}"),
                    "--mutation {text} has no effect with {technique}: `{name}` moves {own} states, and those of \
                     {technique} are {here}"
                ));
            }
        }
        return Ok(());
    }
    let of_chains = args.chains.given();
    let given = args.mutations.mutation.first().map(|text| format!("--mutation {text}"));
    match of_chains.or(given) {
        Some(option) => Err(miette!(
            help = "leave it out, or render with chains: --technique pssmlt or mlt",
            "{option} has no effect with {technique}: its samples are independent, it has no chains"
        )),
        None => Ok(()),
    }
}
