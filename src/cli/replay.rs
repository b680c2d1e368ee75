//! `replay`: one step of one chain, looked at closely.

use super::budget::ThreadArgs;
use super::load::SceneArgs;
use super::output::{note, print};
use super::{interrupt, replay_text};
use crate::plan::Registry;
use crate::render::RenderError;
use crate::replay::{Moment, Part, ReplayError, replay};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use miette::{IntoDiagnostic, Result};
use std::process::ExitCode;

/// Arguments of `replay`.
#[derive(Args, Clone, Debug)]
pub struct ReplayArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of the chain, over all groups; of the pixel (y * width + x) where samples are independent
    #[arg(long, value_name = "C")]
    chain: u32,
    /// Number of the step, from 0 on; of the sample where samples are independent
    #[arg(long, value_name = "S")]
    step: u64,
    /// Seed of the render
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Steps of the progress bar.
const BAR_STEPS: u64 = 1000;

/// Replays and prints.
///
/// # Errors
/// A scene that cannot be loaded, or a chain or step that there is not.
pub fn run(args: &ReplayArgs, registry: &Registry) -> Result<ExitCode> {
    let loaded = args.scene.load(registry)?;
    let interrupt = interrupt::listen()?;
    let moment = Moment {
        seed: args.seed,
        chain: args.chain,
        step: args.step,
    };
    let bar = progress_bar();
    let show = |part, share: f64| {
        bar.set_message(match part {
            Part::Bootstrap => "bootstrap of the chain's group",
            Part::Steps => "steps before",
        });
        bar.set_position((share * BAR_STEPS as f64) as u64);
    };
    let replayed = replay(
        &loaded.scene,
        &loaded.plan,
        moment,
        args.threads.count(),
        &interrupt,
        &show,
    );
    bar.finish_and_clear();
    let replayed = match replayed {
        Err(ReplayError::Render(RenderError::Interrupted)) => {
            note("interrupted before the step was reached: nothing to show");
            return Ok(ExitCode::from(interrupt::EXIT_STATUS));
        }
        other => other?,
    };
    if args.json {
        print(&serde_json::to_string_pretty(&replayed).into_diagnostic()?)?;
    } else {
        print(replay_text::text(&replayed).trim_end())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A bar on a terminal; hidden anywhere else.
fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {elapsed} gone") {
        bar.set_style(style);
    }
    bar
}
