//! A subpath's vertices as joining sees them, and the odds of the strategies that would have fewer of them.

use crate::color::Rgb;
use crate::path::measure::Site;
use crate::path::mis::Heuristic;
use crate::path::scatterer::Scatterer;

/// A vertex of a subpath.
#[derive(Clone, Copy, Debug)]
pub struct EndVertex {
    /// The surface that it is on, with the direction in which the subpath arrived. Of an end, only position and normal count.
    pub surface: Scatterer,
    /// Its kind.
    pub kind: u32,
    /// The light that it is on, or [`NOT_EMITTING`](crate::geometry::NOT_EMITTING).
    pub light: u32,
    /// p→: the density of the vertex, drawn from its own end.
    pub forward: f64,
    /// Sᵢ₋₂.
    pub tail: f64,
    /// The product of f/p over the vertices before it.
    pub throughput: Rgb,
}

impl EndVertex {
    /// Where it is.
    #[inline]
    #[must_use]
    pub const fn site(&self) -> Site {
        Site {
            kind: self.kind,
            position: self.surface.position,
            normal: self.surface.normal,
        }
    }
}

/// Sᵢ₋₂ of the vertex that is appended behind the vertices `site(0)` … `site(i − 1)`: `reverse` is p←(xᵢ₋₂), `forward`
/// p→(xᵢ₋₂), `tail` the same of the vertex before, and `first` c₀: whether a path may begin with this subpath's second vertex.
/// `connects(k)` says of a vertex whether it can be joined.
#[inline]
#[must_use]
pub fn tail(
    heuristic: Heuristic,
    i: u32,
    reverse: f64,
    forward: f64,
    tail: f64,
    first: bool,
    connects: impl Fn(u32) -> bool,
) -> f64 {
    let Some(k) = i.checked_sub(2) else { return 0.0 };
    let joined = if k == 0 { first } else { connects(k - 1) && connects(k) };
    let behind = f64::from(u8::from(joined)) + tail;
    if behind == 0.0 {
        0.0
    } else {
        heuristic.odds(reverse / forward) * behind
    }
}

/// Sᵢ of the last vertex of `subpath`, whose p← is `reverse`, and that of the vertex before it `before`. `first` is c₀.
#[inline]
#[must_use]
pub fn odds_behind(heuristic: Heuristic, subpath: &[EndVertex], reverse: f64, before: f64, first: bool) -> f64 {
    let count = |joined: bool| f64::from(u8::from(joined));
    let i = subpath.len() - 1;
    let last = &subpath[i];
    let Some(previous) = i.checked_sub(1).map(|k| &subpath[k]) else {
        return if first {
            heuristic.odds(reverse / last.forward)
        } else {
            0.0
        };
    };
    let behind = match i.checked_sub(2).map(|k| &subpath[k]) {
        None => count(first),
        Some(second) => count(second.site().connects() && previous.site().connects()) + last.tail,
    };
    let inner = if behind == 0.0 {
        0.0
    } else {
        heuristic.odds(before / previous.forward) * behind
    };
    let behind = count(previous.site().connects()) + inner;
    if behind == 0.0 {
        0.0
    } else {
        heuristic.odds(reverse / last.forward) * behind
    }
}
