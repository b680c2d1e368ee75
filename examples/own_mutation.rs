//! A program with a mutation of its own. `lens_step` moves where a path starts on the film by a small step, and keeps every
//! other random number: a path through the same chances, seen a little to the side.
//!
//! `cargo run --release --example own_mutation` checks it, checks what a mistake in it looks like, and renders with it.
//! With arguments it is the whole program: `cargo run --release --example own_mutation -- check lens_step`, or
//! `-- render scenes/cornell-box.ron --technique pssmlt --mutation lens_step:weight=1`.
#![expect(clippy::print_stdout, reason = "an example prints what it found")]

use bevy_ecs::system::Res;
use chainlight::chain::{Kernel, MutationList, SupportDensity};
use chainlight::check::{self, Options, built_in_scene};
use chainlight::cli::{Cli, run_with};
use chainlight::path::{ChainTable, FilmCoordinates, PrimaryFilm};
use chainlight::plan::{
    Mutation, Place, Plan, PlanOptions, Region, Registered, Registry, Stage, StateSpace, Support, SystemPlan,
    SystemSpec, Technique, TraceStep,
};
use chainlight::render::{ChainRender, Rendering};
use chainlight::sampling::Purpose;
use chainlight::system;
use chainlight::systems::chains::{Keys, MutationLists};
use chainlight::systems::propose::drawing::{Drawing, Drawn};
use chainlight::systems::propose::proposal::Proposals;
use chainlight::table::{Read, Rows, Write};
use clap::Parser;
use serde::{Deserialize, Serialize};
use std::process::ExitCode;

/// Settings of `lens_step`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LensStep {
    /// How often it is tried, relative to the other mutations.
    pub weight: f32,
    /// The smallest step, in shares of the film.
    pub smallest: f32,
    /// The largest step, in shares of the film, at most 0.5.
    pub largest: f32,
    /// A planted mistake: whether steps only ever go to the right, while the density says otherwise.
    pub drifts: bool,
}

impl Default for LensStep {
    fn default() -> Self {
        Self {
            weight: 0.5,
            smallest: 1.0 / 64.0,
            largest: 1.0 / 16.0,
            drifts: false,
        }
    }
}

const PROPOSE: SystemSpec = system!(Place::Stage(Stage::Propose), propose_lens_steps);
const DRAW: SystemSpec = system!(Place::Loop(TraceStep::Draw), draw_lens_steps);
const PROPOSE_SUPPORT: SystemSpec = system!(Place::Stage(Stage::Propose), propose_lens_supports);
const WEIGH_SUPPORT: SystemSpec = system!(Place::Stage(Stage::Evaluate), weigh_lens_supports);

impl LensStep {
    fn kernel(&self) -> Kernel {
        match Kernel::new(self.smallest, self.largest) {
            Ok(kernel) => kernel,
            Err(error) => panic!("settings are checked before they are planned: {error}"),
        }
    }
}

impl Mutation for LensStep {
    const NAME: &'static str = "lens_step";
    const ABOUT: &'static str = "the same chances, seen a little to the side";
    const SPACE: StateSpace = StateSpace::PRIMARY;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn check(&self) -> Result<(), String> {
        let kernel = Kernel::new(self.smallest, self.largest);
        kernel.map(|_| ()).map_err(|error| error.to_string())
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(PROPOSE, "lens steps start a little to the side"),
            SystemPlan::new(DRAW, "and go on by the same numbers"),
        ]
    }

    /// So that the harness can test the density, too.
    fn support(&self) -> Option<Support> {
        Some(Support::Region(Region {
            draw: vec![
                SystemPlan::new(PROPOSE_SUPPORT, "any start that a lens step can reach"),
                SystemPlan::new(DRAW, "and on by the same numbers"),
            ],
            weigh: vec![SystemPlan::new(WEIGH_SUPPORT, "1 over the area of those starts")],
            // Two coordinates are drawn uniformly.
            fourth_moment: libm::pow(self.kernel().fourth_moment_of_uniform(), 2.0),
        }))
    }
}

/// Moves where on the film the chains that take a lens step start.
fn propose_lens_steps(
    mutation: Res<Registered<LensStep>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let kernel = mutation.settings.kernel();
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let current = FilmCoordinates(film.at(chain));
        let mut stream = keys.at(chain).stream(Purpose::named("lens_step"), 0);
        // The lowest bit is the sign of a step.
        let sign = if mutation.settings.drifts { !1 } else { !0 };
        let moved = FilmCoordinates(current.0.map(|c| kernel.perturb_wide(c, stream.next_u32() & sign)));
        proposals.start(chain, moved, current.log_density(&kernel, moved));
    }
}

/// Keeps the coordinates of all vertices that the current path has, and draws those beyond its end.
fn draw_lens_steps(mutation: Res<Registered<LensStep>>, mut drawing: Drawing) {
    drawing.draw(mutation.number, |current, waiting| {
        current.map_or_else(|| Drawn::afresh(waiting), Drawn::uniform)
    });
}

/// Draws where on the film lens steps can lead, uniformly.
fn propose_lens_supports(
    mutation: Res<Registered<LensStep>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let kernel = mutation.settings.kernel();
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let current = FilmCoordinates(film.at(chain));
        proposals.start(chain, current.uniform_in_support(&kernel, keys.at(chain)), 0.0);
    }
}

/// Writes the density of those draws.
fn weigh_lens_supports(
    mutation: Res<Registered<LensStep>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    mut densities: Write<SupportDensity, ChainTable>,
) {
    let log_area = 2.0 * libm::log(mutation.settings.kernel().support_length());
    let (list, densities) = (list.rows(), densities.rows());
    for entry in lists.entries(mutation.number) {
        densities.put(list.at(entry) as usize, -log_area);
    }
}

/// The mutations of this program: those of the renderer, and its own in one line.
fn registry() -> Registry {
    chainlight::systems::propose::mutations().with(LensStep::default())
}

/// What [`demonstrate`] found.
#[derive(Debug)]
pub struct Shown {
    /// Whether the mutation passed all tests.
    pub passes: bool,
    /// Whether its twin with a mistake failed any.
    pub twin_fails: bool,
    /// The share of its proposals that were taken in a render.
    pub acceptance: f64,
    /// Mean radiance of the picture.
    pub radiance: f32,
}

/// Checks the mutation and its twin with a planted mistake, and renders with it.
pub fn demonstrate() -> miette::Result<Shown> {
    let scene = built_in_scene()?;
    let options = Options {
        replicas: 1 << 15,
        density_replicas: 1 << 15,
        threads: 2,
        ..Options::default()
    };
    let report = check::run(&registry(), LensStep::NAME, &scene, &options)?;
    println!("{report}\n\nand with a mistake:\n");
    let mut broken = registry();
    broken
        .set("lens_step:drifts=true")
        .map_err(|error| miette::miette!("{error}"))?;
    let twin = check::run(&broken, LensStep::NAME, &scene, &options)?;
    println!("{twin}\n");

    let options = PlanOptions {
        mutations: registry(),
        ..PlanOptions::default()
    };
    let plan = Plan::with(&scene, Technique::Pssmlt, &options)?;
    let (seed, threads) = (0, 2);
    let mut render = ChainRender::new(scene, plan, seed, threads)?;
    render.burst(200, &|_| {});
    let statistics = render.run.statistics();
    let mut acceptance = 0.0;
    for (number, planned) in render.run.chains().mutations.iter().enumerate() {
        let count = (0..chainlight::chain::StateClass::LENGTHS)
            .map(|length| statistics.of_length(number, length))
            .fold(
                Default::default(),
                |a: chainlight::systems::chains::ProposalCount, b| a.plus(b),
            );
        let share = count.accepted as f64 / count.proposed.max(1) as f64;
        println!(
            "{}: {:.1} % of {} taken",
            planned.mutation.name(),
            100.0 * share,
            count.proposed
        );
        if planned.mutation.name() == LensStep::NAME {
            acceptance = share;
        }
    }
    let picture = render.picture();
    let radiance = picture.rgb.iter().map(|rgb| rgb.mean()).sum::<f32>() / picture.rgb.len() as f32;
    println!("mean radiance {radiance:.4}");
    Ok(Shown {
        passes: report.passed(),
        twin_fails: !twin.passed(),
        acceptance,
        radiance,
    })
}

/// The whole program with arguments, a demonstration without.
pub fn main() -> miette::Result<ExitCode> {
    if std::env::args_os().len() > 1 {
        return run_with(&Cli::parse(), &registry());
    }
    let shown = demonstrate()?;
    Ok(if shown.passes && shown.twin_fails {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}
