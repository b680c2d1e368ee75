//! A triangle as the sieve of rays sees it: quickly, and so well that it never says no to a ray that meets it.

use crate::geometry::triangle::CornerRows;
use crate::tolerance::F32_ROUNDING;
use glam::{DVec3, Vec3};

/// Where numbers of the sieve are small: the scene moved to the origin and shrunk to about the cube from −1 to 1, by a power of two.
#[derive(Clone, Copy, Debug, Default)]
pub struct Frame {
    /// What becomes the origin.
    pub center: Vec3,
    /// What lengths are multiplied by; not a number where that would leave f32's range.
    pub scale: f32,
}

/// Scales beyond this, or below its inverse, are not used.
const MOST_SCALE: f64 = 1e30;

impl Frame {
    /// The frame of what lies between two corners.
    pub fn around(low: Vec3, high: Vec3) -> Self {
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let center = (0.5 * (low + high)).as_vec3();
        let half = (high - center.as_dvec3()).max(center.as_dvec3() - low).max_element();
        // The power of two at or below 1 / half, exactly: f64 without its fraction.
        const FRACTION: u64 = (1 << 52) - 1;
        let scale = f64::from_bits((1.0 / half).to_bits() & !FRACTION);
        let is_usable = (1.0 / MOST_SCALE..=MOST_SCALE).contains(&scale);
        Self {
            center,
            scale: if is_usable { scale as f32 } else { f32::NAN },
        }
    }
}

/// A triangle by the functions whose signs tell whether a line crosses it: with the line's direction d and moment m = o × d, an edge from p
/// to q lies on the side d · (p × q) + m · (q − p) (Plücker's coordinates; Shoemake 1998, "Plücker coordinate tutorial").
///
/// **What rounding does to a side.** With u = 2⁻²⁴, d at most 1, and `reach` the largest coordinate of o: inputs are off by u (o, and this
/// triangle's numbers) and 2 u (d), a moment by 10.2 u · reach, and six products and their sum by 7 u; together by at most
/// u (10 |p × q|₁ + 26.2 · reach · |q − p|₁). The exact test's own rounding, in f64, is below 10⁻¹⁴ (1 + reach)². What is
/// kept here is larger by half.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// p × q of each edge.
    pub normals: [[f32; 3]; 3],
    /// q − p of each edge.
    pub edges: [[f32; 3]; 3],
    /// The plane's normal, its components' sizes adding to one; zero where the triangle is too small for it.
    pub plane: [f32; 3],
    /// The same in f64: rays that leave a triangle start nearer to its plane than f32 tells.
    pub plane_f64: [f64; 3],
    /// The plane's distance from the origin in units of the normal.
    pub height: f64,
    /// How far off heights over the plane may be for each unit of (1 + reach)²: what the roundings of this normal make of them, and, times
    /// the height's share of the distance, what the exact test's weights are off by.
    pub height_slack: f32,
    /// How far off a side may be, whatever the ray.
    pub slack: f32,
    /// How far off a side may be for each unit of the ray's reach.
    pub slack_by_reach: f32,
}

/// Triangles of less than half this area are too small to tell at which distance they are: the exact test's own weights, the sides over
/// their sum, are then off by more than 10⁻⁴.
const SMALL: f64 = 1e-6;

fn one_norm(v: DVec3) -> f64 {
    v.abs().element_sum()
}

impl Facet {
    /// The facet of a triangle.
    pub fn new(corners: &CornerRows, frame: Frame) -> Self {
        let corner = |i: usize| {
            let corner = Vec3::from_array(corners.map(|row| row[i])).as_dvec3();
            (corner - frame.center.as_dvec3()) * f64::from(frame.scale)
        };
        let [a, b, c] = [0, 1, 2].map(corner);
        let normals = [b.cross(c), c.cross(a), a.cross(b)];
        let edges = [c - b, a - c, b - a];
        let largest = |of: [DVec3; 3]| of.map(one_norm).into_iter().fold(0.0, f64::max);
        let normal = (b - a).cross(c - a);
        let size = one_norm(normal);
        let plane = if size < SMALL { DVec3::ZERO } else { normal / size };
        let unit = f64::from(F32_ROUNDING);
        Self {
            normals: normals.map(|normal| normal.as_vec3().to_array()),
            edges: edges.map(|edge| edge.as_vec3().to_array()),
            plane: plane.as_vec3().to_array(),
            plane_f64: plane.to_array(),
            height: plane.dot(a),
            height_slack: (1e-13 / size) as f32,
            slack: (16.0 * unit * largest(normals)) as f32,
            slack_by_reach: (40.0 * unit * largest(edges)) as f32,
        }
    }
}
