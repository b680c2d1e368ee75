//! Samplers against the densities they claim, by chi-square tests over independent samples. The tests of a file share a
//! chance of a false alarm of one in a hundred; each prints what it could have seen, and is shown to fail on a planted
//! bias.

mod cameras;
mod diffuse;
mod discrete;
mod discrete_lights;
mod discrete_lobes;
mod emission;
mod emitters;
mod infinite;
mod jumps;
mod light_choice;
mod lights;
mod primary;
mod remote;
mod resampling;
mod rough;
mod rough_lobes;
mod round_lights;
mod smooth;
mod stream_lags;
mod streams;
mod warps;
