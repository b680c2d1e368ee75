//! The density of a whole path by every strategy, as a product over its edges in f64: no recursion, no ratios.
//!
//! **Plain edges** carry a density per solid angle to one per unit area where they arrive. **Through vertices that scatter into one
//! of a few directions** a path from a goes on to b for certain, but for the probability of each choice. What a solid angle at a
//! becomes as an area at b depends on the curvature of all that is between them; but n² cos θ dA dω is the same at both ends of
//! any bundle of rays (étendue), so that the factor is G · n_b² cos θ_b one way and G · n_a² cos θ_a the other. G is the same for
//! all strategies, since none can join anything in between.

use chainlight::material::{ScatterDraw, Transport};
use chainlight::path::bidirectional::EndVertex;
use chainlight::path::{Scatterer, VERTEX_DISCRETE, VERTEX_INFINITE};
use chainlight::scene::Scene;
use glam::{DVec3, Vec3};

/// A vertex of a whole path, from the lens on.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// The surface, of those that scatter.
    pub surface: Scatterer,
    /// Whether it has a direction and no position; its normal is then the direction from there into the scene.
    pub infinite: bool,
    /// Whether it scatters into one of a few directions.
    pub discrete: bool,
}

impl Node {
    /// A vertex of a subpath through which the path goes on.
    pub fn inner(vertex: &EndVertex) -> Self {
        Self {
            discrete: vertex.kind == VERTEX_DISCRETE,
            ..Self::joined(vertex)
        }
    }

    /// A vertex of a subpath at which it is joined to another, or ends.
    pub fn joined(vertex: &EndVertex) -> Self {
        Self {
            surface: vertex.surface,
            infinite: vertex.kind == VERTEX_INFINITE,
            discrete: false,
        }
    }

    fn position(&self) -> DVec3 {
        self.surface.position.as_dvec3()
    }

    /// |cos| of the geometric normal and a direction; 1 for what has no normal.
    fn cosine(&self, direction: DVec3) -> f64 {
        let normal = self.surface.normal.as_dvec3();
        if self.infinite || normal == DVec3::ZERO {
            1.0
        } else {
            normal.dot(direction).abs()
        }
    }
}

/// A mistake in the products, planted to see that it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// None.
    None,
    /// Étendue without the indices of refraction.
    Refraction,
    /// Sampled lights as if by area.
    SampledByArea,
    /// Strategies that are seen by the lens left out.
    Unseen,
}

/// A path with the light that it ends on.
#[derive(Clone, Copy, Debug)]
pub struct WholePath<'a> {
    pub scene: &'a Scene,
    pub nodes: &'a [Node],
    /// The light's number.
    pub light: u32,
    /// Where the index of refraction is not 1: a ball, and its index.
    pub ball: (DVec3, f64, f64),
    pub mistake: Mistake,
    /// An edge, by the number of its vertex that is nearer to the lens, and what is added to its direction from there.
    pub turned: Option<(usize, DVec3)>,
}

/// How far a direction may be off for being rounded to f32, in radians.
const DIRECTION_ROUNDING: f64 = 1.0 / (1_u32 << 23) as f64;
/// How far a position may be off for being rounded to f32, over its distance from the origin.
const POSITION_ROUNDING: f64 = 1.0 / (1_u32 << 24) as f64;

impl WholePath<'_> {
    /// The density of strategy (s, t = n − s) for every s, zero where it cannot find the path.
    pub fn densities(&self) -> Vec<f64> {
        (0..self.nodes.len()).map(|s| self.density(s)).collect()
    }

    /// This path with one edge turned by as much as it may be off, for every edge and two ways across it.
    ///
    /// What a subpath knows of an edge is the ray that it followed. That started **off** its surface, by the offset that keeps it
    /// from meeting the surface again, and ended where the position is rounded; so it is not the direction from the one position to
    /// the other, by these distances over the edge's length. On an edge of a millimetre that is a thousandth of a radian in a scene
    /// of some metres. How much a density changes with it is the material's: e.g. by 1/cos θ where light grazes, and up to
    /// 1/α − α of itself a radian in a lobe of the roughness α (GGX; a direction turns its half vector by half as much).
    pub fn turned(&self) -> impl Iterator<Item = Self> {
        (1..self.nodes.len()).flat_map(move |next| {
            let (a, b) = (&self.nodes[next - 1], &self.nodes[next]);
            let mut angle = DIRECTION_ROUNDING;
            if !a.infinite && !b.infinite {
                let (from, to) = (a.position(), b.position());
                let offset = a.surface.offset.abs().max(b.surface.offset.abs());
                let rounded = POSITION_ROUNDING * (from.length() + to.length());
                angle += (f64::from(offset) + rounded) / (to - from).length();
            }
            let direction = self.direction(next - 1, next);
            let across = direction.any_orthonormal_vector() * angle;
            [across, direction.cross(across)].map(|turn| Self {
                turned: Some((next - 1, turn)),
                ..*self
            })
        })
    }

    fn density(&self, s: usize) -> f64 {
        let (nodes, lights) = (self.nodes, &self.scene.lights);
        let t = nodes.len() - s;
        let (end, delta) = (&nodes[nodes.len() - 1], lights.is_delta(self.light));
        if (s == 0 && (delta || t < 2)) || (s == 1 && t == 1 && (delta || end.infinite)) {
            return 0.0;
        }
        if s > 0 && (nodes[t - 1].discrete || nodes[t].discrete) {
            return 0.0;
        }
        if self.mistake == Mistake::Unseen && t == 1 {
            return 0.0;
        }
        self.along(&(0..t).collect::<Vec<_>>())
            * self.along(&(t..nodes.len()).rev().collect::<Vec<_>>())
            * self.light_end(s, t)
    }

    /// The density of the last vertex, where the light subpath has it.
    fn light_end(&self, s: usize, t: usize) -> f64 {
        let lights = &self.scene.lights;
        if s == 0 {
            return 1.0;
        }
        let count = self.nodes.len();
        let end = &self.nodes[count - 1];
        let before = count - 2;
        let towards = self.direction(count - 1, before);
        let emission = lights.emission_densities(self.light, end.surface.normal, towards.as_vec3());
        let by_area = self.mistake == Mistake::SampledByArea;
        if s > 1 || t == 1 || lights.is_delta(self.light) || by_area {
            return f64::from(emission.position);
        }
        let surface = end.surface;
        let sampled = lights.density(
            self.light,
            self.nodes[before].surface.position,
            surface.position,
            surface.normal,
        );
        f64::from(sampled) * self.spread(before, count - 1)
    }

    /// The density of all vertices of a subpath but its first, which has these numbers on the path.
    fn along(&self, numbers: &[usize]) -> f64 {
        let mut density = 1.0;
        let mut start = 0;
        while start + 1 < numbers.len() {
            // To the next vertex that is not discrete, or the subpath's last.
            let mut end = start + 1;
            while self.nodes[numbers[end]].discrete && end + 1 < numbers.len() {
                end += 1;
            }
            for i in start..end {
                let before = i.checked_sub(1).map(|i| numbers[i]);
                density *= self.leaving(before, numbers[i], numbers[i + 1]);
            }
            let (a, b) = (numbers[start], numbers[end]);
            density *= if end == start + 1 {
                self.spread(a, b)
            } else {
                let last = numbers[end - 1];
                let index = self.index(b, last);
                let b = &self.nodes[b];
                index * index * b.cosine(self.direction(last, numbers[end]))
            };
            start = end;
        }
        density
    }

    /// The density per solid angle (the probability) of going on from `at` to `to`.
    fn leaving(&self, before: Option<usize>, at: usize, to: usize) -> f64 {
        let scene = self.scene;
        let outgoing = self.direction(at, to).as_vec3();
        let surface = &self.nodes[at].surface;
        let Some(before) = before else {
            return f64::from(if at == 0 {
                scene.camera.density(outgoing)
            } else {
                scene
                    .lights
                    .emission_densities(self.light, surface.normal, outgoing)
                    .direction
            });
        };
        let frame = surface.frame();
        let (wi, wo) = (
            frame.to_local(self.direction(at, before).as_vec3()),
            frame.to_local(outgoing),
        );
        let (material, uv) = (surface.material, surface.uv);
        // From the camera where the path's numbers rise.
        let transport = if before < at {
            Transport::Radiance
        } else {
            Transport::Importance
        };
        if !self.nodes[at].discrete {
            return f64::from(scene.materials.evaluate(material, uv, wi, wo, transport).density);
        }
        // The draw that goes the same way.
        let ends = [0.0, 1.0_f32.next_down()];
        let draws = ends.iter().flat_map(|&direction| ends.map(|lobe| (direction, lobe)));
        let found = draws.filter_map(|(direction, lobe)| {
            let draw = ScatterDraw {
                direction: [direction; 2],
                lobe,
            };
            scene.materials.sample(material, uv, wi, draw, transport)
        });
        let nearest = found
            .filter(|found| found.discrete)
            .max_by(|a, b| a.wo.dot(wo).total_cmp(&b.wo.dot(wo)));
        nearest
            .filter(|found| found.wo.dot(wo) > 0.999)
            .map_or(0.0, |found| f64::from(found.density))
    }

    /// What a solid angle of directions from `a`, or an area of a plane that faces them, is as an area (a solid angle) of `b`.
    fn spread(&self, a: usize, b: usize) -> f64 {
        let (from, to) = (&self.nodes[a], &self.nodes[b]);
        if to.infinite {
            return 1.0;
        }
        let cosine = to.cosine(self.direction(a, b));
        if from.infinite {
            cosine
        } else {
            cosine / (to.position() - from.position()).length_squared()
        }
    }

    /// The unit direction from one vertex to another.
    fn direction(&self, from: usize, to: usize) -> DVec3 {
        let (a, b) = (&self.nodes[from], &self.nodes[to]);
        let of = |normal: Vec3| normal.as_dvec3();
        let direction = if a.infinite {
            of(a.surface.normal)
        } else if b.infinite {
            -of(b.surface.normal)
        } else {
            (b.position() - a.position()).normalize()
        };
        match self.turned {
            Some((edge, turn)) if edge == from.min(to) => {
                (direction + if from < to { turn } else { -turn }).normalize()
            }
            _ => direction,
        }
    }

    /// The index of refraction between two vertices that follow each other.
    fn index(&self, a: usize, b: usize) -> f64 {
        let (center, radius, index) = self.ball;
        let (a, b) = (&self.nodes[a], &self.nodes[b]);
        if self.mistake == Mistake::Refraction || a.infinite || b.infinite {
            return 1.0;
        }
        let middle = 0.5 * (a.position() + b.position());
        if (middle - center).length() < radius {
            index
        } else {
            1.0
        }
    }
}
