//! What a render of independent samples says of a picture without any light.

use super::Rendering;
use crate::film::Picture;
use crate::path::bidirectional::Weights;
use crate::plan::{Effect, Technique};

/// What somebody who looks at `picture`, as `render` has it, has to know if there is no light in it, in words: what was seen,
/// likely reasons, and what to try. `None` where there is light, where nothing in the scene emits any (its reader says so),
/// where samples were not finite (which is told by itself), and of chains, which tell it of their bootstraps.
#[must_use]
pub fn blank(render: &dyn Rendering, picture: &Picture) -> Option<String> {
    let (plan, scene, counters) = (render.plan(), render.scene(), render.counters());
    let (chains, tally) = (plan.chains.is_some(), render.tally());
    let uncounted = counters.non_finite + tally.non_finite;
    if chains || uncounted > 0 || !plan.has(Effect::Emission) || picture.rgb.iter().any(|rgb| !rgb.is_black()) {
        return None;
    }
    if tally.vanished > 0 {
        return Some(format!(
            "{} samples brought light that is too dim for the film beside what lights shine with, and none brought more: the \
             picture is black, which it may not be. Another --seed may begin with samples that tell how bright the picture is",
            tally.vanished
        ));
    }
    let advice = match (plan.technique, plan.strategies.map(|strategies| strategies.weights)) {
        (_, Some(Weights::Only(s, t))) => {
            format!("strategy ({s}, {t}) alone finds few paths, or none: leave --strategy out")
        }
        (Technique::Lt, _) => {
            "lt finds light only where it reaches a rough surface that the camera sees: try --technique bdpt".to_owned()
        }
        (Technique::Pt | Technique::PtReference, _) => {
            "pt seldom finds small lights by way of mirrors and smooth glass, and lights at a point never: try \
             --technique bdpt"
                .to_owned()
        }
        _ => "light that is only hard to find takes more samples (--spp), or chains: --technique pssmlt --base bdpt, or mlt"
            .to_owned(),
    };
    Some(format!(
        "none of {} samples brought any light: the picture is black, which it may not be. Either no light can reach the \
         camera (a wall between them; a light inside something; the camera inside something, or turned away), or it takes \
         more edges than --max-depth {}, or {} does not find it: {advice}",
        counters.decisions, scene.max_depth, plan.technique
    ))
}
