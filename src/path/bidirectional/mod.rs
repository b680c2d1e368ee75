//! Paths joined from a subpath that starts at the camera and one that starts at a light (Veach and Guibas 1994; Lafortune
//! and Willems 1993; Veach 1997, chapter 10).
//!
//! **Strategy (s, t)** joins the first s vertices of the light subpath y₀ … to the first t vertices of the camera subpath
//! x₀ …, which makes a path of s + t − 1 edges: s = 0 is a camera subpath that meets a light, s = 1 a light sampled from the
//! camera subpath's last vertex, t = 1 a light subpath seen by the lens. The lens is nothing that light can meet: t ≥ 1.
//!
//! **Weights** compare a path with all strategies that could have found it. What the strategies with fewer camera vertices
//! add to the odds follows a recursion along the camera subpath, and the same along the light subpath for those with more:
//!
//! S₀ = 0, Sᵢ = (p←(xᵢ) / p→(xᵢ))^β (cᵢ + Sᵢ₋₁)
//!
//! with p→ the density of drawing the vertex from its own end, p← from the other one, and cᵢ = 1 where xᵢ₋₁ and xᵢ can be
//! joined ([`odds_behind`]). Of a vertex, Sᵢ₋₂ is known as soon as it is appended ([`tail`]); the last two ratios depend on
//! what it is joined to. So a weight costs the same however long the path is.
//!
//! **The light's end.** Strategy s = 1 draws the point on the light as seen from the vertex before it, the others by area. p→(y₀)
//! is the former, and p→(y₁) is multiplied with the ratio of the two: their product is that of the subpath.

mod join;
mod subpath;

pub use join::{Join, Offer, Seen, Strategies, Weights};
pub use subpath::{EndVertex, odds_behind, tail};
