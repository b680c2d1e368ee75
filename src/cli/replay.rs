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
use miette::{IntoDiagnostic, Result, miette};
use std::process::ExitCode;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Arguments of `replay`.
#[derive(Args, Clone, Debug)]
pub struct ReplayArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of the chain, over all groups; of the pixel (y * width + x) where samples are independent
    #[arg(long, value_name = "C")]
    chain: u32,
    /// Number of the step, from 0 on; of the sample where samples are independent. A chain takes all steps before it again,
    /// some hundred thousand a second
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
    if args.scene.layers.is_given() {
        return Err(miette!(
            help = "leave --layers and --layer out",
            "layers have no effect on a replay: it shows single paths"
        ));
    }
    let loaded = args.scene.load(registry)?;
    let interrupt = interrupt::listen()?;
    let moment = Moment {
        seed: args.seed,
        chain: args.chain,
        step: args.step,
    };
    let bar = progress_bar();
    let patience = Patience::default();
    let show = |part, share: f64| {
        if part == Part::Steps
            && let Some(left) = patience.left(share)
        {
            bar.suspend(|| {
                note(&format!(
                    "the steps before step {} take {left} yet; Ctrl-C ends it",
                    args.step
                ))
            });
        }
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

/// How long the way may seem before it is said how long it is.
const LONG: Duration = Duration::from_secs(60);
/// How long it is watched before that is guessed.
const WATCHED: Duration = Duration::from_secs(2);

/// Whether steps take long. A chain's state is known only by taking its steps, so a step far out can take hours to get to.
#[derive(Default)]
struct Patience {
    began: OnceLock<Instant>,
    told: AtomicBool,
}

impl Patience {
    /// Of steps of which `share` is done: how long the others take, in words; once, and only if it is long.
    fn left(&self, share: f64) -> Option<String> {
        let gone = self.began.get_or_init(Instant::now).elapsed();
        let left = gone.as_secs_f64() * (1.0 - share) / share.max(f64::MIN_POSITIVE);
        let long = gone >= WATCHED && left >= LONG.as_secs_f64();
        (long && !self.told.swap(true, Ordering::Relaxed)).then(|| span(left))
    }
}

/// Seconds for people.
fn span(seconds: f64) -> String {
    match seconds / 3600.0 {
        hours if hours >= 48.0 => format!("about {:.0} days", hours / 24.0),
        hours if hours >= 2.0 => format!("about {hours:.0} hours"),
        hours => format!("about {:.0} minutes", 60.0 * hours),
    }
}

/// A bar on a terminal; hidden anywhere else.
fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {elapsed} gone, {eta} left") {
        bar.set_style(style);
    }
    bar
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_way_is_told_once() {
        let patience = Patience::default();
        assert_eq!(patience.left(1e-9), None, "it has only begun");
        let long_ago = Instant::now().checked_sub(Duration::from_secs(10)).expect("a time");
        let patience = Patience {
            began: OnceLock::from(long_ago),
            told: AtomicBool::new(false),
        };
        assert_eq!(patience.left(0.5), None, "it is soon over");
        let told = patience.left(1e-3).expect("10 000 s are long");
        assert!(told == "about 3 hours", "{told}");
        assert_eq!(patience.left(1e-3), None, "it was told");
    }

    #[test]
    fn spans_read_well() {
        for (seconds, words) in [
            (90.0, "about 2 minutes"),
            (7300.0, "about 2 hours"),
            (1e6, "about 12 days"),
        ] {
            assert_eq!(span(seconds), words);
        }
    }
}
