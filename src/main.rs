//! The program: parse arguments, call one command, print one error.

fn main() {}
