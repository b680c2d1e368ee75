//! What a replay cannot show, and how it says so.

use super::{SEED, plan, scene};
use chainlight::plan::{Plan, Technique};
use chainlight::render::RenderError;
use chainlight::replay::{Moment, Part, ReplayError, replay};
use chainlight::scene::Scene;
use miette::Diagnostic;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The message and the advice.
fn refusal(scene: &Arc<Scene>, plan: &Plan, chain: u32, step: u64) -> String {
    let moment = Moment {
        seed: SEED,
        chain,
        step,
    };
    let error = replay(scene, plan, moment, 1, &AtomicBool::new(false), &|_, _| ()).expect_err("no such moment");
    let help = error.help().map(|help| help.to_string()).unwrap_or_default();
    format!("{error}\n{help}")
}

#[test]
fn a_chain_that_there_is_not_is_answered_with_those_there_are() {
    let scene = scene();
    insta::assert_snapshot!(refusal(&scene, &plan(&scene, None, false), 120, 0), @"
    there is no chain 120: the chains of pssmlt are 0 to 119
    groups follow each other: chain = group * chains of a group + number in the group
    ");
    insta::assert_snapshot!(refusal(&scene, &Plan::new(&scene, Technique::Pt, None), 576, 0), @"
    there is no chain 576: the chains of pt are 0 to 575
    each pixel is a chain, row by row from the top left: y * width + x
    ");
}

#[test]
fn a_step_beyond_all_is_refused() {
    let scene = scene();
    insta::assert_snapshot!(refusal(&scene, &plan(&scene, None, false), 0, 1 << 63), @"
    there is no step 9223372036854775808: steps are 0 to 9223372036854775807
    give the number of a step that the render has taken
    ");
}

#[test]
fn the_depth_first_baseline_is_answered_with_its_twin() {
    let scene = scene();
    insta::assert_snapshot!(refusal(&scene, &Plan::new(&scene, Technique::PtReference, None), 0, 0), @"
    techniques that run depth first leave no path behind to look at
    replay pt, or pssmlt: with the same seed they draw the same paths, bit for bit
    ");
}

#[test]
fn a_long_way_tells_how_far_it_is_and_can_be_interrupted() {
    let scene = scene();
    let plan = plan(&scene, None, false);
    for part in [Part::Bootstrap, Part::Steps] {
        let interrupt = AtomicBool::new(false);
        let moment = Moment {
            seed: SEED,
            chain: 0,
            step: u64::MAX >> 1,
        };
        let result = replay(&scene, &plan, moment, 1, &interrupt, &|heard, share| {
            assert!((0.0..=1.0).contains(&share));
            if heard == part {
                interrupt.store(true, Ordering::Relaxed);
            }
        });
        assert!(
            matches!(result, Err(ReplayError::Render(RenderError::Interrupted))),
            "{part:?}"
        );
    }
}
