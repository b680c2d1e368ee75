//! Cells to count samples in, and densities integrated over them.

use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// A rectangle of coordinates cut into cells, row by row.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Least and largest first coordinate.
    pub x: [f64; 2],
    /// Least and largest second coordinate.
    pub y: [f64; 2],
    /// Cells along the first coordinate.
    pub columns: usize,
    /// Cells along the second coordinate.
    pub rows: usize,
}

impl Grid {
    /// 20 x 20 cells of a first coordinate in `x` and an angle around in [0, 2π).
    pub const fn around(x: [f64; 2]) -> Self {
        Self {
            x,
            y: [0.0, TAU],
            columns: 20,
            rows: 20,
        }
    }

    /// 20 x 20 cells of the unit square.
    pub const fn unit_square() -> Self {
        Self {
            x: [0.0, 1.0],
            y: [0.0, 1.0],
            columns: 20,
            rows: 20,
        }
    }

    /// Number of cells.
    pub const fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// The cell of a point; the last number, [`len`](Self::len), for a point outside, which no density allows.
    pub fn cell(&self, [x, y]: [f64; 2]) -> usize {
        let place = |value: f64, [low, high]: [f64; 2], cells: usize| {
            let inside = value >= low && value <= high;
            inside.then(|| (((value - low) / (high - low) * cells as f64) as usize).min(cells - 1))
        };
        match (place(x, self.x, self.columns), place(y, self.y, self.rows)) {
            (Some(column), Some(row)) => row * self.columns + column,
            _ => self.len(),
        }
    }

    /// Counts points in the cells, those outside in one more.
    pub fn count(&self, points: impl Iterator<Item = [f64; 2]>) -> Vec<u64> {
        let mut counts = vec![0; self.len() + 1];
        for point in points {
            counts[self.cell(point)] += 1;
        }
        counts
    }

    /// `density` (per unit of both coordinates) integrated over every cell by Simpson's rule with `intervals` (even)
    /// along each side: for densities that are smooth inside cells.
    pub fn simpson(&self, intervals: usize, density: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let weight = |i: usize| match i {
            0 => 1.0,
            i if i == intervals => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        self.integrate(|[x, dx], [y, dy]| {
            let (hx, hy) = (dx / intervals as f64, dy / intervals as f64);
            let node = |i: usize, j: usize| weight(i) * weight(j) * density(x + hx * i as f64, y + hy * j as f64);
            let sum: f64 = (0..=intervals)
                .map(|j| (0..=intervals).map(|i| node(i, j)).sum::<f64>())
                .sum();
            sum * hx * hy / 9.0
        })
    }

    /// `density` integrated over every cell by the midpoint rule with `points` along each side: for densities that jump
    /// inside cells.
    pub fn midpoint(&self, points: usize, density: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        self.integrate(|[x, dx], [y, dy]| {
            let (hx, hy) = (dx / points as f64, dy / points as f64);
            let node = |i: usize, j: usize| density(x + hx * (i as f64 + 0.5), y + hy * (j as f64 + 0.5));
            let sum: f64 = (0..points).map(|j| (0..points).map(|i| node(i, j)).sum::<f64>()).sum();
            sum * hx * hy
        })
    }

    /// `cell` of every cell's start and length along both coordinates.
    fn integrate(&self, cell: impl Fn([f64; 2], [f64; 2]) -> f64) -> Vec<f64> {
        let (dx, dy) = (
            (self.x[1] - self.x[0]) / self.columns as f64,
            (self.y[1] - self.y[0]) / self.rows as f64,
        );
        let corner = |i: usize| {
            let (column, row) = (i % self.columns, i / self.columns);
            (self.x[0] + dx * column as f64, self.y[0] + dy * row as f64)
        };
        (0..self.len())
            .map(|i| {
                let (x, y) = corner(i);
                cell([x, dx], [y, dy])
            })
            .collect()
    }
}

/// The angle around of a point of the plane, in [0, 2π).
pub fn angle(x: f64, y: f64) -> f64 {
    let angle = libm::atan2(y, x);
    if angle < 0.0 { angle + TAU } else { angle }
}

/// The height z and the angle around of a direction: coordinates in which solid angle is area.
pub fn height_and_angle(direction: Vec3) -> [f64; 2] {
    let d = direction.as_dvec3();
    [d.z.clamp(-1.0, 1.0), angle(d.x, d.y)]
}

/// The unit direction of height `z` at the angle `phi`.
pub fn direction(z: f64, phi: f64) -> DVec3 {
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * libm::cos(phi), r * libm::sin(phi), z)
}

/// 1 − cos θ of a unit direction to +z, without cancellation near the pole.
pub fn one_minus_cos(d: DVec3) -> f64 {
    if d.z > 0.0 {
        let sin2 = d.x * d.x + d.y * d.y;
        sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt())
    } else {
        1.0 - d.z
    }
}
