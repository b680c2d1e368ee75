//! Markov chains of light paths: the light they find, how they start, the rules they keep, and what must not show.

mod bytes;
mod depth_first;
mod direct;
mod oracle;
mod path_space;
mod rules;
mod start_up;
