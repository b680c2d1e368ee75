//! Markov chains of light paths: the light they find, how they start, the rules they keep, and what must not show.

mod bytes;
mod depth_first;
mod oracle;
mod rules;
mod start_up;
