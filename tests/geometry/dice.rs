//! Random numbers for the tests of this folder, from fixed seeds.

use chainlight::math;
use chainlight::sampling::{Purpose, Stream, StreamKey, warp};
use glam::{DVec3, Vec3};

pub struct Dice(Stream);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(StreamKey::new(seed, 0, 0).stream(Purpose::SCATTER, 0))
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f32 {
        self.0.next_f32()
    }

    pub fn fine_unit(&mut self) -> f64 {
        self.0.next_f64()
    }

    pub fn pair(&mut self) -> [f32; 2] {
        self.0.next_pair()
    }

    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Uniform in its logarithm.
    pub fn magnitude(&mut self, low: f32, high: f32) -> f32 {
        math::exp(self.between(math::ln(low), math::ln(high)))
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.fine_unit() * count as f64) as usize
    }

    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// A unit vector.
    pub fn direction(&mut self) -> Vec3 {
        let pair = self.pair();
        warp::uniform_sphere(pair).as_dvec3().normalize().as_vec3()
    }

    /// A point in the cube [-half, half]³.
    pub fn point(&mut self, half: f32) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|_| self.between(-half, half)))
    }

    /// A unit vector that makes an angle of the given cosine with `normal`.
    pub fn at_cosine(&mut self, normal: Vec3, cosine: f32) -> Vec3 {
        let normal = normal.as_dvec3().normalize();
        let cosine = f64::from(cosine);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        (normal * cosine + self.beside(normal) * sine).normalize().as_vec3()
    }

    /// Two unit vectors at right angles.
    pub fn plane(&mut self) -> [DVec3; 2] {
        let first = self.direction().as_dvec3().normalize();
        [first, self.beside(first)]
    }

    /// A unit vector at right angles to `axis`.
    fn beside(&mut self, axis: DVec3) -> DVec3 {
        loop {
            let across = self.direction().as_dvec3().cross(axis);
            if across.length() > 0.1 {
                return across.normalize();
            }
        }
    }
}
