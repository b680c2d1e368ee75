//! Geometry as the renderer uses it: queues of rays and segments against compiled scenes.
//!
//! Counts of failures are required to be zero. By the rule of three, zero failures in n independent cases bound the
//! rate of failures below 3/n with 95 % confidence; each statistical test names its n.

mod any_numbers;
mod degenerate;
mod dice;
mod hard;
mod leaving;
mod lights;
mod points;
mod rooms;
mod round;
mod scan;
mod shapes;
mod sheets;
mod ties;
mod tracers;
mod tree;
mod watertight;
mod world;
