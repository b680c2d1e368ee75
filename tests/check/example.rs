//! The example of a program with a mutation of its own, run.

#[path = "../../examples/own_mutation.rs"]
mod own_mutation;

use std::process::ExitCode;

#[test]
fn a_mutation_of_another_crate_is_registered_checked_and_rendered_with() {
    let shown = own_mutation::demonstrate().expect("it runs");
    assert!(shown.passes && shown.twin_fails, "{shown:?}");
    assert!(shown.acceptance > 0.5 && shown.radiance > 0.0, "{shown:?}");
    // The program's own entry takes arguments, and the tests' are not for it.
    let _: fn() -> miette::Result<ExitCode> = own_mutation::main;
}
