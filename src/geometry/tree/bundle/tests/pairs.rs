//! Triangles and lines that are hard to tell apart.

use super::promise::Line;
use crate::sampling::{Purpose, Stream, StreamKey, warp};
use glam::{DVec3, Vec3};

pub type Triangle = [Vec3; 3];

/// Random numbers from a fixed seed.
pub struct Dice(Stream);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(StreamKey::new(seed, 0, 0).stream(Purpose::SCATTER, 0))
    }

    pub fn unit(&mut self) -> f64 {
        self.0.next_f64()
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in its logarithm.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    pub fn direction(&mut self) -> DVec3 {
        warp::uniform_sphere(self.0.next_pair()).as_dvec3().normalize()
    }

    /// A point in the cube from −1 to 1.
    pub fn point(&mut self) -> DVec3 {
        DVec3::from_array([0; 3].map(|_| self.between(-1.0, 1.0)))
    }

    /// A point in the cube from −1 to 1 with such short coordinates that sums and differences are exact.
    pub fn short_point(&mut self) -> DVec3 {
        (self.point() * 1024.0).round() / 1024.0
    }
}

/// What meshes are made of, about the cube from −1 to 1.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Triangles anywhere, of one size.
    Soup,
    /// Triangles around common corners.
    Fan,
    /// Triangles whose corners are almost on a line, or almost two.
    Slivers,
    /// Sizes from 10⁻⁶ to 1.
    Mixed,
    /// One triangle many times over, exactly or up to some roundings.
    Sheets,
    /// In planes of the axes, through the middle too.
    Flat,
    /// Planes and edges exactly through the middle, where coordinates are finest.
    Middle,
    /// As small as roundings of the exact test, which then says anything.
    Specks,
}

impl Kind {
    pub const ALL: [Self; 8] = [
        Self::Soup,
        Self::Fan,
        Self::Slivers,
        Self::Mixed,
        Self::Sheets,
        Self::Flat,
        Self::Middle,
        Self::Specks,
    ];

    /// So many triangles, scaled, then moved.
    pub fn mesh(self, dice: &mut Dice, count: usize, scale: f64, center: DVec3) -> Vec<Triangle> {
        let common = [dice.point(), dice.point(), dice.point()];
        let size = dice.magnitude(0.01, 1.0);
        let mut mesh: Vec<[DVec3; 3]> = (0..count).map(|_| self.triangle(dice, size, common)).collect();
        // Both corners of the cube: the middle of the scene is the middle of the cube.
        mesh.extend([DVec3::ONE, DVec3::NEG_ONE].map(|corner| [corner, corner * 0.75, DVec3::X * corner]));
        let place = |corner: DVec3| (corner * scale + center).as_vec3();
        mesh.into_iter().map(|corners| corners.map(place)).collect()
    }

    fn triangle(self, dice: &mut Dice, size: f64, common: [DVec3; 3]) -> [DVec3; 3] {
        let around = |dice: &mut Dice, size: f64| {
            let center = dice.point();
            [0; 3].map(|_| center + dice.point() * size)
        };
        match self {
            Self::Soup => around(dice, size),
            Self::Fan => [dice.pick(&common), dice.point(), dice.point()],
            Self::Slivers => {
                let [a, b, _] = around(dice, size);
                let along = dice.pick(&[0.0, 0.5, 1.0, 1.5]);
                [a, b, a + (b - a) * along + dice.point() * dice.magnitude(1e-9, 1e-2)]
            }
            Self::Mixed => {
                let size = dice.magnitude(1e-6, 1.0);
                around(dice, size)
            }
            Self::Sheets => {
                let apart = dice.pick(&[0.0, 1e-7, 1e-5, 1e-3]);
                common.map(|corner| corner + dice.point() * apart)
            }
            Self::Flat => {
                let (axis, at) = (dice.below(3), dice.pick(&[-1.0, -0.5, 0.0, 0.5, 1.0]));
                around(dice, size).map(|mut corner| {
                    corner[axis] = at;
                    corner
                })
            }
            Self::Middle => {
                let (a, b) = (dice.short_point() / 4.0, dice.short_point() / 4.0);
                match dice.below(3) {
                    0 => [a, b, -a - b],
                    1 => [a, a * 3.0, b],
                    _ => [a, b, a + b],
                }
            }
            Self::Specks => {
                let mut center = DVec3::ZERO;
                center[dice.below(3)] = dice.pick(&[-0.75, 0.5]);
                let size = dice.magnitude(1e-18, 1e-13);
                [0; 3].map(|_| center + dice.point() * size)
            }
        }
    }
}

/// A point of a triangle: inside, on an edge, at a corner, or just beside it.
fn aim(dice: &mut Dice, triangle: Triangle) -> DVec3 {
    let [a, b, c] = triangle.map(Vec3::as_dvec3);
    let (u, v) = match dice.below(5) {
        0 => dice.pick(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]),
        1 => (dice.unit(), 0.0),
        2 => {
            let u = dice.unit();
            (u, 1.0 - u)
        }
        3 => (dice.between(-0.001, 1.001), dice.between(-0.001, 0.001)),
        _ => {
            let u = dice.unit();
            (u, (1.0 - u) * dice.unit())
        }
    };
    a + (b - a) * u + (c - a) * v
}

/// A point in a triangle's plane, or off it by some roundings.
fn near_the_plane(dice: &mut Dice, triangle: Triangle, scale: f64) -> DVec3 {
    let [a, b, c] = triangle.map(Vec3::as_dvec3);
    let [u, v] = [0; 2].map(|_| dice.between(-1.5, 1.5));
    let off = (b - a).cross(c - a).normalize_or_zero() * scale;
    let size = dice.pick(&[0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-4]);
    a + (b - a) * u + (c - a) * v + off * (size * dice.between(-2.0, 2.0))
}

/// A line from just off a triangle, across it or away.
fn line_off(dice: &mut Dice, triangle: Triangle, scale: f64) -> Line {
    let [a, b, c] = triangle.map(Vec3::as_dvec3);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let off = normal * (scale * dice.magnitude(1e-16, 1e-4) * dice.pick(&[1.0, -1.0]));
    let origin = aim(dice, triangle) + off;
    (origin.as_vec3(), (dice.direction() * scale).as_vec3().as_dvec3())
}

/// A line towards a triangle, or beside it.
pub fn line(dice: &mut Dice, triangle: Triangle, scale: f64, center: DVec3) -> Line {
    if dice.below(6) == 0 {
        return line_off(dice, triangle, scale);
    }
    let target = if dice.below(12) == 0 {
        dice.point() * scale + center
    } else {
        aim(dice, triangle)
    };
    let origin = match dice.below(8) {
        0..3 => dice.point() * (1.5 * scale) + center,
        3..5 => near_the_plane(dice, triangle, scale),
        5 => dice.point() * (scale * dice.magnitude(1e-20, 1.0)) + center,
        6 => dice.pick(&triangle).as_dvec3(),
        _ => dice.direction() * (scale * dice.magnitude(1.0, 1e8)) + center,
    };
    let origin = origin.as_vec3();
    let way = target - origin.as_dvec3();
    let direction = match dice.below(4) {
        // As rays of the renderer go.
        0 => way.normalize().as_vec3().as_dvec3(),
        1 => (way * dice.magnitude(1e-9, 1e9)).as_vec3().as_dvec3(),
        // As segments do, to a target of single precision.
        2 => target.as_vec3().as_dvec3() - origin.as_dvec3(),
        _ => way * dice.pick(&[0.5, 1.0 - 1e-7, 1.0 + 1e-7, 1.0 + 1e-12, 2.0, 100.0]),
    };
    (origin, direction)
}

/// Lines that no renderer asks about.
pub fn broken_line(dice: &mut Dice, sound: Line) -> Line {
    const BAD: [f64; 9] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        1e38,
        -1e30,
        1e-30,
        -1e-42,
    ];
    let (mut origin, mut direction) = sound;
    for axis in 0..3 {
        if dice.below(2) == 0 {
            direction[axis] = dice.pick(&BAD);
        }
        if dice.below(8) == 0 {
            origin[axis] = dice.pick(&BAD) as f32;
        }
    }
    (origin, direction)
}
