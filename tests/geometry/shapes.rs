//! Closed and open meshes that several tests share.

use super::dice::Dice;
use super::world::Triangle;
use glam::{DVec3, Vec3};

/// A parallelogram, seen from its front along u × v.
pub fn quad(corner: Vec3, u: Vec3, v: Vec3) -> [Triangle; 2] {
    let far = corner + u + v;
    [[corner, corner + u, far], [corner, far, corner + v]]
}

/// The inside of a box: normals point inwards.
pub fn room(min: Vec3, max: Vec3) -> Vec<Triangle> {
    let at = |x: usize, y: usize, z: usize| {
        let pick = |axis: usize, side: usize| if side == 0 { min[axis] } else { max[axis] };
        Vec3::new(pick(0, x), pick(1, y), pick(2, z))
    };
    let faces = [
        [at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)],
        [at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)],
        [at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)],
        [at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)],
        [at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)],
        [at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)],
    ];
    faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// An icosahedron, each face split in four `levels` times, vertices on the unit sphere.
pub fn icosphere(levels: u32) -> Vec<[DVec3; 3]> {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let signs = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
    let mut corners = Vec::new();
    for (a, b) in signs {
        corners.push(DVec3::new(0.0, a, b * golden));
        corners.push(DVec3::new(a, b * golden, 0.0));
        corners.push(DVec3::new(b * golden, 0.0, a));
    }
    let mut faces = Vec::new();
    for (i, &a) in corners.iter().enumerate() {
        for (j, &b) in corners.iter().enumerate().skip(i + 1) {
            for &c in &corners[j + 1..] {
                // Edges of this icosahedron are 2 long; the next nearest pair of corners is 3.2 apart.
                if [a.distance(b), b.distance(c), c.distance(a)].iter().all(|&d| d < 2.5) {
                    faces.push([a, b, c].map(DVec3::normalize));
                }
            }
        }
    }
    for _ in 0..levels {
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| (p + q).normalize());
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    faces
}

/// A closed mesh from one on the unit sphere: scaled, then moved.
pub fn placed(unit: &[[DVec3; 3]], scale: f64, center: DVec3) -> Vec<Triangle> {
    let place = |corner: DVec3| (corner * scale + center).as_vec3();
    unit.iter().map(|corners| corners.map(place)).collect()
}

/// A random point of a triangle: inside, on an edge, or at a corner.
pub fn point_on(triangle: Triangle, dice: &mut Dice) -> DVec3 {
    let [a, b, c] = triangle.map(Vec3::as_dvec3);
    let (mut u, mut v) = (dice.fine_unit(), dice.fine_unit());
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    match dice.below(4) {
        0 => (u, v) = (u, 0.0),
        1 => (u, v) = dice.pick(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]),
        _ => {}
    }
    a + (b - a) * u + (c - a) * v
}
