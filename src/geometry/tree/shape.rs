//! Primitives one by one: those that are no triangles, as leaves keep them, and all where there is no tree.

use crate::geometry::leaf::LeafPrimitive;

/// A primitive, and the box around it.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// The primitive.
    pub primitive: LeafPrimitive,
    /// Its box, least and largest coordinate by axis.
    pub bounds: [[f32; 2]; 3],
}

impl Shape {
    /// Puts a box around a primitive.
    pub fn new(primitive: LeafPrimitive) -> Self {
        let (low, high) = (primitive.bounds().min.to_array(), primitive.bounds().max.to_array());
        Self {
            primitive,
            bounds: [0, 1, 2].map(|axis| [low[axis], high[axis]]),
        }
    }
}
