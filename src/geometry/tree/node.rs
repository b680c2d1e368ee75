//! Eight sibling boxes of the tree, and what stands behind each.

use bytemuck::{Pod, Zeroable};
use obvhs::aabb::Aabb;

/// Boxes of a node.
pub const WIDTH: usize = 8;

/// What a box holds: another node, or something to intersect. One number, so that a box left for later is one word with its distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(transparent)]
pub struct Reference(pub u32);

/// What a [`Reference`] refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A node, by number.
    Node(u32),
    /// A block of triangles, by number.
    Block(u32),
    /// A primitive that is no triangle, by number.
    Shape(u32),
    /// Nothing: the walk is over.
    End,
}

impl Reference {
    /// The kinds are in the two uppermost bits.
    const KIND_BITS: u32 = 30;
    /// Kinds of targets.
    pub const KINDS: usize = 4;
    /// The kind of nodes.
    pub const NODE: usize = 0;
    /// The kind of blocks.
    pub const BLOCK: usize = 1;
    /// The kind of shapes.
    pub const SHAPE: usize = 2;
    /// The kind of the end.
    pub const OVER: usize = 3;
    /// The end.
    pub const END: Self = Self::new(Self::OVER, 0);

    /// The `number`-th of a kind; there may be 2³⁰ of each.
    pub const fn new(kind: usize, number: u32) -> Self {
        Self((kind as u32) << Self::KIND_BITS | number)
    }

    /// Which kind it refers to.
    #[inline(always)]
    pub const fn kind(self) -> usize {
        (self.0 >> Self::KIND_BITS) as usize
    }

    /// Which one of its kind.
    #[inline(always)]
    pub const fn number(self) -> usize {
        (self.0 & ((1 << Self::KIND_BITS) - 1)) as usize
    }

    /// What it refers to.
    #[inline(always)]
    pub const fn target(self) -> Target {
        let number = self.number() as u32;
        match self.kind() {
            Self::NODE => Target::Node(number),
            Self::BLOCK => Target::Block(number),
            Self::SHAPE => Target::Shape(number),
            _ => Target::End,
        }
    }
}

/// Eight sibling boxes: four cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Node {
    /// Least and largest coordinate of each box along x, then y, then z.
    pub planes: [[f32; WIDTH]; 6],
    /// What each box holds.
    pub children: [Reference; WIDTH],
    /// Fills the last line.
    unused: [u32; WIDTH],
}

impl Node {
    /// Boxes that no ray meets.
    pub const EMPTY: Self = Self {
        planes: {
            let (low, high) = ([f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]);
            [low, high, low, high, low, high]
        },
        children: [Reference(0); WIDTH],
        unused: [0; WIDTH],
    };

    /// Puts a box into a place.
    pub fn put(&mut self, place: usize, bounds: &Aabb, child: Reference) {
        let (low, high) = (bounds.min.to_array(), bounds.max.to_array());
        for axis in 0..3 {
            self.planes[2 * axis][place] = low[axis];
            self.planes[2 * axis + 1][place] = high[axis];
        }
        self.children[place] = child;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_are_read_as_they_were_written() {
        for number in [0, 1, 12_345, (1 << 30) - 1] {
            let targets = [Target::Node(number), Target::Block(number), Target::Shape(number)];
            for (kind, target) in targets.into_iter().enumerate() {
                let reference = Reference::new(kind, number);
                assert_eq!(reference.target(), target);
                assert_eq!((reference.kind(), reference.number()), (kind, number as usize));
            }
        }
        assert_eq!(Reference::END.target(), Target::End);
    }

    #[test]
    fn a_node_is_four_cache_lines() {
        assert_eq!((size_of::<Node>(), align_of::<Node>()), (256, 64));
    }
}
