//! Where a camera stands and how it is turned, and its film as a plane before it.

use glam::{DMat3, DVec2, DVec3, Vec2, Vec3};

/// Where a camera stands, as scenes say it. World space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) origin: [f32; 3],
    pub(super) target: [f32; 3],
    pub(super) up: [f32; 3],
}

impl Pose {
    fn view(&self) -> DVec3 {
        Vec3::from_array(self.target).as_dvec3() - Vec3::from_array(self.origin).as_dvec3()
    }

    /// From the origin to the target, in scene units.
    pub(super) fn distance(&self) -> f64 {
        self.view().length()
    }

    /// Unit vectors to the right and up in the picture, and along the view.
    pub(super) fn axes(&self) -> [DVec3; 3] {
        let forward = self.view().normalize();
        let right = forward.cross(Vec3::from_array(self.up).as_dvec3()).normalize();
        [right, right.cross(forward), forward]
    }
}

/// The film as a plane before a camera: a film position is `forward + right · x + up · y`, with x and y in [-1, 1] over
/// the film. In f32, as rays are made of it; what goes back from points to the film takes these very vectors, so that
/// nothing is lost but roundings.
#[derive(Clone, Copy, Debug)]
pub(super) struct FilmPlane {
    /// Unit vector along the view.
    pub(super) forward: Vec3,
    /// From the film's centre to its right edge.
    pub(super) right: Vec3,
    /// From the film's centre to its top edge.
    pub(super) up: Vec3,
    /// Film size in pixels.
    pub(super) film: Vec2,
    /// From a vector to its parts along `right`, `up` and `forward`.
    parts: DMat3,
    /// Four times the volume that the three vectors span: the film's area, but for roundings.
    area: f64,
}

impl FilmPlane {
    pub(super) fn new([right, up, forward]: [Vec3; 3], film: Vec2) -> Self {
        let columns = DMat3::from_cols(right.as_dvec3(), up.as_dvec3(), forward.as_dvec3());
        Self {
            forward,
            right,
            up,
            film,
            parts: columns.inverse(),
            area: 4.0 * columns.determinant().abs(),
        }
    }

    /// x and y of a film position; y points down as on the film.
    #[inline]
    pub(super) fn ndc(&self, film: Vec2) -> Vec2 {
        film / self.film * 2.0 - 1.0
    }

    /// The film position of parts along `right` and `up`; `None` if it is beyond the numbers.
    #[inline]
    pub(super) fn position(&self, along: DVec2) -> Option<Vec2> {
        let film = (DVec2::new(along.x, -along.y) + 1.0) * 0.5 * self.film.as_dvec2();
        let film = film.as_vec2();
        film.is_finite().then_some(film)
    }

    /// A vector's parts along `right`, `up` and `forward`.
    #[inline]
    pub(super) fn parts(&self, vector: DVec3) -> DVec3 {
        self.parts * vector
    }

    /// The film's area.
    #[inline]
    pub(super) fn area(&self) -> f64 {
        self.area
    }

    /// The density of directions from a point at distance 1 behind the film, for uniform film positions: distance² over
    /// the cosine and the area. Zero where no film position is, and beyond the largest number, at right angles to the view.
    #[inline]
    pub(super) fn density(&self, direction: Vec3) -> f32 {
        let cosine = self.parts(direction.as_dvec3()).z;
        if cosine <= 0.0 {
            return 0.0;
        }
        let density = (1.0 / (self.area * cosine * cosine * cosine)) as f32;
        if density.is_finite() { density } else { 0.0 }
    }
}
