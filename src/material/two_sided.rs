//! `TwoSided`: a sheet whose sides differ, such as a printed page or a can that is painted outside.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `front` | the name of the material on the side of the geometric normal | an opaque material with no sides of its own | required |
//! | `back` | the name of the material on the other side | the same | required |
//!
//! Use it for thin things with two faces: pages, labels, cups, leaves that let no light pass. Each side is the material that
//! it names, as that looks from its own front; the back shows it whether it is `two_sided` or not. Do not use it for clear
//! materials, whose sides belong together, nor for a surface that looks alike from both sides (`two_sided` of the material
//! itself), nor for light that shines through a sheet: none passes it.
//!
//! It scatters nothing itself: a ray that meets it takes the material of the side that it comes from, told by the geometric
//! normal, so that shading normals do not mix the sides (Veach 1997, §5.3, on the two normals of a surface).

/// The materials of the two sides of every surface, where some differ.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    /// The numbers of front and back of every material up to the last that differs by side.
    pairs: Vec<[u32; 2]>,
}

impl Sides {
    /// Whether no surface has another material on its back than on its front.
    #[inline]
    pub(super) fn are_alike(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Makes `front` and `back` the sides of the material `front`. Those before it that have no sides yet are alike.
    pub(super) fn put(&mut self, front: u32, back: u32) {
        let alike = self.pairs.len() as u32..front;
        self.pairs.extend(alike.map(|material| [material; 2]));
        self.pairs.push([front, back]);
    }

    /// The material that is seen from the front, or from the back, of a surface with this one.
    #[inline]
    pub(super) fn facing(&self, material: u32, front: bool) -> u32 {
        match self.pairs.get(material as usize) {
            None => material,
            Some(sides) => sides[usize::from(!front)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_was_put_differs_by_side() {
        let mut sides = Sides::default();
        assert!(sides.are_alike());
        sides.put(2, 3);
        sides.put(4, 5);
        let all: Vec<[u32; 2]> = (0..7)
            .map(|material| [sides.facing(material, true), sides.facing(material, false)])
            .collect();
        assert_eq!(all, [[0, 0], [1, 1], [2, 3], [3, 3], [4, 5], [5, 5], [6, 6]]);
        assert!(!sides.are_alike());
    }
}
