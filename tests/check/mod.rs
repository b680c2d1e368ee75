//! The harness that can refute a mutation: what is right passes, and every planted mistake is found.

mod command;
mod example;
mod path_twins;
mod paths;
mod steps;
mod twins;
mod verdicts;
