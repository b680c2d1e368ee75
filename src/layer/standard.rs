//! The layers that are split where none are named.

use super::Layers;

/// Names and expressions. What is found sooner is left out of what comes later.
const STANDARD: [(&str, &str); 9] = [
    // Lights that the camera sees itself.
    ("emitted", "C[OP]"),
    // Surroundings that it sees, also in mirrors and through glass.
    ("environment", "CS*B"),
    // Lamps in mirrors and through glass.
    ("specular", "CS+L"),
    // Light that one surface scatters to the camera.
    ("direct", "C[DG]L"),
    // Light that goes on from one surface to another which are both matt, or also glossy.
    ("diffuse", "CDD+L"),
    ("glossy", "C[DG][DG]+L"),
    // No two neighbours of the path, its ends included, scatter with a density: no strategy can join it, so it is found by light that a
    // walk meets by chance, or not at all (Veach 1997, section 8.3.3.1).
    ("sds", "CS+([DG]S+)+L"),
    // Light that mirrors and glass bundle onto a surface.
    ("caustic", "C.*[DG]S+L"),
    // Surfaces in the light of others, seen in mirrors and through glass.
    ("seen_specular", "CS+[DG]+L"),
];

/// The standard layers; see [`Layers::within`] for those of a scene.
///
/// # Panics
/// Never: a test builds them.
#[must_use]
pub fn standard() -> Layers {
    match Layers::new(STANDARD) {
        Ok(layers) => layers,
        Err(error) => panic!("the standard layers are expressions: {error}"),
    }
}
