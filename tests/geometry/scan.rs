//! The oracle of the tree: every primitive against every ray, with formulas of its own.
//!
//! A triangle is met where the three signed volumes of the ray with its edges agree in sign (Plücker coordinates); a
//! sphere where a quadratic has real roots. What rounding could turn over is called unsure and not judged; with a
//! margin of zero nothing is, for worlds whose numbers are so short that f64 computes them exactly.

use super::world::{Line, Triangle};
use glam::{DVec3, Vec3};

#[derive(Clone, Copy, Debug)]
pub enum Shape {
    Triangle(Triangle),
    Sphere(Vec3, f32),
}

/// What the scan says of one primitive: where a line meets it, if it does.
#[derive(Clone, Debug, PartialEq)]
enum Meeting {
    Never,
    At(Vec<f64>),
    Unsure,
}

pub struct Scan {
    /// By instance, then primitive.
    pub shapes: Vec<Vec<Shape>>,
    /// Relative to the lengths that a volume is computed from.
    pub margin: f64,
}

/// What the scan says of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    Nothing,
    /// Distance and name of the lexicographic minimum, and whether another primitive is within 1e-6 of it.
    Hit(f64, (u32, u32), bool),
    Unsure,
}

impl Scan {
    fn each(&self, origin: Vec3, direction: DVec3) -> impl Iterator<Item = ((u32, u32), Meeting)> {
        self.shapes.iter().enumerate().flat_map(move |(instance, shapes)| {
            shapes.iter().enumerate().map(move |(primitive, shape)| {
                let meeting = match *shape {
                    Shape::Triangle(corners) => meet_triangle(corners, origin, direction, self.margin),
                    Shape::Sphere(center, radius) => meet_sphere(center, radius, origin, direction),
                };
                ((instance as u32, primitive as u32), meeting)
            })
        })
    }

    pub fn closest(&self, (origin, direction): Line) -> Verdict {
        let mut hits = Vec::new();
        for (name, meeting) in self.each(origin, direction.as_dvec3()) {
            match meeting {
                Meeting::Never => {}
                Meeting::Unsure => return Verdict::Unsure,
                Meeting::At(distances) => {
                    if distances.iter().any(|t| t.abs() < self.margin) {
                        return Verdict::Unsure;
                    }
                    hits.extend(distances.iter().filter(|&&t| t > 0.0).map(|&t| (t, name)));
                }
            }
        }
        hits.sort_by(|a, b| (a.0 as f32).total_cmp(&(b.0 as f32)).then(a.1.cmp(&b.1)));
        match hits.first() {
            None => Verdict::Nothing,
            Some(&(t, name)) => {
                let tied = hits.iter().any(|other| other.1 != name && other.0 <= t * (1.0 + 1e-6));
                Verdict::Hit(t, name, tied)
            }
        }
    }

    /// Whether a segment is free; `None` where the scan is unsure.
    pub fn free(&self, (origin, target): Line) -> Option<bool> {
        let mut free = Some(true);
        for (_, meeting) in self.each(origin, target.as_dvec3() - origin.as_dvec3()) {
            match meeting {
                Meeting::Never => {}
                Meeting::Unsure => free = None,
                Meeting::At(distances) => {
                    for t in distances {
                        if t > self.margin && t < 1.0 - self.margin {
                            return Some(false);
                        }
                        if t.abs().min((t - 1.0).abs()) < self.margin {
                            free = None;
                        }
                    }
                }
            }
        }
        free
    }
}

fn meet_triangle(corners: Triangle, origin: Vec3, direction: DVec3, margin: f64) -> Meeting {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3() - origin.as_dvec3());
    let [ab, bc, ca] = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| corners[j].as_dvec3() - corners[i].as_dvec3());
    // An edge p to q, seen from the origin: d · (p × q), with p × q = p × (q - p).
    let volumes = [(b, bc), (c, ca), (a, ab)].map(|(p, edge)| direction.dot(p.cross(edge)));
    let reach = a.length().max(b.length()).max(c.length());
    let longest = ab.length().max(bc.length()).max(ca.length());
    let doubt = margin * direction.length() * reach * longest;
    let above = volumes.iter().filter(|&&v| v >= 0.0 && v >= doubt).count();
    let below = volumes.iter().filter(|&&v| v <= 0.0 && v <= -doubt).count();
    let sum: f64 = volumes.iter().sum();
    if above == 3 || below == 3 {
        if sum == 0.0 {
            return Meeting::Never;
        }
        let normal = ab.cross(-ca);
        return Meeting::At(vec![normal.dot(a) / sum]);
    }
    let surely_above = volumes.iter().any(|&v| v > doubt);
    let surely_below = volumes.iter().any(|&v| v < -doubt);
    if surely_above && surely_below {
        Meeting::Never
    } else {
        Meeting::Unsure
    }
}

fn meet_sphere(center: Vec3, radius: f32, origin: Vec3, direction: DVec3) -> Meeting {
    let radius = f64::from(radius);
    let from_center = origin.as_dvec3() - center.as_dvec3();
    let a = direction.length_squared();
    let b = from_center.dot(direction);
    let c = from_center.length_squared() - radius * radius;
    let discriminant = b * b - a * c;
    if discriminant.abs() < 1e-9 * (b * b + a * (from_center.length_squared() + radius * radius)) {
        return Meeting::Unsure;
    }
    if discriminant < 0.0 {
        return Meeting::Never;
    }
    let root = discriminant.sqrt();
    Meeting::At(vec![(-b - root) / a, (-b + root) / a])
}
