//! How long a render that aims at an error has yet to go.

use crate::stats::stopping::Checkpoints;

/// What a render knew of its error when it last looked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastLook {
    /// Steps that it had taken.
    pub steps: u64,
    /// The error's upper bound.
    pub upper: f64,
}

/// The steps after which the bound will have fallen to `target` when it is next looked at: errors fall with the root of the work, and
/// are looked at after numbers of steps that double. `None` where that is no number of steps.
#[must_use]
pub fn steps_to_target(look: LastLook, target: f64, checkpoints: &Checkpoints) -> Option<u64> {
    let ratio = look.upper / target;
    let needed = look.steps as f64 * ratio * ratio;
    // As many as fit into the type are more than anyone waits for.
    if !(needed > 0.0 && needed < u64::MAX as f64) {
        return None;
    }
    match checkpoints.next((needed.ceil() as u64).saturating_sub(1).max(look.steps)) {
        u64::MAX => None,
        steps => Some(steps),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_fall_with_the_root_of_the_work_and_are_looked_at_when_it_doubles() {
        let checkpoints = Checkpoints::new(16);
        let look = |steps, upper| LastLook { steps, upper };
        // Four times the work halves an error; a little more than that takes until the next look.
        assert_eq!(steps_to_target(look(64, 0.02), 0.01, &checkpoints), Some(256));
        assert_eq!(steps_to_target(look(64, 0.0201), 0.01, &checkpoints), Some(512));
        assert_eq!(steps_to_target(look(64, 0.0199), 0.01, &checkpoints), Some(256));
        // It was not good enough at this look, so not before the next.
        assert_eq!(steps_to_target(look(64, 0.01), 0.01, &checkpoints), Some(128));
        for (upper, target) in [(0.0, 0.01), (f64::NAN, 0.01), (f64::INFINITY, 0.01), (1e30, 1e-30)] {
            assert_eq!(
                steps_to_target(look(64, upper), target, &checkpoints),
                None,
                "{upper} {target}"
            );
        }
    }
}
