//! The oracle of the tree: every primitive against every ray, with formulas of its own.
//!
//! A triangle is met where the three signed volumes of the ray with its edges agree in sign (Plücker coordinates); a
//! sphere or tube where a quadratic has real roots, a disk where the point of its plane is near enough. Rims are fuzzy. What rounding could turn over is called unsure and not judged; with a
//! margin of zero nothing is, for worlds whose numbers are so short that f64 computes them exactly.

use super::world::{Line, Triangle};
use glam::{DVec3, Vec3};

#[derive(Clone, Copy, Debug)]
pub enum Shape {
    Triangle(Triangle),
    Sphere(Vec3, f32),
    /// Centre, unit normal, radius.
    Disk(Vec3, Vec3, f32),
    /// Both ends, radius.
    Cylinder(Vec3, Vec3, f32),
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
                    Shape::Disk(center, normal, radius) => meet_disk(center, normal, radius, origin, direction),
                    Shape::Cylinder(from, to, radius) => meet_cylinder([from, to], radius, origin, direction),
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
        let height = ab.cross(-ca).dot(a);
        // So near the plane, how far it is along the line is anybody's guess.
        if height.abs() < margin * reach * longest * longest {
            return Meeting::Unsure;
        }
        return Meeting::At(vec![height / sum]);
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

/// How far from a rim, relative to its radius, the scan is sure: the tracer is to meet what lies just beyond.
const RIM: f64 = 1e-6;

fn meet_disk(center: Vec3, normal: Vec3, radius: f32, origin: Vec3, direction: DVec3) -> Meeting {
    let (radius, normal) = (f64::from(radius), normal.as_dvec3());
    let slant = normal.dot(direction);
    if slant == 0.0 {
        return Meeting::Never;
    }
    if slant.abs() < 1e-9 * direction.length() {
        return Meeting::Unsure;
    }
    // From the origin to its foot on the plane, and from there along the direction's part in the plane.
    let height = normal.dot(origin.as_dvec3() - center.as_dvec3());
    let foot = origin.as_dvec3() - normal * height;
    let t = -height / slant;
    let point = foot + (direction - normal * slant) * t;
    let off = (point - center.as_dvec3()).length() / radius - 1.0;
    if off.abs() < RIM {
        return Meeting::Unsure;
    }
    if off > 0.0 {
        Meeting::Never
    } else {
        Meeting::At(vec![t])
    }
}

fn meet_cylinder([from, to]: [Vec3; 2], radius: f32, origin: Vec3, direction: DVec3) -> Meeting {
    let axis = to.as_dvec3() - from.as_dvec3();
    let length = axis.length();
    // Products of vectors with the axis turn them by a quarter about it, which changes no lengths across.
    let across = |v: DVec3| v.cross(axis) / length;
    let (p, d) = (across(origin.as_dvec3() - from.as_dvec3()), across(direction));
    let (a, b, c) = (
        d.length_squared(),
        p.dot(d),
        p.length_squared() - f64::from(radius) * f64::from(radius),
    );
    if a == 0.0 {
        return Meeting::Never;
    }
    if a < 1e-12 * direction.length_squared() {
        return Meeting::Unsure;
    }
    let discriminant = b * b - a * c;
    if discriminant.abs() < 1e-9 * (b * b + a * (p.length_squared() + f64::from(radius) * f64::from(radius))) {
        return Meeting::Unsure;
    }
    if discriminant < 0.0 {
        return Meeting::Never;
    }
    let root = discriminant.sqrt();
    let mut distances = Vec::new();
    for t in [(-b - root) / a, (-b + root) / a] {
        let point = origin.as_dvec3() + direction * t;
        let along = (point - from.as_dvec3()).dot(axis) / (length * length);
        let fuzzy = RIM * (1.0 + f64::from(radius) / length);
        if along.abs().min((along - 1.0).abs()) < fuzzy {
            return Meeting::Unsure;
        }
        if (0.0..1.0).contains(&along) {
            distances.push(t);
        }
    }
    if distances.is_empty() {
        Meeting::Never
    } else {
        Meeting::At(distances)
    }
}
